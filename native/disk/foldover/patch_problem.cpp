#include "foldover/patch_problem.h"

#include "core/sort_unique.h"
#include "quality/stored_uv.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr double rounding = 3e-7;  // twice the area a face can lose by rounding, over its longest edge, disk units

class ProblemBuilder {
public:
    ProblemBuilder(const TangledMap& map, const std::vector<Index>& faces, PatchBoundary boundary)
        : map_(map), patch_(faces), boundary_(boundary)
    {
        auto& names = result_.vertices;
        for (const Index f : faces)
            names.insert(names.end(), map.triangles().row(f).begin(), map.triangles().row(f).end());
        sort_unique(names);
        result_.problem.points = map.uv()(names, Eigen::all);
        for (const Index v : names) {
            result_.problem.mobility.push_back(mobility(v));
            result_.problem.circles.push_back(map.loop_of(v) >= 0 ? map.circles()[map.loop_of(v)] : Circle{});
        }
    }

    PatchProblem run(PatchShape shape)
    {
        add_faces(shape);
        FoldoverProblem& problem = result_.problem;
        problem.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
        for (std::size_t i = 0; i < triangles_.size(); ++i) problem.triangles.row(i) = triangles_[i];
        problem.floor = Eigen::Map<const VectorXd>(floors_.data(), static_cast<Eigen::Index>(floors_.size()));
        return std::move(result_);
    }

private:
    Mobility mobility(Index v) const
    {
        const auto around = map_.faces_around(v);
        if (!map_.mobile(v, boundary_) || !std::all_of(around.begin(), around.end(), [&](Index f) {
                return std::binary_search(patch_.begin(), patch_.end(), f);
            }))
            return Mobility::held;
        return map_.place(v) == TangledMap::Place::on_circle ? Mobility::sliding : Mobility::free;
    }

    void add_faces(PatchShape shape)
    {
        std::vector<Index> faces;
        for (const Index f : patch_) {
            const auto corners = map_.triangles().row(f);
            if (std::any_of(corners.begin(), corners.end(), [&](Index v) { return result_.moves(result_.row(v)); }))
                faces.push_back(f);
        }
        const PatchShapes wanted = patch_shapes(map_.vertices(), map_.triangles(), map_.uv(), faces, shape);
        result_.problem.reference = wanted.references;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const Index f = faces[i];
            const auto corner = [&](int k) { return map_.uv().row(map_.triangles()(f, k % 3)).transpose(); };
            double area = wanted.areas[i];
            double longest = 1.5 * std::sqrt(area);
            for (int k = 0; k < 3; ++k) longest = std::max(longest, (corner(k) - corner(k + 1)).norm());
            const StoredFace face(map_.triangles(), map_.uv(), f);
            if (map_.touches_ear(f) && !face.doubtful()) {
                // An ear keeps the shape that fits into its hole.
                result_.problem.reference[i] << corner(1) - corner(0), corner(2) - corner(0);
                area = 0.5 * result_.problem.reference[i].determinant();
            }
            double floor = face.below_resolution() ? 0.0 : rounding * longest / (2.0 * area);
            if (!face.doubtful()) floor = std::min(floor, 2.0 * face.area() / area);
            triangles_.emplace_back(result_.row(map_.triangles()(f, 0)), result_.row(map_.triangles()(f, 1)),
                                    result_.row(map_.triangles()(f, 2)));
            floors_.push_back(floor);
        }
    }

    const TangledMap& map_;
    const std::vector<Index>& patch_;
    const PatchBoundary boundary_;
    PatchProblem result_;
    std::vector<Eigen::RowVector3<Index>> triangles_;
    std::vector<double> floors_;
};

}  // namespace

PatchProblem patch_problem(const TangledMap& map, const std::vector<Index>& faces, PatchShape shape,
                           PatchBoundary boundary)
{
    return ProblemBuilder(map, faces, boundary).run(shape);
}

}  // namespace koebe
