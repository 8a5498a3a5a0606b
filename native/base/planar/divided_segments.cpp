#include "planar/divided_segments.h"

#include "core/errors.h"
#include "core/silent_cgal.h"
#include "planar/meeting_boxes.h"
#include "planar/planar_predicates.h"
#include "planar/planar_region.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t most_cuts = 2000000;  // two for each crossing
constexpr int most_rounds = 50;             // three or four in practice
constexpr double grid_steps = 0x1p36;       // from 0 to the largest coordinate, up to a power of two

using SegmentBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;

std::pair<double, double> place_of(Complex z) { return {z.real(), z.imag()}; }
bool before(Complex z, Complex w) { return place_of(z) < place_of(w); }

struct Cut {
    std::size_t segment;
    double along;
    Complex at;
};

/// Puts the lower ends first, and joins segments with the same ends.
void join_equal(std::vector<CountedSegment>& segments)
{
    for (CountedSegment& one : segments)
        if (before(one.upper, one.lower)) one = {one.upper, one.lower, -one.times};
    const auto ends = [](const CountedSegment& one) { return std::pair(place_of(one.lower), place_of(one.upper)); };
    std::ranges::sort(segments, {}, ends);
    std::size_t count = 0;
    for (std::size_t i = 0; i < segments.size();) {
        CountedSegment sum = segments[i];
        for (++i; i < segments.size() && ends(segments[i]) == ends(sum); ++i) sum.times += segments[i].times;
        if (sum.times != 0 && sum.lower != sum.upper) segments[count++] = sum;
    }
    segments.resize(count);
}

/// The direction in which most of the length runs, up to right angles: boxes along it are thin.
Complex main_direction(const std::vector<CountedSegment>& segments)
{
    Complex sum = 0.0;
    for (const CountedSegment& one : segments) {
        const Complex way = one.upper - one.lower;
        const double length = std::abs(way);
        if (!(length > 0.0)) continue;
        const Complex square = (way / length) * (way / length);
        sum += length * (square * square);
    }
    return std::polar(1.0, 0.25 * std::arg(sum));
}

/// The grid that all ends lie on: the points where three lines meet, computed for two of them, are then one.
class Grid {
public:
    explicit Grid(const std::vector<CountedSegment>& segments)
    {
        double largest = 0.0;
        for (const CountedSegment& one : segments)
            for (const Complex z : {one.lower, one.upper})
                largest = std::max({largest, std::abs(z.real()), std::abs(z.imag())});
        if (largest > 0.0) step_ = std::exp2(std::ceil(std::log2(largest))) / grid_steps;
    }
    double step() const { return step_; }
    Complex nearest(Complex z) const { return {nearest(z.real()), nearest(z.imag())}; }

private:
    double nearest(double x) const { return std::round(x / step_) * step_; }
    double step_ = 1.0;
};

Complex crossing_of(const CountedSegment& first, const CountedSegment& second)
{
    const Complex a = first.lower, way = first.upper - a, c = second.lower, other = second.upper - c;
    return a + std::clamp(cross(c - a, other) / cross(way, other), 0.0, 1.0) * way;
}

class Dividing {
public:
    Dividing(const std::vector<CountedSegment>& segments, const Grid& grid) : segments_(segments), grid_(grid) {}

    std::vector<Cut> cuts()
    {
        const Complex turn = std::conj(main_direction(segments_));
        const double room = 2.0 * grid_.step();
        std::vector<SegmentBox> boxes;
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            const Complex a = turn * segments_[i].lower, b = turn * segments_[i].upper;
            double low[2] = {std::min(a.real(), b.real()) - room, std::min(a.imag(), b.imag()) - room};
            double high[2] = {std::max(a.real(), b.real()) + room, std::max(a.imag(), b.imag()) + room};
            boxes.emplace_back(low, high, i);
        }
        detail::visit_meeting_boxes(boxes,
                                    [&](const SegmentBox& s, const SegmentBox& t) { divide(s.info(), t.info()); });
        return std::move(cuts_);
    }

private:
    using Point = detail::PlanarRegion::Kernel::Point_2;

    static int side(const CountedSegment& segment, Complex z)
    {
        return CGAL::orientation(detail::to_point(segment.lower), detail::to_point(segment.upper), detail::to_point(z));
    }

    void cut(std::size_t i, Complex z)
    {
        const Complex a = segments_[i].lower, b = segments_[i].upper;
        if (z == a || z == b) return;
        if (cuts_.size() >= most_cuts) throw InputError("the paths cross over a million times: simplify them");
        cuts_.push_back({i, dot(z - a, b - a), z});
    }

    /// Leads a segment through an end of another one that is less than a step away. So segments that are on one line up
    /// to rounding become one chain.
    bool snap(std::size_t i, Complex z)
    {
        const CountedSegment& s = segments_[i];
        const Complex way = s.upper - s.lower, to = z - s.lower;
        const double along = dot(to, way), squared = std::norm(way);
        if (!(along > 0.0 && along < squared) || z == s.lower || z == s.upper) return false;
        if (!(std::abs(cross(way, to)) < grid_.step() * std::sqrt(squared))) return false;
        cut(i, z);
        return true;
    }

    void divide(std::size_t i, std::size_t j)
    {
        const CountedSegment &s = segments_[i], &t = segments_[j];
        bool snapped = false;
        for (const Complex z : {t.lower, t.upper}) snapped |= snap(i, z);
        for (const Complex z : {s.lower, s.upper}) snapped |= snap(j, z);
        if (snapped || side(s, t.lower) * side(s, t.upper) >= 0 || side(t, s.lower) * side(t, s.upper) >= 0) return;
        const Complex z = grid_.nearest(crossing_of(s, t));
        cut(i, z);
        cut(j, z);
    }

    const std::vector<CountedSegment>& segments_;
    const Grid& grid_;
    std::vector<Cut> cuts_;
};

}  // namespace

std::vector<CountedSegment> divided_segments(std::vector<CountedSegment> segments)
{
    const SilentCgal silent;
    const Grid grid(segments);
    for (CountedSegment& one : segments) one = {grid.nearest(one.lower), grid.nearest(one.upper), one.times};
    for (int round = 0; round < most_rounds; ++round) {
        join_equal(segments);
        std::vector<Cut> cuts = Dividing(segments, grid).cuts();
        if (cuts.empty()) return segments;
        std::ranges::sort(cuts, {},
                          [](const Cut& one) { return std::tuple(one.segment, one.along, place_of(one.at)); });
        for (auto first = cuts.begin(); first != cuts.end();) {
            CountedSegment& whole = segments[first->segment];
            const CountedSegment given = whole;
            const auto last =
                std::find_if(first, cuts.end(), [&](const Cut& c) { return c.segment != first->segment; });
            whole.upper = first->at;
            std::vector<CountedSegment> parts;
            for (; first != last; ++first)
                parts.push_back({first->at, first + 1 == last ? given.upper : (first + 1)->at, given.times});
            segments.insert(segments.end(), parts.begin(), parts.end());
        }
    }
    throw InputError("the paths cross too often in too little room: simplify them");
}

}  // namespace koebe
