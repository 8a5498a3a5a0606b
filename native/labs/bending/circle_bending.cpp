#include "bending/circle_bending.h"

#include "bending/bent_domain.h"
#include "core/complex_places.h"
#include "surface/harmonic_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double first_share = 0.25;                        // share of the path
constexpr double least_share = 1.0 / 2048;                  // share of the path
constexpr double unfolded_share = 1.0 / 8;                  // faces that fold in a step as short are turned back
constexpr int unfoldings_of_a_path = 10;                    // of a path
constexpr int trials_of_a_path = 300;                       // steps of a path, including those that fail
constexpr int newton_between = 4, newton_at_the_end = 200;  // Newton steps
constexpr double nothing = 1e-13;                           // disk units: a way that is rounding
constexpr double thin_ring = 1.2;  // ratio of radii below which a ring is not scaled by a power

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

class CircleBending {
public:
    CircleBending(const BendingInput& input, const CirclePath& path, ExecutionContext& context)
        : input_(input), path_(path), context_(context), domain_(input, path.at(0.0), context)
    {
        set_turns();
    }

    BendingResult run(const Extremal& extremal)
    {
        BendingResult result;
        for (const int unfoldings : {0, unfoldings_of_a_path})
            if (go(unfoldings, extremal.way(), result)) {
                finish(extremal, result);
                return result;
            }
        return result;
    }

private:
    /// How far each rim turns on the whole way: a pinned vertex takes the shorter way round.
    void set_turns()
    {
        const std::vector<Circle> begin = path_.at(0.0);
        for (std::size_t k = 0; k < input_.loops.size(); ++k) {
            const auto& pin = input_.rims[k].pin;
            turns_.push_back(
                pin ? wrapped(pin->angle - std::arg(complex_at(input_.start, pin->vertex) - begin[k].center)) : 0.0);
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
                const Complex arm = complex_at(now, v) - c;
                const double length = std::abs(arm);
                if (!(length < reach && length > 0.0)) continue;
                const double moves = std::min((reach - length) / (reach - r), 1.0);
                put_complex(result, v, c + moves * way + arm * std::exp(power * std::log(length / reach)));
            }
        }
        return result;
    }

    /// Moves rims from circles to circles, and the inside by the harmonic displacement.
    /// @param share of the turns
    PlanarPoints step_to(PlanarPoints now, const std::vector<Circle>& from, const std::vector<Circle>& to, double share,
                         bool by_rings) const
    {
        const std::vector<Index>& rim = domain_.rim();
        const std::vector<std::size_t>& loop_of = domain_.rim_loops();
        VectorXcd there(static_cast<Eigen::Index>(rim.size()));
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const Circle& circle = to[loop_of[i]];
            const Complex arm = complex_at(now, rim[i]) - from[loop_of[i]].center;
            there[static_cast<Eigen::Index>(i)] =
                circle.center + circle.radius / std::abs(arm) * arm * std::polar(1.0, share * turns_[loop_of[i]]);
        }
        if (by_rings) now = with_rings_moved(now, from, to, share);
        VectorXcd way = there;
        for (std::size_t i = 0; i < rim.size(); ++i) way[static_cast<Eigen::Index>(i)] -= complex_at(now, rim[i]);
        if (way.size() > 0 && way.cwiseAbs().maxCoeff() > nothing) {
            const VectorXcd moved = harmonic_map(input_.triangles, edge_lengths(now, input_.triangles),
                                                 static_cast<Index>(now.rows()), rim, way);
            now.col(0) += moved.real();
            now.col(1) += moved.imag();
        }
        domain_.put_on(to, now);
        return now;
    }

    /// A step, or nothing if faces turn over.
    /// @param unfoldings how many times faces may still be turned back
    std::optional<PlanarPoints> tried(const PlanarPoints& now, double reached, double share, int& unfoldings)
    {
        const std::vector<Circle> from = path_.at(reached), to = path_.at(reached + share);
        for (const bool by_rings : {true, false}) {
            PlanarPoints next = step_to(now, from, to, share, by_rings);
            if (domain_.is_one_to_one(next, to)) return next;
            if (by_rings || !next.allFinite()) continue;
            if (share <= unfolded_share && unfoldings-- > 0 && domain_.unfold(next, to)) return next;
            blame(next);
        }
        return {};
    }

    bool go(int unfoldings, double share_of_all, BendingResult& result)
    {
        PlanarPoints now = domain_.start();
        double reached = 0.0, step = first_share;
        // Forward while maps stay one to one: the step doubles, and halves after a failure.
        for (int trial = 0; trial < trials_of_a_path && reached < 1.0; ++trial) {
            context_.advance(share_of_all * reached);
            const double share = std::min(step, 1.0 - reached);
            if (std::optional<PlanarPoints> next = tried(now, reached, share, unfoldings)) {
                now = std::move(*next);
                reached = share < 1.0 - reached ? reached + share : 1.0;
                step = 2.0 * share;
                ++result.steps;
                domain_.relax(now, path_.at(reached), newton_between);
            } else if ((step = 0.5 * share) < least_share) {
                break;
            }
        }
        // The best of all ways so far says where they are blocked.
        result.newton_steps = domain_.newton_steps();
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
        const std::vector<char> corner = domain_.folded_corners(uv);
        blocked_.clear();
        for (std::size_t k = 0; k < input_.loops.size(); ++k)
            if (std::ranges::any_of(input_.loops[k], [&](Index v) { return corner[v] != 0; }))
                blocked_.push_back(static_cast<Index>(k));
    }

    void finish(const Extremal& extremal, BendingResult& result)
    {
        const std::vector<Circle> circles = path_.at(1.0);
        domain_.relax(result.uv, circles, newton_at_the_end);
        domain_.set_floors(result.uv);
        result.settled = domain_.relax(result.uv, circles, newton_at_the_end);
        domain_.lower_the_largest(extremal, result.uv, circles, newton_at_the_end);
        domain_.put_on(circles, result.uv);
        result.uv.conservativeResize(input_.start.rows(), 2);
        result.newton_steps = domain_.newton_steps();
    }

    const BendingInput& input_;
    const CirclePath& path_;
    ExecutionContext& context_;
    BentDomain domain_;
    std::vector<double> turns_;  // of the loops, radians
    std::vector<Index> blocked_;
};

}  // namespace

BendingResult bend_along(const BendingInput& input, const CirclePath& path, const Extremal& extremal,
                         ExecutionContext& context)
{
    return CircleBending(input, path, context).run(extremal);
}

}  // namespace koebe
