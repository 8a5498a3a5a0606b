#include "cli/commands/shape_input.h"

#include "cli/files/mesh_input.h"
#include "cli/process/progress_line.h"
#include "mesh/loop_with.h"
#include "mesh/topology.h"
#include "pipeline/uniformize.h"
#include "report/json.h"
#include "shape/conformal_module.h"
#include "shape/module_error.h"

#include <filesystem>
#include <utility>

namespace koebe::cli {

ShapeInput read_shape(const std::string& path, const UniformizeOptions& options, const CancelToken& token,
                      bool with_refined)
{
    const MeshInput input = read_mesh_input(path, token, {.keep_file = false});
    ProgressLine progress(false);
    ExecutionContext context(progress.callback(), token);
    const Triangles& triangles = input.triangulation.triangles;
    UniformizeResult result =
        with_filed_faces(input, [&] { return uniformize(input.polygons.vertices, triangles, options, context); });

    require_own_circles(result.conformal_loops());
    ShapeInput shape{std::filesystem::path(path).filename().string(), {}, {}, {}, {}, result.converged, {}};
    add_input_warnings(input, result.warnings);
    shape.warnings = std::move(result.warnings);
    const auto loops = analyze_surface(triangles, static_cast<Index>(input.polygons.vertices.rows())).loops;
    for (const LoopReport& loop : result.conformal_loops()) {
        shape.circles.push_back(loop.circle);
        shape.ranks.push_back(loop_with(loops, loop.vertices.front()));
    }
    if (with_refined)
        shape.refined = refined_circles(input.polygons.vertices, triangles, result.conformal_loops(), options, context);
    shape.surface = conformal_surface(input.polygons.vertices, triangles, result);
    return shape;
}

nlohmann::ordered_json module_json(const ShapeInput& shape, const std::vector<int>& order)
{
    const VectorXd module = conformal_module(shape.circles, order);
    std::vector<Index> ranks;
    for (const int k : order) ranks.push_back(shape.ranks[k]);
    return {{"version", KOEBE_VERSION},
            {"input", shape.name},
            {"converged", shape.converged},
            {"loops", ranks},
            {"names", module_names(order.size())},
            {"module", std::vector<double>(module.begin(), module.end())},
            {"warnings", to_json(shape.warnings)}};
}

}  // namespace koebe::cli
