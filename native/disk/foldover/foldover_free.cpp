#include "foldover/foldover_free.h"

#include "core/complex_places.h"
#include "foldover/face_energy.h"
#include "foldover/newton_system.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr double least_epsilon = 1e-6;  // Garanzha et al. 2021, section 3.2
constexpr double armijo = 1e-4;
constexpr double rounded = 1e-14;  // relative rounding error of a sum whose least value is known
constexpr int halvings = 24;
constexpr int most_folded = 30;  // steps in which a map may stay folded

class FoldoverMinimizer {
public:
    FoldoverMinimizer(FoldoverProblem& problem, const FoldoverOptions& options)
        : problem_(problem),
          options_(options),
          energy_{options.area_weight, options.power, options.slack, 1.0, options.scale},
          system_(problem, options.pattern)
    {
        for (const Eigen::Matrix2d& reference : problem.reference) shapes_.emplace_back(reference);
    }

    FoldoverResult run(const ExecutionContext& context)
    {
        FoldoverResult result;
        Worth now = worth(problem_);
        if (system_.unknowns() == 0) return {now.worst > 0.0, 0};
        int folded = 0;
        for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
            context.checkpoint();
            energy_.epsilon = std::sqrt(least_epsilon * least_epsilon + 0.04 * std::pow(std::min(now.worst, 0.0), 2));
            if (now.worst > 0.0)
                folded = 0;
            else if (++folded > most_folded)
                break;
            ++result.iterations;
            const double before = take_derivatives();
            const bool was_right = now.worst > 0.0;
            const bool has_moved = newton_step(before, now);
            result.hindered = hindered_;
            if (!has_moved || hindered_) break;
            if (before - now.energy < (was_right ? options_.settled : options_.stalled) * (before - options_.least))
                break;
        }
        result.foldover_free = now.worst > 0.0;
        return result;
    }

private:
    /// The minimized sum, and the least determinant above its floor.
    struct Worth {
        double energy = 0.0, worst = std::numeric_limits<double>::infinity();
    };

    FaceMap face_map(const FoldoverPlaces& places, Eigen::Index f) const
    {
        const CornerPlaces at = corners_of(places.points, problem_.triangles, problem_.lift, places.periods, f);
        return shapes_[f].map_to(at[1] - at[0], at[2] - at[0]);
    }

    double weight(Eigen::Index f) const { return problem_.weight.size() > 0 ? problem_.weight[f] : 1.0; }

    /// Terms and pulls are not negative. @param upright_only stops at a face that is not upright, and the sum
    /// @param most stops where the sum exceeds this: a worth that is not finished is of no use
    Worth worth(const FoldoverPlaces& places, bool upright_only = false,
                double most = std::numeric_limits<double>::infinity()) const
    {
        Worth result;
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            if (result.energy > most || (upright_only && result.worst <= 0.0)) break;
            const FaceMap map = face_map(places, f);
            result.energy += weight(f) * energy_(map, problem_.floor[f]);
            result.worst = std::min(result.worst, map.determinant() - problem_.floor[f]);
        }
        result.energy += pulls(places.points);
        return result;
    }

    double pulls(const PlanarPoints& points) const
    {
        double sum = 0.0;
        for (Eigen::Index v = 0; v < problem_.pull.size(); ++v)
            if (pulled(v)) sum += problem_.pull[v] * std::pow(offset(points, v).second, 2);
        return sum;
    }

    bool pulled(Eigen::Index v) const { return problem_.pull[v] > 0.0 && problem_.mobility[v] == Mobility::free; }

    bool to_centre(Eigen::Index v) const { return !problem_.pull_inside.empty() && problem_.pull_inside[v]; }

    /// The outward direction of a pulled vertex, and its distance from the circle or the centre over the radius.
    std::pair<Eigen::Vector2d, double> offset(const PlanarPoints& points, Eigen::Index v) const
    {
        const Circle& circle = problem_.circles[v];
        const Eigen::Vector2d arm =
            points.row(v).transpose() - Eigen::Vector2d(circle.center.real(), circle.center.imag());
        const double distance = arm.norm();
        const double target = to_centre(v) ? 0.0 : 1.0;
        if (!(distance > 0.0)) return {Eigen::Vector2d::Zero(), -target};
        return {arm / distance, distance / circle.radius - target};
    }

    /// Fills the system. @return the minimized sum
    double take_derivatives()
    {
        system_.clear();
        double energy = 0.0;
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            const FaceDerivatives face =
                energy_.derivatives(face_map(problem_, f), problem_.floor[f], weight(f), shapes_[f]);
            energy += face.term;
            system_.add_face(f, face, shapes_[f]);
        }
        system_.add_bends();
        for (Eigen::Index v = 0; v < problem_.pull.size(); ++v) {
            if (!pulled(v)) continue;
            const auto [outward, distance] = offset(problem_.points, v);
            const double weight = 2.0 * problem_.pull[v] / problem_.circles[v].radius;
            Eigen::Matrix2d block = outward * outward.transpose();
            if (to_centre(v)) block.setIdentity();
            system_.add_vertex(static_cast<Index>(v), weight * distance * outward,
                               weight / problem_.circles[v].radius * block);
        }
        return energy + pulls(problem_.points);
    }

    /// Takes a damped Newton step for the present epsilon. Returns false if no step decreases the energy.
    /// @param now the worth of the points, updated after the step
    bool newton_step(double before, Worth& now)
    {
        const auto [step, slope] = system_.descent();
        if (!(slope < 0.0)) return false;
        double share = 1.0;
        hindered_ = false;
        for (int i = 0; i < halvings; ++i, share *= 0.5) {
            FoldoverPlaces trial = system_.moved(step, share);
            const double most = before + armijo * share * slope + (options_.least > 0.0 ? rounded * before : 0.0);
            const Worth there = worth(trial, options_.strict, most);
            if (options_.strict && !(there.worst > 0.0)) continue;
            if (there.energy <= most) {
                if (options_.refuses && options_.refuses(trial)) {
                    hindered_ = true;
                    continue;
                }
                static_cast<FoldoverPlaces&>(problem_) = std::move(trial);
                now = there;
                return true;
            }
        }
        return false;
    }

    FoldoverProblem& problem_;
    FoldoverOptions options_;
    FaceEnergy energy_;
    std::vector<WantedShape> shapes_;  // per face
    NewtonSystem system_;
    bool hindered_ = false;  // whether points were refused in the last step
};

}  // namespace

FoldoverResult minimize_foldover_free(FoldoverProblem& problem, const ExecutionContext& context,
                                      const FoldoverOptions& options)
{
    return FoldoverMinimizer(problem, options).run(context);
}

double most_bent(const FoldoverProblem& problem, Eigen::Index count)
{
    double most = 0.0;
    for (Eigen::Index f = 0; f < count; ++f) {
        const auto corner = [&](int k) { return complex_at(problem.points, problem.triangles(f, k)); };
        const FaceMap map = WantedShape(problem.reference[f]).map_to(corner(1) - corner(0), corner(2) - corner(0));
        const double determinant = map.determinant();
        if (!(determinant > 0.0)) return std::numeric_limits<double>::infinity();
        most = std::max(most, 2.0 * std::norm(map.unlike) / determinant);
    }
    return most;
}

}  // namespace koebe
