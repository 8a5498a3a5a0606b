#include "array_checks.h"
#include "promise_check.h"

#include "conformal/annulus_map.h"
#include "conformal/disk_map.h"
#include "core/errors.h"
#include "holes/fan_filling.h"
#include "mesh/topology.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_mesh.h"
#include "quality/distortion.h"
#include "report/json.h"
#include "shape/conformal_module.h"
#include "shape/domain_alignment.h"
#include "shape/loop_matching.h"
#include "surface/harmonic_map.h"

#include <algorithm>
#include <cmath>

namespace koebe::fuzz {
namespace {

constexpr double rounding = 1e-9;  // disk units

/// As the Python package does before a map.
Surface surface_with_loops(const Program& program, std::size_t count)
{
    const Triangles triangles = program.soup.triangles();
    validate_arrays(program.soup.vertices(), triangles);
    Surface surface = require_bordered_genus_zero(triangles, static_cast<Index>(program.soup.points.size()));
    if (surface.loops.size() != count) throw InputError("another number of loops");
    return surface;
}

void require_in_disk(const VectorXcd& positions)
{
    require(positions.allFinite(), "a map is finite");
    require(positions.cwiseAbs().maxCoeff() <= 1.0 + rounding, "a map is in the closed disk");
}

void check_disk_map(const Program& program)
{
    const Surface surface = surface_with_loops(program, 1);
    require_in_disk(disk_map(surface.triangles, edge_lengths(program.soup.vertices(), surface.triangles),
                             surface.vertex_count, surface.loops[0])
                        .positions);
}

void check_annulus(const Program& program, AnnulusBackend backend)
{
    const Surface surface = surface_with_loops(program, 2);
    const AnnulusMap map = annulus_map(surface.triangles, edge_lengths(program.soup.vertices(), surface.triangles),
                                       surface.vertex_count, surface.loops[0], surface.loops[1], {.backend = backend});
    if (!map.converged) return;
    require_in_disk(map.positions);
    require(map.inner_radius >= 0.0 && map.inner_radius <= 1.0, "the inner circle is inside the outer one");
}

void check_annulus_map(const Program& program) { check_annulus(program, AnnulusBackend::harmonic); }

void check_cylinder(const Program& program) { check_annulus(program, AnnulusBackend::yamabe); }

PlanarPoints flat_points(const Program& program) { return program.soup.vertices().leftCols(2); }

void check_distortion(const Program& program)
{
    const Vertices vertices = program.soup.vertices();
    const Triangles triangles = program.soup.triangles();
    validate_arrays(vertices, triangles);
    const PlanarPoints uv = flat_points(program);
    const Distortion distortion{measure_distortion(vertices, triangles, uv), judge_disk(vertices, triangles, uv)};
    require(distortion.flipped == flipped_faces(triangles, uv), "flips are counted alike");
    require(!to_json(distortion).dump().empty(), "the report is JSON");
}

void check_embedding(const Program& program)
{
    const Surface surface = surface_with_loops(program, 1);
    const VertexLoop& loop = surface.loops[0];
    VectorXcd values(static_cast<Eigen::Index>(loop.size()));
    for (Eigen::Index i = 0; i < values.size(); ++i)
        values[i] =
            std::polar(1.0, 2.0 * 3.141592653589793 * static_cast<double>(i) / static_cast<double>(values.size()));
    require_in_disk(harmonic_map(surface.triangles, EdgeLengths::Ones(surface.triangles.rows(), 3),
                                 surface.vertex_count, loop, values));
}

std::vector<Complex> points_of(const Program& program, std::size_t most)
{
    std::vector<Complex> points;
    for (const auto& p : program.soup.points)
        if (points.size() < most && std::abs(p[0]) < 1e6 && std::abs(p[1]) < 1e6) points.emplace_back(p[0], p[1]);
    return points;
}

/// The points in the order of their angle around their middle, as a rule, and else as they are.
VectorXcd polygon_of(const Program& program)
{
    std::vector<Complex> points = points_of(program, 24);
    if (points.size() < 3) throw InputError("too few points");
    if (program.options.threads == 0) {
        Complex middle = 0.0;
        for (const Complex p : points) middle += p / static_cast<double>(points.size());
        std::ranges::sort(points, {}, [middle](Complex p) { return std::arg(p - middle); });
    }
    return Eigen::Map<const VectorXcd>(points.data(), static_cast<Eigen::Index>(points.size()));
}

double area_of(const VectorXcd& polygon)
{
    double twice = 0.0;
    for (Eigen::Index i = 0; i < polygon.size(); ++i)
        twice += (std::conj(polygon[i]) * polygon[(i + 1) % polygon.size()]).imag();
    return twice / 2.0;
}

double extent_of(const VectorXcd& polygon)
{
    return std::max(polygon.real().cwiseAbs().maxCoeff(), polygon.imag().cwiseAbs().maxCoeff());
}

/// As many small edges as the gradation asks for may be very many: only polygons without short edges.
void require_even(const VectorXcd& polygon)
{
    double shortest = std::abs(polygon[0] - polygon[polygon.size() - 1]), longest = shortest;
    for (Eigen::Index i = 1; i < polygon.size(); ++i) {
        shortest = std::min(shortest, std::abs(polygon[i] - polygon[i - 1]));
        longest = std::max(longest, std::abs(polygon[i] - polygon[i - 1]));
    }
    if (!(shortest > 0.02 * longest)) throw InputError("short edges");
}

void check_planar_mesh(const Program& program)
{
    const VectorXcd polygon = polygon_of(program);
    require_even(polygon);
    const PlanarMesh mesh = planar_mesh({polygon});
    require(mesh.points.allFinite() && mesh.points.head(polygon.size()) == polygon, "the polygon's points stay");
    const int exponent = -std::ilogb(extent_of(polygon));  // to a size of which no area underflows
    const auto scaled = [exponent](Complex z) {
        return Complex(std::ldexp(z.real(), exponent), std::ldexp(z.imag(), exponent));
    };
    const VectorXcd unit = polygon.unaryExpr(scaled);
    const double extent = extent_of(unit);
    // By its rounding, a chord's middle is beside it; and the area is rounded.
    const double middle_is_off = 8.0 * 0x1p-53 * extent * extent;
    double area = 0.0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        VectorXcd triangle(3);
        for (int k = 0; k < 3; ++k) triangle[k] = scaled(mesh.points[mesh.triangles(f, k)]);
        const double part = area_of(triangle);
        require(part >= -middle_is_off, "triangles are counter-clockwise");
        area += part;
    }
    require(std::abs(area - std::abs(area_of(unit))) <= 1e-9 * extent * extent, "the triangles fill the polygon");
}

void check_crossings(const Program& program)
{
    if (program.soup.points.size() < 4) return;
    VertexLoop loop;
    for (Index v = 0; v < static_cast<Index>(std::min<std::size_t>(program.soup.points.size(), 40)); ++v)
        loop.push_back(v);
    for (const auto& [a, b] : crossing_boundary_edges({loop}, flat_points(program), 1e-6))
        require(a != b && a >= 0 && b < static_cast<Index>(loop.size()), "crossing edges exist");
}

std::vector<Circle> circles_of(const Program& program, std::size_t from)
{
    std::vector<Circle> circles{Circle{}};
    for (std::size_t i = from; i < program.soup.points.size() && circles.size() < 6; i += 3) {
        const auto& p = program.soup.points[i];
        circles.push_back({Complex(p[0], p[1]) / 4.0, p[2] == 0.0 ? 0.05 : p[2] / 8.0});
    }
    return circles;
}

void check_module(const Program& program)
{
    const std::vector<Circle> circles = circles_of(program, program.options.max_sweeps % 3);
    const VectorXd numbers = conformal_module(circles);
    require(numbers.allFinite(), "a module is finite");
    require(static_cast<std::size_t>(numbers.size()) == module_names(circles.size()).size(), "its numbers have names");
    require(canonical_order(circles).size() == circles.size(), "an order has all loops");
    const LoopMatch match = match_loops(circles, circles_of(program, 1));
    require(std::isfinite(match.distance) && match.distance >= 0.0, "a distance is a number");
    require(std::isfinite(align_domains(circles, circles_of(program, 1)).residual), "a residual is a number");
}

constexpr ArrayCheck checks[] = {check_disk_map,  check_annulus_map, check_cylinder,  check_distortion,
                                 check_embedding, check_planar_mesh, check_crossings, check_module};

}  // namespace

std::span<const ArrayCheck> planar_checks() { return checks; }

}  // namespace koebe::fuzz
