#include "parts/even_parts.h"

#include "circles/circle_fit.h"
#include "even/even_map.h"
#include "execution/side_by_side.h"
#include "parts/carried_cuts.h"
#include "parts/coarse_parts.h"
#include "parts/dart_rounds.h"
#include "parts/tension.h"
#include "parts/through_rounds.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <iterator>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr double on_track = 1e-6;  // of a circle's radius, or a line's length: vertices farther off are free
constexpr double first_even = 0.02, least_even = 0.005;       // start and end of the search for E
constexpr EvenEffort search{.most_steps = 12};                // for an E of the search, and before it for
constexpr EvenEffort look{4, 1, 8};                           // a first look, which ends the trial if
constexpr double clearly_worse = 1.02;                        // angles are worse by this factor
constexpr double most_worse = 1.1;                            // the same, of parts that start from coarse ones
constexpr double roomy_piece = 0.1;                           // price of one more part, if that saves room
constexpr double step = 1.5;                                  // factor from one E to the next
constexpr double even_with_darts = 0.1;                       // E with darts, if no E is given,
constexpr std::array less_even_with_darts{0.06, 0.03, 0.01};  // and if angles are then worse
constexpr Index faces_to_decide = 4000;                       // on which the cuts of all parts are decided,
constexpr std::size_t many_faces = 6000;                      // if they have more faces,
constexpr std::size_t fewest_in_part = 20;                    // and so many coarse ones in the mean
constexpr double tolerant = 1.5;                              // of an E at which angles may be no worse
constexpr EvenEffort carried_effort{12, 3, 24};               // for parts whose cuts were decided so, or
constexpr EvenEffort own_effort{12, 6, 60};                   // for those of them that start from their own map
constexpr double dearer_on_coarse = 2.0;                      // cuts: coarse parts bend less, and so overrate them

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

bool has_darts(const HeldPart& part) { return !part.flat.tips.empty(); }

/// What a dart as long as the root of the surface's area costs, in energy.
double dart_price(double darts) { return 1e-4 / darts; }

class PartRelaxation {
public:
    PartRelaxation(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context)
        : flats_(flats), options_(options), context_(context)
    {
        for (FlatPart& flat : flats) {
            std::vector<RoundLoop> round;
            if (options.loops == LoopForm::round) round = round_loops(flat);
            flat.held.assign(flat.held.size(), 0);
            for (const RoundLoop& loop : round)
                for (const Index v : loop.vertices) flat.held[v] = 1;
            parts_.push_back({std::move(flat), std::move(round)});
        }
    }
    ~PartRelaxation()
    {
        flats_.resize(parts_.size());
        for (std::size_t k = 0; k < parts_.size(); ++k) flats_[k] = std::move(parts_[k].flat);
    }
    PartRelaxation(const PartRelaxation&) = delete;
    PartRelaxation& operator=(const PartRelaxation&) = delete;

    void relax(double even, const EvenEffort& effort)
    {
        relax(even, [&](std::size_t) { return effort; });
    }

    template <typename EffortOf>
    requires std::invocable<EffortOf, std::size_t>
    void relax(double even, const EffortOf& effort_of)
    {
        std::vector<char> moved(parts_.size(), 0);
        side_by_side(parts_.size(), options_.threads, context_, [&](std::size_t k, ExecutionContext& own) {
            auto& [flat, round] = parts_[k];
            moved[k] = make_even(flat_surface(flat, round), even, packed_side, own, effort_of(k)).moved;
        });
        left_.clear();
        for (std::size_t k = 0; k < moved.size(); ++k)
            if (!moved[k]) left_.push_back(k);
    }

    /// The parts that could not be moved.
    const std::vector<std::size_t>& left() const { return left_; }

    void relax_with_darts(double even, const EvenEffort& effort)
    {
        relax(even, effort);
        if (!(options_.darts > 0.0)) return;
        const bool joined = cut_through(even, {});
        cut_darts(parts_, even, dart_price(options_.darts), options_.threads, context_);
        if (joined || std::ranges::any_of(parts_, has_darts)) relax_cut(even, effort);
        const bool is_split = cut_through(even, options_.piece * dart_price(options_.darts));
        if (cut_for_room() || is_split) relax_cut(even, effort);
    }

    /// Tries darts first. If they do not help, goes from one E to the next, as long as angles are no worse than at 0.
    double relax_freely()
    {
        const double conformal = angles();
        const std::vector<HeldPart> before = parts_;
        if (options_.darts > 0.0) {
            relax_with_darts(even_with_darts, search);
            if (angles() <= conformal) return even_with_darts;
            if (std::ranges::any_of(parts_, has_darts))
                for (const double less : less_even_with_darts) {
                    relax_cut(less, search);
                    if (angles() <= conformal) return less;
                }
            parts_ = before;
        }
        double even = 0.0;
        for (double next = first_even; next >= least_even && next <= 1.0;) {
            const std::vector<HeldPart> last = parts_;
            relax(next, look);
            if (angles() <= clearly_worse * conformal) relax(next, search);
            if (angles() <= conformal) {
                even = next;
                next *= step;
            } else {
                parts_ = last;
                if (even > 0.0) break;
                next *= 0.25;
            }
        }
        return even;
    }

    /// Relaxes parts whose cuts were decided on coarse parts. @param how as in CarriedParts @param most of the sum
    /// of angle errors: if it is exceeded, E becomes less @return E
    double finish(const std::vector<Carried>& how, double even, double most)
    {
        const auto effort = [&](std::size_t k) { return how[k] == Carried::placed ? carried_effort : own_effort; };
        for (auto next = less_even_with_darts.begin(); next != less_even_with_darts.end(); ++next) {
            relax_cut(even, look);
            if (angles() <= most_worse * most) relax_cut(even, effort);
            const double worse = angles() / most;
            if (worse <= 1.0) return even;
            // Angles go about with the third root of E: leave out an E at which they will be worse, too.
            while (std::next(next) != less_even_with_darts.end() && *next * std::pow(worse, 3) > tolerant * even)
                ++next;
            even = std::min(even, *next);
        }
        relax_cut(even, effort);
        return even;
    }

private:
    /// @param piece price of one more part, in energy; without a value no part is split @return whether any part was
    /// cut
    bool cut_through(double even, std::optional<double> piece)
    {
        if (options_.loops != LoopForm::free) return false;
        const ThroughPrice price{dart_price(options_.darts), piece};
        return cut_parts_through(parts_, even, price, options_.threads, context_);
    }

    bool cut_for_room()
    {
        if (options_.loops != LoopForm::free || !options_.roomy) return false;
        const double price = dart_price(options_.darts);
        return cut_parts_for_room(parts_, {price, roomy_piece * options_.piece * price}, options_.threads, context_);
    }

    /// Relaxes parts that are one to one as stored, and keeps them so.
    template <typename Effort>
    void relax_cut(double even, const Effort& effort)
    {
        const std::vector<HeldPart> before = parts_;
        relax(even, effort);
        for (std::size_t k = 0; k < parts_.size(); ++k)
            if (!survives_storing(parts_[k].flat)) parts_[k] = before[k];
    }

    double angles() const
    {
        double sum = 0.0;
        for (const HeldPart& part : parts_) sum += sum_of_angle_errors(part.flat);
        return sum;
    }

    std::vector<FlatPart>& flats_;
    std::vector<HeldPart> parts_;
    std::vector<std::size_t> left_;
    EvenOptions options_;
    ExecutionContext& context_;
};

/// E and the cuts, decided on these parts.
EvenParts decide(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context)
{
    PartRelaxation parts(flats, options, context);
    if (options.even == 0.0) return {};
    if (options.even) parts.relax_with_darts(*options.even, {});
    const double even = options.even ? *options.even : parts.relax_freely();
    return {even, even > 0.0 ? parts.left() : std::vector<std::size_t>{}};
}

/// Small parts whose cuts could not be carried get cuts that are decided on themselves.
void cut_anew(CarriedParts& carried, double even, const EvenOptions& options, ExecutionContext& context)
{
    CarriedParts all;
    for (std::size_t k = 0; k < carried.parts.size(); ++k) {
        std::vector<FlatPart> own{std::move(carried.parts[k])};
        Carried how = carried.how[k];
        if (how == Carried::whole && own.front().faces.size() <= static_cast<std::size_t>(faces_to_decide)) {
            PartRelaxation(own, options, context).relax_with_darts(even, search);
            how = Carried::placed;
        }
        all.how.resize(all.how.size() + own.size(), how);
        std::ranges::move(own, std::back_inserter(all.parts));
    }
    carried = std::move(all);
}

/// E and the cuts, decided on coarse parts. Then the fine parts are cut in the same places, and relaxed once.
EvenParts decide_coarsely(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context)
{
    const CoarseParts before = coarse_parts(flats, faces_to_decide, context);
    std::vector<FlatPart> after = before.parts;
    EvenOptions coarse_options = options;
    coarse_options.darts /= dearer_on_coarse;
    const double even = decide(after, coarse_options, context).even;
    if (!(even > 0.0)) return {};
    const auto angles = [&] {
        double sum = 0.0;
        for (const FlatPart& flat : flats) sum += sum_of_angle_errors(flat);
        return sum;
    };
    const double most =
        options.even ? std::numeric_limits<double>::infinity() : angles();  // an E that is given is kept
    std::vector<FlatPart> uncut = std::move(flats);
    CarriedParts cut = carried(uncut, before, after, context);
    cut_anew(cut, even, options, context);
    flats = std::move(cut.parts);
    EvenParts result;
    {
        PartRelaxation parts(flats, options, context);
        result.even = parts.finish(cut.how, even, most);
        result.left = parts.left();
    }
    if (angles() <= most) return result;
    flats = std::move(uncut);  // cuts lower the angles, so no E would do without them
    return {};
}

/// Whether parts are large enough for coarse ones: edges of a round loop must lie on the fine part's circle.
bool has_many_faces(const std::vector<FlatPart>& flats, const EvenOptions& options)
{
    std::size_t faces = 0;
    for (const FlatPart& flat : flats) faces += flat.faces.size();
    return options.loops == LoopForm::free && options.even != 0.0 && faces > many_faces &&
           flats.size() < faces_to_decide / fewest_in_part;
}

}  // namespace

EvenParts make_parts_even(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context)
{
    return has_many_faces(flats, options) ? decide_coarsely(flats, options, context) : decide(flats, options, context);
}

double cost_when_even(std::vector<FlatPart> parts, const EvenOptions& options, ExecutionContext& context)
{
    make_parts_even(parts, options, context);
    const double even = options.even.value_or(even_with_darts);
    double energy = 0.0, boundary = 0.0;
    for (const FlatPart& part : parts) {
        energy += lies_one_to_one(part, part.points) ? forces_in(part, even).energy.sum()
                                                     : std::numeric_limits<double>::infinity();
        for (const VertexLoop& loop : part.surface.loops) boundary += loop_edges(part.vertices, loop).sum();
    }
    return energy + dart_price(options.darts) * (0.5 * boundary + options.piece * static_cast<double>(parts.size()));
}

}  // namespace koebe
