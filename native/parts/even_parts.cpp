#include "parts/even_parts.h"

#include "circles/circle_fit.h"
#include "execution/side_by_side.h"
#include "relax/even_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace koebe {
namespace {

constexpr double on_track = 1e-6;  // of a circle's radius, or a line's length: what lies farther off is free
constexpr double first_even = 0.02, least_even = 0.005;  // of the search for E
constexpr int search_steps = 12, most_steps = 60;        // Newton steps for one, and for one that was asked for
constexpr double step = 1.5;                             // from one to the next

/// The circle of a rim's held vertices, or the straight end of a tube.
Track track_of(PartKind kind, const PlanarPoints& at)
{
    Track track;
    track.straight = kind == PartKind::tube;
    if (track.straight) {
        track.point = {at.col(0).mean(), at.col(1).mean()};
        track.direction = {0.0, 1.0};
    } else {
        const VectorXcd points = at.col(0) + Complex(0.0, 1.0) * at.col(1);
        track.circle = fit_circle_least_squares(points);
    }
    return track;
}

/// How far off its track a point is, over the extent of the track.
double off_track(const Track& track, const PlanarPoints& at, Eigen::Index i)
{
    const Complex z(at(i, 0), at(i, 1));
    if (!track.straight) return std::abs(std::abs(z - track.circle.center) / track.circle.radius - 1.0);
    const double length = at.col(1).maxCoeff() - at.col(1).minCoeff();
    return std::abs(z.real() - track.point.real()) / std::max(length, 1e-300);
}

std::vector<RoundLoop> round_loops(const FlatPart& flat)
{
    std::vector<RoundLoop> loops;
    for (const std::vector<Index>& rim : flat.rims) {
        RoundLoop loop;
        std::ranges::copy_if(rim, std::back_inserter(loop.vertices), [&](Index v) { return flat.held[v]; });
        if (loop.vertices.size() < 3) continue;
        const PlanarPoints at = flat.points(loop.vertices, Eigen::all);
        loop.track = track_of(flat.kind, at);
        bool fits = true;
        for (Eigen::Index i = 0; i < at.rows(); ++i) fits = fits && off_track(loop.track, at, i) < on_track;
        if (fits) loops.push_back(std::move(loop));
    }
    return loops;
}

class PartRelaxation {
public:
    PartRelaxation(std::vector<FlatPart>& flats, LoopForm loops, int threads, ExecutionContext& context)
        : flats_(flats), round_(flats.size()), threads_(threads), context_(context)
    {
        if (loops == LoopForm::round)
            for (std::size_t k = 0; k < flats.size(); ++k) round_[k] = round_loops(flats[k]);
    }

    /// @return the parts that could not be moved
    std::vector<std::size_t> relax(double even, int most_steps)
    {
        std::vector<char> moved(flats_.size(), 0);
        side_by_side(flats_.size(), threads_, context_, [&](std::size_t k, ExecutionContext& own) {
            FlatPart& flat = flats_[k];
            moved[k] = make_even({flat.vertices, flat.surface.triangles, flat.surface.loops, flat.points, round_[k]},
                                 even, packed_side, own, most_steps)
                           .moved;
        });
        std::vector<std::size_t> left;
        for (std::size_t k = 0; k < moved.size(); ++k)
            if (!moved[k]) left.push_back(k);
        return left;
    }

    /// From one E to the next, as long as angles are no worse than at 0.
    double relax_freely()
    {
        const double conformal = angle_error(flats_);
        double even = 0.0;
        for (double next = first_even; next >= least_even && next <= 1.0;) {
            const State before = state();
            relax(next, search_steps);
            if (angle_error(flats_) <= conformal) {
                even = next;
                next *= step;
            } else {
                restore(before);
                if (even > 0.0) break;
                next *= 0.25;
            }
        }
        return even;
    }

private:
    struct State {
        std::vector<PlanarPoints> points;
        std::vector<std::vector<RoundLoop>> round;
    };

    State state() const
    {
        State state{{}, round_};
        for (const FlatPart& flat : flats_) state.points.push_back(flat.points);
        return state;
    }
    void restore(const State& state)
    {
        round_ = state.round;
        for (std::size_t k = 0; k < flats_.size(); ++k) flats_[k].points = state.points[k];
    }

    std::vector<FlatPart>& flats_;
    std::vector<std::vector<RoundLoop>> round_;
    int threads_;
    ExecutionContext& context_;
};

}  // namespace

EvenParts make_parts_even(std::vector<FlatPart>& flats, std::optional<double> even, LoopForm loops, int threads,
                          ExecutionContext& context)
{
    PartRelaxation parts(flats, loops, threads, context);
    if (!even) return {parts.relax_freely(), {}};
    if (*even == 0.0) return {};
    return {*even, parts.relax(*even, most_steps)};
}

}  // namespace koebe
