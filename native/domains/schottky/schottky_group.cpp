#include "schottky/schottky_group.h"

#include "circles/circle_projection.h"
#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr int tried_radii = 256;
constexpr int most_letters = 64;
constexpr double some_room = 0.05;  // between circles, over the sum of their radii
constexpr int rounds_of_choice = 2, tried_turns = 12;

/// Fits the generator, and moves each side by half of the misfit.
void fit_sides(const CutLoop& first, VectorXcd& from, VectorXcd& to, SchottkyPlane& plane)
{
    const VectorXcd goal = to(first.matches);
    LinearFractional map = fitted_map(from, goal);
    const Complex middle = goal.mean();
    const double size = std::sqrt((goal.array() - middle).abs2().mean());
    plane.misfit.push_back((map(from) - goal).cwiseAbs().maxCoeff() / size);
    const VectorXcd between = 0.5 * (map(from) + goal);
    from = map.inverse()(between);
    const VectorXcd exact = map(from);
    for (std::size_t i = 0; i < first.matches.size(); ++i) to[first.matches[i]] = exact[static_cast<Eigen::Index>(i)];
    plane.generators.push_back(map);
}

/// The choice of circles for a handle.
enum class PairKind {
    isometric,  ///< equally large
    coaxial,    ///< round the fixed points, at equal distance; these never meet
    fitted,     ///< the circle of least squared distance to the cut, and its image
};

std::array<Circle, 2> pair_of(const SchottkyPlane& plane, std::size_t handle, PairKind kind)
{
    const LinearFractional& map = plane.generators[handle];
    if (kind == PairKind::isometric) return {map.isometric_circle(), map.inverse().isometric_circle()};
    Circle first;
    if (kind == PairKind::coaxial) {
        // Let the coordinate w be 0 at the attracting point and infinity at the other: then |w|^2 = 1 / |lambda|.
        const auto [zero, zero_weight] = map.attracting();
        const auto [pole, pole_weight] = map.inverse().attracting();
        const LinearFractional to_plane = linear_fractional(zero_weight, -zero, pole_weight, -pole).inverse();
        const double product = std::abs(map.multiplier());
        first = to_plane(Circle{0.0, std::sqrt(1.0 / product)});
    } else {
        first = fit_circle_least_squares(plane.images[plane.images.size() - 2 * (plane.generators.size() - handle)]);
    }
    return {first, map(first)};
}

/// Circles of all handles, and how far apart they are.
struct CirclesInPlace {
    std::vector<std::array<Circle, 2>> pairs;
    double room = -1.0;      // between circles, over the sum of their radii; positive if they are apart
    double log_scale = 0.0;  // of the outer circle's radius
};

/// The distance of two separate circles over the sum of their radii.
double room_between(const Circle& a, const Circle& b)
{
    return std::abs(a.center - b.center) / (a.radius + b.radius) - 1.0;
}

/// @param circles all circles that must be apart, except the outer one
double room_among(const std::vector<Circle>& circles)
{
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < circles.size(); ++i) {
        if (!(circles[i].radius > 0.0) || !std::isfinite(std::abs(circles[i].center) + circles[i].radius)) return -1.0;
        for (std::size_t j = 0; j < i; ++j) room = std::min(room, room_between(circles[i], circles[j]));
    }
    return room;
}

CirclesInPlace circles_of(const SchottkyPlane& plane, const std::vector<PairKind>& kinds)
{
    CirclesInPlace result;
    const int outer = plane.outer_handle;
    std::vector<Circle> circles;
    for (std::size_t j = 0; j < kinds.size(); ++j) {
        if (static_cast<int>(j) == outer) {
            result.pairs.push_back({Circle{}, Circle{0.0, std::abs(plane.generators[j].multiplier())}});
            continue;
        }
        result.pairs.push_back(pair_of(plane, j, kinds[j]));
        circles.insert(circles.end(), result.pairs.back().begin(), result.pairs.back().end());
    }
    if (outer < 0) {
        FundamentalCircles own;
        own.pairs = result.pairs;
        // If a hole lies in a circle that is cut out, its copy outside that circle counts.
        for (std::size_t k = 1; k < plane.holes.size(); ++k)
            circles.push_back(applied(way_out(plane.holes[k].center, plane, own), plane.generators, plane.holes[k]));
        result.room = room_among(circles);
        for (const Circle& circle : circles)
            result.room = std::min(result.room, (1.0 - std::abs(circle.center)) / circle.radius - 1.0);
        return result;
    }
    result.room = room_among(circles);
    // Put the outer circle where it has the most room: all others lie between it and its image.
    const double period = -std::log(std::abs(plane.generators[outer].multiplier()));
    double best = -period;
    for (int i = 0; i < tried_radii; ++i) {
        const double log_radius = period * (static_cast<double>(i) / tried_radii - 0.5);
        double room = 0.5 * period;
        for (const Circle& circle : circles) {
            const double middle = std::abs(circle.center);
            if (!(middle > circle.radius)) return result.room = -1.0, result;
            room = std::min({room, log_radius - std::log(middle + circle.radius),
                             std::log(middle - circle.radius) - (log_radius - period)});
        }
        if (room <= best) continue;
        best = room;
        result.log_scale = log_radius;
    }
    result.room = std::min(result.room, best);
    return result;
}

/// Starts with isometric circles; where these meet, handles one after another get circles with more room.
CirclesInPlace roomiest(const SchottkyPlane& plane)
{
    const std::size_t handles = plane.generators.size();
    std::vector<PairKind> kinds(handles, PairKind::isometric);
    CirclesInPlace best = circles_of(plane, kinds);
    for (int round = 0; round < rounds_of_choice && !(best.room > 0.0); ++round)
        for (std::size_t j = 0; j < handles; ++j) {
            if (static_cast<int>(j) == plane.outer_handle) continue;
            for (const PairKind kind : {PairKind::isometric, PairKind::coaxial, PairKind::fitted}) {
                std::vector<PairKind> tried = kinds;
                tried[j] = kind;
                CirclesInPlace circles = circles_of(plane, tried);
                if (!(circles.room > best.room)) continue;
                best = std::move(circles);
                kinds = std::move(tried);
            }
        }
    return best;
}

/// Points of the disk, from the middle outwards.
std::vector<Complex> tried_centers()
{
    std::vector<Complex> result{0.0};
    for (const double radius : {0.3, 0.6, 0.8, 0.9, 0.95})
        for (int turn = 0; turn < tried_turns; ++turn)
            result.push_back(std::polar(radius, 2.0 * std::numbers::pi * turn / tried_turns));
    return result;
}

/// Moves the loops, without the inside of the surface.
SchottkyPlane moved_loops(const SchottkyPlane& plane, const Moebius& map)
{
    SchottkyPlane moved;
    moved.images = plane.images;
    moved.generators = plane.generators;
    moved.holes = plane.holes;
    moved.move(linear_fractional(map.turn, -map.turn * map.a, -std::conj(map.a), 1.0));
    moved.holes.front() = Circle{};
    return moved;
}

}  // namespace

Moebius nearest_with_room(const SchottkyPlane& plane)
{
    const std::vector<PairKind> isometric(plane.generators.size(), PairKind::isometric);
    for (const Complex center : tried_centers()) {
        const Moebius away{center, 1.0};
        if (circles_of(moved_loops(plane, away), isometric).room > some_room) return away;
    }
    return {};
}

void SchottkyPlane::move(const LinearFractional& map)
{
    z = map(z);
    for (VectorXcd& image : images) image = map(image);
    // Do not scale to determinant 1 again: a d - b c, of numbers as large as 1 over a radius, is less accurate.
    for (LinearFractional& generator : generators) generator = map * generator * map.inverse();
    for (Circle& hole : holes) hole = map(hole);
}

void SchottkyPlane::shift(const std::vector<Complex>& shifts)
{
    for (std::size_t k = 0; k < images.size(); ++k) images[k].array() += shifts[k];
    for (std::size_t k = 0; k < holes.size(); ++k) holes[k].center += shifts[k];
    for (std::size_t j = 0; j < generators.size(); ++j) {
        const LinearFractional back = linear_fractional(1.0, -shifts[holes.size() + 2 * j], 0.0, 1.0);
        const LinearFractional ahead = linear_fractional(1.0, shifts[holes.size() + 2 * j + 1], 0.0, 1.0);
        generators[j] = ahead * generators[j] * back;
    }
}

SchottkyPlane schottky_plane(const HandleCut& cut, std::vector<VectorXcd> images)
{
    SchottkyPlane plane;
    for (const VectorXcd& image : images)
        if (!image.allFinite()) throw SolverError("no finite map of the cut surface: the metric is degenerate");
    plane.images = std::move(images);
    for (std::size_t k = 0; k < cut.holes; ++k) {
        VectorXcd& image = plane.images[k];
        const Circle circle = k == 0 ? Circle{} : fit_circle_least_squares(image);
        plane.holes.push_back(circle);
        plane.roundness.push_back(roundness(image, circle));
        image = project_onto_circle(circle, image, k == 0 ? 1 : -1);
    }
    for (std::size_t k = cut.holes; k < cut.loops.size(); k += 2)
        fit_sides(cut.loops[k], plane.images[k], plane.images[k + 1], plane);
    return plane;
}

void make_annular(SchottkyPlane& plane, int handle)
{
    const LinearFractional generator = plane.generators[handle];
    const auto [zero, zero_weight] = generator.attracting();
    const auto [pole, pole_weight] = generator.inverse().attracting();
    plane.move(linear_fractional(zero_weight, -zero, pole_weight, -pole));
    LinearFractional& annular = plane.generators[handle];
    annular = linear_fractional(annular.a, 0.0, 0.0, annular.d);
    plane.outer_handle = handle;
    // Make the sides fit exactly again; the first circle is about as large as the unit circle.
    double log_size = 0.0;
    const VectorXcd& outer = plane.images[2 * static_cast<std::size_t>(handle)];
    for (const Complex z : outer) log_size += std::log(std::abs(z)) / static_cast<double>(outer.size());
    plane.move(linear_fractional(std::exp(-log_size), 0.0, 0.0, 1.0));
}

FundamentalCircles fundamental_circles(SchottkyPlane& plane)
{
    CirclesInPlace best = roomiest(plane);
    if (plane.outer_handle < 0 && !(best.room > 0.0))
        // Circles that are apart stay so under automorphisms of the disk: there may be such circles after one of these.
        for (const Complex center : tried_centers()) {
            const Moebius away{center, 1.0};
            CirclesInPlace circles = roomiest(moved_loops(plane, away));
            if (!(circles.room > best.room)) continue;
            best = std::move(circles);
            for (auto& pair : best.pairs)
                for (Circle& circle : pair) circle = away.inverse()(circle);
            if (best.room > 0.0) break;
        }
    if (plane.outer_handle >= 0 && best.log_scale != 0.0) {
        const double scale = std::exp(-best.log_scale);
        plane.move(linear_fractional(scale, 0.0, 0.0, 1.0));
        for (std::size_t j = 0; j < best.pairs.size(); ++j)
            if (static_cast<int>(j) != plane.outer_handle)
                for (Circle& circle : best.pairs[j]) circle = {scale * circle.center, scale * circle.radius};
    }
    FundamentalCircles result;
    result.apart = best.room > 0.0;
    result.pairs = std::move(best.pairs);
    return result;
}

FundamentalCircles circles_beside(const SchottkyPlane& plane, const FundamentalCircles& circles, double factor)
{
    FundamentalCircles result;
    std::vector<Circle> inside;
    for (std::size_t j = 0; j < circles.pairs.size(); ++j) {
        const Circle first{circles.pairs[j][0].center, factor * circles.pairs[j][0].radius};
        result.pairs.push_back({first, plane.generators[j](first)});
        const bool outer = static_cast<int>(j) == plane.outer_handle;
        if (!outer) inside.push_back(first);
        inside.push_back(result.pairs.back()[1]);
    }
    for (std::size_t k = 1; k < plane.holes.size(); ++k)
        inside.push_back(applied(way_out(plane.holes[k].center, plane, result), plane.generators, plane.holes[k]));
    const double rim = plane.outer_handle >= 0 ? factor : 1.0;
    result.apart = room_among(inside) > 0.0 && std::ranges::all_of(inside, [&](const Circle& circle) {
                       return std::abs(circle.center) + circle.radius < rim;
                   });
    return result;
}

GroupWord way_out(Complex at, const SchottkyPlane& plane, const FundamentalCircles& circles)
{
    GroupWord word;
    for (int step = 0; step < most_letters; ++step) {
        int letter = 0;
        for (std::size_t j = 0; j < circles.pairs.size() && letter == 0; ++j)
            for (int side = 0; side < 2; ++side) {
                const Circle& circle = circles.pairs[j][side];
                const bool outside = std::abs(at - circle.center) > circle.radius;
                const bool wanted_inside = side == 0 && static_cast<int>(j) == plane.outer_handle;
                if (outside == wanted_inside) letter = (side == 0 ? 1 : -1) * (static_cast<int>(j) + 1);
            }
        if (letter == 0) break;
        at = applied({letter}, plane.generators, at);
        word.insert(word.begin(), letter);
    }
    return word;
}

}  // namespace koebe
