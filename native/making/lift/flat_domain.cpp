#include "lift/flat_domain.h"

#include "core/counted.h"
#include "core/sort_unique.h"
#include "core/vertex_weights.h"
#include "lift/filled_sheet.h"
#include "mesh/corner_order.h"
#include "mesh/loop_with.h"
#include "parts/parts.h"
#include "pipeline/final_check.h"
#include "pipeline/uniformize.h"
#include "quality/take_verdict.h"
#include "sphere/sphere_map.h"
#include "tiles/tile.h"
#include "tiles/tile_map.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

namespace koebe {
namespace {

const char* const no_map = "the map is not one to one: take --shape parts";

PlanarPoints disk_corners(const Surface& surface, const PlanarPoints& disk)
{
    PlanarPoints uv(surface.triangles.size(), 2);
    for (Eigen::Index c = 0; c < uv.rows(); ++c)
        uv.row(c) = 0.5 * (disk.row(surface.triangles.data()[c]).array() + 1.0).matrix();
    return uv;
}

/// The map is not one to one. Names its flipped faces; without them, the vertices of the loops at fault.
[[noreturn]] void refuse_map(const Warning& fault, const std::vector<Index>& vertices)
{
    if (fault.elements.empty() && !vertices.empty()) throw SolverError(no_map, ElementKind::vertices, vertices);
    throw SolverError(no_map, ElementKind::faces, fault.elements);
}

/// The vertices of the disk's loops that cross, or whose circles are at fault.
std::vector<Index> faulty_loops(const Surface& surface, const UniformizeResult& map)
{
    std::vector<VertexLoop> loops;
    std::vector<Circle> circles;
    for (const LoopReport& loop : map.loops) {
        loops.push_back(loop.vertices);
        circles.push_back(loop.circle);
    }
    const MapFaults faults = find_faults(surface.triangles, loops, map.uv, circles);
    std::vector<Index> vertices = faults.outside;
    for (const int k : faults.bad_circles) vertices.insert(vertices.end(), loops[k].begin(), loops[k].end());
    for (const auto& [first, second] : faults.crossings) vertices.insert(vertices.end(), {first, second});
    sort_unique(vertices);
    return vertices;
}

/// The vertices of the loops that a tile's warnings name.
std::vector<Index> faulty_loops(const TileResult& map)
{
    std::vector<Index> vertices;
    for (const Warning& warning : map.warnings)
        if (warning.kind == WarningKind::lost_circles)
            for (const Index k : warning.elements)
                vertices.insert(vertices.end(), map.loops[k].vertices.begin(), map.loops[k].vertices.end());
    sort_unique(vertices);
    return vertices;
}

Circle hole_with(const std::vector<LoopReport>& loops, Index vertex)
{
    const int k = loop_with(loops, vertex, &LoopReport::vertices);
    if (k > 0) return loops[k].circle;  // the first one is the outer loop
    throw InputError("vertex " + std::to_string(vertex) + " is on no hole of the disk", ElementKind::vertices,
                     {vertex});
}

/// The map to the sphere, and what is true of its UVs in two disks in place of the map's own layout.
SphereSheets sphere_domain(const Vertices& vertices, const Triangles& triangles, const LiftOptions& options,
                           const Surface& surface, MapReport& report, ExecutionContext& context)
{
    SphereOptions chosen;
    chosen.most_lost = 1.0;  // judged below
    SphereResult map = sphere_map(vertices, triangles, chosen, context);
    std::vector<Index> flipped;
    std::ranges::set_difference(map.flipped_on_sphere, map.below_sphere_resolution, std::back_inserter(flipped));
    if (!flipped.empty()) throw SolverError(no_map, ElementKind::faces, std::move(flipped));
    SphereSheets sheets = sphere_sheets(vertices, surface.triangles, map.points,
                                        options.around < 0 ? std::nullopt : std::optional<Index>(options.around));
    std::erase_if(map.warnings, [](const Warning& warning) { return warning.kind == WarningKind::flipped; });
    static_cast<Verdict&>(map.distortion) = judge_corners(vertices, surface.triangles, planar_points(sheets.home.uv));
    take_verdict({.advice = "Parts (--shape parts) lose less"}, map);
    if (const std::vector<Index>& faces = map.distortion.flipped; !faces.empty())
        map.warnings.push_back(
            {WarningKind::flipped, counted(faces.size(), "face") + " of the map without area in 32-bit UVs", faces});
    report = std::move(map);
    return sheets;
}

}  // namespace

FlatDomain flat_domain(const Vertices& vertices, const Triangles& triangles, const LiftOptions& options,
                       ExecutionContext& context)
{
    validate_arrays(vertices, triangles);
    FlatDomain domain;
    domain.surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    if (options.around >= static_cast<Index>(vertices.rows()))
        throw InputError("vertex " + std::to_string(options.around) + " does not exist", ElementKind::vertices,
                         {options.around});
    require_weights("a share of the size", options.graded, static_cast<Index>(vertices.rows()));
    if (options.shape == LiftShape::sphere) {
        domain.sphere = sphere_domain(vertices, triangles, options, domain.surface, domain.map, context);
        domain.sphere->home.grade = options.graded;
        for (FlatSheet& chart : domain.sphere->charts) chart.grade = options.graded;
        return domain;
    }
    PlanarPoints uv;
    double grid = 0.0;
    std::vector<Complex> periods;
    std::vector<Index> faulty;  // vertices of loops, if the map is not one to one
    if (options.shape == LiftShape::disk) {
        UniformizeOptions chosen;
        chosen.even = options.even.value_or(0.0);
        UniformizeResult map = uniformize(vertices, triangles, chosen, context);
        uv = disk_corners(domain.surface, map.uv);
        if (options.around >= 0) domain.hole = hole_with(map.loops, options.around);
        if (!map.converged) faulty = faulty_loops(domain.surface, map);
        domain.map = std::move(map);
    } else if (options.shape == LiftShape::parts) {
        PartsOptions chosen;
        chosen.even = options.even;
        PartsResult map = parts_of(vertices, triangles, chosen, context);
        uv = in_corner_order(map.uv, triangles, domain.surface.triangles);
        domain.map = std::move(map);
    } else {
        TileOptions chosen;
        chosen.even = options.even.value_or(0.0);
        TileResult map = options.shape == LiftShape::ring ? ring_map(vertices, triangles, chosen, context)
                                                          : torus_map(vertices, triangles, chosen, context);
        uv = in_corner_order(map.uv, triangles, domain.surface.triangles);
        for (const auto& period : map.periods) periods.emplace_back(period[0], period[1]);
        grid = uv_grid;
        faulty = faulty_loops(map);
        domain.map = std::move(map);
    }
    for (const Warning& warning : domain.map.warnings)
        if (warning.kind == WarningKind::not_one_to_one) refuse_map(warning, faulty);
    domain.flat = flat_sheet(vertices, domain.surface.triangles, uv, grid, std::move(periods));
    domain.flat.grade = options.graded;
    if (options.rim == LiftRim::clip) domain.filled = filled_sheet(domain.flat);
    return domain;
}

}  // namespace koebe
