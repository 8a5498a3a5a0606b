// The input file of every sub-command: its polygons, and their triangles.
#pragma once

#include "core/errors.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "io/mesh_formats.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace koebe::cli {

struct MeshInput {
    MeshFile file;                      ///< kept if the file is to be written again
    PolygonMesh polygons;               ///< as they are written again
    std::vector<Index> first;           ///< (V) with --weld: the vertex that each one is joined to; else empty
    std::optional<PolygonMesh> joined;  ///< with --weld: the polygons with joined corners
    Triangulation triangulation;        ///< of the joined polygons
    std::vector<Warning> warnings;
    std::vector<Index> marks;  ///< (C) see MeshFormat::corner_marks; empty: none
    PlanarPoints uvs;          ///< (C, 2) the file's own, of the polygons' corners, if requested
    std::string sha256;        ///< hash of the file, if requested; empty for a pipe or a device
    double seconds = 0.0;      ///< time to read and triangulate

    const PolygonMesh& mapped_polygons() const { return joined ? *joined : polygons; }
    /// The vertex that stands for a vertex in the map; also -1 for none.
    Index mapped(Index vertex) const
    {
        const bool is_joined = vertex >= 0 && vertex < static_cast<Index>(first.size());
        return is_joined ? first[static_cast<std::size_t>(vertex)] : vertex;
    }
    /// Gives joined vertices the row of the vertex that they are joined to.
    template <typename Rows>
    void give_to_joined(Rows& rows) const
    {
        for (Index v = 0; v < static_cast<Index>(first.size()); ++v)
            if (mapped(v) != v) rows.row(v) = rows.row(mapped(v)).eval();
    }
};

/// Changes the vertices that options name to the vertices that stand for them in the map.
template <typename Options>
void name_mapped_vertices(const MeshInput& input, Options& options)
{
    if constexpr (requires { options.outer_vertex; }) {
        options.outer_vertex = input.mapped(options.outer_vertex);
        options.center = input.mapped(options.center);
        options.point = input.mapped(options.point);
    }
    if constexpr (requires { options.inner; }) {
        options.outer = input.mapped(options.outer);
        options.inner = input.mapped(options.inner);
    }
    if constexpr (requires { options.around; }) options.around = input.mapped(options.around);
}

struct ReadOptions {
    bool keep_file = true;     ///< needed to write the file's other contents again
    bool any_polygon = false;  ///< polygons that cannot be cut into triangles are a warning, not an error
    bool hash = false;         ///< computes sha256: takes as long as reading
    std::optional<double> weld = {};
    std::vector<Index> first = {};  ///< with weld: joins as they were found in another file of a sequence
    int threads = 1;                ///< at most; 0: all cores
    CutAt cut_at = CutAt::nothing;
    std::optional<int> uv_set = {};  ///< reads the file's texture coordinates; the set where it has several
};

/// @throws FileError, InputError, Cancelled
MeshInput read_mesh_input(const std::filesystem::path& path, const CancelToken& token, const ReadOptions& options = {});

/// Reads a file. @param sha256 takes its hash before, if the options ask for it; stays empty for a pipe or a device
/// @throws FileError
MeshFile read_hashed(const std::filesystem::path& path, const ReadOptions& options, std::string& sha256);

/// Joins vertices, triangulates the polygons, and adds warnings about left out ones, and about coincident vertices.
/// @throws InputError
void triangulate_input(MeshInput& input, const ReadOptions& options);

/// Numbers of the file's faces, as numbers of the triangles. @throws InputError there are not as many as faces
std::vector<double> of_triangles(const MeshInput& input, const std::vector<double>& of_faces);

/// The edges at which faces with different marks meet, as pairs of vertices of the map.
std::vector<std::array<Index, 2>> marked_edges(const MeshInput& input);

/// The faces of the file that contain these triangles, each once.
std::vector<Index> filed_faces(const Triangulation& triangulation, const std::vector<Index>& triangles);

/// Changes the warnings' faces to the file's, takes joined vertices out of those that no face has, and puts the
/// warnings from reading first.
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
