#include "parts/parts.h"

#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/numbering.h"
#include "core/vertex_weights.h"
#include "cost/costs.h"
#include "even/even_map.h"
#include "execution/memory_limit.h"
#include "flat/turned_to_axes.h"
#include "foldover/convex_polygons.h"
#include "hard/grid_parts.h"
#include "linear/dense_spd.h"
#include "opened/disk_packing.h"
#include "packing/tile_packing.h"
#include "part_maps/part_mesh.h"
#include "parts/alike_pieces.h"
#include "parts/flat_mesh.h"
#include "parts/pack_parts.h"
#include "parts/parts_report.h"
#include "parts/rigid_faces.h"
#include "planar/planar_predicates.h"
#include "quality/map_clock.h"
#include "quality/shared_warnings.h"
#include "quality/stored_uv.h"
#include "quality/take_verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace koebe {
namespace {

/// The median over the area of the parts' lengths over those on the surface, in the unit of their vertices.
double median_scale(const std::vector<FlatPart>& parts)
{
    std::vector<std::pair<double, double>> scales;
    for (const FlatPart& part : parts) {
        const VectorXd areas = face_areas(part.vertices, part.surface.triangles);
        for (Eigen::Index f = 0; f < areas.size(); ++f)
            if (const double area = signed_area(part.points, part.surface.triangles, f); areas[f] > 0.0)
                scales.emplace_back(std::sqrt(std::max(area, 0.0) / areas[f]), areas[f]);
    }
    std::ranges::sort(scales);
    return scales.empty() ? 1.0 : quantile(scales, 0.5);
}

/// @param unit length of the layout's unit in the mesh's
std::optional<WantedScale> wanted_scale(const FlatMesh& mesh, const PartsOptions& options, double unit)
{
    if (!options.density) return {};
    const double scale = *options.density * unit / options.pixels / median_scale(mesh.parts);
    if (!std::isfinite(scale) || !(scale > 0.0))
        throw InputError("the density is too large or too small for this mesh");
    return WantedScale{scale, *options.density};
}

/// @throws InputError
void require_options(const PartsOptions& options)
{
    if (!(options.price > 0.0) || !std::isfinite(options.price)) throw InputError("the price must be positive");
    if (!options.cuts.empty() && !options.cut) throw InputError("cuts need cut = true");
    if (options.even) require_even(*options.even);
    if (!(options.darts >= 0.0 && options.darts <= 1.0)) throw InputError("darts must be from 0 to 1");
    if (options.density && (!(*options.density > 0.0) || !std::isfinite(*options.density)))
        throw InputError("the density must be positive");
    if (!(options.hard_angle >= 1.0 && options.hard_angle <= 179.0))
        throw InputError("the hard angle must be from 1 to 179 degrees");
    margin_in_square(options.margin, options.pixels);  // refuses a negative one
    if (options.tiles < 0 || options.tiles > most_tiles) throw InputError("tiles must be from 0 to 100");
    if (options.tiles == 0 && !options.density) throw InputError("as many tiles as needed (0) needs a density");
}

/// The parts with room for each polygon, upright, their twins found, and packed.
PackedParts packed_parts(FlatMesh& mesh, const PartsOptions& options, double unit, const Eigen::RowVector3d& up,
                         ExecutionContext& context)
{
    context.begin_stage("pack", 0.9, 1.0);
    const bool is_free = !options.even && options.loops != LoopForm::round && !options.round_cuts;
    if ((is_free && options.importance.empty()) || options.rectify)
        rectify_grids(mesh.parts, options.rectify, mesh.layout.noise);
    turn_to_axes(mesh.parts, up);
    PackOptions packing{
        .tiles = options.tiles, .margin = margin_in_square(options.margin, options.pixels), .threads = options.threads};
    Twins twins = find_twins(mesh.parts);
    if (options.stack) packing.twins = std::move(twins.copies);
    if (options.stack_mirrored) packing.twins = std::move(twins.all);
    packing.wanted = wanted_scale(mesh, options, unit);
    return pack_parts(mesh.parts, packing, context);
}

/// The faces of parts that were drawn anew, ascending.
std::vector<Index> faces_anew(const FlatMesh& mesh, const PackedParts& packed)
{
    std::vector<Index> anew;
    for (std::size_t k = 0; k < mesh.parts.size(); ++k)
        if (packed.anew[k]) anew.insert(anew.end(), mesh.parts[k].faces.begin(), mesh.parts[k].faces.end());
    if (!mesh.divided.face.empty()) std::erase_if(anew, [&](Index f) { return f >= mesh.undivided.rows(); });
    std::ranges::sort(anew);
    return anew;
}

/// @param length_of_unit of a unit of the layout, in the mesh's unit
PartsResult compute(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                    const std::function<double()>& length_of_unit, const Eigen::RowVector3d& up,
                    ExecutionContext& context)
{
    MapClock clock;
    require_options(options);
    require_memory_for_faces(triangles.rows());
    fix_product_blocks();

    // Cut the mesh into flat parts, alike where pieces are alike.
    FlatMesh mesh = flat_mesh(vertices, triangles, options, context);
    if (options.show.empty() && options.importance.empty() && options.slits.empty()) cut_alike(mesh);
    mend_rims(mesh, options.threads, context);
    clock.take(mesh.seconds);

    // Pack them, and make polygons convex where they lie.
    const double unit = length_of_unit();
    const PackedParts packed = packed_parts(mesh, options, unit, up, context);
    std::vector<Index> anew = faces_anew(mesh, packed);
    PartsResult result;
    std::vector<char> mirrored(mesh.parts.size(), 0);
    for (std::size_t k = 0; k < packed.twins.size(); ++k) {
        if (!packed.twins[k]) continue;
        mirrored[k] = packed.twins[k]->mirrored;
        result.stacked.push_back(
            {static_cast<Index>(k), static_cast<Index>(packed.twins[k]->of), packed.twins[k]->mirrored});
    }
    const std::vector<Index> none_turned, rigid = rigid_vertices(mesh);
    PartsLayout layout = layout_at(std::move(mesh), packed.places, mirrored);
    const SurfacePolygons polygons{layout.vertices, layout.triangles, options.polygon, none_turned, rigid};
    mend_polygons(polygons, layout.uv, context);

    // Report on the UVs as 32-bit floats store them.
    describe(layout, vertices, triangles, packed, options, options.pixels / unit, result);
    if (!anew.empty())
        result.warnings.push_back(
            {WarningKind::not_even,
             counted(anew.size(), "face") +
                 " in parts that were drawn anew, less even: they overlapped themselves as stored",
             std::move(anew)});
    warn_concave_polygons(polygons, layout.uv.unaryExpr(&as_stored), result.warnings);
    take_verdict({.most_lost = options.most_lost, .advice = lower_price}, result);
    result.part = std::move(layout.part);
    clock.finish(result, context);
    return result;
}

void name_parts(const CanonicalMesh& mesh, PartsResult& result)
{
    mesh.name_values(result.part);
    for (PartReport& part : result.parts) {
        mesh.name_faces(part.faces);
        for (VertexLoop& loop : part.loops) mesh.name_loop(loop);
    }
}

}  // namespace

PartsResult parts_of(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                     ExecutionContext& context)
{
    require_weights("a weight to show", options.show, static_cast<Index>(vertices.rows()));
    require_weights("an importance", options.importance, static_cast<Index>(vertices.rows()));
    const auto compute_here = [vertices, triangles](const CanonicalMesh& mesh, PartsOptions& here,
                                                    ExecutionContext& own) {
        const auto length_of_unit = [&] { return root_of_area(vertices, triangles); };
        here.show = mesh.of_vertices(here.show);
        here.importance = mesh.of_vertices(here.importance);
        for (auto* const edges : {&here.slits, &here.cuts})
            for (auto& edge : *edges) edge = {mesh.vertex(edge[0]), mesh.vertex(edge[1])};
        if (here.sketch)
            here.sketch = [&mesh, given = std::move(here.sketch)](CutEdges edges) {
                for (auto& edge : edges) std::ranges::for_each(edge, [&](Index& v) { mesh.name_vertex(v); });
                given(std::move(edges));
            };
        return compute(mesh.vertices, mesh.triangles, here, length_of_unit, mesh.turn.row(2), own);
    };
    return corner_map<PartsResult>(vertices, triangles, options, context, compute_here, name_parts);
}

}  // namespace koebe
