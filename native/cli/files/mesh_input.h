// The input file of every sub-command: its polygons, and their triangles.
#pragma once

#include "core/errors.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"

#include <filesystem>
#include <string>
#include <vector>

namespace koebe::cli {

struct MeshInput {
    MeshFile file;  ///< kept if the file is to be written again
    PolygonMesh polygons;
    Triangulation triangulation;
    std::vector<Warning> warnings;
    std::string sha256;    ///< hash of the file, if requested; empty for a pipe or a device
    double seconds = 0.0;  ///< time to read and triangulate
};

struct ReadOptions {
    bool keep_file = true;     ///< needed to write the file's other contents again
    bool any_polygon = false;  ///< polygons that cannot be cut into triangles are a warning, not an error
    bool hash = false;         ///< computes sha256: takes as long as reading
    int threads = 1;           ///< at most; 0: all cores
};

/// @throws FileError, InputError, Cancelled
MeshInput read_mesh_input(const std::filesystem::path& path, const CancelToken& token, ReadOptions options = {});

/// The hash of a file before it is read; empty for a pipe or a device.
std::string input_hash(const std::filesystem::path& path);

/// Triangulates the polygons, and adds warnings about left out ones. @throws InputError
void triangulate_input(MeshInput& input, bool any_polygon);

/// The faces of the file that contain these triangles, each once.
std::vector<Index> filed_faces(const Triangulation& triangulation, const std::vector<Index>& triangles);

/// Changes the warnings' faces to the file's, and puts the warnings from reading first.
void add_input_warnings(const MeshInput& input, std::vector<Warning>& warnings);

/// Calls compute(), and changes an error's faces to the file's.
template <typename Compute>
auto with_filed_faces(const MeshInput& input, Compute&& compute)
{
    try {
        return compute();
    } catch (const TopologyError& error) {
        if (error.kind() != TopologyKind::disconnected) throw;
        throw TopologyError(error.kind(), error.what(), filed_faces(input.triangulation, error.elements()));
    } catch (const InputError& error) {
        if (error.elements_of() != ElementKind::faces) throw;
        throw InputError(error.what(), ElementKind::faces, filed_faces(input.triangulation, error.elements()));
    }
}

}  // namespace koebe::cli
