#include "part_maps/part_map.h"

#include "circles/circle_fit.h"
#include "circles/moebius.h"
#include "conformal/annulus_map.h"
#include "core/connectivity.h"
#include "core/enum_words.h"
#include "core/errors.h"
#include "cost/tolerances.h"
#include "cost/tuning.h"
#include "execution/profile.h"
#include "part_maps/even_pole.h"
#include "pipeline/uniformize.h"
#include "surface/intrinsic_metric.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace koebe {
namespace {

constexpr double rough = 1e-3;      // disk units: change of the circles in the last sweep of a map that judges
constexpr double deep_hole = 1e-7;  // disk units: a map is precise round a smaller hole only if the hole is at 0

double area_in_plane(Complex a, Complex b, Complex c) { return 0.5 * std::imag(std::conj(b - a) * (c - a)); }

/// Gives lost faces the values of their neighbours, if those have any. Then smooths all values a little.
void smooth(const PartMesh& part, VectorXd& u, std::vector<char>& lost)
{
    // (a_f u_f + 1/2 sum a_g u_g) / (a_f + 1/2 sum a_g) over the neighbours g that are not lost.
    for (int round = 0; round < 4; ++round) {
        VectorXd next = u;
        std::vector<char> next_lost = lost;
        for (Index f = 0; f < static_cast<Index>(u.size()); ++f) {
            double sum = lost[f] ? 0.0 : part.areas[f] * u[f], weight = lost[f] ? 0.0 : part.areas[f];
            int known = 0;
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const Index t = part.surface.twin[h];
                if (t == no_twin || lost[face_of(t)]) continue;
                ++known;
                const double w = 0.5 * part.areas[face_of(t)];
                sum += w * u[face_of(t)];
                weight += w;
            }
            if (lost[f] && known < 2) continue;
            if (weight > 0.0) next[f] = sum / weight;
            next_lost[f] = 0;
        }
        u = std::move(next);
        lost = std::move(next_lost);
    }
    // What is still lost is less dense than all others.
    double least = std::numeric_limits<double>::infinity();
    for (Index f = 0; f < static_cast<Index>(u.size()); ++f)
        if (!lost[f]) least = std::min(least, u[f]);
    if (!std::isfinite(least)) least = 0.0;
    for (Index f = 0; f < static_cast<Index>(u.size()); ++f)
        if (lost[f]) u[f] = least - 1.0;
}

/// @param corner the image of a corner, of one face's corners on one sheet @param floor edges that count as lost
template <typename Corner>
void measure(const PartMesh& part, const Corner& corner, double floor, PartMap& map)
{
    const Index count = static_cast<Index>(part.faces.size());
    map.u.resize(count);
    map.centers.resize(count);
    map.lost.assign(count, 0);
    for (Index f = 0; f < count; ++f) {
        const auto [a, b, c] = corner(f);
        map.centers[f] = (a + b + c) / 3.0;
        const double area = area_in_plane(a, b, c);
        const double longest = std::max({std::abs(a - b), std::abs(b - c), std::abs(c - a)});
        map.lost[f] = !(area > 0.0) || !(part.areas[f] > 0.0) || !(longest > floor);
        map.u[f] = map.lost[f] ? 0.0 : 0.5 * std::log(area / part.areas[f]);
    }
    smooth(part, map.u, map.lost);
}

/// Puts the two loops on circles about 0. Keeps log z too, which is precise at any depth.
bool map_annulus(const PartMesh& part, PartMap& map)
{
    const auto& loops = part.surface.loops;
    map.outer = loop_edges(part.vertices, loops[0]).sum() >= loop_edges(part.vertices, loops[1]).sum() ? 0 : 1;
    const auto log_map = [&](bool delaunay) {
        const IntrinsicMetric metric = intrinsic_metric(part.vertices, part.surface, {.delaunay = delaunay});
        const AnnulusMap annulus = annulus_map(metric.triangles, metric.lengths, part.surface.vertex_count,
                                               loops[map.outer], loops[1 - map.outer], {.inside = false});
        constexpr double two_pi = 2.0 * std::numbers::pi;
        VectorXcd strip(part.surface.vertex_count);
        for (Index c = 0; c < static_cast<Index>(metric.triangles.size()); ++c) {
            const Index v = metric.triangles.data()[c];
            strip[v] = {-two_pi / annulus.lambda * annulus.f[v], -two_pi * (annulus.g0[c] + annulus.g1[v])};
        }
        return strip;
    };
    try {
        map.strip = log_map(true);
    } catch (const TopologyError&) {  // two edges between the same vertices
        map.strip = log_map(false);
    }
    if (!map.strip.allFinite()) return false;
    constexpr double two_pi = 2.0 * std::numbers::pi;
    measure(
        part,
        [&](Index f) {
            std::array<Complex, 3> w;
            for (int k = 0; k < 3; ++k) w[k] = map.strip[part.surface.triangles(f, k)];
            for (int k = 1; k < 3; ++k) w[k] -= Complex(0.0, two_pi * std::round((w[k].imag() - w[0].imag()) / two_pi));
            return w;
        },
        0.0, map);
    map.tube_overflow = evenness(map.u, part.areas, map.lost).overflow;
    map.u += map.centers.real();
    map.centers = map.centers.array().exp();
    map.positions = map.strip.array().exp();
    return map.positions.allFinite() && map.positions.cwiseAbs().maxCoeff() < 1.0 + 1e-3;
}

void map_disk(const PartMesh& part, MapPurpose purpose, PartMap& map, ExecutionContext& context)
{
    ExecutionContext inner({}, {}, [&context] { context.checkpoint(); });
    UniformizeOptions options;
    options.outer = OuterLoop::longest;
    options.repair = false;
    if (purpose == MapPurpose::judging) options.tolerance = rough;
    const UniformizeResult result = uniformize(part.vertices, part.surface.triangles, options, inner);
    map.positions = result.uv.col(0) + Complex(0.0, 1.0) * result.uv.col(1);
    map.outer = result.outer_loop;
    map.strip.resize(0);
    map.tube_overflow = -1.0;
    measure(
        part,
        [&](Index f) {
            std::array<Complex, 3> z;
            for (int k = 0; k < 3; ++k) z[k] = map.positions[part.surface.triangles(f, k)];
            return z;
        },
        tolerance::rounded_edge, map);
}

void fit_each_circle(const PartMesh& part, PartMap& map)
{
    map.circles.clear();
    for (std::size_t k = 0; k < part.surface.loops.size(); ++k)
        map.circles.push_back(static_cast<int>(k) == map.outer
                                  ? Circle{}
                                  : fit_circle_least_squares(gather_loop(map.positions, part.surface.loops[k])));
}

/// Chooses the pole and the kind.
void finish(const PartMesh& part, PartMap& map)
{
    map.lost_area = 0.0;
    for (std::size_t f = 0; f < map.lost.size(); ++f)
        if (map.lost[f]) map.lost_area += part.areas[static_cast<Eigen::Index>(f)];
    fit_each_circle(part, map);
    const bool two = part.surface.loops.size() == 2;
    // As a tube, log of the map with the hole in the middle: u rises by log |d log m / dz|.
    if (two && map.tube_overflow < 0.0) {
        const Moebius centered = center_circle(map.circles[1 - map.outer]);
        VectorXd u = map.u;
        for (Eigen::Index f = 0; f < u.size(); ++f) {
            const Complex z = map.centers[f];
            u[f] += std::log((1.0 - std::norm(centered.a)) /
                             std::max(std::abs(z - centered.a) * std::abs(1.0 - std::conj(centered.a) * z), 1e-300));
        }
        map.tube_overflow = u.allFinite() ? evenness(u, part.areas, map.lost).overflow : tuning::lost_cost * part.area;
    }
    // As a disk, from the most even pole.
    if (!two || map.circles[1 - map.outer].radius > deep_hole) {
        move_to_even_pole(part.areas, map);
        fit_each_circle(part, map);
    }
    const Evenness disk = evenness(map.u, part.areas, map.lost);
    map.kind = PartKind::disk;
    map.overflow = map.disk_overflow = disk.overflow;
    map.from = disk.from;
    if (two && map.tube_overflow < map.overflow) {
        map.kind = PartKind::tube;
        map.overflow = map.tube_overflow;
    }
}

}  // namespace

const char* to_string(PartKind kind) noexcept { return word_of(kind, std::array{"disk", "tube", "cone"}); }

PartMap map_part(const PartMesh& part, MapPurpose purpose, ExecutionContext& context)
{
    const ProfiledStage profiled("map");
    PartMap map;
    bool done = false;
    if (part.surface.loops.size() == 2) try {
            done = map_annulus(part, map);
        } catch (const SolverError&) {
        }
    if (!done) map_disk(part, purpose, map, context);
    finish(part, map);
    return map;
}

PartMap restricted_map(const PartMesh& whole, const PartMap& map, const PartMesh& part)
{
    PartMap own;
    own.measured = false;
    const Eigen::Index count = static_cast<Eigen::Index>(part.faces.size());
    own.positions.resize(part.surface.vertex_count);
    own.centers.resize(count);
    own.u.resize(count);
    own.lost.resize(count);
    for (Eigen::Index f = 0; f < count; ++f) {
        const auto at = std::lower_bound(whole.faces.begin(), whole.faces.end(), part.faces[f]) - whole.faces.begin();
        own.centers[f] = map.centers[at];
        own.u[f] = map.u[at];
        own.lost[f] = map.lost[at];
        for (int k = 0; k < 3; ++k)
            own.positions[part.surface.triangles(f, k)] = map.positions[whole.surface.triangles(at, k)];
    }
    // The outer loop is the one round the others; its circle becomes the unit circle.
    double widest = -1.0;
    Circle circle;
    for (std::size_t k = 0; k < part.surface.loops.size(); ++k) {
        const VectorXcd points = gather_loop(own.positions, part.surface.loops[k]);
        const double width = std::max(points.real().maxCoeff() - points.real().minCoeff(),
                                      points.imag().maxCoeff() - points.imag().minCoeff());
        if (!(width > widest)) continue;
        widest = width;
        own.outer = static_cast<int>(k);
        circle = fit_circle_least_squares(points);
    }
    for (const VertexLoop& loop : part.surface.loops) {
        const VectorXcd points = gather_loop(own.positions, loop);
        own.off_round = std::max(own.off_round, deviation_from(fit_circle_least_squares(points), points));
    }
    if (!(circle.radius > 0.0)) circle = {};
    own.positions = (own.positions.array() - circle.center) / circle.radius;
    own.centers = (own.centers.array() - circle.center) / circle.radius;
    own.u.array() -= std::log(circle.radius);
    finish(part, own);
    return own;
}

}  // namespace koebe
