#include "pipeline/flip_removal.h"

#include "ears/ear_map.h"
#include "pipeline/normalization.h"

#include <algorithm>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr double room_factor = 0.8;  // of a circle's radius
constexpr int most_rooms = 4;
constexpr std::size_t few_flips = 4;  // more flips have a worse cause than two circles too near
constexpr int most_starts = 4;
constexpr std::size_t some_flips = 16;    // left by a search that another start is worth,
constexpr std::size_t faces_a_flip = 50;  // at least: a coarser surface gets its map from embedded_map sooner

/// Shrinks the inner circles at which faces are still flipped: between two circles less than an edge apart, such faces
/// have no upright place. @return whether there are such circles
bool make_room(const MapInput& whole, const std::vector<Index>& flipped, CircleMap& map)
{
    std::set<Index> corners, loops;
    for (const Index f : flipped)
        for (int k = 0; k < 3; ++k) corners.insert(whole.surface.triangles(f, k));
    for (std::size_t k = 1; k < whole.loops.size(); ++k)
        if (std::ranges::any_of(whole.loops[k], [&](Index v) { return corners.contains(v); }))
            loops.insert(static_cast<Index>(k));
    for (const Index k : loops) {
        Circle& circle = map.circles[k];
        circle.radius *= room_factor;
        for (const Index v : whole.loops[k]) {
            const Complex at = circle.center + room_factor * (Complex(map.uv(v, 0), map.uv(v, 1)) - circle.center);
            map.uv.row(v) << at.real(), at.imag();
        }
        if (std::ranges::find(map.shrunk, k) == map.shrunk.end()) map.shrunk.push_back(k);
    }
    std::ranges::sort(map.shrunk);
    return !loops.empty();
}

/// Turns flipped faces back. Where few of them are left, shrinks circles and goes on.
UntangleReport search(const MapInput& whole, CircleMap& map, ExecutionContext& context)
{
    UntangleReport report;
    RepairEffort effort(whole.surface.triangles.rows());
    for (int i = 0;; ++i) {
        UntangleReport more = untangle(whole.vertices, whole.surface, whole.loops, map.circles, map.off_circle, map.uv,
                                       context, {.held = held_vertices(whole), .effort = &effort});
        map.off_circle.insert(map.off_circle.end(), more.freed.begin(), more.freed.end());
        std::sort(map.off_circle.begin(), map.off_circle.end());
        report.repairs += more.repairs;
        report.freed.insert(report.freed.end(), more.freed.begin(), more.freed.end());
        report.tangled = std::move(more.tangled);
        if (i == most_rooms || report.tangled.empty() || report.tangled.size() > few_flips ||
            !make_room(whole, report.tangled, map))
            break;
        effort.renew();  // the first search may have spent it all, and few problems are left
    }
    std::sort(report.freed.begin(), report.freed.end());
    return report;
}

}  // namespace

CircleMap with_ears(const MapInput& whole, const EarCut& cut, CircleMap map, ExecutionContext& context)
{
    if (cut.ears.empty()) return map;
    const PlanarPoints core_uv = std::move(map.uv);
    map.uv = PlanarPoints::Zero(whole.vertices.rows(), 2);
    map.uv(cut.vertices, Eigen::all) = core_uv;
    map.off_circle = lay_ears(whole.vertices, whole.surface.triangles, cut.ears, whole.loops, map.uv, context);
    std::sort(map.off_circle.begin(), map.off_circle.end());
    return map;
}

UntangleReport remove_flips(const MapInput& whole, CircleMap& map, ExecutionContext& context)
{
    CircleMap start = map;
    UntangleReport first = search(whole, map, context);
    const auto faces = static_cast<std::size_t>(whole.surface.triangles.rows());
    if (first.tangled.empty() || first.tangled.size() > std::min(some_flips, faces / faces_a_flip)) return first;
    CircleMap first_map = map;
    std::vector<Index> tangled = first.tangled;
    for (int i = 1; i < most_starts && make_room(whole, tangled, start); ++i) {
        map = start;
        UntangleReport report = search(whole, map, context);
        if (report.tangled.empty()) return report;
        tangled = std::move(report.tangled);
    }
    map = std::move(first_map);
    return first;
}

}  // namespace koebe
