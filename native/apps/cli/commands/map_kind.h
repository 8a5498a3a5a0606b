// A kind of map, as the command runs it: how it is computed, written, drawn and reported.
#pragma once

#include "cli/files/mesh_input.h"
#include "cli/options/map_request.h"
#include "cli/process/roomy_heap.h"
#include "core/warning.h"
#include "io/atomic_file.h"
#include "pipeline/result.h"
#include "quality/distortion.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace koebe::cli {

/// The differences between kinds of maps. The result has `seconds`, `converged`, `warnings` and `distortion`.
template <typename Result>
struct MapKind {
    bool any_polygon = false;  ///< see ReadOptions
    bool many_pieces = false;  ///< threads work on several pieces side by side
    /// Computes the map. All numbers in the result are the file's.
    std::function<Result(const MeshInput&, ExecutionContext&)> compute;
    /// Writes the mesh. Returns warnings about replaced or lost contents of the file.
    std::function<std::vector<Warning>(AtomicFile&, const MeshInput&, const Result&)> write_mesh;
    /// Writes the mesh of --sphere, if requested; returns such warnings.
    std::function<std::vector<Warning>(AtomicFile&, const MeshInput&, const Result&)> write_sphere;
    /// Writes more files than the request names, if there are any.
    std::function<void(std::vector<AtomicFile>&, const Result&)> write_more;
    /// u and v of the file's corners, (C, 2), for a GLB file.
    std::function<PlanarPoints(const MeshInput&, const Result&)> corner_uvs;
    std::function<std::string(const MeshInput&, const Result&)> draw;
    std::function<nlohmann::ordered_json(const Result&)> report;
    std::function<std::string(const Result&)> first_words;  ///< of the result line, after the file's name
};

/// Begins a run, before anything is read. @return how its file is read @throws FileError a file cannot be written
template <typename Result>
ReadOptions begin_run(const MapRequest& request, const MapKind<Result>& kind)
{
    if (!kind.many_pieces) take_roomy_heap();
    require_writable_files(map_files(request), !request.quiet);
    return {.any_polygon = kind.any_polygon,
            .hash = !request.json.empty(),
            .weld = request.of_files.weld,
            .threads = request.options.threads};
}

/// The kind of a map to the disk, without its computation.
MapKind<UniformizeResult> disk_map(const MapRequest& request);

/// The result line: the file, the first words, and the figures that all maps have.
std::string map_line(const MapRequest& request, const std::string& first_words, const Distortion& distortion,
                     double seconds, bool converged, const std::vector<Warning>& warnings);

/// Adds warnings about contents that a written file does not keep. @param file put before each sentence
void add_losses(const std::string& file, const std::vector<Warning>& losses, std::vector<Warning>& warnings);

}  // namespace koebe::cli
