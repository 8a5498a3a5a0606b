#include "cli/commands/map_command.h"

#include "cli/commands/map_run.h"
#include "cli/options/loop_options.h"
#include "core/counted.h"
#include "pipeline/convex_disk.h"
#include "report/svg.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace koebe::cli {

std::string map_line(const MapRequest& request, const std::string& first_words, const Distortion& distortion,
                     double seconds, bool converged, const std::vector<Warning>& warnings)
{
    std::string line = one_line(request.output) + ": " + first_words + ", angle error " +
                       formatted("%.2f", distortion.angle_error_deg.mean) + " deg, " +
                       std::to_string(distortion.flipped.size()) + " flipped";
    if (const std::size_t tiny = distortion.below_resolution.size(); tiny > 0)
        line += " (" + std::to_string(tiny) + " below resolution)";
    return line + last_words(seconds, converged, warnings);
}

void add_losses(const std::string& file, const std::vector<Warning>& losses, std::vector<Warning>& warnings)
{
    for (Warning loss : losses) {
        loss.sentence = file + loss.sentence;
        warnings.push_back(std::move(loss));
    }
}

MapKind<UniformizeResult> disk_map(const MapRequest& request)
{
    MapKind<UniformizeResult> kind;
    kind.write_mesh = [format = request.format](AtomicFile& file, const MeshInput& input,
                                                const UniformizeResult& result) {
        return write_with_uvs(file, *format, input.polygons, result.uv, {input.file});
    };
    kind.corner_uvs = [](const MeshInput& input, const UniformizeResult& result) {
        return PlanarPoints(0.5 * (1.0 + result.uv(input.polygons.corners, Eigen::all).array()));
    };
    kind.draw = [](const MeshInput& input, const UniformizeResult& result) { return to_svg(result, input.polygons); };
    kind.report = [](const UniformizeResult& result) { return to_json(result); };
    kind.first_words = [](const UniformizeResult& result) {
        double roundness = 0.0;
        for (const LoopReport& loop : result.loops) roundness = std::max(roundness, loop.roundness.paper);
        return counted(result.loops.size(), "loop") + ", " + counted(static_cast<std::size_t>(result.sweeps), "sweep") +
               ", roundness " + formatted("%.1e", roundness);
    };
    return kind;
}

int run_map(const MapRequest& request, const MapFunction& compute)
{
    MapKind<UniformizeResult> kind = disk_map(request);
    kind.compute = [&](const MeshInput& input, ExecutionContext& context) {
        UniformizeOptions options = request.options;
        name_mapped_vertices(input, options);
        UniformizeResult result = with_filed_faces(input, [&] {
            require_fitting_vertices(input, options);
            UniformizeResult made = compute(input.polygons.vertices, input.triangulation.triangles, options, context);
            make_polygons_convex(input.polygons.vertices, input.triangulation.triangles, input.triangulation.face, made,
                                 context);
            return made;
        });
        input.give_to_joined(result.uv);
        add_input_warnings(input, result.warnings);
        return result;
    };
    return run_map_of(request, kind);
}

}  // namespace koebe::cli
