// The examples of the C++ reference (scripts/site/cpp_pages.py): each stands between its function's name and [end].
#include "examples.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace {

void require(bool holds)
{
    if (!holds) throw std::logic_error("an example of the reference does not hold");
}

// A torus of `around` x `across` quadrilaterals, each cut into two triangles.
void make_torus(int around, int across, koebe::Vertices& vertices, koebe::Triangles& triangles)
{
    vertices.resize(around * across, 3);
    triangles.resize(2 * around * across, 3);
    for (int k = 0, face = 0; k < around; ++k)
        for (int m = 0; m < across; ++m) {
            const double a = 2.0 * std::numbers::pi * k / around, t = 2.0 * std::numbers::pi * m / across;
            const double radius = 2.0 + std::cos(t);
            vertices.row(k * across + m) << radius * std::cos(a), radius * std::sin(a), std::sin(t);
            const int next = (k + 1) % around * across, n = (m + 1) % across;
            triangles.row(face++) << k * across + m, next + m, next + n;
            triangles.row(face++) << k * across + m, next + n, k * across + n;
        }
}

}  // namespace

void one_surface(const koebe::Vertices& vertices, const koebe::Triangles& triangles)
{
    koebe::ExecutionContext context;

    // [uniformize]
    const koebe::UniformizeResult map = koebe::uniformize(vertices, triangles);
    require(map.converged && map.distortion.flipped.empty() && map.uv.rows() == vertices.rows());
    // [end]

    // [SurfaceSolver]
    koebe::SurfaceSolver solver(vertices, triangles);
    const koebe::Vertices moved = 2.0 * vertices;
    const koebe::UniformizeResult again = solver.uniformize(moved);
    require(std::abs(again.loops[1].circle.radius - map.loops[1].circle.radius) < 1e-6);
    // [end]

    // [uniformize_with_cuts]
    const koebe::CutUniformizeResult pieces = koebe::uniformize_with_cuts(vertices, triangles);
    require(pieces.pieces.size() == 1 && pieces.cuts.empty());
    // [end]

    // [open_surface]
    const koebe::OpenedSurface opened = koebe::open_surface(vertices, triangles);
    require(opened.pieces.size() == 1 && opened.handles == 0);
    // [end]

    // [parts_of]
    const koebe::PartsResult parts = koebe::parts_of(vertices, triangles, koebe::PartsOptions(), context);
    require(!parts.parts.empty() && parts.distortion.flipped.empty());
    // [end]

    // [flatten]
    koebe::FlattenOptions cloth;
    cloth.allowance = 5.0;  // millimetres
    const koebe::FlattenResult flat = koebe::flatten(100.0 * vertices, triangles, cloth, context);
    require(flat.stretch.max < 1e-3);  // this surface is flat
    // [end]

    // [ring_map]
    const koebe::TileResult ring = koebe::ring_map(vertices, triangles, koebe::TileOptions(), context);
    require(std::abs(ring.modulus.imag() - std::log(1.0 / 0.3) / (2.0 * std::numbers::pi)) < 1e-2);
    // [end]

    // [sphere_map]
    const koebe::SphereResult sphere = koebe::sphere_map(vertices, triangles, koebe::SphereOptions(), context);
    require(sphere.points.rowwise().norm().isOnes(1e-12));
    // [end]

    // [lift]
    koebe::LiftOptions holes;
    holes.perforate = true;
    const koebe::LiftResult sheet = koebe::lift(vertices, triangles, "circles", holes, context);
    require(sheet.loops_after == sheet.loops_before + sheet.outlines);
    // [end]

    // [fit_circles]
    koebe::CircleTemplate wanted;
    wanted.circles = {koebe::Circle{{0.2, 0.1}, 0.25}};
    const koebe::FitResult fitted = koebe::fit_circles(vertices, triangles, wanted, koebe::FitOptions(), context);
    require(fitted.distortion.flipped.empty() && fitted.mu.maxCoeff() < 1.0);
    // [end]

    // [teichmueller_map]
    const koebe::MappedSurface mapped{vertices, triangles, map.uv, map.loops};
    const koebe::TeichmuellerMap extremal = koebe::teichmueller_map(mapped, {{}, {0.2, 0.25}}, {}, context);
    require(extremal.flipped == 0 && extremal.dilatation >= 1.0 && extremal.dilatation <= extremal.largest);
    // [end]

    // [torus_dilatation]
    require(std::abs(koebe::torus_dilatation({0.0, 1.0}, {1.0, 3.0}) - 3.0) < 1e-12);
    // [end]

    // [measure_distortion]
    const koebe::ComputedDistortion distortion = koebe::measure_distortion(vertices, triangles, map.uv);
    require(distortion.angle_error_deg.mean < 1.0);  // degrees
    // [end]

    // [judge_disk]
    const koebe::Verdict verdict = koebe::judge_disk(vertices, triangles, map.uv);
    require(verdict.flipped.empty() && verdict.lost_area == 0.0);
    // [end]

    // [certified_capacities]
    const koebe::CapacityReport proved =
        koebe::certified_capacities(vertices, triangles, koebe::loop_condensers(2), koebe::CapacityOptions(), context);
    require(proved.modulus->lower <= proved.modulus->upper);
    // [end]
}

void steps(const koebe::Vertices& vertices, const koebe::Triangles& triangles)
{
    // [analyze_surface]
    const koebe::Index count = static_cast<koebe::Index>(vertices.rows());
    const koebe::Surface surface = koebe::analyze_surface(triangles, count);
    require(surface.loops.size() == 2 && surface.genus == 0);
    // [end]

    // [annulus_map]
    const koebe::EdgeLengths lengths = koebe::edge_lengths(vertices, triangles);
    const koebe::AnnulusMap annulus =
        koebe::annulus_map(triangles, lengths, count, surface.loops[1], surface.loops[0]);  // the outer loop first
    require(std::abs(annulus.inner_radius - 0.3) < 1e-2);
    // [end]

    // [fill_holes]
    const std::vector<koebe::Index> first = {0};
    const koebe::FilledSurface filled = koebe::fill_holes(vertices, triangles, first);
    require(filled.vertices.rows() == vertices.rows() + 1);
    // [end]

    // [fill_and_fair_holes]
    const koebe::FilledSurface fair = koebe::fill_and_fair_holes(vertices, triangles, first);
    require(fair.label.size() == static_cast<std::size_t>(fair.triangles.rows()));
    // [end]

    // [disk_map]
    const koebe::Index more = static_cast<koebe::Index>(filled.vertices.rows());
    const koebe::VertexLoop rim = koebe::analyze_surface(filled.triangles, more).loops[0];
    const koebe::EdgeLengths sides = koebe::edge_lengths(filled.vertices, filled.triangles);
    const koebe::DiskMap disk = koebe::disk_map(filled.triangles, sides, more, rim);
    require(disk.positions.cwiseAbs().maxCoeff() < 1.0 + 1e-9);
    // [end]

    // [harmonic_map]
    koebe::VectorXcd values(static_cast<Eigen::Index>(rim.size()));
    for (std::size_t k = 0; k < rim.size(); ++k)
        values[static_cast<Eigen::Index>(k)] = std::polar(1.0, 2.0 * std::numbers::pi * k / rim.size());
    const koebe::VectorXcd harmonic = koebe::harmonic_map(filled.triangles, sides, more, rim, values);
    require(harmonic.cwiseAbs().maxCoeff() < 1.0 + 1e-9);
    // [end]
}

void shapes()
{
    const std::vector<koebe::Circle> circles = {{{0.0, 0.0}, 1.0}, {{0.4, 0.1}, 0.2}, {{-0.3, 0.3}, 0.1}};

    // [conformal_module]
    const koebe::VectorXd module = koebe::conformal_module(circles);
    require(module.size() == 3);
    // [end]

    // [module_names]
    require(koebe::module_names(circles.size()) == std::vector<std::string>{"r_1", "y_2", "r_2"});
    // [end]

    // [canonical_order]
    require(koebe::canonical_order(circles).front() == 0);  // the outer loop
    // [end]

    // [match_loops]
    const koebe::LoopMatch match = koebe::match_loops(circles, circles);
    require(match.distance == 0.0 && match.order_a == match.order_b);
    // [end]

    // [align_domains]
    require(koebe::align_domains(circles, circles).residual < 1e-9);
    // [end]
}

void handles()
{
    koebe::ExecutionContext context;
    koebe::Vertices vertices;
    koebe::Triangles triangles;
    make_torus(40, 20, vertices, triangles);

    // [torus_map]
    const koebe::TileResult tile = koebe::torus_map(vertices, triangles, koebe::TileOptions(), context);
    require(tile.converged && std::abs(tile.modulus.imag() - std::sqrt(3.0)) < 0.05);
    // [end]

    // [schottky_map]
    const koebe::SchottkyResult cut = koebe::schottky_map(vertices, triangles, koebe::SchottkyOptions(), context);
    require(cut.handles.size() == 1 && cut.holes.empty());
    // [end]
}
