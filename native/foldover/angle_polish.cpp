#include "foldover/angle_polish.h"

#include "foldover/patch_problem.h"
#include "quality/distortion.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr int most_passes = 6;
constexpr double worthwhile = 2e-3;       // relative fall of the angle error that another pass is made for
constexpr double least_distortion = 0.1;  // |mu| at which a weight is taken, over the mean
constexpr double flat = 1e-3;             // (1 - |mu|^2) / (1 + |mu|^2) of a face that keeps its vertices
constexpr int most_restorations = 16;     // of vertices around faces that a pass has flipped

/// (1 - |mu|^2) / (1 + |mu|^2) for each face.
VectorXd conformality(const FoldoverProblem& problem)
{
    VectorXd ratio(problem.triangles.rows());
    for (Eigen::Index f = 0; f < ratio.size(); ++f) {
        const auto corner = [&](int k) { return problem.points.row(problem.triangles(f, k)).transpose(); };
        Eigen::Matrix2d image;
        image << corner(1) - corner(0), corner(2) - corner(0);
        const Eigen::Matrix2d j = image * problem.reference[f].inverse();
        ratio[f] = std::clamp(2.0 * j.determinant() / j.squaredNorm(), 1e-30, 1.0);
    }
    return ratio;
}

/// conformality / |mu| for each face: so weighted, the sum's excess over that of a conformal map is 4 |mu| / (1 +
/// |mu|^2) a face, to first order its angle error.
VectorXd distortion_weights(const FoldoverProblem& problem)
{
    const VectorXd ratio = conformality(problem);
    const VectorXd mu = ((1.0 - ratio.array()) / (1.0 + ratio.array())).sqrt();
    return ratio.array() / mu.array().max(least_distortion * mu.mean() + 1e-30);
}

class AnglePolish {
public:
    AnglePolish(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                const std::vector<Index>& held)
        : vertices_(vertices),
          triangles_(surface.triangles),
          loops_(loops),
          circles_(circles),
          off_circle_(surface.vertex_count, 0),
          uv_(uv),
          map_(vertices, surface, loops, circles, off_circle, uv)
    {
        for (const Index v : held) map_.hold(v);
        std::vector<Index> faces(triangles_.rows());
        std::iota(faces.begin(), faces.end(), 0);
        problem_ = patch_problem(map_, faces, PatchShape::surface, PatchBoundary::sliding).problem;
        problem_.floor.setZero();
        for (const Index v : off_circle) {
            off_circle_[v] = 1;
            problem_.mobility[v] = Mobility::held;
        }
        const VertexLoop& outer = loops[0];
        std::size_t first = 0, pins = loops.size() == 1 ? 3 : 1;
        for (const Index v : held)
            if (map_.loop_of(v) == 0)
                first = static_cast<std::size_t>(std::ranges::find(outer, v) - outer.begin());
            else
                pins = 1;
        for (std::size_t i = 0; i < pins; ++i)
            problem_.mobility[outer[(first + i * outer.size() / 3) % outer.size()]] = Mobility::held;
        const VectorXd ratio = conformality(problem_);
        for (Eigen::Index f = 0; f < ratio.size(); ++f)
            if (ratio[f] < flat)
                for (const Index v : problem_.triangles.row(f)) problem_.mobility[v] = Mobility::held;
        for (std::size_t k = 0; k < loops.size(); ++k) ordered_.push_back(out_of_order(k).empty());
    }

    bool run(ExecutionContext& context)
    {
        const FoldoverOptions one_step{.max_iterations = 1, .area_weight = 0.0};
        const std::size_t tangled = map_.tangled().size();
        double error = angle_error();
        bool better = false;
        for (int pass = 0; pass < most_passes; ++pass) {
            context.advance(static_cast<double>(pass) / most_passes);
            const PlanarPoints before = uv_;
            problem_.points = before;
            problem_.weight = distortion_weights(problem_);
            minimize_foldover_free(problem_, context, one_step);
            uv_ = problem_.points;
            const double now = uv_.allFinite() && restore_flipped(before, tangled) ? angle_error() : error;
            if (!(now < error)) {
                uv_ = before;
                break;
            }
            better = true;
            const bool last = now > (1.0 - worthwhile) * error;
            error = now;
            if (last) break;
        }
        return better;
    }

private:
    double angle_error() const { return measure_distortion(vertices_, triangles_, uv_).angle_error_deg.mean; }

    /// The ends of a loop's edges that run backwards, if its vertices that are on its circle do not run round it once.
    std::vector<Index> out_of_order(std::size_t k) const
    {
        std::vector<Index> on, back;
        for (const Index v : loops_[k])
            if (!off_circle_[v]) on.push_back(v);
        const auto arm = [&](Index v) { return Complex(uv_(v, 0), uv_(v, 1)) - circles_[k].center; };
        double sum = 0.0;
        for (std::size_t i = 0; i < on.size(); ++i) {
            const Index a = on[i], b = on[(i + 1) % on.size()];
            const double step = (k == 0 ? 1.0 : -1.0) * std::arg(arm(b) / arm(a));
            sum += step > 0.0 ? step : step + 2.0 * std::numbers::pi;
            if (!(step > 0.0)) back.insert(back.end(), {a, b});
        }
        if (sum < 3.0 * std::numbers::pi) back.clear();
        return back;
    }

    /// Puts the vertices of faces that are flipped now, and of loops where they run backwards, back where they were;
    /// at last all of such a loop.
    /// @param allowed flipped faces that there may be @return whether no more are left, and all loops are in order
    bool restore_flipped(const PlanarPoints& before, std::size_t allowed)
    {
        for (int i = 0; i <= most_restorations; ++i) {
            std::vector<Index> wrong;
            for (std::size_t k = 0; k < loops_.size(); ++k) {
                if (!ordered_[k]) continue;
                const std::vector<Index> back = out_of_order(k);
                if (back.empty()) continue;
                const std::vector<Index>& part = 2 * i < most_restorations ? back : loops_[k];
                wrong.insert(wrong.end(), part.begin(), part.end());
            }
            const std::vector<Index> tangled = map_.tangled();
            if (wrong.empty() && tangled.size() <= allowed) return true;
            for (const Index f : tangled) wrong.insert(wrong.end(), triangles_.row(f).begin(), triangles_.row(f).end());
            for (const Index v : wrong) uv_.row(v) = before.row(v);
        }
        return false;
    }

    const Vertices& vertices_;
    const Triangles& triangles_;
    const std::vector<VertexLoop>& loops_;
    const std::vector<Circle>& circles_;
    std::vector<char> off_circle_;
    PlanarPoints& uv_;
    TangledMap map_;
    FoldoverProblem problem_;
    std::vector<char> ordered_;  // loops that were from the start
};

}  // namespace

bool polish_angles(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                   ExecutionContext& context, const std::vector<Index>& held)
{
    return AnglePolish(vertices, surface, loops, circles, off_circle, uv, held).run(context);
}

}  // namespace koebe
