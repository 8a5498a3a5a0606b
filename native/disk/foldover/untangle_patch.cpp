#include "foldover/untangle_patch.h"

#include "core/uv_resolution.h"
#include "foldover/patch_problem.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <utility>

namespace koebe {
namespace {

/// A hash of all data that determines the result.
std::uint64_t hash_of(const FoldoverProblem& problem)
{
    std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a, of 64 bits at a time
    const auto take = [&](auto value) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ULL;
        hash ^= hash >> 32;
    };
    for (Eigen::Index v = 0; v < problem.points.rows(); ++v) {
        take(problem.points(v, 0));
        take(problem.points(v, 1));
        take(static_cast<std::int64_t>(problem.mobility[v]));
    }
    for (Eigen::Index f = 0; f < problem.triangles.rows(); ++f) {
        for (const Index v : problem.triangles.row(f)) take(static_cast<std::int64_t>(v));
        for (const double edge : problem.reference[f].reshaped()) take(edge);
        take(problem.floor[f]);
    }
    return hash;
}

}  // namespace

std::vector<std::vector<Index>> patches_around(const TangledMap& map, const std::vector<Index>& faces, int rings,
                                               PatchBoundary boundary)
{
    std::vector<char> taken(map.triangles().rows(), 0);
    for (const Index f : map.vertex_faces().with_rings(map.triangles(), faces, rings)) taken[f] = 1;
    // Vertices on the edge of the region are held: groups meet only there.
    const auto moves = [&](Index v) {
        for (const Index f : map.faces_around(v))
            if (!taken[f]) return false;
        return map.mobile(v, boundary);
    };
    std::vector<char> grouped(map.triangles().rows(), 0);
    std::map<Index, bool> moves_cache;
    std::vector<std::vector<Index>> result;
    for (const Index seed : faces) {
        if (std::exchange(grouped[seed], 1)) continue;
        std::vector<Index> group{seed};
        for (std::size_t head = 0; head < group.size(); ++head)
            for (int k = 0; k < 3; ++k) {
                const Index v = map.triangles()(group[head], k);
                const auto [known, fresh] = moves_cache.try_emplace(v, false);
                if (!fresh) continue;  // it does not move, or its faces are in a group already
                known->second = moves(v);
                if (!known->second) continue;
                for (const Index f : map.faces_around(v))
                    if (!std::exchange(grouped[f], 1)) group.push_back(f);
            }
        std::sort(group.begin(), group.end());
        result.push_back(std::move(group));
    }
    return result;
}

bool repair_patch(TangledMap& map, const std::vector<Index>& patch, PatchShape shape, PatchBoundary boundary,
                  RepairEffort& effort, const ExecutionContext& context)
{
    // Is there something to repair, and effort left for it? A problem that failed before fails again.
    const std::size_t tangled_before = map.tangled(patch).size(), lost_before = map.flipped(patch) - tangled_before;
    if (tangled_before == 0) return false;
    PatchProblem posed = patch_problem(map, patch, shape, boundary);
    const Eigen::Index faces = posed.problem.triangles.rows();
    const int affordable = faces > 0 ? effort.affordable(faces) : 0;
    if (affordable == 0) return false;
    const std::uint64_t name = hash_of(posed.problem);
    if (effort.has_failed(name)) return false;
    effort.spend(faces, minimize_foldover_free(posed.problem, context, {.max_iterations = affordable}).iterations);

    // Write the solution, and keep it if fewer faces are tangled and nothing else became worse: faces lost, loops that
    // cross, holes that turn over.
    const PlanarPoints before = map.uv()(posed.vertices, Eigen::all);
    std::vector<Index> moved_rim;
    for (std::size_t i = 0; i < posed.vertices.size(); ++i)
        if (posed.moves(i) && map.loop_of(posed.vertices[i]) >= 0) moved_rim.push_back(posed.vertices[i]);
    std::ranges::sort(moved_rim);
    const std::vector<int> holes = map.clockwise_holes(moved_rim);
    map.uv()(posed.vertices, Eigen::all) = posed.problem.points.topRows(before.rows());
    const std::size_t tangled_now = map.tangled(patch).size();
    if (posed.problem.points.allFinite() && tangled_now < tangled_before &&
        map.flipped(patch) - tangled_now <= lost_before && !map.loops_cross(moved_rim) &&
        std::ranges::includes(map.clockwise_holes(moved_rim), holes))
        return true;
    map.uv()(posed.vertices, Eigen::all) = before;
    if (affordable == FoldoverOptions{}.max_iterations) effort.note_failure(name);
    return false;
}

bool nudge_face(TangledMap& map, Index face)
{
    PlanarPoints& uv = map.uv();
    std::array<Index, 3> v{map.triangles()(face, 0), map.triangles()(face, 1), map.triangles()(face, 2)};
    for (const Index corner : v)
        if (map.loop_of(corner) != 0 || map.place(corner) != TangledMap::Place::on_circle || map.held(corner))
            return false;
    // The middle vertex is opposite to the longest edge.
    const auto opposite = [&](int k) { return (uv.row(v[(k + 1) % 3]) - uv.row(v[(k + 2) % 3])).squaredNorm(); };
    const int middle = opposite(0) > std::max(opposite(1), opposite(2)) ? 0 : opposite(1) > opposite(2) ? 1 : 2;
    std::vector<Index> around;
    for (const int k : {(middle + 1) % 3, (middle + 2) % 3})
        around.insert(around.end(), map.faces_around(v[k]).begin(), map.faces_around(v[k]).end());
    const std::size_t tangled_before = map.tangled(around).size();
    const PlanarPoints before = uv(v, Eigen::all);
    for (const int k : {(middle + 1) % 3, (middle + 2) % 3})
        uv.row(v[k]) *= (1.0 - inner_circle_tolerance) / uv.row(v[k]).norm();
    if (map.tangled(around).size() < tangled_before) return true;
    for (int k = 0; k < 3; ++k) uv.row(v[k]) = before.row(k);
    return false;
}

}  // namespace koebe
