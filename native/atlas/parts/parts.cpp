#include "parts/parts.h"

#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/numbering.h"
#include "core/vertex_weights.h"
#include "cost/costs.h"
#include "even/even_map.h"
#include "execution/memory_limit.h"
#include "execution/side_by_side.h"
#include "flat/upright_parts.h"
#include "foldover/convex_polygons.h"
#include "hard/grid_parts.h"
#include "linear/dense_spd.h"
#include "opened/disk_packing.h"
#include "packing/tile_packing.h"
#include "part_maps/part_mesh.h"
#include "parts/alike_pieces.h"
#include "parts/flat_mesh.h"
#include "parts/hard_figures.h"
#include "parts/pack_parts.h"
#include "planar/planar_predicates.h"
#include "quality/map_clock.h"
#include "quality/shared_warnings.h"
#include "quality/stored_uv.h"
#include "quality/take_verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double rigid_edge = 1e-5;  // in roots of the area: edges of rigid faces keep their length up to this,
constexpr double most_rigid = 1e-3;  // and up to this share of it

constexpr const char* lower_price = "A lower price makes more parts, and more even ones";

/// The value below which a share of the weight lies. @param values (value, weight), rising; not empty
double quantile(const std::vector<std::pair<double, double>>& values, double share)
{
    double total = 0.0, below = 0.0;
    for (const auto& [value, weight] : values) total += weight;
    for (const auto& [value, weight] : values)
        if ((below += weight) >= share * total) return value;
    return values.back().first;
}

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

/// Texel densities: the ratio of the quantiles, and the area within the best factor 3. Faces without area in the UVs
/// count as the least dense.
/// @param pixels_per_unit pixels along the square, over the length of the layout's unit in the mesh's
void report_density(const PartsLayout& layout, const PlanarPoints& uv, const std::vector<Index>& faces,
                    double pixels_per_unit, PartsResult& result)
{
    constexpr double none = -1000.0;
    const VectorXd areas = face_areas(layout.vertices, layout.triangles);
    std::vector<std::pair<double, double>> density;
    double total = 0.0;
    for (const Index f : faces) {
        if (!(areas[f] > 0.0)) continue;
        const double area = signed_corner_area(uv, f);
        density.emplace_back(area > 0.0 ? 0.5 * std::log(area / areas[f]) : none, areas[f]);
        total += areas[f];
    }
    std::ranges::sort(density);
    if (density.empty()) return;
    result.density_ratio_5_95 = std::exp(std::min(quantile(density, 0.95) - quantile(density, 0.05), 700.0));
    result.density = std::exp(quantile(density, 0.5)) * pixels_per_unit;
    double inside = 0.0;
    std::size_t end = 0;
    for (const auto& [u, area] : density) {
        while (end < density.size() && density[end].first <= u + factor_three) inside += density[end++].second;
        result.even_area = std::max(result.even_area, inside / total);
        inside -= area;
    }
}

/// The length of edges whose faces do not meet in the UVs. An edge of more than two faces counts for each further face.
double seam_length(const PartsLayout& layout, const std::vector<Index>& faces)
{
    using Side = std::array<double, 7>;  // the edge's vertices, their UVs, and the part: twins may meet in their fold
    std::vector<Side> sides;
    sides.reserve(3 * faces.size());
    for (const Index f : faces)
        for (int k = 0; k < 3; ++k) {
            Eigen::Index a = 3 * static_cast<Eigen::Index>(f) + k, b = 3 * static_cast<Eigen::Index>(f) + (k + 1) % 3;
            if (layout.triangles.data()[a] > layout.triangles.data()[b]) std::swap(a, b);
            sides.push_back({static_cast<double>(layout.triangles.data()[a]),
                             static_cast<double>(layout.triangles.data()[b]), layout.uv(a, 0), layout.uv(a, 1),
                             layout.uv(b, 0), layout.uv(b, 1), static_cast<double>(layout.part[f])});
        }
    std::sort(sides.begin(), sides.end());
    double length = 0.0;
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i][0] != sides[i - 1][0] || sides[i][1] != sides[i - 1][1] || sides[i] == sides[i - 1]) continue;
        const auto end = [&](int k) { return layout.vertices.row(static_cast<Eigen::Index>(sides[i][k])); };
        length += (end(0) - end(1)).norm();
    }
    return length;
}

std::vector<Warning> warnings_of(const PartsLayout& layout, const std::vector<Index>& left_out,
                                 const Distortion& distortion)
{
    std::vector<Warning> warnings;
    // Of the mesh.
    if (!left_out.empty())
        warnings.push_back(
            {WarningKind::collapsed_faces,
             counted(left_out.size(), "face") + " in no part: without area, or with the same vertices as another face",
             left_out});
    warn_reoriented(layout.reoriented, warnings);
    // Of the UVs as stored. A face too small for them may lie either way.
    if (!distortion.below_resolution.empty())
        warnings.push_back({WarningKind::below_resolution,
                            counted(distortion.below_resolution.size(), "face") + " below the resolution of 32-bit UVs",
                            distortion.below_resolution, lower_price});
    if (distortion.flipped.size() > distortion.below_resolution.size()) {
        std::vector<Index> flipped;
        std::ranges::set_difference(distortion.flipped, distortion.below_resolution, std::back_inserter(flipped));
        warnings.push_back({WarningKind::flipped, counted(flipped.size(), "face") + " flipped in 32-bit UVs", flipped});
    }
    if (!layout.crossing.empty())
        warnings.push_back({WarningKind::not_one_to_one,
                            "parts whose boundary crosses itself, with " + counted(layout.crossing.size(), "face"),
                            layout.crossing});
    if (!layout.not_even.empty()) warn_not_even(layout.not_even, warnings);
    return warnings;
}

/// (V) 1 for vertices of faces that lie true to size, as flat and rolled regions do.
std::vector<char> at_rigid_faces(const FlatPart& part, double noise)
{
    std::vector<char> rigid(part.original.size(), 0);
    for (const auto& face : part.surface.triangles.rowwise()) {
        const auto is_rigid = [&](int k) {
            const Index a = face[k], b = face[(k + 1) % 3];
            const double length = (part.vertices.row(a) - part.vertices.row(b)).norm();
            return std::abs((part.points.row(a) - part.points.row(b)).norm() - length) <=
                   std::min(std::max(rigid_edge, 2.0 * noise), most_rigid * length);
        };
        if (is_rigid(0) && is_rigid(1) && is_rigid(2)) rigid[face[0]] = rigid[face[1]] = rigid[face[2]] = 1;
    }
    return rigid;
}

/// The vertices of the input at such faces; none of a mesh of triangles, whose vertices nothing moves.
std::vector<Index> rigid_vertices(const FlatMesh& mesh)
{
    std::vector<Index> vertices;
    if (mesh.polygon.empty()) return vertices;
    for (const FlatPart& part : mesh.parts) {
        const std::vector<char> rigid = at_rigid_faces(part, mesh.layout.noise);
        for (std::size_t v = 0; v < rigid.size(); ++v)
            if (rigid[v] != 0) vertices.push_back(part.original[v]);
    }
    return vertices;
}

/// Makes polygons convex with free rims, as long as the part stays one to one. Rigid faces and divided edges stay.
/// Packing keeps the parts apart afterwards.
void mend_rims(FlatMesh& mesh, int threads, ExecutionContext& context)
{
    if (mesh.polygon.empty()) return;
    std::vector<char> straight(static_cast<std::size_t>(mesh.layout.vertices.rows()), 0);
    for (const DividedEdge& edge : mesh.divided.edges)
        straight[edge.from] = straight[edge.to] = straight[edge.middle] = 1;
    side_by_side(mesh.parts.size(), threads, context, [&](std::size_t k, ExecutionContext& own) {
        FlatPart& part = mesh.parts[k];
        if (!part.one_to_one) return;
        const std::vector<Index> polygons = values_at(mesh.polygon, part.faces), none_turned;
        SurfacePolygons surface{part.vertices, part.surface.triangles, polygons, none_turned};
        surface.free_rims = true;
        const std::vector<char> rigid = at_rigid_faces(part, mesh.layout.noise);
        for (std::size_t v = 0; v < part.held.size(); ++v)
            if (part.held[v] != 0 || straight[part.original[v]] != 0 || rigid[v] != 0)
                surface.held.push_back(static_cast<Index>(v));
        PlanarPoints moved = part.points;
        if (mend_disk_polygons(surface, moved, own) && lies_one_to_one(part, moved)) part.points = std::move(moved);
    });
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
    stand_upright(mesh.parts, up);
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

/// What the layout says, as the UVs are stored. @param pixels_per_unit as in report_density
void describe(PartsLayout& layout, const Vertices& vertices, const Triangles& triangles, const PackedParts& packed,
              const PartsOptions& options, double pixels_per_unit, PartsResult& result)
{
    // Distortion, and the density of the faces that have a part.
    const PlanarPoints uv = layout.uv.unaryExpr(&as_stored);
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    std::vector<Index> mapped, left_out;
    for (std::size_t f = 0; f < layout.part.size(); ++f)
        (layout.part[f] >= 0 ? mapped : left_out).push_back(static_cast<Index>(f));
    result.uv = uv_of_input(layout, triangles);
    result.distortion = {distortion_of_parts(layout, uv, mapped),
                         judge_corners(vertices, triangles, result.uv, layout.turned, left_out)};
    result.turned = layout.turned;
    result.parts = std::move(layout.parts);
    for (PartReport& part : result.parts)
        part.angle_error_deg = distortion_of_parts(layout, uv, part.faces).angle_error_deg.mean;
    report_density(layout, uv, mapped, pixels_per_unit, result);

    // The square: twins cover no further area.
    for (const Index f : mapped)
        if (!packed.twins[static_cast<std::size_t>(layout.part[f])]) result.coverage += signed_corner_area(uv, f);
    result.tiles = packed.tiles;
    result.coverage /= packed.tiles;
    result.margin = packed.margin * options.pixels;
    const HardFigures hard = hard_figures(layout, uv);
    result.regions = hard.regions;
    result.whole = hard.whole;
    result.aligned = hard.aligned;

    // Cuts and effort.
    result.cut_length = seam_length(layout, mapped);
    result.slit_length = layout.slit_length;
    result.dart_length = layout.dart_length;
    result.darts = layout.darts;
    result.handles_cut = layout.handles_cut;
    result.maps = layout.maps;
    result.even = layout.even;
    result.overlaps = layout.overlaps;
    result.converged =
        layout.crossing.empty() && result.distortion.flipped.size() == result.distortion.below_resolution.size();
    result.warnings = warnings_of(layout, left_out, result.distortion);
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
