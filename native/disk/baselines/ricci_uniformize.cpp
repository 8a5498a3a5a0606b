#include "baselines/ricci_uniformize.h"

#include "circles/circle_fit.h"
#include "circles/moebius.h"
#include "core/counted.h"
#include "core/uv_resolution.h"
#include "execution/run_on_copies.h"
#include "linear/dense_spd.h"
#include "pipeline/final_check.h"
#include "pipeline/flip_removal.h"
#include "pipeline/map_input.h"
#include "pipeline/map_report.h"
#include "pipeline/map_warnings.h"
#include "pipeline/normalization.h"
#include "quality/map_clock.h"
#include "quality/take_verdict.h"
#include "surface/intrinsic_metric.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double flat = 1e-5;             // radians of curvature that remains at a vertex
constexpr double worth_a_warning = 1e-3;  // relative change of a length

/// Puts vertices of the outer loop that lie outside the unit disk onto its circle.
void draw_in(const VertexLoop& outer, PlanarPoints& points)
{
    for (const Index v : outer)
        if (const double radius = points.row(v).norm(); radius > 1.0) points.row(v) /= radius;
}

/// The flow's layout with circles fitted to its loops, and two loops concentric.
CircleMap in_normal_position(const RicciFlowResult& flow, const MapInput& input)
{
    CircleMap map;
    std::vector<Circle> circles;
    for (const VectorXcd& loop : flow.outcome.loops) circles.push_back(fit_circle_least_squares(loop));
    circles[0] = Circle{};
    Moebius moebius;
    if (circles.size() == 2 && std::abs(circles[1].center) + circles[1].radius < 1.0)
        moebius = center_circle(circles[1]);
    const VectorXcd positions = moebius(flow.positions);
    for (std::size_t k = 0; k < circles.size(); ++k) {
        map.circles.push_back(k == 0 ? circles[0] : moebius(circles[k]));
        map.roundness.push_back(roundness(gather_loop(positions, input.loops[k]), map.circles[k]));
    }
    map.uv.resize(positions.size(), 2);
    map.uv << positions.real(), positions.imag();
    draw_in(input.loops[0], map.uv);
    return map;
}

UniformizeResult run_pipeline(const Vertices& vertices, const Triangles& triangles, const RicciOptions& options,
                              ExecutionContext& context)
{
    UniformizeResult result;
    result.method = options.common.method;
    result.engine = options.common.engine;
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    result.center = options.common.center;
    result.point = options.common.point;
    MapClock clock;

    context.begin_stage("topology", 0.0, 0.05);
    const MapInput whole = prepare_input(vertices, triangles, options.common);
    EarCut cut = cut_ears(whole.vertices, whole.surface, whole.loops);
    std::optional<MapInput> core;
    if (!cut.ears.empty()) core = core_input(whole, cut);
    const MapInput& input = core ? *core : whole;
    result.outer_loop = input.outer_rank;
    clock.end(&StageSeconds::topology);

    context.begin_stage("metric", 0.05, 0.1);
    const IntrinsicMetric metric = intrinsic_metric(input.vertices, input.surface, {.delaunay = options.delaunay});
    clock.end(&StageSeconds::metric);

    context.begin_stage("iterate", 0.1, 0.9);
    RicciFlowOptions flow_options{.packing = options.packing,
                                  .target = options.target,
                                  .tolerance = options.common.tolerance,
                                  .max_updates = options.common.max_sweeps,
                                  .newton = {}};
    const RicciFlowResult flow = [&] {
        fix_product_blocks();
        return ricci_flow(metric, input.surface.vertex_count, input.loops, flow_options, context);
    }();
    result.converged = flow.outcome.converged;
    result.sweeps = flow.outcome.sweeps;
    result.steps = flow.outcome.steps;
    result.history = flow.outcome.history;
    clock.end(&StageSeconds::iterate);

    context.begin_stage("finish", 0.9, 1.0);
    CircleMap map = in_normal_position(flow, input);
    const std::size_t own_flips = flipped_faces(input.surface.triangles, map.uv).size();
    map = with_ears(whole, cut, std::move(map), context);
    normalize(whole, map);
    // A surface that is not flat has no layout: flips are everywhere, and untangling them would be useless.
    const UntangleReport untangled = flow.curvature_error < flat ? remove_flips(whole, map, context) : UntangleReport{};
    report_map(vertices, triangles, whole, map, result);

    result.warnings = input_warnings(whole);
    if (!result.converged) result.warnings.push_back({WarningKind::not_converged, "not converged: " + flow.reason});
    if (flow.packing_change > worth_a_warning)
        result.warnings.push_back(
            {WarningKind::packing,
             formatted("the circle packing changes edge lengths by up to %.2g of themselves", flow.packing_change)});
    if (flow.closing_gap > circle_tolerance)
        result.warnings.push_back({WarningKind::closing_gap,
                                   formatted("holes do not close: gaps up to %.2g of their length", flow.closing_gap)});
    if (own_flips > 0)
        result.warnings.push_back(
            {WarningKind::flow_flips, "faces flipped by the flow's own map: " + std::to_string(own_flips)});
    for (Warning& warning : flip_warnings(whole, map.uv, cut.ears, untangled, result.distortion))
        result.warnings.push_back(std::move(warning));
    if (const MapFaults faults = find_faults(whole.surface.triangles, whole.loops, map.uv, map.circles); faults.any()) {
        result.converged = false;
        result.warnings.push_back(faults.warning("not one to one: ", whole.original, whole.original_faces));
    }
    take_verdict({.most_lost = options.common.most_lost, .done = true}, result);
    clock.finish(result, context);
    return result;
}

}  // namespace

UniformizeResult ricci_uniformize(const Vertices& vertices, const Triangles& triangles, const RicciOptions& options,
                                  ExecutionContext& context)
{
    return run_on_copies<UniformizeResult>(context, run_pipeline, vertices, triangles, options);
}

}  // namespace koebe
