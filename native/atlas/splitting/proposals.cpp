#include "splitting/proposals.h"

#include "circles/moebius.h"
#include "cost/tuning.h"
#include "execution/profile.h"
#include "execution/side_by_side.h"
#include "part_maps/log_polar.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace koebe {
namespace {

constexpr double margin = 0.35;  // in u: faces beyond it are surely on the other side
constexpr double apart = 0.5;    // in u: between the windows that are proposed
constexpr std::size_t most_windows = 3, most_tips = 6, most_holes = 6;

struct Window {
    double from = 0.0, area = 0.0;
    Index piece = -1;
    std::vector<Index> pieces;  // (F)
};

Window window_at(const PartMesh& part, const PartMap& map, double from)
{
    std::vector<int> label(part.faces.size());
    for (std::size_t f = 0; f < label.size(); ++f) {
        const double u = map.u[static_cast<Eigen::Index>(f)];
        label[f] = u >= from && u <= from + tuning::window_share * tuning::even_range;
    }
    Window window{from, 0.0, -1, {}};
    Index count = 0;
    window.pieces = connected_pieces(part, label, count);
    std::vector<double> areas(count, 0.0);
    for (std::size_t f = 0; f < label.size(); ++f)
        if (label[f]) areas[window.pieces[f]] += part.areas[static_cast<Eigen::Index>(f)];
    if (count == 0) return window;
    window.piece = static_cast<Index>(std::ranges::max_element(areas) - areas.begin());
    window.area = areas[window.piece];
    return window;
}

/// The windows of most area in one piece, apart from each other. The area of all faces in a window bounds that of a
/// piece: most windows need no look at their pieces.
std::vector<Window> best_windows(const PartMesh& part, const PartMap& map)
{
    std::vector<double> u;
    for (std::size_t f = 0; f < map.lost.size(); ++f)
        if (!map.lost[f]) u.push_back(map.u[static_cast<Eigen::Index>(f)]);
    if (u.empty()) return {};
    // Windows at equal steps over the values of u, without the outermost hundredths.
    const auto quantile = [&](std::size_t at) {
        std::nth_element(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(at), u.end());
        return u[at];
    };
    const double low = quantile(u.size() / 100), high = quantile(u.size() - 1 - u.size() / 100);
    const double step = std::max(0.12, (high - low) / 60.0);
    std::vector<Window> open, best;
    for (double from = low - 0.5; from < high; from += step) open.push_back({from, 0.0, -1, {}});
    // The area in each: faces enter the first window that reaches them and leave after the last.
    std::vector<double> change(open.size() + 1, 0.0);
    const auto first_at = [&](double from) {
        return static_cast<std::size_t>(
            std::clamp(std::ceil((from - open.front().from) / step), 0.0, static_cast<double>(open.size())));
    };
    for (Eigen::Index f = 0; f < map.u.size(); ++f) {
        change[first_at(map.u[f] - tuning::window_share * tuning::even_range)] += part.areas[f];
        change[first_at(map.u[f])] -= part.areas[f];
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < open.size(); ++i) open[i].area = (sum += change[i]) + 1e-9 * part.area;
    // The best ones. A window is looked at closely when its area is the largest left.
    while (!open.empty() && best.size() < most_windows) {
        const auto largest =
            std::ranges::max_element(open, [](const Window& a, const Window& b) { return a.area < b.area; });
        if (!(largest->area > 0.0)) break;
        if (largest->piece < 0) {
            *largest = window_at(part, map, largest->from);
            continue;
        }
        best.push_back(std::move(*largest));
        std::erase_if(open, [&](const Window& w) { return std::abs(best.back().from - w.from) <= apart; });
    }
    return best;
}

Proposal propose(const PartMap& map, const Window& window)
{
    Proposal proposal{std::vector<Side>(window.pieces.size(), Side::free), window.area, "window"};
    for (std::size_t f = 0; f < window.pieces.size(); ++f) {
        const double u = map.u[static_cast<Eigen::Index>(f)];
        if (window.pieces[f] == window.piece)
            proposal.sides[f] = Side::inside;
        else if (u < window.from - margin || u > window.from + tuning::window_share * tuning::even_range + margin)
            proposal.sides[f] = Side::outside;
    }
    return proposal;
}

/// The places where the map shrinks most, in each piece below the window; the costliest piece first.
std::vector<Complex> tips(const PartMesh& part, const PartMap& map, const Window& window)
{
    // Pieces of the faces that are smaller than the window shows.
    std::vector<int> label(part.faces.size());
    for (std::size_t f = 0; f < label.size(); ++f) label[f] = map.u[static_cast<Eigen::Index>(f)] < window.from;
    Index count = 0;
    const std::vector<Index> piece = connected_pieces(part, label, count);
    // Their cost in area times log density, and the smallest face.
    struct Tip {
        double cost = 0.0, u = std::numeric_limits<double>::infinity();
        Complex place;
    };
    std::vector<Tip> all(count);
    for (std::size_t f = 0; f < label.size(); ++f) {
        if (!label[f]) continue;
        const auto face = static_cast<Eigen::Index>(f);
        Tip& tip = all[piece[f]];
        tip.cost += part.areas[face] * std::min(window.from - map.u[face], tuning::lost_cost);
        if (map.u[face] < tip.u) {
            tip.u = map.u[face];
            tip.place = map.centers[face];
        }
    }
    // The costliest ones.
    std::ranges::sort(all, [](const Tip& a, const Tip& b) { return a.cost > b.cost; });
    std::vector<Complex> places;
    for (const Tip& tip : all)
        if (tip.cost > 0.0 && places.size() < most_tips) places.push_back(tip.place);
    return places;
}

std::vector<Side> sides_of(const LogPolar& polar, double from, double until, double gap)
{
    std::vector<Side> sides(static_cast<std::size_t>(polar.t.size()), Side::free);
    for (std::size_t f = 0; f < sides.size(); ++f) {
        const double t = polar.t[static_cast<Eigen::Index>(f)];
        if (t > from + gap && t < until - gap)
            sides[f] = Side::inside;
        else if (t < from - gap || t > until + gap)
            sides[f] = Side::outside;
    }
    return sides;
}

/// A point about which tubes are proposed.
struct Axis {
    Complex about;
    int hole = -1;  ///< its loop, if it is a hole
};

std::vector<Proposal> tubes_about(const PartMesh& part, const PartMap& map, const Axis& axis)
{
    std::vector<Proposal> tubes;
    if (!(std::norm(axis.about) < 1.0)) return tubes;  // on the rim, by rounding
    const LogPolar polar = log_polar(part, map, axis.about, axis.hole);
    for (const double share : {0.985, 0.95}) {
        const TubeRange tube = longest_tube(part, map, polar, share);
        if (!(tube.area > 0.0)) continue;
        const double gap = std::min(0.5 * margin, 0.2 * (tube.until - tube.from));
        tubes.push_back({sides_of(polar, tube.from, tube.until, gap), tube.area, "tube"});
        tubes.push_back(
            {sides_of(polar, -std::numeric_limits<double>::infinity(), tube.until, gap), 0.5 * tube.area, "circle"});
    }
    return tubes;
}

}  // namespace

std::vector<Proposal> proposals(const PartMesh& part, const PartMap& map, int threads, ExecutionContext& context)
{
    const ProfiledStage profiled("proposals");
    std::vector<Proposal> all;
    const std::vector<Window> windows = best_windows(part, map);
    for (const Window& window : windows) all.push_back(propose(map, window));
    if (windows.empty()) return all;
    std::vector<Axis> axes;
    for (const Complex tip : tips(part, map, windows.front())) axes.push_back({tip});
    std::vector<int> holes;
    for (std::size_t k = 0; k < map.circles.size(); ++k)
        if (static_cast<int>(k) != map.outer) holes.push_back(static_cast<int>(k));
    std::ranges::sort(holes, [&](int a, int b) { return map.circles[a].radius < map.circles[b].radius; });
    for (std::size_t i = 0; i < std::min(holes.size(), most_holes); ++i)
        axes.push_back({center_circle(map.circles[holes[i]]).a, holes[i]});
    std::vector<std::vector<Proposal>> tubes(axes.size());
    side_by_side(axes.size(), threads, context,
                 [&](std::size_t i, ExecutionContext&) { tubes[i] = tubes_about(part, map, axes[i]); });
    for (auto& own : tubes) std::ranges::move(own, std::back_inserter(all));
    return all;
}

}  // namespace koebe
