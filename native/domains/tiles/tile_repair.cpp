#include "tiles/tile_repair.h"

#include "core/connectivity.h"
#include "core/sort_unique.h"
#include "cut/seamed_mesh.h"
#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "foldover/untangle.h"
#include "mesh/vertex_faces.h"
#include "tiles/tile_cut.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace koebe {
namespace {

constexpr int most_tile_passes = 8;
constexpr int most_in_vain = 3;              // passes that turn no face back
constexpr std::size_t tile_effort = 600000;  // steps of a face beside those of the whole (repair_effort.h)

/// The tile as a mesh of the plane, with a vertex for each fan of corners that the tile joins.
struct TileSheet {
    Surface surface;
    Vertices vertices;          // (n, 3) in space
    PlanarPoints uv;            // (n, 2) in [-1, 1]
    std::vector<Index> source;  // (n) vertex of the domain
    std::vector<Lift> lift;     // (n)
    double scale = 1.0;         // of the map's plane
    Complex middle{0.0, 0.0};   // of the map's plane, at 0
};

TileSheet sheet_of(const PeriodicSurface& domain, const FlatMap& map, const std::vector<Lift>& lift)
{
    SeamedMesh mesh;
    mesh.corners = domain.surface.triangles;
    mesh.twin = domain.surface.twin;
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
        if (domain.surface.twin[h] > h && is_seam(domain, lift, h)) mesh.cut(h);
    number_fans(mesh);
    // One vertex of the sheet for each fan, at the place of its lift.
    TileSheet sheet;
    sheet.surface = analyze_surface(mesh.fans, mesh.fan_count);
    sheet.source = vertices_of_fans(mesh);
    sheet.lift.resize(mesh.fan_count);
    for (Index h = 0; h < mesh.halfedge_count(); ++h) sheet.lift[origin(mesh.fans, h)] = lift[h];
    sheet.vertices = domain.vertices(sheet.source, Eigen::all);
    VectorXcd points(mesh.fan_count);
    for (Index v = 0; v < mesh.fan_count; ++v) points[v] = lifted(map, map.z[sheet.source[v]], sheet.lift[v]);
    const Complex low(points.real().minCoeff(), points.imag().minCoeff());
    const Complex high(points.real().maxCoeff(), points.imag().maxCoeff());
    sheet.middle = 0.5 * (low + high);
    sheet.scale = 2.0 / std::max({(high - low).real(), (high - low).imag(), 1e-300});
    sheet.uv.resize(mesh.fan_count, 2);
    for (Index v = 0; v < mesh.fan_count; ++v) {
        const Complex at = sheet.scale * (points[v] - sheet.middle);
        sheet.uv.row(v) << at.real(), at.imag();
    }
    return sheet;
}

/// Untangles a tile with these cuts. Vertices on its border stay.
void turn_back_in(const PeriodicSurface& domain, const std::vector<Lift>& lift, HoleShape shape, FlatMap& map,
                  RepairEffort& effort, ExecutionContext& context)
{
    TileSheet sheet = sheet_of(domain, map, lift);
    std::vector<Index> hole_of(domain.surface.vertex_count, -1);
    for (std::size_t k = domain.first_hole; k < domain.loops.size(); ++k)
        for (const Index v : domain.loops[k]) hole_of[v] = static_cast<Index>(k);
    std::vector<VertexLoop> loops, holes;
    std::vector<Circle> places, hole_places;
    const bool circles = shape == HoleShape::open && domain.first_hole == 0 && map.apart && !map.circles.empty();
    UntangleOptions options{.slide = circles, .effort = &effort};
    std::vector<Index> off_circle;
    for (const VertexLoop& loop : sheet.surface.loops) {
        const Index k = hole_of[sheet.source[loop.front()]];
        const bool whole = k >= 0 && loop.size() == domain.loops[k].size() &&
                           std::ranges::all_of(loop, [&](Index v) { return hole_of[sheet.source[v]] == k; });
        if (!whole || shape != HoleShape::open) {
            loops.push_back(loop);
            places.push_back(Circle{});
            for (const Index v : loop) {
                off_circle.push_back(v);
                options.held.push_back(v);
            }
            continue;
        }
        holes.push_back(loop);
        Circle place{0.0, 10.0};  // a circle is needed even where the loop may not slide
        if (circles) {
            place = map.circles[k - static_cast<Index>(domain.first_hole)];
            place = {sheet.scale * (lifted(map, place.center, sheet.lift[loop.front()]) - sheet.middle),
                     sheet.scale * place.radius};
        }
        hole_places.push_back(place);
        for (const Index v : loop)
            if (std::ranges::binary_search(map.off_circle, sheet.source[v])) off_circle.push_back(v);
    }
    if (loops.empty()) return;  // without a border nothing would hold the tile
    loops.insert(loops.end(), holes.begin(), holes.end());
    places.insert(places.end(), hole_places.begin(), hole_places.end());
    std::ranges::sort(off_circle);
    const PlanarPoints before = sheet.uv;
    const UntangleReport report =
        untangle(sheet.vertices, sheet.surface, loops, places, off_circle, sheet.uv, context, options);
    for (Eigen::Index v = 0; v < sheet.uv.rows(); ++v) {
        if (sheet.uv.row(v) == before.row(v)) continue;
        const Complex at = Complex(sheet.uv(v, 0), sheet.uv(v, 1)) / sheet.scale + sheet.middle;
        const Lift l = sheet.lift[v];
        map.z[sheet.source[v]] = lifted(map, at, {-l[0], -l[1]});
    }
    for (const Index v : report.freed) map.off_circle.push_back(sheet.source[v]);
    sort_unique(map.off_circle);
}

/// Moves the neighbourhoods of a ring's flipped faces by foldover-free minimization (Garanzha et al. 2021); vertices of
/// rims and slits stay on their lines.
void slide_along_lines(const PeriodicSurface& domain, const std::vector<Lift>& lift, int rings, HoleShape shape,
                       FlatMap& map, ExecutionContext& context)
{
    constexpr double far = 1e4;        // radius of the circle that replaces a line, over the tile's
    constexpr double rounding = 4e-7;  // area that a face can lose by rounding, over its longest edge
    TileSheet sheet = sheet_of(domain, map, lift);
    const Triangles& triangles = sheet.surface.triangles;
    const auto area = [&](const PlanarPoints& uv, Index f) {
        const Eigen::RowVector2d a = uv.row(triangles(f, 1)) - uv.row(triangles(f, 0));
        const Eigen::RowVector2d b = uv.row(triangles(f, 2)) - uv.row(triangles(f, 0));
        return 0.5 * (a[0] * b[1] - a[1] * b[0]);
    };
    const auto longest = [&](Index f) {
        double result = 0.0;
        for (int k = 0; k < 3; ++k)
            result = std::max(result, (sheet.uv.row(triangles(f, (k + 1) % 3)) - sheet.uv.row(triangles(f, k))).norm());
        return result;
    };
    const auto flat = [&](const PlanarPoints& uv, Index f) { return !(area(uv, f) > 0.25 * rounding * longest(f)); };
    std::vector<Index> seeds;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        if (flat(sheet.uv, f)) seeds.push_back(f);
    if (seeds.empty()) return;
    std::vector<Index> faces =
        VertexFaces(triangles, sheet.surface.vertex_count).with_rings(triangles, seeds, rings + 1);
    std::ranges::sort(faces);

    using Mobility = FoldoverProblem::Mobility;
    const Index count = sheet.surface.vertex_count;
    FoldoverProblem problem;
    problem.points = sheet.uv;
    problem.mobility.assign(static_cast<std::size_t>(count), Mobility::held);
    problem.circles.resize(static_cast<std::size_t>(count));
    std::vector<char> inside(static_cast<std::size_t>(count), 0);
    std::vector<int> fans(static_cast<std::size_t>(domain.surface.vertex_count), 0);
    for (const Index v : sheet.source) ++fans[v];
    for (const Index f : faces)
        for (const Index v : triangles.row(f)) inside[v] = fans[sheet.source[v]] == 1;
    std::vector<char> chosen(static_cast<std::size_t>(triangles.rows()), 0);
    for (const Index f : faces) chosen[f] = 1;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        if (!chosen[f])
            for (const Index v : triangles.row(f)) inside[v] = 0;
    std::vector<int> line(static_cast<std::size_t>(domain.surface.vertex_count), 0);  // 1 along u, 2 along v, 3 none
    for (std::size_t k = 0; k < domain.loops.size(); ++k)
        for (const Index v : domain.loops[k])
            line[v] = k < domain.first_hole ? 1 : shape == HoleShape::along_u ? 1 : shape == HoleShape::along_v ? 2 : 3;
    for (Index v = 0; v < count; ++v) {
        const int along = line[sheet.source[v]];
        if (!inside[v] || along == 3) continue;
        problem.mobility[v] = along == 0 ? Mobility::free : Mobility::sliding;
        const Complex at(sheet.uv(v, 0), sheet.uv(v, 1));
        problem.circles[v] = {at + (along == 1 ? Complex(0.0, far) : Complex(far, 0.0)), far};
    }
    std::erase_if(faces, [&](Index f) {
        return std::ranges::all_of(triangles.row(f), [&](Index v) { return problem.mobility[v] == Mobility::held; });
    });
    if (faces.empty()) return;
    const PatchShapes shapes = patch_shapes(sheet.vertices, triangles, sheet.uv, faces, PatchShape::equilateral);
    problem.triangles = triangles(faces, Eigen::all);
    problem.reference = shapes.references;
    problem.floor.resize(static_cast<Eigen::Index>(faces.size()));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Eigen::Index f = static_cast<Eigen::Index>(i);
        const double full = shapes.areas[f];
        problem.floor[f] = rounding * longest(faces[i]) / (2.0 * full);
        if (!flat(sheet.uv, faces[i]))
            problem.floor[f] = std::min(problem.floor[f], 0.5 * area(sheet.uv, faces[i]) / full);
    }
    minimize_foldover_free(problem, context);
    for (Index v = 0; v < count; ++v) {  // from the circles back to the lines
        const int along = line[sheet.source[v]];
        if (along == 1) problem.points(v, 1) = sheet.uv(v, 1);
        if (along == 2) problem.points(v, 0) = sheet.uv(v, 0);
    }
    std::size_t before = 0, after = 0;
    for (const Index f : faces) {
        before += flat(sheet.uv, f) ? 1 : 0;
        after += flat(problem.points, f) ? 1 : 0;
    }
    if (!problem.points.allFinite() || after >= before) return;
    for (Index v = 0; v < count; ++v) {
        if (!inside[v] || problem.points.row(v) == sheet.uv.row(v)) continue;
        const Complex old = map.z[sheet.source[v]];
        const Complex by = Complex(problem.points(v, 0) - sheet.uv(v, 0), problem.points(v, 1) - sheet.uv(v, 1));
        const int along = line[sheet.source[v]];
        map.z[sheet.source[v]] = old + by / sheet.scale;
        if (along == 1) map.z[sheet.source[v]].imag(old.imag());
        if (along == 2) map.z[sheet.source[v]].real(old.real());
    }
}

/// The tile's flipped faces, except those below resolution.
std::vector<Index> tangled(const PeriodicSurface& domain, const Tile& tile)
{
    const TileFaults faults = find_faults(domain, tile, HoleShape::open);
    std::vector<Index> result;
    std::ranges::set_difference(faults.flipped, faults.below_resolution, std::back_inserter(result));
    return result;
}

}  // namespace

std::size_t turn_faces_back(const PeriodicSurface& domain, HoleShape shape, FlatMap& map, ExecutionContext& context)
{
    RepairEffort effort(domain.surface.triangles.rows(), tile_effort);
    std::vector<Index> left = tangled(domain, tile_of(domain, map));
    for (int pass = 0, in_vain = 0; pass < most_tile_passes && in_vain < most_in_vain && !left.empty(); ++pass) {
        context.advance(static_cast<double>(pass) / most_tile_passes);
        std::array<double, 2> origin = clear_origin(domain, map);
        if (pass > 0) {  // around one of them
            const Index f = left[(static_cast<std::size_t>(pass) * 7919) % left.size()];
            origin = in_periods(map, map.z[domain.surface.triangles(f, 0)]);
            for (double& o : origin) o -= 0.5;
        }
        const std::vector<Lift> lift = cut_tile(domain, map, origin);
        if (domain.first_hole > 0) slide_along_lines(domain, lift, pass < 2 ? 2 : 5, shape, map, context);
        if (shape == HoleShape::open || pass > 1) turn_back_in(domain, lift, shape, map, effort, context);
        const std::size_t before = left.size();
        left = tangled(domain, tile_of(domain, map));
        in_vain = left.size() < before ? 0 : in_vain + 1;
    }
    return left.size();
}

}  // namespace koebe
