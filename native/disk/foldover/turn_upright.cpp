#include "foldover/turn_upright.h"

#include "core/errors.h"
#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "foldover/repair_effort.h"
#include "foldover/void_mesh.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr std::array reach{2, 6, 18};  // rings

constexpr double void_weight = 1e-3;  // of a face of the void, over a face of the surface

/// What loops do: stay, move without meeting, or move.
enum class LoopsMay { stay, move_apart, move };

class FallenFaces {
public:
    FallenFaces(const Vertices& vertices, const Triangles& triangles, const std::vector<VertexLoop>& loops,
                const std::vector<char>& fixed, const PlanarPoints& points)
        : vertices_(vertices), triangles_(triangles), loops_(loops), fixed_(fixed), points_(points)
    {
        fallen_ = fallen(points);
    }

    const std::vector<Index>& faces() const { return fallen_; }

    /// Goes on from other points, if fewer faces are without positive area there.
    void go_on_from(PlanarPoints points)
    {
        if (!points.allFinite() || fallen(points).size() >= fallen_.size()) return;
        points_ = std::move(points);
        fallen_ = fallen(points_);
    }

    bool is_upright(Index f, const PlanarPoints& points) const { return signed_area(points, triangles_, f) > 0.0; }

    /// The space around the present points; none if their loops are not simple and apart.
    std::optional<VoidMesh> around() const
    {
        try {
            return void_mesh(loops_, points_, VoidPoints::own);
        } catch (const InputError&) {
            return {};
        }
    }

    /// @param around to be kept upright, too
    /// @return the points after; `right` says whether all faces are upright
    std::pair<bool, PlanarPoints> moved(int rings, bool hold_loops, const std::optional<VoidMesh>& around,
                                        RepairEffort& effort, const ExecutionContext& context) const
    {
        FoldoverProblem problem;
        problem.points = points_;
        problem.mobility = mobile(rings, hold_loops);
        std::vector<Index> faces;
        for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f)
            if (std::ranges::any_of(triangles_.row(f), [&](Index v) { return problem.mobility[v] != Mobility::held; }))
                faces.push_back(f);
        problem.triangles = triangles_(faces, Eigen::all);
        problem.reference = patch_shapes(vertices_, triangles_, points_, faces, PatchShape::surface).references;
        problem.floor = VectorXd::Zero(problem.triangles.rows());
        if (around) add_void(*around, void_weight, 0.0, problem);
        const Eigen::Index all = problem.triangles.rows();
        const int steps = faces.empty() ? 0 : effort.affordable(all);
        if (steps == 0) return {false, points_};
        const FoldoverResult done = minimize_foldover_free(problem, context, {.max_iterations = steps});
        effort.spend(all, done.iterations);
        const bool right = done.foldover_free && problem.points.allFinite() &&
                           std::ranges::all_of(faces, [&](Index f) { return is_upright(f, problem.points); }) &&
                           std::ranges::all_of(fallen_, [&](Index f) { return is_upright(f, problem.points); });
        return {right, problem.points.topRows(points_.rows())};
    }

private:
    std::vector<Index> fallen(const PlanarPoints& points) const
    {
        std::vector<Index> faces;
        for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f)
            if (!is_upright(f, points)) faces.push_back(f);
        return faces;
    }

    std::vector<Mobility> mobile(int rings, bool hold_loops) const
    {
        std::vector<char> near(static_cast<std::size_t>(points_.rows()), 0);
        for (const Index f : fallen_)
            for (const Index v : triangles_.row(f)) near[v] = 1;
        for (int ring = 1; ring < rings; ++ring) {
            std::vector<char> wider = near;
            for (const auto face : triangles_.rowwise())
                if (std::ranges::any_of(face, [&](Index v) { return near[v] != 0; }))
                    for (const Index v : face) wider[v] = 1;
            near = std::move(wider);
        }
        for (std::size_t v = 0; v < near.size(); ++v) near[v] = near[v] && !fixed_[v];
        if (hold_loops)
            for (const VertexLoop& loop : loops_)
                for (const Index v : loop) near[v] = 0;
        std::vector<Mobility> mobility;
        for (const char is_near : near) mobility.push_back(is_near ? Mobility::free : Mobility::held);
        return mobility;
    }

    const Vertices& vertices_;
    const Triangles& triangles_;
    const std::vector<VertexLoop>& loops_;
    const std::vector<char>& fixed_;
    PlanarPoints points_;
    std::vector<Index> fallen_;
};

}  // namespace

bool turn_upright(const Vertices& vertices, const Triangles& triangles, const std::vector<VertexLoop>& loops,
                  const std::vector<char>& fixed, PlanarPoints& points, const ExecutionContext& context)
{
    const FallenFaces first(vertices, triangles, loops, fixed, points);
    if (first.faces().empty()) return true;
    FallenFaces fallen = first;
    RepairEffort effort(triangles.rows());
    for (const LoopsMay loops_may : {LoopsMay::stay, LoopsMay::move_apart, LoopsMay::move}) {
        const bool apart = loops_may == LoopsMay::move_apart;
        const FallenFaces& start = loops_may == LoopsMay::move ? first : fallen;
        const std::optional<VoidMesh> around = apart && !effort.exhausted() ? start.around() : std::nullopt;
        if (apart && !around) continue;
        for (const int rings : reach) {
            auto [right, after] = start.moved(rings, loops_may == LoopsMay::stay, around, effort, context);
            // A void face without area holds nothing apart.
            if (right && (!apart || !loops_cross(loops, after, 0.0))) {
                points = std::move(after);
                return true;
            }
            if (loops_may == LoopsMay::stay) fallen.go_on_from(std::move(after));
        }
    }
    return false;
}

}  // namespace koebe
