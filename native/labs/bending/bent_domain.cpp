#include "bending/bent_domain.h"

#include "circles/circle_projection.h"
#include "core/complex_places.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

using BendMobility = FoldoverProblem::Mobility;

constexpr double conformal_enough = 1e-5;     // of the energy: nothing below counts for relative decreases
constexpr double bend_settled = 1e-6;         // relative decrease of the energy
constexpr double least_share_of_area = 1e-3;  // of a face, over the mean
constexpr double thinnest_face = 1e-11;       // of a face that counts, over its longest edge
constexpr double fan_weight = 1.0;            // of the faces at a rim
constexpr double stored_rounding = 1.5e-7;    // twice the area that a face can lose as stored, over its longest edge
constexpr double extremal_slack = 1e-3;
constexpr double extremal_settled = 1e-4;
constexpr double rim_leeway = 4.0;    // by which triangles of free rims may bend more than faces
constexpr double least_bent = 1e-12;  // of the term of a face: scale of conformal maps

/// Edges 0-1 and 0-2 of a face as columns.
Eigen::Matrix2d edges_of(const Triangles& triangles, const PlanarPoints& uv, Eigen::Index f)
{
    Eigen::Matrix2d edges;
    edges << (uv.row(triangles(f, 1)) - uv.row(triangles(f, 0))).transpose(),
        (uv.row(triangles(f, 2)) - uv.row(triangles(f, 0))).transpose();
    return edges;
}

double longest_edge_of(const Eigen::Matrix2d& edges)
{
    return std::max({edges.col(0).norm(), edges.col(1).norm(), (edges.col(1) - edges.col(0)).norm()});
}

}  // namespace

BentDomain::BentDomain(const BendingInput& input, const std::vector<Circle>& circles, ExecutionContext& context)
    : input_(input), context_(context)
{
    const Triangles& triangles = input_.triangles;
    const std::size_t count = static_cast<std::size_t>(input_.start.rows());
    problem_.mobility.assign(count, BendMobility::free);
    problem_.mobility.resize(count + input_.loops.size(), BendMobility::held);
    problem_.circles.resize(problem_.mobility.size());
    problem_.bends = true;
    for (std::size_t k = 0; k < input_.loops.size(); ++k) {
        const TemplateRim& rim = input_.rims[k];
        for (const Index v : input_.loops[k]) {
            if (std::ranges::binary_search(input_.off_circle, v)) continue;
            const bool held = !rim.rotates || (rim.pin && rim.pin->vertex == v);
            problem_.mobility[v] = held ? BendMobility::held : BendMobility::sliding;
            rim_.push_back(v);
            loop_of_.push_back(k);
        }
    }
    std::vector<Index> whole;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Eigen::Matrix2d shape = edges_of(triangles, input_.undistorted, f);
        const double longest = longest_edge_of(shape);
        if (!(shape.determinant() > thinnest_face * longest * longest) ||
            !(edges_of(triangles, input_.start, f).determinant() > 0.0))
            continue;  // lost in the conformal map already
        whole.push_back(static_cast<Index>(f));
        problem_.reference.push_back(shape);
    }
    problem_.triangles = triangles(whole, Eigen::all);
    start_ = input_.start;
    start_.conservativeResize(start_.rows() + static_cast<Eigen::Index>(input_.loops.size()), 2);
    put_on(circles, start_);
    problem_.weight = input_.weight(whole);
    const double mean = whole.empty() ? 1.0 : problem_.weight.mean();
    problem_.weight = (problem_.weight / mean).cwiseMax(least_share_of_area);
    const double total = problem_.weight.sum();
    face_count_ = problem_.triangles.rows();
    for (std::size_t k = 0; k < input_.loops.size(); ++k) add_fan(k, total);
    problem_.floor = VectorXd::Zero(problem_.triangles.rows());
}

/// Adds triangles from a circle's centre to the edges of its rim. They keep the vertices from gathering on an arc:
/// then the polygon of a few vertices would no longer be round.
/// @param total the weight of all faces
void BentDomain::add_fan(std::size_t k, double total)
{
    std::vector<Index> rim;
    for (std::size_t i = 0; i < rim_.size(); ++i)
        if (loop_of_[i] == k) rim.push_back(rim_[i]);
    if (rim.size() < 3) return;
    const double weight = fan_weight * total / static_cast<double>(rim.size());
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const Index here = rim[i], next = rim[(i + 1) % rim.size()];
        const Eigen::Index f = problem_.triangles.rows();
        problem_.triangles.conservativeResize(f + 1, 3);
        problem_.triangles.row(f) << static_cast<Index>(input_.start.rows()) + static_cast<Index>(k),
            k == 0 ? here : next, k == 0 ? next : here;
        const Eigen::Matrix2d shape = edges_of(problem_.triangles, start_, f);
        const double longest = longest_edge_of(shape);
        if (!(shape.determinant() > thinnest_face * longest * longest)) {  // half the circle, or nothing of it
            problem_.triangles.conservativeResize(f, 3);
            continue;
        }
        problem_.reference.push_back(shape);
        problem_.weight.conservativeResize(f + 1);
        problem_.weight[f] = weight;
    }
}

void BentDomain::put_on(const std::vector<Circle>& circles, PlanarPoints& uv) const
{
    for (std::size_t i = 0; i < rim_.size(); ++i)
        put_complex(uv, rim_[i], Track{.circle = circles[loop_of_[i]]}.nearest(complex_at(uv, rim_[i])));
    for (std::size_t k = 0; k < circles.size(); ++k)
        put_complex(uv, input_.start.rows() + static_cast<Eigen::Index>(k), circles[k].center);
}

std::vector<Index> BentDomain::folded(const PlanarPoints& uv) const
{
    std::vector<Index> faces;
    for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f)
        if (!(edges_of(problem_.triangles, uv, f).determinant() > 0.0)) faces.push_back(static_cast<Index>(f));
    return faces;
}

std::vector<char> BentDomain::folded_corners(const PlanarPoints& uv) const
{
    std::vector<char> corner(static_cast<std::size_t>(uv.rows()), 0);
    for (const Index f : folded(uv))
        for (const Index v : problem_.triangles.row(f)) corner[v] = 1;
    return corner;
}

bool BentDomain::is_one_to_one(const PlanarPoints& uv, const std::vector<Circle>& circles) const
{
    return uv.allFinite() && folded(uv).empty() && rims_in_order(uv, circles);
}

bool BentDomain::rims_in_order(const PlanarPoints& uv, const std::vector<Circle>& circles) const
{
    for (std::size_t i = 0, end = 0; i < rim_.size(); i = end) {
        while (end < rim_.size() && loop_of_[end] == loop_of_[i]) ++end;
        VectorXcd arms(static_cast<Eigen::Index>(end - i));
        for (std::size_t j = i; j < end; ++j)
            arms[static_cast<Eigen::Index>(j - i)] = complex_at(uv, rim_[j]) - circles[loop_of_[i]].center;
        if (!run_once_round(arms, loop_of_[i] == 0 ? 1 : -1)) return false;
    }
    return true;
}

FoldoverOptions BentDomain::gentle(int steps) const
{
    return {.max_iterations = steps,
            .area_weight = 0.0,
            .settled = bend_settled,
            .least = 2.0 * (1.0 - conformal_enough) * problem_.weight.sum(),
            .strict = true};
}

FoldoverResult BentDomain::minimize(PlanarPoints& uv, const std::vector<Circle>& circles,
                                    const FoldoverOptions& options)
{
    for (std::size_t i = 0; i < rim_.size(); ++i) problem_.circles[rim_[i]] = circles[loop_of_[i]];
    problem_.points = uv;
    FoldoverResult done = minimize_foldover_free(problem_, context_, options);
    newton_steps_ += done.iterations;
    if (is_one_to_one(problem_.points, circles))
        uv = problem_.points;
    else
        done.foldover_free = false;
    return done;
}

bool BentDomain::unfold(PlanarPoints& uv, const std::vector<Circle>& circles)
{
    return minimize(uv, circles, {}).foldover_free;
}

bool BentDomain::relax(PlanarPoints& uv, const std::vector<Circle>& circles, int steps)
{
    return minimize(uv, circles, gentle(steps)).iterations < steps;
}

void BentDomain::set_floors(const PlanarPoints& uv)
{
    for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
        const Eigen::Matrix2d edges = edges_of(problem_.triangles, uv, f);
        problem_.floor[f] = std::min(stored_rounding * longest_edge_of(edges), 0.5 * edges.determinant()) /
                            problem_.reference[f].determinant();
    }
}

void BentDomain::lower_the_largest(const Extremal& extremal, PlanarPoints& uv, const std::vector<Circle>& circles,
                                   int steps)
{
    const VectorXd weight = problem_.weight;
    for (std::size_t i = 0; i < extremal.powers.size(); ++i) {
        const double power = extremal.powers[i];
        context_.advance(std::lerp(extremal.way(), 1.0, static_cast<double>(i) / extremal.powers.size()));
        FoldoverOptions options = gentle(steps);
        options.least = 0.0;
        options.power = power;
        options.slack = extremal_slack;
        if (extremal.free_rims) {
            problem_.points = uv;
            options.scale = std::max(most_bent(problem_, face_count_), least_bent);
            options.slack *= options.scale;
            options.settled = extremal_settled;
            problem_.weight.tail(weight.size() - face_count_) =
                std::pow(rim_leeway, -power) * weight.tail(weight.size() - face_count_);
        }
        minimize(uv, circles, options);
    }
}

}  // namespace koebe
