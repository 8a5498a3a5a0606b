#include "fit/circle_bending.h"

#include "circles/circle_projection.h"
#include "fit/plane_beltrami.h"
#include "foldover/foldover_free.h"
#include "surface/harmonic_map.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace koebe {
namespace {

using BendMobility = FoldoverProblem::Mobility;

constexpr double first_share = 0.25;                        // share of the path
constexpr double least_share = 1.0 / 2048;                  // share of the path
constexpr double unfolded_share = 1.0 / 32;                 // faces that fold in a step as short are turned back
constexpr int unfoldings_of_a_path = 10;                    // of a path
constexpr int trials_of_a_path = 300;                       // steps of a path, including those that fail
constexpr int newton_between = 4, newton_at_the_end = 200;  // Newton steps
constexpr double conformal_enough = 1e-5;     // of the energy: nothing below counts for relative decreases
constexpr double bend_settled = 1e-6;         // relative decrease of the energy
constexpr double least_share_of_area = 1e-3;  // of a face, over the mean
constexpr double thinnest_face = 1e-11;       // of a face that counts, over its longest edge
constexpr double fan_weight = 1.0;            // of the faces at a rim
constexpr double nothing = 1e-13;             // disk units: a way that is rounding
constexpr double thin_ring = 1.2;             // ratio of radii below which a ring is not scaled by a power
constexpr double stored_rounding = 1.5e-7;    // twice the area that a face can lose as stored, over its longest edge
constexpr double extremal_slack = 1e-3;
constexpr double extremal_settled = 1e-4;
constexpr double rim_leeway = 4.0;    // by which triangles of free rims may bend more than faces
constexpr double least_bent = 1e-12;  // of the term of a face: scale of conformal maps

Complex place_of(const PlanarPoints& points, Eigen::Index v) { return {points(v, 0), points(v, 1)}; }

void put_at(PlanarPoints& points, Eigen::Index v, Complex z) { points.row(v) << z.real(), z.imag(); }

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

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

class CircleBending {
public:
    CircleBending(const BendingInput& input, const CirclePath& path, ExecutionContext& context)
        : input_(input), path_(path), context_(context)
    {
        set_problem();
        set_turns();
    }

    BendingResult run(const Extremal& extremal)
    {
        BendingResult result;
        for (const int unfoldings : {0, unfoldings_of_a_path})
            if (go(unfoldings, result)) {
                finish(extremal, result);
                return result;
            }
        return result;
    }

private:
    bool is_off(Index v) const { return std::ranges::binary_search(input_.off_circle, v); }

    void set_problem()
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
                if (is_off(v)) continue;
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
        put_on(path_.at(0.0), start_);
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
    void add_fan(std::size_t k, double total)
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

    /// How far each rim turns on the whole way: a pinned vertex takes the shorter way round.
    void set_turns()
    {
        const std::vector<Circle> begin = path_.at(0.0);
        for (std::size_t k = 0; k < input_.loops.size(); ++k) {
            const auto& pin = input_.rims[k].pin;
            turns_.push_back(pin ? wrapped(pin->angle - std::arg(place_of(input_.start, pin->vertex) - begin[k].center))
                                 : 0.0);
        }
    }

    /// Scales, turns and moves the ring around each hole, so that the hole gets its new circle and all else stays.
    /// Along a radius s the scale and the turn go with log s, and the way with s.
    PlanarPoints with_rings_moved(const PlanarPoints& now, const std::vector<Circle>& from,
                                  const std::vector<Circle>& to, double share) const
    {
        PlanarPoints result = now;
        for (std::size_t k = 1; k < from.size(); ++k) {
            const Complex c = from[k].center, way = to[k].center - c;
            const double r = from[k].radius;
            double reach = 1.0 - std::abs(c);
            for (std::size_t j = 1; j < from.size(); ++j)
                if (j != k) reach = std::min(reach, r + 0.5 * (std::abs(from[j].center - c) - from[j].radius - r));
            if (reach < thin_ring * r || to[k].radius * thin_ring > reach) continue;
            const double depth = std::log(r / reach);
            const Complex power(std::log(to[k].radius / reach) / depth - 1.0, share * turns_[k] / depth);
            for (Eigen::Index v = 0; v < now.rows(); ++v) {
                const Complex arm = place_of(now, v) - c;
                const double length = std::abs(arm);
                if (!(length < reach && length > 0.0)) continue;
                const double moves = std::min((reach - length) / (reach - r), 1.0);
                put_at(result, v, c + moves * way + arm * std::exp(power * std::log(length / reach)));
            }
        }
        return result;
    }

    /// Moves rims from circles to circles, and the inside by the harmonic displacement.
    /// @param share of the turns
    PlanarPoints step_to(PlanarPoints now, const std::vector<Circle>& from, const std::vector<Circle>& to, double share,
                         bool by_rings) const
    {
        VectorXcd there(static_cast<Eigen::Index>(rim_.size()));
        for (std::size_t i = 0; i < rim_.size(); ++i) {
            const Circle& circle = to[loop_of_[i]];
            const Complex arm = place_of(now, rim_[i]) - from[loop_of_[i]].center;
            there[static_cast<Eigen::Index>(i)] =
                circle.center + circle.radius / std::abs(arm) * arm * std::polar(1.0, share * turns_[loop_of_[i]]);
        }
        if (by_rings) now = with_rings_moved(now, from, to, share);
        VectorXcd way = there;
        for (std::size_t i = 0; i < rim_.size(); ++i) way[static_cast<Eigen::Index>(i)] -= place_of(now, rim_[i]);
        if (way.size() > 0 && way.cwiseAbs().maxCoeff() > nothing) {
            const VectorXcd moved = harmonic_map(input_.triangles, edge_lengths(now, input_.triangles),
                                                 static_cast<Index>(now.rows()), rim_, way);
            now.col(0) += moved.real();
            now.col(1) += moved.imag();
        }
        put_on(to, now);
        return now;
    }

    /// Puts the rims exactly onto circles, and the middles of fans to their centres.
    void put_on(const std::vector<Circle>& circles, PlanarPoints& uv) const
    {
        for (std::size_t i = 0; i < rim_.size(); ++i)
            put_at(uv, rim_[i], Track{.circle = circles[loop_of_[i]]}.nearest(place_of(uv, rim_[i])));
        for (std::size_t k = 0; k < circles.size(); ++k)
            put_at(uv, input_.start.rows() + static_cast<Eigen::Index>(k), circles[k].center);
    }

    void set_circles(const std::vector<Circle>& circles)
    {
        for (std::size_t i = 0; i < rim_.size(); ++i) problem_.circles[rim_[i]] = circles[loop_of_[i]];
    }

    FoldoverResult minimize(PlanarPoints& now, const std::vector<Circle>& circles, const FoldoverOptions& options)
    {
        set_circles(circles);
        problem_.points = now;
        FoldoverResult done = minimize_foldover_free(problem_, context_, options);
        newton_steps_ += done.iterations;
        if (is_one_to_one(problem_.points, circles))
            now = problem_.points;
        else
            done.foldover_free = false;
        return done;
    }

    FoldoverOptions gentle(int steps) const
    {
        return {.max_iterations = steps,
                .area_weight = 0.0,
                .settled = bend_settled,
                .least = 2.0 * (1.0 - conformal_enough) * problem_.weight.sum(),
                .strict = true};
    }

    std::vector<Index> folded(const PlanarPoints& uv) const
    {
        std::vector<Index> faces;
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f)
            if (!(edges_of(problem_.triangles, uv, f).determinant() > 0.0)) faces.push_back(static_cast<Index>(f));
        return faces;
    }

    bool is_one_to_one(const PlanarPoints& uv, const std::vector<Circle>& circles) const
    {
        return uv.allFinite() && folded(uv).empty() && rims_in_order(uv, circles);
    }

    bool rims_in_order(const PlanarPoints& uv, const std::vector<Circle>& circles) const
    {
        for (std::size_t i = 0, end = 0; i < rim_.size(); i = end) {
            while (end < rim_.size() && loop_of_[end] == loop_of_[i]) ++end;
            VectorXcd arms(static_cast<Eigen::Index>(end - i));
            for (std::size_t j = i; j < end; ++j)
                arms[static_cast<Eigen::Index>(j - i)] = place_of(uv, rim_[j]) - circles[loop_of_[i]].center;
            if (!run_once_round(arms, loop_of_[i] == 0 ? 1 : -1)) return false;
        }
        return true;
    }

    /// A step, or nothing if faces turn over.
    std::optional<PlanarPoints> tried(const PlanarPoints& now, double reached, double share, bool may_unfold)
    {
        const std::vector<Circle> from = path_.at(reached), to = path_.at(reached + share);
        for (const bool by_rings : {true, false}) {
            PlanarPoints next = step_to(now, from, to, share, by_rings);
            if (is_one_to_one(next, to)) return next;
            if (by_rings || !next.allFinite()) continue;
            if (may_unfold && minimize(next, to, {}).foldover_free) return next;
            blame(next);
        }
        return {};
    }

    bool go(int unfoldings, BendingResult& result)
    {
        PlanarPoints now = start_;
        double reached = 0.0, step = first_share;
        for (int trial = 0; trial < trials_of_a_path && reached < 1.0; ++trial) {
            context_.advance(reached);
            const double share = std::min(step, 1.0 - reached);
            const bool may_unfold = share <= unfolded_share && unfoldings > 0;
            if (may_unfold) --unfoldings;
            if (std::optional<PlanarPoints> next = tried(now, reached, share, may_unfold)) {
                now = std::move(*next);
                reached = share < 1.0 - reached ? reached + share : 1.0;
                step = 2.0 * share;
                ++result.steps;
                minimize(now, path_.at(reached), gentle(newton_between));
            } else if ((step = 0.5 * share) < least_share) {
                break;
            }
        }
        result.newton_steps = newton_steps_;
        if (reached > result.reached || result.reached == 0.0) {
            result.reached = reached;
            result.blocked = blocked_;
        }
        result.arrived = reached >= 1.0;
        if (result.arrived) result.uv = std::move(now);
        return result.arrived;
    }

    /// Notes the loops at folded faces.
    void blame(const PlanarPoints& uv)
    {
        std::vector<char> corner(static_cast<std::size_t>(uv.rows()), 0);
        for (const Index f : folded(uv))
            for (const Index v : problem_.triangles.row(f)) corner[v] = 1;
        blocked_.clear();
        for (std::size_t k = 0; k < input_.loops.size(); ++k)
            if (std::ranges::any_of(input_.loops[k], [&](Index v) { return corner[v] != 0; }))
                blocked_.push_back(static_cast<Index>(k));
    }

    /// Bounds the faces' areas from below, so that they stay upright as 32-bit UVs, as far as they are now.
    void set_floors(const PlanarPoints& uv)
    {
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            const Eigen::Matrix2d edges = edges_of(problem_.triangles, uv, f);
            problem_.floor[f] = std::min(stored_rounding * longest_edge_of(edges), 0.5 * edges.determinant()) /
                                problem_.reference[f].determinant();
        }
    }

    /// The largest 2 |mu|^2 / (1 - |mu|^2) of a face.
    double most_bent(const PlanarPoints& uv) const
    {
        const Triangles faces = problem_.triangles.topRows(face_count_);
        const double mu = plane_beltrami(input_.undistorted, faces, uv).cwiseAbs().maxCoeff();
        return std::max(2.0 * mu * mu / (1.0 - mu * mu), least_bent);
    }

    void lower_the_largest(const Extremal& extremal, const std::vector<Circle>& circles, PlanarPoints& uv)
    {
        const VectorXd weight = problem_.weight;
        for (const double power : extremal.powers) {
            FoldoverOptions options = gentle(newton_at_the_end);
            options.least = 0.0;
            options.power = power;
            options.slack = extremal_slack;
            if (extremal.free_rims) {
                options.scale = most_bent(uv);
                options.slack *= options.scale;
                options.settled = extremal_settled;
                problem_.weight.tail(weight.size() - face_count_) =
                    std::pow(rim_leeway, -power) * weight.tail(weight.size() - face_count_);
            }
            minimize(uv, circles, options);
        }
    }

    void finish(const Extremal& extremal, BendingResult& result)
    {
        const std::vector<Circle> circles = path_.at(1.0);
        minimize(result.uv, circles, gentle(newton_at_the_end));
        set_floors(result.uv);
        const FoldoverResult done = minimize(result.uv, circles, gentle(newton_at_the_end));
        result.settled = done.iterations < newton_at_the_end;
        lower_the_largest(extremal, circles, result.uv);
        put_on(circles, result.uv);
        result.uv.conservativeResize(input_.start.rows(), 2);
        result.newton_steps = newton_steps_;
    }

    const BendingInput& input_;
    const CirclePath& path_;
    ExecutionContext& context_;
    FoldoverProblem problem_;
    Eigen::Index face_count_ = 0;       // of the problem's triangles, before those of the rims
    PlanarPoints start_;                // (V + loops, 2) with the circles' centres
    std::vector<Index> rim_;            // vertices on circles, loop by loop
    std::vector<std::size_t> loop_of_;  // of each of these
    std::vector<double> turns_;         // of the loops, radians
    std::vector<Index> blocked_;
    int newton_steps_ = 0;
};

}  // namespace

BendingResult bend_along(const BendingInput& input, const CirclePath& path, const Extremal& extremal,
                         ExecutionContext& context)
{
    return CircleBending(input, path, context).run(extremal);
}

}  // namespace koebe
