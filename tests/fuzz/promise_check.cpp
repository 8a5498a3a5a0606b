#include "promise_check.h"

#include <algorithm>
#include <cmath>

namespace koebe::fuzz {
namespace {

constexpr double rounding = 1e-12;      // disk units
constexpr double on_circle = 1e-6;      // disk units: what is farther off is listed
constexpr double resolution = 1e-6;     // UV units
constexpr double shortest_edge = 2e-6;  // disk units: shorter loop edges may cross

struct Stored {
    double u, v;
};

Stored stored(const UniformizeResult& result, Index vertex)
{
    const auto to_float = [](double x) { return static_cast<double>(static_cast<float>((1.0 + x) / 2.0)); };
    return {to_float(result.uv(vertex, 0)), to_float(result.uv(vertex, 1))};
}

double twice_area(Stored a, Stored b, Stored c) { return (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v); }

/// The faces without positive area, and those of them that are too small to be drawn.
struct Flips {
    std::vector<Index> flipped, tiny;
};

Flips count_flips(const SurfaceFacts& facts, const UniformizeResult& result, bool turned)
{
    Flips flips;
    for (std::size_t f = 0; f < facts.faces.size(); ++f) {
        const Stored a = stored(result, facts.faces[f][0]), b = stored(result, facts.faces[f][turned ? 2 : 1]),
                     c = stored(result, facts.faces[f][turned ? 1 : 2]);
        if (twice_area(a, b, c) > 0.0) continue;
        flips.flipped.push_back(static_cast<Index>(f));
        if (std::hypot(a.u - b.u, a.v - b.v) < resolution && std::hypot(b.u - c.u, b.v - c.v) < resolution &&
            std::hypot(c.u - a.u, c.v - a.v) < resolution)
            flips.tiny.push_back(static_cast<Index>(f));
    }
    return flips;
}

/// The orientation is that of most faces; of as many on both sides, either.
void check_flips(const SurfaceFacts& facts, const UniformizeResult& result)
{
    const Distortion& told = result.distortion;
    const auto agrees = [&](bool turned) {
        const Flips flips = count_flips(facts, result, turned);
        return told.flipped == flips.flipped && told.below_resolution == flips.tiny;
    };
    const std::size_t half = 2 * facts.reversed, all = facts.faces.size();
    require((half <= all && agrees(false)) || (half >= all && agrees(true)), "the flips are those of the report");
}

void check_loops(const SurfaceFacts& facts, const UniformizeResult& result)
{
    require(result.loops.size() == facts.loop_count, "every boundary loop is reported");
    std::vector<Edge> edges;
    for (const LoopReport& loop : result.loops) {
        const std::size_t n = loop.vertices.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Index a = loop.vertices[i], b = loop.vertices[(i + 1) % n];
            edges.push_back({std::min(a, b), std::max(a, b)});
        }
        for (const Index v : loop.off_circle)
            require(std::ranges::count(loop.vertices, v) == 1, "what is off a circle is of its loop");
    }
    std::ranges::sort(edges);
    require(edges == facts.boundary, "the loops are the boundary");
}

Complex place(const UniformizeResult& result, Index v) { return {result.uv(v, 0), result.uv(v, 1)}; }

void check_circles(const UniformizeResult& result)
{
    const auto& loops = result.loops;
    require(loops[0].circle.center == 0.0 && loops[0].circle.radius == 1.0, "the outer circle is the unit circle");
    for (std::size_t k = 0; k < loops.size(); ++k) {
        const Circle& circle = loops[k].circle;
        require(std::isfinite(circle.radius) && circle.radius > 0.0, "radii are positive");
        if (k > 0) require(std::abs(circle.center) + circle.radius <= 1.0 + rounding, "circles are inside the disk");
        for (std::size_t j = 1; j < k; ++j)
            require(std::abs(circle.center - loops[j].circle.center) >=
                        circle.radius + loops[j].circle.radius - rounding,
                    "circles are apart");
        for (const Index v : loops[k].vertices)
            if (std::ranges::count(loops[k].off_circle, v) == 0)
                require(std::abs(std::abs(place(result, v) - circle.center) - circle.radius) <= on_circle + rounding,
                        "loop vertices are on their circles or listed");
    }
}

struct Segment {
    Index from, to;
    Complex a, b;
};

/// Sign of the turn from a over b to c, in 113 bits.
int turn(Complex a, Complex b, Complex c)
{
    __extension__ using Quad = __float128;
    const Quad cross = (static_cast<Quad>(b.real()) - a.real()) * (static_cast<Quad>(c.imag()) - a.imag()) -
                       (static_cast<Quad>(b.imag()) - a.imag()) * (static_cast<Quad>(c.real()) - a.real());
    return (cross > 0) - (cross < 0);
}

bool cross(const Segment& s, const Segment& t)
{
    return turn(s.a, s.b, t.a) * turn(s.a, s.b, t.b) < 0 && turn(t.a, t.b, s.a) * turn(t.a, t.b, s.b) < 0;
}

/// No two edges of loops cross, of the same loop or of two.
void check_simple(const UniformizeResult& result)
{
    std::vector<Segment> segments;
    for (const LoopReport& loop : result.loops)
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
            const Index a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.vertices.size()];
            const Segment segment{a, b, place(result, a), place(result, b)};
            if (std::abs(segment.a - segment.b) > shortest_edge) segments.push_back(segment);
        }
    for (std::size_t i = 0; i < segments.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) require(!cross(segments[i], segments[j]), "loops are simple and disjoint");
}

}  // namespace

void check_map(const Soup& soup, const SurfaceFacts& facts, const UniformizeResult& result)
{
    require(result.uv.rows() == static_cast<Eigen::Index>(soup.points.size()) &&
                result.vertex_count == static_cast<Index>(soup.points.size()) &&
                result.face_count == static_cast<Index>(soup.faces.size()),
            "the map is of the input's vertices and faces");
    check_loops(facts, result);
    check_flips(facts, result);
    if (!result.converged) {
        require(!result.warnings.empty(), "what did not converge is said");
        return;
    }
    require(result.uv.allFinite(), "a map is finite");
    for (Index v = 0; v < result.vertex_count; ++v)
        require(std::abs(place(result, v)) <= 1.0 + rounding, "a map is in the closed disk");
    check_circles(result);
    check_simple(result);
    require(result.distortion.flipped == result.distortion.below_resolution, "no face is flipped that can be drawn");
    require(std::isfinite(result.distortion.angle_error_deg.mean), "the angle error is a number");
}

}  // namespace koebe::fuzz
