// A kind of map, as the command runs it: how it is computed, written, drawn and reported.
#pragma once

#include "cli/files/mesh_input.h"
#include "cli/options/map_request.h"
#include "core/warning.h"
#include "files/atomic_file.h"
#include "quality/distortion.h"
#include "report/svg.h"

#include <optional>
#include <string>
#include <vector>

namespace koebe::cli {

/// A kind of map. Each command has a class of its own for its kind. The result has `seconds`, `converged`, `warnings`
/// and `distortion`, and to_json() makes its report.
template <typename Result>
class MapKind {
public:
    virtual ~MapKind() = default;

    virtual bool any_polygon() const { return false; }  ///< see ReadOptions
    virtual bool takes_uvs() const { return false; }    ///< whether it needs the file's own texture coordinates
    /// Computes the map. All numbers in the result are the file's.
    virtual Result compute(const MeshInput&, ExecutionContext&) const = 0;
    /// Writes the mesh. Returns warnings about replaced or lost contents of the file.
    virtual std::vector<Warning> write_mesh(AtomicFile&, const MeshInput&, const Result&) const = 0;
    /// Writes the mesh of --sphere; returns such warnings.
    virtual std::vector<Warning> write_sphere(AtomicFile&, const MeshInput&, const Result&) const { return {}; }
    /// Writes more files than the request names.
    virtual void write_more(std::vector<AtomicFile>&, const Result&) const {}
    /// u and v of the file's corners, (C, 2), for a GLB file.
    virtual PlanarPoints corner_uvs(const MeshInput&, const Result&) const { return {}; }
    virtual std::string draw(const MeshInput&, const Result&) const { return {}; }
    virtual std::string first_words(const Result&) const = 0;  ///< of the result line, after the file's name
};

/// Begins a run, before anything is read. @return how its file is read @throws FileError a file cannot be written
template <typename Result>
ReadOptions begin_run(const MapRequest& request, const MapKind<Result>& kind)
{
    require_writable_files(map_files(request), !request.quiet);
    return {.any_polygon = kind.any_polygon(),
            .hash = !request.json.empty(),
            .weld = request.of_files.weld,
            .threads = request.options.threads,
            .cut_at = request.of_files.cut_at,
            .uv_set = kind.takes_uvs() ? std::optional(request.of_files.uv_channel) : std::nullopt};
}

/// A map to the disk.
template <typename Result>
class DiskKind : public MapKind<Result> {
public:
    explicit DiskKind(const MapRequest& request) : request_(request) {}

    std::vector<Warning> write_mesh(AtomicFile& file, const MeshInput& input, const Result& result) const override
    {
        return write_with_uvs(file, *request_.format, input.polygons, result.uv, {input.file});
    }
    PlanarPoints corner_uvs(const MeshInput& input, const Result& result) const override
    {
        return 0.5 * (1.0 + result.uv(input.polygons.corners, Eigen::all).array());
    }
    std::string draw(const MeshInput& input, const Result& result) const override
    {
        return to_svg(result, input.polygons);
    }

protected:
    const MapRequest& request_;
};

/// The result line: the file, the first words, and the figures that all maps have.
std::string map_line(const MapRequest& request, const std::string& first_words, const Distortion& distortion,
                     double seconds, bool converged, const std::vector<Warning>& warnings);

/// Adds warnings about contents that a written file does not keep. @param file put before each sentence
void add_losses(const std::string& file, const std::vector<Warning>& losses, std::vector<Warning>& warnings);

}  // namespace koebe::cli
