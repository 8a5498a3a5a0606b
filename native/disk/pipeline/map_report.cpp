#include "pipeline/map_report.h"

#include "circles/circle_fit.h"
#include "circles/circle_projection.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

LoopReport report_loop(const MapInput& whole, const CircleMap& map, std::size_t k)
{
    LoopReport report;
    report.circle = map.circles[k];
    report.roundness = map.roundness[k];
    for (const auto* changed : {&map.shrunk, &map.lost, &map.replaced})
        report.shrunk |= std::ranges::count(*changed, static_cast<Index>(k)) > 0;
    VectorXcd points(static_cast<Eigen::Index>(whole.loops[k].size()));
    Eigen::Index count = 0;
    for (const Index v : whole.loops[k]) {
        const Complex point(map.uv(v, 0), map.uv(v, 1));
        report.vertices.push_back(whole.original[v]);
        if (std::ranges::binary_search(map.off_circle, v) || is_off_circle(report.circle, point))
            report.off_circle.push_back(whole.original[v]);
        else
            points[count++] = point;
    }
    std::rotate(report.vertices.begin(), std::min_element(report.vertices.begin(), report.vertices.end()),
                report.vertices.end());
    std::sort(report.off_circle.begin(), report.off_circle.end());
    report.roundness_projected = count > 0 ? deviation_from(report.circle, points.head(count)) : 0.0;
    return report;
}

}  // namespace

ConformalDomain domain_of(const MapInput& whole, const CircleMap& map, Index vertex_count)
{
    ConformalDomain domain{PlanarPoints::Zero(vertex_count, 2), {}};
    for (std::size_t k = 0; k < whole.loops.size(); ++k) domain.loops.push_back(report_loop(whole, map, k));
    domain.uv(whole.original, Eigen::all) = map.uv;
    return domain;
}

void keep_conformal(ConformalDomain domain, UniformizeResult& result)
{
    for (LoopReport& loop : result.loops) loop.shrunk = true;
    result.conformal = std::move(domain);
}

void report_map(const Vertices& vertices, const Triangles& triangles, const MapInput& whole, const CircleMap& map,
                UniformizeResult& result)
{
    ConformalDomain shown = domain_of(whole, map, result.vertex_count);
    result.loops = std::move(shown.loops);
    result.uv = std::move(shown.uv);
    result.distortion = {measure_distortion(whole.vertices, whole.surface.triangles, map.uv),
                         judge_disk(vertices, triangles, result.uv, whole.surface.reoriented)};
}

}  // namespace koebe
