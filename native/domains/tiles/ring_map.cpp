#include "circles/moebius.h"
#include "core/connectivity.h"
#include "core/counted.h"
#include "core/errors.h"
#include "linear/dense_spd.h"
#include "mesh/loop_with.h"
#include "pipeline/loop_numbers.h"
#include "pipeline/uniformize.h"
#include "quality/map_clock.h"
#include "quality/take_verdict.h"
#include "tiles/floating_loops.h"
#include "tiles/rim_bends.h"
#include "tiles/slit_strip.h"
#include "tiles/tile_map.h"
#include "tiles/tile_result.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// The circle domain, moved by the automorphism that makes the inner rim concentric.
struct RoundRing {
    VectorXcd points;  // (V) of the domain's vertices, in the unit disk
    std::vector<Circle> circles;
    std::vector<Roundness> roundness;
    std::vector<std::vector<Index>> off_circle;  // per loop, vertices of the input
    bool converged = false;
    int sweeps = 0;
    std::vector<double> changes;
    std::vector<Warning> warnings;
};

RoundRing round_ring(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                     const TileOptions& options, ExecutionContext& context)
{
    UniformizeOptions map_options;
    map_options.outer = OuterLoop::vertex;
    map_options.outer_vertex = domain.original[domain.loops[0].front()];
    static_cast<SweepOptions&>(map_options) = options;
    map_options.most_lost = 1.0;  // the tile has its own verdict
    const UniformizeResult disk = uniformize_here(vertices, triangles, map_options, context);
    std::vector<const LoopReport*> report;
    for (const VertexLoop& loop : domain.loops)
        report.push_back(&disk.loops.at(loop_with(disk.loops, domain.original[loop.front()], &LoopReport::vertices)));
    const Moebius move = center_circle(report.at(1)->circle);
    RoundRing ring;
    ring.points.resize(static_cast<Eigen::Index>(domain.original.size()));
    for (std::size_t v = 0; v < domain.original.size(); ++v)
        ring.points[static_cast<Eigen::Index>(v)] =
            move(Complex(disk.uv(domain.original[v], 0), disk.uv(domain.original[v], 1)));
    for (const LoopReport* loop : report) {
        ring.circles.push_back(move(loop->circle));
        ring.roundness.push_back(loop->roundness);
        ring.off_circle.push_back(loop->off_circle);
    }
    ring.circles[0] = Circle{};
    ring.circles[1].center = 0.0;
    ring.converged = disk.converged;
    ring.sweeps = disk.sweeps;
    for (const KoebeStep& step : disk.history) ring.changes.push_back(step.change);
    ring.warnings = with_loops_renumbered(disk, report,
                                          {WarningKind::below_resolution, WarningKind::flipped,
                                           WarningKind::not_one_to_one, WarningKind::reoriented_faces,
                                           WarningKind::coarse_mesh});  // which has the angles of the disk
    return ring;
}

/// (V) turns about 0, arg / 2 pi, counted in steps along edges, so that the shifts are the jumps.
VectorXd turns_of(const PeriodicSurface& domain, const VectorXcd& points)
{
    const Triangles& triangles = domain.surface.triangles;
    std::vector<std::vector<Index>> leaving(domain.surface.vertex_count);
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        leaving[origin(triangles, h)].push_back(h);
        if (domain.surface.twin[h] == no_twin) leaving[target(triangles, h)].push_back(h);
    }
    VectorXd turns = VectorXd::Zero(domain.surface.vertex_count);
    std::vector<char> met(domain.surface.vertex_count, 0);
    // Start at the outer rim, where steps are safe, and go along loops first.
    const Index start = domain.loops[0].front();
    turns[start] = std::arg(points[start]) / two_pi;
    met[start] = 1;
    std::vector<Index> queue{start};
    for (std::size_t head = 0; head < queue.size(); ++head)
        for (const Index h : leaving[queue[head]]) {
            const bool along = origin(triangles, h) == queue[head];
            const Index next = along ? target(triangles, h) : origin(triangles, h);
            if (met[next]) continue;
            met[next] = 1;
            const double step = std::arg(points[next] / points[queue[head]]) / two_pi;
            turns[next] = turns[queue[head]] + step - (along ? 1.0 : -1.0) * domain.shifts[0][h];
            queue.push_back(next);
        }
    return turns;
}

/// Unrolls the round annulus, u + i v = log z / (2 pi i): its boundary exactly, the inside harmonic.
FlatMap unrolled(const PeriodicSurface& domain, const RoundRing& ring, double height)
{
    FlatMap map;
    map.periods = {1.0};
    map.z = FloatingLoops(domain, false).round().cast<Complex>();
    const VectorXd turns = turns_of(domain, ring.points);
    VectorXcd places = map.z;
    std::vector<char> moved(static_cast<std::size_t>(map.z.size()), 0);
    for (std::size_t k = 0; k < domain.loops.size(); ++k)
        for (const Index v : domain.loops[k]) {
            const double v_place = k == 0 ? 0.0 : k == 1 ? height : -std::log(std::abs(ring.points[v])) / two_pi;
            places[v] = {turns[v], v_place};
            moved[v] = 1;
        }
    if (!places.allFinite()) throw SolverError("the annulus cannot be unrolled: a vertex lies at its centre");
    bend_rims(domain, places, map);
    move_boundary(domain, places, moved, map.z);
    map.circles = ring.circles;
    map.roundness = ring.roundness;
    map.converged = ring.converged;
    map.changes = ring.changes;
    return map;
}

/// The circles of the round annulus that the cylinder is by exp; empty if the inner one is too small for a number.
std::vector<Circle> annulus_circles(double height)
{
    const double inner = std::exp(-two_pi * height);
    if (!std::isnormal(inner)) return {};
    return {Circle{}, Circle{0.0, inner}};
}

// Upper over lower bound of a modulus that one pair of functions encloses: above the first it is uncertain, which a
// warning says; above the second the mesh does not resolve it.
constexpr double certain_gap = 1.2, resolved_gap = 2.0;

bool far_apart(const ModulusBounds& bounds, double gap) { return !(bounds.upper <= gap * bounds.lower); }

/// Whether the bounds of the modulus would meet on a fine mesh: filled holes leave a gap.
bool is_enclosed(const PeriodicSurface& domain, RingHoles holes)
{
    return domain.loops.size() == domain.first_hole || holes != RingHoles::circles;
}

/// The modulus of the ring, enclosed.
struct EnclosedModulus : ModulusBounds {
    bool tight = false;  ///< whether bounds that are far apart tell that the mesh is too coarse: see is_enclosed
};

/// Encloses the modulus. Where the bounds are apart, mollification may have made short edges longer: then the
/// metric is taken with less of it, as little as lengths of double precision allow.
EnclosedModulus enclose_modulus(PeriodicSurface& domain, RingHoles holes)
{
    constexpr double least_margin = 1e-10;  // IntrinsicMetricOptions::margin
    constexpr double fine_gap = 1.05;       // upper over lower bound where mollification has done no harm
    const EnclosedModulus bounds{modulus_bounds(domain, holes), is_enclosed(domain, holes)};
    if (!bounds.tight || bounds.upper <= fine_gap * bounds.lower) return bounds;
    PeriodicSurface finer = domain;
    finer.metric_shifts = finer.shifts;
    finer.metric = intrinsic_metric(finer.vertices, finer.surface, {.margin = least_margin}, &finer.metric_shifts);
    const ModulusBounds own = modulus_bounds(finer, holes);
    if (!(own.upper * bounds.lower < bounds.upper * own.lower)) return bounds;
    domain = std::move(finer);
    return {own, true};
}

/// Compares the modulus with its bounds: circles lost in rounding, and a metric mollified beyond its shortest edges,
/// give any modulus.
void check_modulus(const EnclosedModulus& bounds, double height, bool has_circles, TileResult& result)
{
    constexpr double slack = 0.02;  // of the bounds: they hold for the polyhedron, circles for smooth rims
    const bool outside = height < (1.0 - slack) * bounds.lower || height > (1.0 + slack) * bounds.upper;
    if (!outside && !(bounds.tight && far_apart(bounds, certain_gap))) return;
    const bool lost = outside && has_circles;
    if (outside || far_apart(bounds, resolved_gap)) result.converged = false;
    result.warnings.push_back(
        {lost ? WarningKind::lost_circles : WarningKind::thin_faces,
         "the modulus " + formatted("%.5g", height) +
             (outside ? " is not between its bounds, " : " is uncertain: its bounds are ") +
             formatted("%.5g", bounds.lower) + " and " + formatted("%.5g", bounds.upper) +
             (lost ? ": the circles are lost in rounding" : ": the mesh is too coarse, or its faces too thin"),
         lost ? std::vector<Index>{0, 1} : std::vector<Index>{}});
}

/// A map of the ring, before it is a tile.
struct FlatRing {
    FlatMap map;
    double height = 0.0;          // over the period
    std::vector<Circle> circles;  // of the loops, in the unit disk
    std::optional<RoundRing> round;
};

FlatRing by_potentials(const PeriodicSurface& domain, RingHoles holes)
{
    FlatRing ring;
    ring.map = slit_strip(domain, holes, ring.height);
    if (holes == RingHoles::circles) ring.circles = annulus_circles(ring.height);
    return ring;
}

FlatRing by_circles(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                    const TileOptions& options, ExecutionContext& context)
{
    ExecutionContext own([&](double done, const std::string& name) { context.report(0.1 + 0.8 * done, name); }, {},
                         [&] { context.checkpoint(); });
    FlatRing ring;
    ring.round = round_ring(vertices, triangles, domain, options, own);
    ring.circles = ring.round->circles;
    ring.height = -std::log(ring.circles[1].radius) / two_pi;
    ring.map = unrolled(domain, *ring.round, ring.height);
    return ring;
}

TileResult ring_tile(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                     const TileOptions& options, HoleShape shape, const EnclosedModulus& bounds, FlatRing ring,
                     ExecutionContext& context)
{
    TileResult result = tile_result(vertices, triangles, domain, options, shape, ring.map, context);
    result.modulus = {0.0, ring.height};
    // An evened ring has the modulus of its cylinder as it lies, not that of the conformal map.
    if (result.even > 0.0) {
        const VectorXcd& z = ring.map.z;
        const double rise = z[domain.loops[1].front()].imag() - z[domain.loops[0].front()].imag();
        result.modulus = {0.0, std::abs(rise) / ring.map.periods[0].real()};
    }
    check_modulus(bounds, ring.height, ring.round.has_value(), result);
    // The further holes are round.
    if (result.even == 0.0)
        for (std::size_t k = 0; k < ring.circles.size(); ++k) {
            result.loops[k].has_circle = true;
            result.loops[k].circle = ring.circles[k];
            if (!ring.round) continue;
            std::vector<Index> both;
            std::ranges::set_union(result.loops[k].off_circle, ring.round->off_circle[k], std::back_inserter(both));
            result.loops[k].off_circle = std::move(both);
        }
    // What the iteration says of itself.
    if (ring.round) {
        result.sweeps = ring.round->sweeps;
        result.warnings.insert(result.warnings.begin(), ring.round->warnings.begin(), ring.round->warnings.end());
    }
    take_verdict({.most_lost = options.most_lost}, result);
    return result;
}

TileResult ring_map_here(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                         ExecutionContext& context)
{
    fix_product_blocks();
    if (options.even > 0.0 && options.holes != RingHoles::circles)
        throw InputError("slits have no area: a map with slits cannot be made more even");
    MapClock clock;
    context.begin_stage("topology", 0.0, 0.1);
    PeriodicSurface domain = periodic_ring(vertices, triangles, options.outer, options.inner);
    domain.polygon = options.polygon;
    clock.end(&StageSeconds::topology);
    const EnclosedModulus bounds = enclose_modulus(domain, options.holes);
    const HoleShape shape = options.holes == RingHoles::circles      ? HoleShape::open
                            : options.holes == RingHoles::concentric ? HoleShape::along_u
                                                                     : HoleShape::along_v;
    const auto tile = [&](FlatRing ring) {
        clock.end(&StageSeconds::iterate);
        context.begin_stage("finish", 0.9, 1.0);
        return ring_tile(vertices, triangles, domain, options, shape, bounds, std::move(ring), context);
    };
    // A tube without holes needs no circles. But harmonic functions lay ears on a rim flat along
    // it; the disk with round holes has a place for these.
    std::optional<TileResult> result;
    if (bounds.tight) {
        context.begin_stage("iterate", 0.1, 0.9);
        result = tile(by_potentials(domain, options.holes));
    }
    const auto round_tile = [&] { return tile(by_circles(vertices, triangles, domain, options, context)); };
    if (!result) {
        result = round_tile();
    } else if (!result->converged && shape == HoleShape::open) {
        clock.end(&StageSeconds::finish);
        try {
            if (TileResult round = round_tile(); round.converged) result = std::move(round);
        } catch (const OutOfMemory&) {
            throw;
        } catch (const SolverError&) {
            // The report of the first map says why there is no map.
        }
    }
    clock.finish(*result, context);
    return *std::move(result);
}

}  // namespace

TileResult ring_map(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                    ExecutionContext& context)
{
    return canonical_tile(vertices, triangles, options, context, ring_map_here);
}

}  // namespace koebe
