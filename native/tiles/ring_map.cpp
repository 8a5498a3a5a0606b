#include "circles/moebius.h"
#include "core/errors.h"
#include "core/tolerances.h"
#include "linear/dense_spd.h"
#include "linear/sparse_cholesky.h"
#include "mesh/connectivity.h"
#include "pipeline/loop_numbers.h"
#include "pipeline/uniformize.h"
#include "quality/map_clock.h"
#include "quality/take_verdict.h"
#include "tiles/tile_map.h"
#include "tiles/tile_result.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// A harmonic function with one free value for each of some loops, through which no flux runs.
class FloatingLoops {
public:
    FloatingLoops(const PeriodicSurface& domain, bool holes_float)
        : domain_(domain), representative_(domain.surface.vertex_count)
    {
        for (Index v = 0; v < domain.surface.vertex_count; ++v) representative_[v] = v;
        for (std::size_t k = domain.first_hole; holes_float && k < domain.loops.size(); ++k)
            for (const Index v : domain.loops[k]) representative_[v] = domain.loops[k].front();
        std::vector<Index> number(representative_.size(), -1);
        for (std::size_t v = 0; v < representative_.size(); ++v)
            if (representative_[v] == static_cast<Index>(v)) number[v] = count_++;
        for (Index& v : representative_) v = number[v];
        const SparseMatrix laplacian = laplacian_of(domain);
        std::vector<Eigen::Triplet<double, Index>> entries;
        for (Index c = 0; c < static_cast<Index>(laplacian.cols()); ++c)
            for (SparseMatrix::InnerIterator it(laplacian, c); it; ++it)
                entries.emplace_back(representative_[it.row()], representative_[c], it.value());
        matrix_.resize(count_, count_);
        matrix_.setFromTriplets(entries.begin(), entries.end());
    }

    /// 0 on the outer rim, 1 on the inner one.
    VectorXd between_rims() const
    {
        std::vector<char> fixed(static_cast<std::size_t>(count_), 0);
        MatrixXd values = MatrixXd::Zero(count_, 1);
        for (int rim = 0; rim < 2; ++rim)
            for (const Index v : domain_.loops[rim]) {
                fixed[representative_[v]] = 1;
                values(representative_[v], 0) = rim;
            }
        return spread(DirichletSolver(matrix_, fixed).solve(values).col(0));
    }

    /// What makes the shift harmonic.
    VectorXd round() const
    {
        const VectorXd load = jump_load(domain_, domain_.metric_shifts[0]);
        MatrixXd sums = MatrixXd::Zero(count_, 1);
        for (Index v = 0; v < static_cast<Index>(load.size()); ++v) sums(representative_[v], 0) += load[v];
        // One vertex is tied to 0: as constants are in the kernel that draws nothing.
        SparseMatrix tied = matrix_;
        tied.coeffRef(0, 0) += matrix_.diagonal().mean();
        return spread(SparseCholesky(tied).solve(sums).col(0));
    }

private:
    VectorXd spread(const VectorXd& values) const
    {
        if (!values.allFinite()) throw SolverError("no finite harmonic function: the metric is degenerate");
        return values(representative_);
    }

    const PeriodicSurface& domain_;
    std::vector<Index> representative_;
    Index count_ = 0;
    SparseMatrix matrix_;
};

/// Integral of |du + form|^2.
double energy(const PeriodicSurface& domain, const VectorXd& u, const OneForm& form)
{
    return squared_norm(half_cotangents(domain.metric.lengths), form + exterior_derivative(domain.metric.triangles, u));
}

/// What hangs on a straight rim by one edge would have no area. So the rim runs along a parabola there, inward at the
/// ends of the edge: as deep as the arc of the disk would be, and deeper where 32-bit UVs need it.
/// @param places of the boundary, the rims straight; changed
void make_room_on_rims(const PeriodicSurface& domain, VectorXcd& places, FlatMap& map)
{
    constexpr double arc = 0.7, deepest = 0.25;  // over the squared width, and over the width
    constexpr double steps = 32.0;               // of the grid between neighbours
    const Triangles& triangles = domain.surface.triangles;
    const double height = places[domain.loops[1].front()].imag();
    VectorXd depth = VectorXd::Zero(domain.surface.vertex_count);
    for (int rim = 0; rim < 2; ++rim) {
        const VertexLoop& loop = domain.loops[rim];
        const Index n = static_cast<Index>(loop.size());
        std::vector<Index> place(domain.surface.vertex_count, -1);
        for (Index b = 0; b < n; ++b) place[loop[b]] = b;
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
            const Index a = origin(triangles, h), b = target(triangles, h);
            if (domain.surface.twin[h] == no_twin || place[a] < 0 || place[b] < 0) continue;
            const double width = places[b].real() - places[a].real() + domain.shifts[0][h];
            if (rim == 0 ? width <= 0.0 : width >= 0.0) continue;  // its twin looks along the rim
            double thinnest = std::abs(width);
            std::vector<double> along;  // from a to b on the rim
            for (Index i = place[a]; i != place[b]; i = (i + 1) % n) {
                along.push_back(std::abs(std::remainder(places[loop[i]].real() - places[a].real(), 1.0)));
                if (along.size() > 1 && along.back() < along[along.size() - 2])
                    along.back() = 1.0 - along.back();  // past half a turn
                const double step =
                    std::abs(std::remainder(places[loop[(i + 1) % n]].real() - places[loop[i]].real(), 1.0));
                if (step > 0.0) thinnest = std::min(thinnest, step);
            }
            const double w = std::abs(width), grid = uv_grid * std::max(1.0, height);
            const double bend = std::min(std::max(arc, steps * grid / (thinnest * thinnest)), deepest / w);
            along.push_back(w);
            for (std::size_t i = 0; i < along.size(); ++i) {
                double& own = depth[loop[(place[a] + static_cast<Index>(i)) % n]];
                own = std::max(own, bend * (2.0 * along[i] - w) * (2.0 * along[i] - w));
            }
        }
        for (const Index v : loop) {
            if (depth[v] == 0.0) continue;
            places[v] += Complex(0.0, rim == 0 ? depth[v] : -depth[v]);
            if (depth[v] > uv_resolution) map.off_circle.push_back(v);
        }
    }
    std::ranges::sort(map.off_circle);
}

/// Which vertex is the tip near an extreme one: on the edges before and behind it the surface must lie on opposite
/// sides of the slit, as the other corners of their faces have it.
/// @param side of the edge from each vertex to the next: how far that corner lies to the left of a slit that runs up
/// @param sign 1 for the upper tip, -1 for the lower one
Eigen::Index tip_near(Eigen::Index extreme, const VectorXd& side, double sign)
{
    const Eigen::Index m = side.size();
    Eigen::Index best = extreme;
    int fewest = 5;
    for (const Eigen::Index offset : {0, -1, 1}) {
        int wrong = 0;
        for (Eigen::Index e = -2; e < 2; ++e)
            wrong += (e < offset ? 1.0 : -1.0) * sign * side[(extreme + e + m) % m] > 0.0 ? 0 : 1;
        if (wrong >= fewest) continue;
        fewest = wrong;
        best = (extreme + offset + m) % m;
    }
    return best;
}

/// Where the vertices of a slit lie along it, its ends at the tips: a tip lies between two vertices as a rule, and a
/// face on the edge between these would have no area. So one of them is moved to where the parabola through the
/// extreme vertex and its neighbours turns, by O(h^2). Between the tips each side runs one way.
/// @param along of at least 4 vertices, changed @param side as above
void sharpen_tips(VectorXd& along, const VectorXd& side)
{
    const Eigen::Index m = along.size();
    const auto turning_point = [&](Eigen::Index b) {
        const double before = along[(b + m - 1) % m], after = along[(b + 1) % m];
        const double bend = 2.0 * along[b] - before - after;
        return bend == 0.0 ? along[b] : along[b] + (after - before) * (after - before) / (8.0 * bend);
    };
    Eigen::Index high = 0, low = 0;
    along.maxCoeff(&high);
    along.minCoeff(&low);
    if (high == low || m < 4) return;
    const double top = turning_point(high), bottom = turning_point(low);
    high = tip_near(high, side, 1.0);
    low = tip_near(low, side, -1.0);
    if (high == low) return;
    along[high] = top;
    along[low] = bottom;
    for (const Eigen::Index step : {Eigen::Index{1}, m - 1}) {
        std::vector<Eigen::Index> way;
        for (Eigen::Index b = high; b != low; b = (b + step) % m) way.push_back(b);
        way.push_back(low);
        const double least = 1e-3 * (top - bottom) / static_cast<double>(m);
        for (std::size_t i = 1; i + 1 < way.size(); ++i)
            along[way[i]] = std::min(along[way[i]], along[way[i - 1]] - least);
        for (std::size_t i = way.size() - 2; i > 0; --i)
            along[way[i]] = std::max(along[way[i]], along[way[i + 1]] + least);
    }
}

/// How far the corners opposite to the edges of a slit lie to its left.
VectorXd sides_of(const PeriodicSurface& domain, const VectorXcd& z, std::size_t k, bool along_u)
{
    const Triangles& triangles = domain.surface.triangles;
    const VertexLoop& loop = domain.loops[k];
    std::vector<Index> place(domain.surface.vertex_count, -1);
    for (std::size_t b = 0; b < loop.size(); ++b) place[loop[b]] = static_cast<Index>(b);
    VectorXd side = VectorXd::Zero(static_cast<Eigen::Index>(loop.size()));
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        const Index a = origin(triangles, h), back = previous_halfedge(h);
        if (domain.surface.twin[h] != no_twin || place[a] < 0) continue;
        const Complex arm = z[origin(triangles, back)] - z[a] - domain.shifts[0][back];
        side[place[a]] = along_u ? arm.imag() : -arm.real();
    }
    return side;
}

/// Rims straight, holes slits: u and v of the two harmonic functions.
FlatMap slit_map(const PeriodicSurface& domain, RingHoles holes, double& height)
{
    const VectorXd f = FloatingLoops(domain, holes == RingHoles::concentric).between_rims();
    const VectorXd g = FloatingLoops(domain, holes == RingHoles::radial).round();
    // The conjugate function of g has the same energy.
    const OneForm none = OneForm::Zero(static_cast<Eigen::Index>(domain.metric_shifts[0].size()));
    height = std::sqrt(energy(domain, g, domain.metric_shifts[0]) / energy(domain, f, none));
    if (!std::isfinite(height) || !(height > 0.0))
        throw SolverError("the ring has no height: the metric is degenerate");
    FlatMap map;
    map.periods = {1.0};
    map.z = g + Complex(0.0, height) * f;
    VectorXcd places = map.z;
    std::vector<char> moved = boundary_mask(domain.surface);
    for (std::size_t k = domain.first_hole; k < domain.loops.size(); ++k) {
        const VectorXcd loop = gather_loop(map.z, domain.loops[k]);
        VectorXd along = loop.imag();
        if (holes == RingHoles::concentric) along = loop.real();
        sharpen_tips(along, sides_of(domain, map.z, k, holes == RingHoles::concentric));
        for (Eigen::Index b = 0; b < along.size(); ++b) {
            Complex& place = places[domain.loops[k][static_cast<std::size_t>(b)]];
            place =
                holes == RingHoles::concentric ? Complex(along[b], loop[0].imag()) : Complex(loop[0].real(), along[b]);
        }
    }
    make_room_on_rims(domain, places, map);
    move_boundary(domain, places, moved, map.z);
    return map;
}

/// The automorphism that makes the inner rim concentric, from the circle domain.
struct RoundRing {
    VectorXcd points;  // (V) of the domain's vertices, in the unit disk
    std::vector<Circle> circles;
    std::vector<Roundness> roundness;
    std::vector<std::vector<Index>> off_circle;  // of the input
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
        for (const LoopReport& candidate : disk.loops)
            if (std::ranges::find(candidate.vertices, domain.original[loop.front()]) != candidate.vertices.end())
                report.push_back(&candidate);
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
                                           WarningKind::not_one_to_one, WarningKind::reoriented_faces});
    return ring;
}

/// Turns about 0 counted in steps along edges: arg / 2 pi of each vertex, so that the shifts are the jumps between.
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
    // From the outer rim, where steps are safe, along loops first.
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

/// The round annulus unrolled, u + i v = log z / (2 pi i): its boundary as it is, the inside harmonic.
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
    make_room_on_rims(domain, places, map);
    move_boundary(domain, places, moved, map.z);
    map.circles = ring.circles;
    map.roundness = ring.roundness;
    map.converged = ring.converged;
    map.changes = ring.changes;
    return map;
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
    const HoleShape shape = options.holes == RingHoles::circles      ? HoleShape::open
                            : options.holes == RingHoles::concentric ? HoleShape::along_u
                                                                     : HoleShape::along_v;
    FlatMap map;
    std::optional<RoundRing> ring;
    double height = 0.0;  // over the period
    if (shape != HoleShape::open) {
        context.begin_stage("iterate", 0.1, 0.9);
        map = slit_map(domain, options.holes, height);
    } else {
        ExecutionContext own([&](double done, const std::string& name) { context.report(0.1 + 0.8 * done, name); }, {},
                             [&] { context.checkpoint(); });
        ring = round_ring(vertices, triangles, domain, options, own);
        height = -std::log(ring->circles[1].radius) / two_pi;
        map = unrolled(domain, *ring, height);
    }
    clock.end(&StageSeconds::iterate);
    context.begin_stage("finish", 0.9, 1.0);
    TileResult result = tile_result(vertices, triangles, domain, options, shape, map, context);
    result.modulus = {0.0, height};
    if (result.even > 0.0) {
        const double rise = map.z[domain.loops[1].front()].imag() - map.z[domain.loops[0].front()].imag();
        result.modulus = {0.0, std::abs(rise) / map.periods[0].real()};
    }
    if (ring && result.even == 0.0)
        for (std::size_t k = 0; k < result.loops.size(); ++k) {
            result.loops[k].has_circle = true;
            result.loops[k].circle = ring->circles[k];
            std::vector<Index> both;
            std::ranges::set_union(result.loops[k].off_circle, ring->off_circle[k], std::back_inserter(both));
            result.loops[k].off_circle = std::move(both);
        }
    if (ring) {
        result.sweeps = ring->sweeps;
        result.warnings.insert(result.warnings.begin(), ring->warnings.begin(), ring->warnings.end());
    }
    take_verdict({.most_lost = options.most_lost}, result);
    clock.finish(result, context);
    return result;
}

}  // namespace

const char* to_string(RingHoles holes) noexcept
{
    switch (holes) {
    case RingHoles::circles: return "circles";
    case RingHoles::concentric: return "concentric";
    case RingHoles::radial: return "radial";
    }
    return "";
}

TileResult ring_map(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                    ExecutionContext& context)
{
    return canonical_tile(vertices, triangles, options, context, ring_map_here);
}

}  // namespace koebe
