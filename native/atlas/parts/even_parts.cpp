#include "parts/even_parts.h"

#include "circles/circle_fit.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "darts/dart_rounds.h"
#include "darts/own_start.h"
#include "darts/stitches.h"
#include "darts/tension.h"
#include "darts/through_rounds.h"
#include "even/even_map.h"
#include "execution/profile.h"
#include "execution/side_by_side.h"
#include "proxies/carried_parts.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double on_track = 1e-6;  // of a circle's radius, or a line's length: vertices farther off are free
constexpr double first_even = 0.02, least_even = 0.005;       // start and end of the search for E
constexpr int search_steps = 12;                              // for an E of the search, and before it for
constexpr int far_rounds = 16;                                // with the void, while faces are far from their size
constexpr EvenEffort look{4, 1, 8};                           // a first look, which ends the trial if angles are worse
constexpr double step = 1.5;                                  // factor from one E to the next
constexpr std::array less_even_with_darts{0.06, 0.03, 0.01};  // E with darts if angles are worse at dart_even
constexpr double tolerant = 1.2;                              // of an E at which angles may be no worse
constexpr EvenEffort carried_effort{12, 3, 24};               // for parts that were relaxed on a coarse surface, or
constexpr EvenEffort own_effort{12, 6, 60};                   // for those of them that start from their own map

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
        relax(even, [&](const FlatPart&) { return effort; });
    }

    void relax(double even, const std::function<EvenEffort(const FlatPart&)>& effort_of)
    {
        const ProfiledStage profiled("relax");
        std::vector<char> moved(parts_.size(), 0);
        side_by_side(parts_.size(), options_.threads, context_, [&](std::size_t k, ExecutionContext& own) {
            auto& [flat, round] = parts_[k];
            moved[k] = make_even(flat_surface(flat, round), even, packed_side, own, effort_of(flat)).moved;
        });
        left_.clear();
        for (std::size_t k = 0; k < moved.size(); ++k)
            if (!moved[k]) left_.push_back(k);
    }

    /// The parts that could not be moved.
    const std::vector<std::size_t>& left() const { return left_; }

    /// @return whether anything was cut
    bool relax_with_darts(double even, const EvenEffort& effort)
    {
        if (!(options_.darts > 0.0)) count_all_faces_alike();
        relax(even, effort);
        if (!(options_.darts > 0.0)) return false;
        const bool joined = cut_through(even, {});
        cut_darts(parts_, DartTips::anywhere, even, cut_price(), options_.threads, context_);
        const bool is_cut = joined || std::ranges::any_of(parts_, has_darts);
        if (is_cut) relax_cut(even, effort);
        const bool is_split = cut_through(even, options_.piece * cut_price());
        const bool is_stitched = stitch(even);
        const bool is_roomy = cut_for_room();
        const bool is_weighted = count_all_faces_alike();
        if (is_roomy || is_split || is_stitched || is_weighted) relax_cut(even, effort);
        return is_cut || is_split || is_stitched || is_roomy;
    }

    /// Tries darts first. If they do not help, goes from one E to the next, as long as angles are no worse than at 0.
    double relax_freely()
    {
        const double conformal = angles();
        const std::vector<HeldPart> before = parts_;
        // With darts, at falling E.
        if (options_.darts > 0.0) {
            const bool is_cut = relax_with_darts(tuning::dart_even, search());
            if (angles() <= conformal) return tuning::dart_even;
            if (is_cut)
                for (const double less : less_even_with_darts) {
                    relax_cut(less, search());
                    if (angles() <= conformal) return less;
                }
            parts_ = before;
        }
        count_all_faces_alike();
        return rise_freely(conformal);
    }

    /// Relaxes parts with their cuts, at first only a little. If their angles are worse than the bounds allow, goes on
    /// with an E at which they may be no worse: angles go about with the third root of E.
    EvenParts relax_carried(double even, AngleBounds bounds)
    {
        for (auto next = less_even_with_darts.begin();;) {
            relax_cut(even, look);
            start_stuck_anew(even);
            if (bounds.exact && angles() > tuning::carried_error * bounds.sum()) bounds = bounds.exact();
            if (bounds.most.empty() || angles() <= tuning::carried_error * bounds.sum()) {
                relax_cut(even, [](const FlatPart& flat) { return flat.is_near ? carried_effort : own_effort; });
                // The coarse surface had no fingers and toes that darts could open.
                if (options_.darts > 0.0 && options_.loops == LoopForm::free && !is_uncut_sheet())
                    cut_darts(parts_, DartTips::strained, even, cut_price(), options_.threads, context_);
            }
            if (bounds.most.empty() || worst_groups(bounds).empty()) return {even, left_};
            const double times = angles() / bounds.sum();
            next = std::find_if(next, less_even_with_darts.end(), [&](double less) {
                return less < even && less * std::pow(times, 3) < tolerant * even;
            });
            if (next == less_even_with_darts.end()) next = std::prev(next);
            if (*next >= even) break;
            even = *next;
        }
        relax_cut(even, EvenEffort{.most_far = far_rounds});  // parts that are far from their minimum
        std::vector<std::size_t> worse = worst_groups(bounds);
        return {worse.size() < bounds.most.size() ? even : 0.0, left_, std::move(worse)};
    }

private:
    /// Without darts: the greatest E at which angles are no worse than at 0. First looks say how far to go.
    double rise_freely(double conformal)
    {
        const std::vector<HeldPart> before = parts_;
        for (double first = first_even; first >= least_even; first *= 0.25) {
            std::vector<std::pair<double, std::vector<HeldPart>>> looked;
            for (double even = first; even <= 1.0; even *= step) {
                relax(even, look);
                if (angles() > (1.0 + tuning::noticeable) * conformal) break;
                looked.emplace_back(even, parts_);
            }
            for (; !looked.empty(); looked.pop_back()) {
                parts_ = std::move(looked.back().second);
                relax(looked.back().first, search());
                if (angles() <= conformal) return looked.back().first;
            }
            parts_ = before;
        }
        return 0.0;
    }

    EvenEffort search() const
    {
        return {.most_steps = search_steps, .most_rounds = options_.rounds, .most_far = far_rounds};
    }

    /// Once cuts are decided, hidden faces count as all others. @return whether some did not
    bool count_all_faces_alike()
    {
        bool any = false;
        for (HeldPart& part : parts_) {
            const VectorXd weights = weights_of_faces(part.flat);
            any = any || (weights.size() > 0 && weights.minCoeff() < 1.0);
            part.flat.shown.clear();
        }
        return any;
    }

    double cut_price() const { return options_.dearer * dart_price(options_.darts); }

    /// @param piece price of one more part, in energy; without a value no part is split @return whether any part was
    /// cut
    bool cut_through(double even, std::optional<double> piece)
    {
        if (options_.loops != LoopForm::free) return false;
        const ThroughPrice price{cut_price(), piece};
        return cut_parts_through(parts_, even, price, options_.threads, context_);
    }

    bool stitch(double even)
    {
        if (options_.loops != LoopForm::free || !options_.stitch) return false;
        return stitch_parts(parts_, even, {cut_price(), options_.piece * cut_price()}, context_);
    }

    /// Whether a single part has all of the surface without a cut: a long sheet stays as long as it is.
    bool is_uncut_sheet() const { return parts_.size() == 1 && !parts_.front().flat.is_cut_open(); }

    bool cut_for_room()
    {
        if (options_.loops != LoopForm::free || !options_.roomy || is_uncut_sheet()) return false;
        return cut_parts_for_room(parts_, room_price(options_.darts, options_.piece), options_.threads, context_);
    }

    /// Relaxes parts that are one to one as stored, and keeps them so.
    void relax_cut(double even, const EvenEffort& effort)
    {
        relax_cut(even, [&](const FlatPart&) { return effort; });
    }

    void relax_cut(double even, const std::function<EvenEffort(const FlatPart&)>& effort)
    {
        const std::vector<HeldPart> before = parts_;
        relax(even, effort);
        for (std::size_t k = 0; k < parts_.size(); ++k)
            if (!survives_storing(parts_[k].flat)) parts_[k] = before[k];
    }

    /// Maps parts by themselves that are stuck far from their minimum.
    void start_stuck_anew(double even)
    {
        const auto energy = [&](const FlatPart& flat) { return forces_in(flat, even).energy.sum(); };
        side_by_side(parts_.size(), options_.threads, context_, [&](std::size_t k, ExecutionContext& own) {
            FlatPart& flat = parts_[k].flat;
            const double area = face_areas(flat.vertices, flat.surface.triangles).sum();
            if (!flat.is_near || !parts_[k].round.empty() || !(energy(flat) > tuning::stuck * area)) return;
            FlatPart anew = flat;
            start_by_itself({}, anew, own);
            make_even(flat_surface(anew, parts_[k].round), even, packed_side, own, {.most_far = far_rounds});
            if (lies_one_to_one(anew, anew.points) && survives_storing(anew) && energy(anew) < energy(flat))
                flat = std::move(anew);
        });
    }

    /// The groups that must go back to E = 0, so that angles are no worse than there: those that gain most.
    std::vector<std::size_t> worst_groups(AngleBounds& bounds) const
    {
        if (bounds.exact && angles() > bounds.sum()) bounds = bounds.exact();
        std::vector<double> excess(bounds.most.size(), 0.0);
        for (std::size_t k = 0; k < parts_.size(); ++k) excess[bounds.group[k]] += sum_of_angle_errors(parts_[k].flat);
        std::ranges::transform(excess, bounds.most, excess.begin(), std::minus<>());
        double sum = std::accumulate(excess.begin(), excess.end(), 0.0);
        std::vector<std::size_t> groups = numbers_below<std::size_t>(excess.size()), worse;
        std::ranges::stable_sort(groups, std::ranges::greater(), [&](std::size_t group) { return excess[group]; });
        for (const std::size_t group : groups) {
            if (!(sum > 0.0)) break;
            sum -= excess[group];
            worse.push_back(group);
        }
        return worse;
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

}  // namespace

EvenParts make_parts_even(std::vector<FlatPart>& flats, const EvenOptions& options, ExecutionContext& context)
{
    PartRelaxation parts(flats, options, context);
    if (options.even == 0.0) return {};
    if (options.even) parts.relax_with_darts(*options.even, {.most_far = far_rounds});
    const double even = options.even ? *options.even : parts.relax_freely();
    return {even, even > 0.0 ? parts.left() : std::vector<std::size_t>{}};
}

EvenParts relax_carried(std::vector<FlatPart>& flats, double even, AngleBounds bounds, const EvenOptions& options,
                        ExecutionContext& context)
{
    return PartRelaxation(flats, options, context).relax_carried(even, std::move(bounds));
}

double cost_when_even(std::vector<FlatPart> parts, const EvenOptions& options, ExecutionContext& context)
{
    make_parts_even(parts, options, context);
    const double even = options.even.value_or(tuning::dart_even);
    double energy = 0.0, boundary = 0.0;
    for (const FlatPart& part : parts) {
        energy += lies_one_to_one(part, part.points) ? forces_in(part, even).energy.sum()
                                                     : std::numeric_limits<double>::infinity();
        for (const VertexLoop& loop : part.surface.loops) boundary += loop_edges(part.vertices, loop).sum();
    }
    return energy + layout_cost(options.darts, 0.5 * boundary, options.piece, static_cast<double>(parts.size()));
}

}  // namespace koebe
