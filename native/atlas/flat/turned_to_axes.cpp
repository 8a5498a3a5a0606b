#include "flat/turned_to_axes.h"

#include "cost/tolerances.h"
#include "cost/tuning.h"
#include "packing/packed_island.h"
#include "part_maps/part_mesh.h"
#include "planar/planar_predicates.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr double long_edge = 0.15;           // in roots of the part's area
constexpr double straight_as_drawn = 0.999;  // chord over length
constexpr double exactly_same = 1e-6;        // radians
constexpr double clearly_up = 0.5;           // mean slope towards the height, 1 on a wall

/// A run of the outline that is straight in space, as it is drawn.
struct StraightRun {
    double angle = 0.0;  ///< up to quarter turns, in [0, pi/2)
    double length = 0.0;
    Complex chord;
};

/// The runs of a loop that are straight and long in space. @param least length in space
void straight_runs(const FlatPart& part, const VertexLoop& loop, double least, std::vector<StraightRun>& runs)
{
    const std::size_t count = loop.size();
    const auto direction = [&](std::size_t i) {
        return (part.vertices.row(loop[(i + 1) % count]) - part.vertices.row(loop[i % count])).normalized().eval();
    };
    const auto at = [&](std::size_t i) {
        const auto point = part.points.row(loop[i % count]);
        return Complex(point[0], point[1]);
    };
    // Begin at a corner, so that no run is cut in two.
    std::size_t corner = 0;
    while (corner < count && direction(corner).dot(direction(corner + count - 1)) > tolerance::straight) ++corner;
    for (std::size_t i = corner; i < corner + count;) {
        const Eigen::RowVector3d first = direction(i);
        double in_space = 0.0, drawn = 0.0;
        const std::size_t begin = i;
        do {
            in_space += (part.vertices.row(loop[(i + 1) % count]) - part.vertices.row(loop[i % count])).norm();
            drawn += std::abs(at(i + 1) - at(i));
            ++i;
        } while (i < corner + count && direction(i).dot(first) > tolerance::straight);
        // A run counts if it is long, and drawn straight too. Its angle is taken modulo 90 degrees.
        const Complex chord = at(i) - at(begin);
        if (!(in_space >= least) || !(std::abs(chord) >= straight_as_drawn * drawn)) continue;
        constexpr double quarter = 0.5 * std::numbers::pi;
        const double angle = std::arg(chord);
        runs.push_back({angle - quarter * std::floor(angle / quarter), std::abs(chord), chord});
    }
}

/// The runs within an angle of each other that are longest together. @param runs by rising angle
std::vector<StraightRun> longest_together(const std::vector<StraightRun>& runs, double width)
{
    std::size_t best_begin = 0, best_count = 0;
    double best = 0.0, sum = 0.0;
    std::size_t end = 0;  // the window may go on beyond a quarter turn
    const std::size_t count = runs.size();
    for (std::size_t begin = 0; begin < count; ++begin) {
        const auto angle = [&](std::size_t i) {
            return runs[i % count].angle + (i < count ? 0.0 : std::numbers::pi / 2);
        };
        while (end < begin + count && angle(end) - runs[begin].angle <= width) sum += runs[end++ % count].length;
        if (sum > best) {
            best = sum;
            best_begin = begin;
            best_count = end - begin;
        }
        sum -= runs[begin].length;
    }
    std::vector<StraightRun> found;
    for (std::size_t i = 0; i < best_count; ++i) found.push_back(runs[(best_begin + i) % count]);
    return found;
}

/// The turn that lays most straight edges along the axes; 0: there are too few.
Complex straightening(const FlatPart& part)
{
    // Along the straight edges that are longest together.
    const double least = long_edge * std::sqrt(face_areas(part.vertices, part.surface.triangles).sum());
    std::vector<StraightRun> runs;
    for (const VertexLoop& loop : part.surface.loops) straight_runs(part, loop, least, runs);
    if (runs.empty()) return 0.0;
    std::ranges::sort(runs, {}, &StraightRun::angle);
    const std::vector<StraightRun> same = longest_together(longest_together(runs, tolerance::off_axis), exactly_same);
    const StraightRun& longest = *std::ranges::max_element(same, {}, &StraightRun::length);
    const Complex turn = std::conj(longest.chord) / longest.length;
    // The share of the outline that then lies along the axes, with its short edges.
    double outline = 0.0, straight = 0.0;
    for (const VertexLoop& loop : part.surface.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Eigen::RowVector2d edge = part.points.row(loop[(i + 1) % loop.size()]) - part.points.row(loop[i]);
            const Complex turned = turn * Complex(edge[0], edge[1]);
            outline += edge.norm();
            if (std::min(std::abs(turned.real()), std::abs(turned.imag())) < tolerance::off_axis * edge.norm())
                straight += edge.norm();
        }
    if (straight > tolerance::majority * outline) return turn;
    if (!(straight > tolerance::along_axes * outline)) return 0.0;
    // Where straight edges are the smaller part of the outline, the part must not need more room.
    const double smallest = box_size(upright_island({part.points, part.surface.loops}).points).prod();
    const double own = box_size(place_island(part.points, {turn}, 1.0)).prod();
    return own <= (1.0 + tuning::noticeable) * smallest ? turn : 0.0;
}

/// The mean gradient of the height, as a direction of length 1; 0: the part has no clear up.
Complex up_in_plane(const FlatPart& part, const Eigen::RowVector3d& up)
{
    Complex sum = 0.0;
    double area = 0.0;
    for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f) {
        const auto at = [&](int k) {
            const auto point = part.points.row(part.surface.triangles(f, k % 3));
            return Complex(point[0], point[1]);
        };
        for (int k = 0; k < 3; ++k) {  // twice the area times the gradient: each height times its edge, turned inwards
            const double height = part.vertices.row(part.surface.triangles(f, k)).dot(up);
            sum += 0.5 * height * Complex(0.0, 1.0) * (at(k + 2) - at(k + 1));
        }
        area += std::max(signed_area(part.points, part.surface.triangles, f), 0.0);
    }
    const double slope = std::abs(sum) / area;
    return slope > clearly_up ? sum / std::abs(sum) : 0.0;
}

}  // namespace

void turn_to_axes(std::vector<FlatPart>& parts, const Eigen::RowVector3d& up)
{
    for (FlatPart& part : parts) {
        const Complex turn = part.kind == PartKind::tube ? Complex(0.0) : straightening(part);
        if (turn != 0.0) {
            const VectorXcd turned = turn * (part.points.col(0) + Complex(0.0, 1.0) * part.points.col(1));
            part.points << turned.real(), turned.imag();
        }
        part.along_axes = part.kind == PartKind::tube || turn != 0.0;
        part.up = up_in_plane(part, up);
    }
}

}  // namespace koebe
