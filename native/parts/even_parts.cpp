#include "parts/even_parts.h"

#include "circles/circle_fit.h"
#include "execution/side_by_side.h"
#include "parts/darts.h"
#include "relax/even_forces.h"
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
constexpr double even_with_darts = 0.1;                  // E, unless it is asked for
constexpr int dart_rounds = 8, steps_a_dart = 12;
constexpr double reach_of_darts = 0.25;  // on the surface, in roots of its area: what a dart changes
constexpr double refused_around = 0.06;  // a dart's tip, if the dart did not pay

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
    PartRelaxation(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context)
        : flats_(flats), round_(flats.size()), options_(options), context_(context)
    {
        if (options.loops == LoopForm::round)
            for (std::size_t k = 0; k < flats.size(); ++k) round_[k] = round_loops(flats[k]);
    }

    /// @return the parts that could not be moved
    std::vector<std::size_t> relax(double even, int most_steps)
    {
        std::vector<char> moved(flats_.size(), 0);
        side_by_side(flats_.size(), options_.threads, context_, [&](std::size_t k, ExecutionContext& own) {
            moved[k] = relax(flats_[k], round_[k], even, most_steps, own);
            if (moved[k] && options_.dart_price && even > 0.0) cut_darts(k, even, own);
        });
        std::vector<std::size_t> left;
        for (std::size_t k = 0; k < moved.size(); ++k)
            if (!moved[k]) left.push_back(k);
        return left;
    }

    /// With darts first; if these do not serve, from one E to the next, as long as angles are no worse than at 0.
    double relax_freely()
    {
        const double conformal = angle_error(flats_);
        const State before = state();
        if (options_.dart_price) {
            relax(even_with_darts, search_steps);
            if (angle_error(flats_) <= conformal) return even_with_darts;
            restore(before);
            options_.dart_price = std::nullopt;
        }
        double even = 0.0;
        for (double next = first_even; next >= least_even && next <= 1.0;) {
            const State last = state();
            relax(next, search_steps);
            if (angle_error(flats_) <= conformal) {
                even = next;
                next *= step;
            } else {
                restore(last);
                if (even > 0.0) break;
                next *= 0.25;
            }
        }
        return even;
    }

private:
    struct State {
        std::vector<FlatPart> flats;
        std::vector<std::vector<RoundLoop>> round;
    };

    static bool relax(FlatPart& flat, std::vector<RoundLoop>& round, double even, int most_steps,
                      ExecutionContext& context)
    {
        return make_even({flat.vertices, flat.surface.triangles, flat.surface.loops, flat.points, round}, even,
                         packed_side, context, most_steps)
            .moved;
    }

    static VectorXd energies(const FlatPart& flat, double even)
    {
        return even_forces(flat.vertices, flat.surface.triangles, flat.points, even).energy;
    }

    /// Darts opened, and the part relaxed. @return what each gains; none where they cannot be opened
    std::vector<double> open(FlatPart& flat, std::vector<RoundLoop>& round, const std::vector<Dart>& darts, double even,
                             ExecutionContext& context)
    {
        const std::vector<int> nearest = nearest_dart(flat, darts, reach_of_darts);
        const VectorXd before = energies(flat, even);
        if (!open_darts(flat, darts)) return {};
        if (!relax(flat, round, even, steps_a_dart, context)) return {};
        const VectorXd after = energies(flat, even);
        std::vector<double> gain(darts.size(), 0.0);
        for (std::size_t f = 0; f < nearest.size(); ++f)
            if (nearest[f] >= 0) gain[nearest[f]] += before[f] - after[f];
        return gain;
    }

    void cut_darts(std::size_t k, double even, ExecutionContext& context)
    {
        std::vector<char> refused(static_cast<std::size_t>(flats_[k].points.rows()), 0);
        for (int round = 0; round < dart_rounds; ++round) {
            refused.resize(static_cast<std::size_t>(flats_[k].points.rows()), 0);
            std::vector<Dart> darts = promising_darts(flats_[k], even, *options_.dart_price, refused);
            if (darts.empty()) return;
            FlatPart flat = flats_[k];
            std::vector<RoundLoop> loops = round_[k];
            std::vector<double> gain = open(flat, loops, darts, even, context);
            if (getenv("DARTS")) {
                fprintf(stderr, "part %zu round %d: %zu darts, opened %zu\n", k, round, darts.size(), gain.size());
                for (std::size_t i = 0; i < gain.size(); ++i)
                    fprintf(stderr, "   tip %d length %.3f predicted %.5f gain %.5f price %.5f\n", darts[i].vertices.front(),
                            darts[i].length, darts[i].gain, gain[i], *options_.dart_price * darts[i].length);
            }
            std::vector<Dart> paying;
            for (std::size_t i = 0; i < darts.size(); ++i) {
                if (!gain.empty() && gain[i] > *options_.dart_price * darts[i].length)
                    paying.push_back(darts[i]);
                else
                    refuse(flats_[k], darts[i].vertices.front(), refused);
            }
            if (paying.size() < darts.size()) {
                if (paying.empty()) continue;
                flat = flats_[k];
                loops = round_[k];
                if (open(flat, loops, paying, even, context).empty()) return;
            }
            flats_[k] = std::move(flat);
            round_[k] = std::move(loops);
        }
    }

    static void refuse(const FlatPart& flat, Index tip, std::vector<char>& refused)
    {
        for (Index v = 0; v < static_cast<Index>(refused.size()); ++v)
            if ((flat.vertices.row(v) - flat.vertices.row(tip)).norm() < refused_around) refused[v] = 1;
    }

    State state() const { return {flats_, round_}; }
    void restore(const State& state)
    {
        flats_ = state.flats;
        round_ = state.round;
    }

    std::vector<FlatPart>& flats_;
    std::vector<std::vector<RoundLoop>> round_;
    EvenOptions options_;
    ExecutionContext& context_;
};

}  // namespace

EvenParts make_parts_even(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context)
{
    PartRelaxation parts(flats, options, context);
    if (!options.even) return {parts.relax_freely(), {}};
    if (*options.even == 0.0) return {};
    return {*options.even, parts.relax(*options.even, most_steps)};
}

}  // namespace koebe
