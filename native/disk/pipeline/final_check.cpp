#include "pipeline/final_check.h"

#include "circles/crowded_circles.h"
#include "core/numbering.h"
#include "execution/thread_share.h"
#include "planar/boundary_crossings.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double disk_tolerance = 1e-12;  // disk units: some rounding errors of a point of the unit circle

double longest_loop_edge(const VertexLoop& loop, const PlanarPoints& uv)
{
    double longest = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        longest = std::max(longest, (uv.row(loop[(i + 1) % loop.size()]) - uv.row(loop[i])).norm());
    return longest;
}

}  // namespace

Warning MapFaults::warning(const std::string& beginning, const std::vector<Index>& original,
                           const std::vector<Index>& original_faces) const
{
    Warning warning{WarningKind::not_one_to_one, beginning};
    std::string& result = warning.sentence;
    const auto add = [&](std::size_t count, const std::string& what, Index first) {
        if (count == 0) return;
        if (result.size() > beginning.size()) result += "; ";
        result += std::to_string(count) + " " + what + ", the first is " + std::to_string(first);
    };
    add(not_finite.size(), "vertices without a place", not_finite.empty() ? 0 : original[not_finite.front()]);
    add(outside.size(), "vertices outside the disk", outside.empty() ? 0 : original[outside.front()]);
    add(bad_circles.size(), "circles that meet another, leave the disk or run the wrong way round",
        bad_circles.empty() ? 0 : bad_circles.front());
    add(crossings.size(), "crossings of loops, at vertices", crossings.empty() ? 0 : original[crossings.front().first]);
    if (flipped.empty()) return warning;
    warning.elements = values_at(original_faces, flipped);
    std::sort(warning.elements.begin(), warning.elements.end());
    if (result.size() > beginning.size()) result += "; ";
    result += std::to_string(flipped.size()) + " faces flipped";
    return warning;
}

MapFaults find_faults(const Triangles& triangles, const std::vector<VertexLoop>& loops, const PlanarPoints& uv,
                      const std::vector<Circle>& circles)
{
    MapFaults faults;
    const std::vector<Index> wrong = found_in_pieces(static_cast<Index>(uv.rows()), [&](Index v) {
        return !(std::hypot(uv(v, 0), uv(v, 1)) <= 1.0 + disk_tolerance);
    });
    for (const Index v : wrong)
        (std::isfinite(std::hypot(uv(v, 0), uv(v, 1))) ? faults.outside : faults.not_finite).push_back(v);
    faults.flipped = found_in_pieces(static_cast<Index>(triangles.rows()), [&](Index f) {
        const StoredFace face(triangles, uv, f);
        return face.doubtful() && !face.below_resolution();
    });
    for (std::size_t k = 1; k < circles.size(); ++k)
        if (!is_apart(circles, k)) faults.bad_circles.push_back(static_cast<int>(k));
    if (!faults.not_finite.empty()) return faults;
    faults.crossings = crossing_boundary_edges(loops, uv, 2.0 * uv_resolution);
    for (const int k : turned_loops(loops, uv, disk_tolerance))
        if (longest_loop_edge(loops[k], uv) >= 2.0 * uv_resolution) faults.bad_circles.push_back(k);
    return faults;
}

}  // namespace koebe
