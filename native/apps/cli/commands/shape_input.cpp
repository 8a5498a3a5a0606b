#include "cli/commands/shape_input.h"

#include "cli/files/mesh_input.h"
#include "cli/process/progress_line.h"
#include "core/counted.h"
#include "mesh/loop_with.h"
#include "mesh/topology.h"
#include "pipeline/uniformize.h"
#include "report/json.h"
#include "shape/conformal_module.h"
#include "shape/module_error.h"

#include <filesystem>
#include <utility>

namespace koebe::cli {

namespace {

constexpr double reported_change = 0.005;  // of a radius: about the bars of coarse meshes (docs/shapes.md)

/// Warns if polygons in place of smooth curves would change a radius by more than its error bar, or without bars by
/// more than 0.5 %.
void warn_about_rims(ShapeInput& shape, const VectorXd& change)
{
    VectorXd allowed = VectorXd::Constant(change.size(), reported_change);
    if (!shape.refined.empty()) {
        const VectorXd module = conformal_module(shape.circles);
        const VectorXd bars = module_error(module, conformal_module(shape.refined));
        // The radii of the module are its numbers 0, 2, 5, 8, ...
        for (Eigen::Index k = 1; k < change.size(); ++k) {
            const Eigen::Index radius = k == 1 ? 0 : 3 * k - 4;
            allowed[k] = bars[radius] / module[radius];
        }
    }
    Eigen::Index most = 0;
    if ((change.cwiseAbs() - allowed).maxCoeff(&most) <= 0.0) return;
    shape.warnings.push_back({WarningKind::coarse_mesh,
                              "the mesh is coarse at its rims: as polygons in place of smooth curves they have another "
                              "module, in which the radius of loop " +
                                  std::to_string(most) + " differs by about " +
                                  formatted("%+.2g %%", 100.0 * change[most]),
                              {},
                              "The option rims chooses"});
}

/// The circles that the options ask for.
void take_circles(ShapeInput& shape, const UniformizeResult& result, const Vertices& vertices,
                  const Triangles& triangles, const ShapeOptions& options, ExecutionContext& context)
{
    const std::vector<LoopReport>& loops = result.conformal_loops();
    if (options.rims == RimKind::polygonal) {
        PolygonalCircles polygonal = polygonal_circles(vertices, triangles, loops, options.map.threads, context);
        shape.circles = std::move(polygonal.circles);
        shape.refined = std::move(polygonal.of_upper_bounds);
        return;
    }
    for (const LoopReport& loop : loops) shape.circles.push_back(loop.circle);
    if (options.rims == RimKind::extrapolated) {
        shape.refined = refined_circles(vertices, triangles, loops, options.map, context);
        shape.circles = extrapolated_circles(shape.circles, shape.refined);
        return;
    }
    if (options.with_error) shape.refined = refined_circles(vertices, triangles, loops, options.map, context);
    warn_about_rims(shape, polygonal_changes(vertices, triangles, result.conformal_uv(), loops));
}

}  // namespace

ShapeInput read_shape(const std::string& path, const ShapeOptions& options, const CancelToken& token)
{
    const MeshInput input = read_mesh_input(path, token, {.keep_file = false, .weld = options.of_files.weld});
    ProgressLine progress(false);
    ExecutionContext context(progress.callback(), token);
    const Triangles& triangles = input.triangulation.triangles;
    UniformizeResult result =
        with_filed_faces(input, [&] { return uniformize(input.polygons.vertices, triangles, options.map, context); });

    require_own_circles(result.conformal_loops());
    ShapeInput shape{
        std::filesystem::path(path).filename().string(), options.rims, {}, {}, {}, {}, result.converged, {}};
    add_input_warnings(input, result.warnings);
    shape.warnings = std::move(result.warnings);
    const auto loops = analyze_surface(triangles, static_cast<Index>(input.polygons.vertices.rows())).loops;
    for (const LoopReport& loop : result.conformal_loops())
        shape.ranks.push_back(loop_with(loops, loop.vertices.front()));
    with_filed_faces(input, [&] { take_circles(shape, result, input.polygons.vertices, triangles, options, context); });
    shape.surface = conformal_surface(input.polygons.vertices, triangles, result);
    return shape;
}

nlohmann::ordered_json module_json(const ShapeInput& shape, const std::vector<int>& order)
{
    const VectorXd module = conformal_module(shape.circles, order);
    std::vector<Index> ranks;
    for (const int k : order) ranks.push_back(shape.ranks[k]);
    nlohmann::ordered_json json{{"version", KOEBE_VERSION},
                                {"input", shape.name},
                                {"converged", shape.converged},
                                {"rims", to_string(shape.rims)},
                                {"loops", ranks},
                                {"names", module_names(order.size())},
                                {"module", std::vector<double>(module.begin(), module.end())}};
    if (!shape.refined.empty()) {
        const VectorXd bars = module_error(module, conformal_module(shape.refined, order));
        json["errors"] = std::vector<double>(bars.begin(), bars.end());
    }
    json["warnings"] = to_json(shape.warnings);
    return json;
}

}  // namespace koebe::cli
