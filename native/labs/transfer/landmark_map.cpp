#include "transfer/landmark_map.h"

#include "circles/circle_projection.h"
#include "core/complex_places.h"
#include "core/errors.h"
#include "foldover/foldover_free.h"
#include "linear/sparse_cholesky.h"
#include "surface/laplacian.h"
#include "transfer/landmark_pins.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr double power = 2.0, slack = 1e-4;  // of the energy, dimensionless: the fourth power of |mu|
constexpr int most_trials = 60;              // steps of a path, including those that fail
constexpr double shortest_step = 1.0 / 256;  // share of the path
constexpr double unfolded_step = 1.0 / 16;   // share of the path: faces that fold in a step as short are turned back
constexpr int most_unfoldings = 6;           // of a map: each takes as long as the last steps
constexpr int steps_between = 4;             // Newton steps after each step of the path
constexpr int steps_at_the_end = 60;
constexpr double settled = 1e-7;                                         // relative decrease of the energy
constexpr double extremal_powers[] = {2.0, 4.0, 8.0, 16.0, 32.0, 64.0};  // of the terms: half of |mu|'s
constexpr double highest_slack = 1e-3;                                   // over the term of the face that is bent most
constexpr double highest_settled = 1e-4;                                 // relative decrease of the energy
constexpr int extremal_steps = 200;                                      // Newton steps for each power
constexpr double least_scale = 1e-12;                                    // of a face's term: conformal maps
constexpr double bows[] = {0.0, 0.5, -0.5};  // heights of the paths' arcs, over the distance
constexpr double least_height = 1e-9;        // of a face that moves, over its longest edge
constexpr double most_cotangent = 20.0;      // of an angle, for the displacement
constexpr double least_area = 1e-3;          // of a face or around a vertex, over the mean

double doubled_area(const Triangles& triangles, const PlanarPoints& uv, Eigen::Index f)
{
    const Complex a = complex_at(uv, triangles(f, 0));
    return std::imag(std::conj(complex_at(uv, triangles(f, 1)) - a) * (complex_at(uv, triangles(f, 2)) - a));
}

/// Place of a vertex after a share t of its path: on a parabola of this height over the distance, or on its circle.
Complex on_way(const Pin& pin, const std::vector<Circle>& circles, double t, double bow)
{
    if (t >= 1.0) return pin.end;
    if (pin.loop < 0) return pin.begin + (pin.end - pin.begin) * Complex(t, 4.0 * bow * t * (1.0 - t));
    const Complex center = circles[pin.loop].center;
    return center + (pin.begin - center) * std::polar(1.0, t * std::arg((pin.end - center) / (pin.begin - center)));
}

class LandmarkBending {
public:
    LandmarkBending(const MappedSurface& target, const std::vector<Circle>& circles, const PlanarPoints& aligned,
                    const PlanarPoints& bent, const std::vector<SurfacePoint>& landmarks, const VectorXcd& places,
                    bool extremal)
        : target_(target), circles_(circles), extremal_(extremal)
    {
        map_.mesh = cut_at_points(target.triangles, static_cast<Index>(target.uv.rows()), landmarks);
        aligned_ = map_.mesh.extended(aligned, target.triangles);
        start_ = map_.mesh.extended(bent, target.triangles);
        pins_ = landmark_pins(map_.mesh, target.triangles, target.loops, circles, start_, places);
        triangles_ = map_.mesh.triangles;
        if (extremal_) flip_ears();
        set_problem();
        folded_ = folded_faces(map_.mesh.triangles, start_).size();
    }

    LandmarkMap run(ExecutionContext& context)
    {
        if (arrives(context)) {
            if (extremal_) lower_the_largest(context);
            map_.triangles = std::move(triangles_);
            return std::move(map_);
        }
        throw SolverError("no one-to-one map was found: the landmarks block each other, or the mesh is too coarse for "
                          "them, worst at " +
                              landmark_numbers(stuck_),
                          ElementKind::landmarks, stuck_);
    }

private:
    bool arrives(ExecutionContext& context)
    {
        const DirichletSolver extension(bending_matrix(), fixed_);
        return std::ranges::any_of(bows, [&](double bow) { return go(extension, bow, 0, context); }) ||
               go(extension, bows[0], most_unfoldings, context) || go_at_once(extension, context);
    }

    /// Links a vertex of the outer rim with one face only, an ear, to the face behind the ear: flips the edge between
    /// both. An ear is so thin beside the circle that its shear would rule the sums of high powers.
    void flip_ears()
    {
        std::vector<int> faces(static_cast<std::size_t>(aligned_.rows()), 0);
        for (Eigen::Index i = 0; i < triangles_.size(); ++i) ++faces[static_cast<std::size_t>(triangles_.data()[i])];
        for (const Index tip : target_.loops[0].vertices)
            if (faces[static_cast<std::size_t>(tip)] == 1) flip_ear(tip);
    }

    void flip_ear(Index tip)
    {
        // The face with an edge from one vertex, to another or to any, and the corner where this edge begins.
        const auto face_with = [&](Index from, Index to) {
            for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f)
                for (int k = 0; k < 3; ++k)
                    if (triangles_(f, k) == from && (to < 0 || triangles_(f, (k + 1) % 3) == to))
                        return std::pair(f, k);
            return std::pair(Index(-1), 0);
        };
        const auto [ear, at] = face_with(tip, -1);
        const Index next = triangles_(ear, (at + 1) % 3), last = triangles_(ear, (at + 2) % 3);
        const auto [behind, from] = face_with(last, next);
        if (behind < 0) return;
        const Index opposite = triangles_(behind, (from + 2) % 3);
        Triangles flipped(2, 3);
        flipped << tip, next, opposite, tip, opposite, last;
        if (!folded_faces(flipped, aligned_).empty() || !folded_faces(flipped, start_).empty()) return;
        triangles_.row(ear) = flipped.row(0);
        triangles_.row(behind) = flipped.row(1);
    }

    void set_problem()
    {
        const Triangles& triangles = triangles_;
        const Eigen::Index count = aligned_.rows();
        const Vertices vertices = map_.mesh.extended(target_.vertices, target_.triangles);
        lengths_ = edge_lengths(vertices, map_.mesh.triangles);
        problem_.mobility.assign(count, Mobility::free);
        problem_.circles.resize(count);
        fixed_.assign(count, 1);
        for (Eigen::Index i = 0; i < triangles.size(); ++i) fixed_[triangles.data()[i]] = 0;
        for (std::size_t k = 0; k < circles_.size(); ++k)
            for (const Index v : target_.loops[k].vertices) {
                const bool off = std::ranges::binary_search(target_.loops[k].off_circle, v);
                problem_.mobility[v] = off ? Mobility::held : Mobility::sliding;
                problem_.circles[v] = circles_[k];
                fixed_[v] = 1;
            }
        for (const Pin& pin : pins_) {
            problem_.mobility[pin.vertex] = Mobility::held;
            fixed_[pin.vertex] = 1;
        }
        // Leave out faces that the map has already lost, as long as no step moves their vertices.
        std::vector<Index> whole;
        std::vector<double> areas;
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            const Complex a = complex_at(aligned_, triangles(f, 0)), b = complex_at(aligned_, triangles(f, 1)),
                          c = complex_at(aligned_, triangles(f, 2));
            const double longest = std::max({std::norm(b - a), std::norm(c - b), std::norm(a - c)});
            if (doubled_area(triangles, aligned_, f) > least_height * longest &&
                doubled_area(triangles, start_, f) > 0.0) {
                whole.push_back(static_cast<Index>(f));
                Eigen::Matrix2d shape;
                shape << (b - a).real(), (c - a).real(), (b - a).imag(), (c - a).imag();
                problem_.reference.push_back(shape);
                areas.push_back(triangle_area(lengths_(f, 0), lengths_(f, 1), lengths_(f, 2)));
            } else {
                for (const Index v : triangles.row(f)) problem_.mobility[v] = Mobility::held;
            }
        }
        problem_.triangles = triangles(whole, Eigen::all);
        problem_.weight = Eigen::Map<const VectorXd>(areas.data(), static_cast<Eigen::Index>(areas.size()));
        const double mean = problem_.weight.size() > 0 ? problem_.weight.mean() : 1.0;
        problem_.weight = (problem_.weight / mean).cwiseMax(least_area);
        problem_.floor = VectorXd::Zero(problem_.triangles.rows());
        problem_.bends = extremal_;
    }

    /// u' B u is the integral of the squared Laplacian of u over the surface.
    SparseMatrix bending_matrix() const
    {
        const Index count = static_cast<Index>(aligned_.rows());
        const EdgeLengths cotangents =
            half_cotangents(lengths_).cwiseMin(0.5 * most_cotangent).cwiseMax(-0.5 * most_cotangent);
        const SparseMatrix laplacian = cotan_laplacian(map_.mesh.triangles, cotangents, count);
        const VectorXd areas = vertex_areas(map_.mesh.triangles, lengths_, count);
        VectorXd weights = areas.cwiseMax(least_area * areas.mean()).cwiseInverse() * areas.mean();
        for (const LoopReport& loop : target_.loops)
            for (const Index v : loop.vertices) weights[v] = 0.0;
        return laplacian * weights.asDiagonal() * laplacian;
    }

    /// Turns a rim's vertices along with its landmarks, at t: linearly in the angle between two of them.
    void turn_rim(PlanarPoints& points, std::size_t k, double t, double bow) const
    {
        const VertexLoop& loop = target_.loops[k].vertices;
        const Circle& circle = circles_[k];
        const auto arm = [&](std::size_t i) { return complex_at(points, loop[i % loop.size()]) - circle.center; };
        std::vector<std::pair<std::size_t, double>> held;  // places of landmarks in the loop, and their turns
        for (const Pin& pin : pins_) {
            if (pin.loop != static_cast<int>(k)) continue;
            const auto i = static_cast<std::size_t>(std::ranges::find(loop, pin.vertex) - loop.begin());
            held.emplace_back(i, std::arg((on_way(pin, circles_, t, bow) - circle.center) / arm(i)));
        }
        if (held.empty()) return;
        std::ranges::sort(held);
        const PlanarPoints before = points;
        for (std::size_t h = 0; h < held.size(); ++h) {
            const auto [first, turn] = held[h];
            const auto [next, next_turn] = held[(h + 1) % held.size()];
            const std::size_t last = h + 1 < held.size() ? next : next + loop.size();
            std::vector<double> angle{0.0};
            for (std::size_t i = first; i < last; ++i) {
                const Complex from = complex_at(before, loop[i % loop.size()]) - circle.center;
                const Complex to = complex_at(before, loop[(i + 1) % loop.size()]) - circle.center;
                angle.push_back(angle.back() + std::abs(std::arg(to / from)));
            }
            for (std::size_t i = first; i < last; ++i) {
                const Index v = loop[i % loop.size()];
                if (problem_.mobility[v] != Mobility::sliding && i != first) continue;
                const double share = angle.back() > 0.0 ? angle[i - first] / angle.back() : 0.0;
                const Complex from = complex_at(before, v) - circle.center;
                put_complex(points, v,
                            circle.center + from * std::polar(1.0, (1.0 - share) * turn + share * next_turn));
            }
        }
    }

    /// Positions of all vertices, with rims and landmarks moved on to t.
    PlanarPoints step_to(const DirichletSolver& extension, const PlanarPoints& now, double t, double bow) const
    {
        PlanarPoints wanted = now;
        for (std::size_t k = 0; k < circles_.size(); ++k) turn_rim(wanted, k, t, bow);
        for (const Pin& pin : pins_) put_complex(wanted, pin.vertex, on_way(pin, circles_, t, bow));
        const PlanarPoints there = now + PlanarPoints(extension.solve(wanted - now));
        for (Eigen::Index v = 0; v < wanted.rows(); ++v)
            if (!fixed_[v]) wanted.row(v) = there.row(v);
        return wanted;
    }

    /// Takes Newton steps that turn no face over.
    void relax(PlanarPoints& now, int steps, const ExecutionContext& context)
    {
        minimize(now,
                 {.max_iterations = steps,
                  .area_weight = 0.0,
                  .settled = settled,
                  .strict = true,
                  .power = power,
                  .slack = slack},
                 context);
    }

    void lower_the_largest(const ExecutionContext& context)
    {
        for (const double high : extremal_powers) {
            problem_.points = map_.uv;
            const double scale = std::max(most_bent(problem_, problem_.triangles.rows()), least_scale);
            if (!std::isfinite(scale)) return;
            minimize(map_.uv,
                     {.max_iterations = extremal_steps,
                      .area_weight = 0.0,
                      .settled = highest_settled,
                      .strict = true,
                      .power = high,
                      .slack = highest_slack * scale,
                      .scale = scale},
                     context);
        }
    }

    void minimize(PlanarPoints& now, const FoldoverOptions& options, const ExecutionContext& context)
    {
        problem_.points = now;
        minimize_foldover_free(problem_, context, options);
        if (problem_.points.allFinite() && is_one_to_one(problem_.points)) now = problem_.points;
    }

    bool is_one_to_one(const PlanarPoints& uv) const
    {
        return uv.allFinite() && folded_faces(map_.mesh.triangles, uv).size() <= folded_ && rims_in_order(uv);
    }

    /// Whether each rim runs once round its circle, and never back.
    bool rims_in_order(const PlanarPoints& uv) const
    {
        for (std::size_t k = 0; k < circles_.size(); ++k) {
            std::vector<Complex> arms;
            for (const Index v : target_.loops[k].vertices)
                if (!std::ranges::binary_search(target_.loops[k].off_circle, v))
                    arms.push_back(complex_at(uv, v) - circles_[k].center);
            const Eigen::Map<const VectorXcd> all(arms.data(), static_cast<Eigen::Index>(arms.size()));
            if (!run_once_round(all, k == 0 ? 1 : -1)) return false;
        }
        return true;
    }

    /// Notes the landmarks at folded faces, or all landmarks if there are none.
    void blame(const PlanarPoints& uv)
    {
        std::vector<char> folded(uv.rows(), 0);
        for (const Index f : folded_faces(map_.mesh.triangles, uv))
            for (const Index v : map_.mesh.triangles.row(f)) folded[v] = 1;
        stuck_.clear();
        for (const Pin& pin : pins_)
            if (folded[pin.vertex]) stuck_.push_back(pin.landmark);
        if (stuck_.empty())
            for (const Pin& pin : pins_) stuck_.push_back(pin.landmark);
    }

    /// @param unfoldings how often faces that fold in a short step may be turned back
    bool go(const DirichletSolver& extension, double bow, int unfoldings, ExecutionContext& context)
    {
        PlanarPoints now = start_;
        if (unfoldings > 0) relax(now, steps_between, context);
        double reached = 0.0, step = 1.0;
        for (int trial = 0; trial < most_trials && reached < 1.0; ++trial) {
            context.advance(reached);
            const double share = std::min(step, 1.0 - reached);
            // A harmonic step to the landmarks' next places.
            PlanarPoints next = step_to(extension, now, reached + share, bow);
            if (is_one_to_one(next) || (share <= unfolded_step && unfoldings-- > 0 && unfold(next, context))) {
                now = std::move(next);
                reached += share;
                step = 2.0 * share;
                relax(now, reached < 1.0 ? steps_between : steps_at_the_end, context);
                // The landmarks to blame are those at faces that turned over.
            } else if ((step = 0.5 * share) < shortest_step) {
                blame(next);
                return false;
            }
        }
        if (reached < 1.0) {
            blame(now);
            return false;
        }
        map_.uv = std::move(now);
        return true;
    }

    /// Turns folded faces back; rim vertices slide.
    bool unfold(PlanarPoints& now, const ExecutionContext& context)
    {
        if (!now.allFinite()) return false;
        problem_.points = now;
        minimize_foldover_free(problem_, context);
        if (!is_one_to_one(problem_.points)) return false;
        now = problem_.points;
        return true;
    }

    bool go_at_once(const DirichletSolver& extension, const ExecutionContext& context)
    {
        map_.uv = step_to(extension, start_, 1.0, 0.0);
        if (!unfold(map_.uv, context)) return false;
        relax(map_.uv, steps_at_the_end, context);
        return true;
    }

    const MappedSurface& target_;
    const std::vector<Circle>& circles_;
    LandmarkMap map_;
    Triangles triangles_;  // in which the map is linear
    PlanarPoints aligned_, start_;
    std::vector<Pin> pins_;
    EdgeLengths lengths_;
    FoldoverProblem problem_;
    std::vector<char> fixed_;
    bool extremal_ = false;
    std::size_t folded_ = 0;
    std::vector<Index> stuck_;
};

}  // namespace

MappedSurface conformal_surface(const Vertices& vertices, const Triangles& triangles, const UniformizeResult& result)
{
    return {vertices, triangles, result.conformal_uv(), result.conformal_loops()};
}

std::vector<Index> folded_faces(const Triangles& triangles, const PlanarPoints& uv)
{
    std::vector<Index> folded;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (!(doubled_area(triangles, uv, f) > 0.0)) folded.push_back(static_cast<Index>(f));
    return folded;
}

LandmarkMap map_with_landmarks(const MappedSurface& target, const std::vector<Circle>& circles,
                               const PlanarPoints& aligned, const PlanarPoints& bent,
                               const std::vector<SurfacePoint>& landmarks, const VectorXcd& places, bool extremal,
                               ExecutionContext& context)
{
    return LandmarkBending(target, circles, aligned, bent, landmarks, places, extremal).run(context);
}

}  // namespace koebe
