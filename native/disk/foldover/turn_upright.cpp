#include "foldover/turn_upright.h"

#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <array>
#include <utility>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr std::array reach{2, 6, 18};  // rings

class FallenFaces {
public:
    FallenFaces(const Vertices& vertices, const Triangles& triangles, const std::vector<VertexLoop>& loops,
                const std::vector<char>& fixed, const PlanarPoints& points)
        : vertices_(vertices), triangles_(triangles), loops_(loops), fixed_(fixed), points_(points)
    {
        for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
            if (!is_upright(f, points)) fallen_.push_back(f);
    }

    const std::vector<Index>& faces() const { return fallen_; }

    bool is_upright(Index f, const PlanarPoints& points) const { return signed_area(points, triangles_, f) > 0.0; }

    /// @return the points after; `right` says whether all faces are upright
    std::pair<bool, PlanarPoints> moved(int rings, bool hold_loops, const ExecutionContext& context) const
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
        const bool right = !faces.empty() && minimize_foldover_free(problem, context).foldover_free &&
                           problem.points.allFinite() &&
                           std::ranges::all_of(faces, [&](Index f) { return is_upright(f, problem.points); }) &&
                           std::ranges::all_of(fallen_, [&](Index f) { return is_upright(f, problem.points); });
        return {right, std::move(problem.points)};
    }

private:
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
    const PlanarPoints& points_;
    std::vector<Index> fallen_;
};

}  // namespace

bool turn_upright(const Vertices& vertices, const Triangles& triangles, const std::vector<VertexLoop>& loops,
                  const std::vector<char>& fixed, PlanarPoints& points, const ExecutionContext& context)
{
    const FallenFaces fallen(vertices, triangles, loops, fixed, points);
    if (fallen.faces().empty()) return true;
    for (const bool hold_loops : {true, false})
        for (const int rings : reach)
            if (auto [right, after] = fallen.moved(rings, hold_loops, context); right) {
                points = std::move(after);
                return true;
            }
    return false;
}

}  // namespace koebe
