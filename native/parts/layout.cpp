#include "parts/layout.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "cut/open_surface.h"
#include "parts/flat_part.h"
#include "parts/mirror_symmetry.h"
#include "parts/packing.h"
#include "parts/splitting.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr double cut_share = 1.0;  // of a part's price, for a cut as long as the root of the area
constexpr int rounds = 2;          // of splitting and merging
constexpr double margin = 0.004;   // between parts, in the unit square

/// Within the unit cube first, as areas of huge or tiny meshes are beyond the range of a double; then of area 1.
Vertices of_area_one(const Vertices& vertices, const Triangles& triangles)
{
    const Eigen::RowVector3d low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
    const Eigen::RowVector3d middle = 0.5 * low + 0.5 * high;
    const double extent = (0.5 * high - 0.5 * low).maxCoeff();
    if (!(extent > 0.0)) throw InputError("all vertices lie on one point");
    Vertices scaled = (vertices.rowwise() - middle) / extent;
    const double area = face_areas(scaled, triangles).sum();
    if (!(area > 0.0)) throw InputError("the surface has no area");
    return scaled / std::sqrt(area);
}

/// The mesh as it is, if it can be mapped so.
OpenedSurface strict_surface(const Vertices& vertices, const Triangles& triangles)
{
    validate_arrays(vertices, triangles);
    Surface surface = require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows()));
    OpenedSurface opened;
    SurfacePiece piece{vertices, std::move(surface.triangles), {}, {}, {}};
    piece.source_vertex.resize(static_cast<std::size_t>(vertices.rows()));
    piece.source_face.resize(static_cast<std::size_t>(triangles.rows()));
    std::iota(piece.source_vertex.begin(), piece.source_vertex.end(), 0);
    std::iota(piece.source_face.begin(), piece.source_face.end(), 0);
    opened.pieces.push_back(std::move(piece));
    return opened;
}

/// Upright, its lower left corner at 0.
PlanarPoints upright(const PlanarPoints& flat, Box& box)
{
    PlanarPoints points = flat;
    Eigen::RowVector2d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
    if (high[0] - low[0] > high[1] - low[1]) {
        points.col(0) = -flat.col(1);
        points.col(1) = flat.col(0);
        low = points.colwise().minCoeff();
        high = points.colwise().maxCoeff();
    }
    points.rowwise() -= low;
    box = {high[0] - low[0], high[1] - low[1]};
    return points;
}

/// Into the unit square, and flips turned back there.
/// @param flats whose kinds may change
std::vector<PlanarPoints> packed(std::vector<FlatPart>& flats, ExecutionContext& context)
{
    std::vector<PlanarPoints> placed;
    std::vector<Box> boxes(flats.size());
    for (std::size_t k = 0; k < flats.size(); ++k) placed.push_back(upright(flats[k].points, boxes[k]));
    const PackedBoxes pack = pack_boxes(boxes, margin);
    for (std::size_t k = 0; k < placed.size(); ++k) {
        placed[k].rowwise() += Eigen::RowVector2d(pack.corners[k][0], pack.corners[k][1]);
        placed[k] /= pack.side;
        repair_flips(flats[k], placed[k], context);
        embed_safely(flats[k], placed[k], context);
        if (!placed[k].allFinite()) throw SolverError("the map of a part is not finite");
        placed[k] = placed[k].cwiseMax(0.0).cwiseMin(1.0);
        if (!loops_apart(flats[k], placed[k])) flats[k].one_to_one = false;
    }
    return placed;
}

/// (3F) half-edges of a piece that are among these edges, by vertices of the input; empty: none.
std::vector<char> chosen_slits(const SurfacePiece& piece, const std::vector<std::array<Index, 2>>& edges)
{
    if (edges.empty()) return {};
    std::set<std::pair<Index, Index>> chosen;
    for (const auto& edge : edges) chosen.insert(std::minmax(edge[0], edge[1]));
    std::vector<char> slit(static_cast<std::size_t>(piece.triangles.size()), 0);
    for (Index h = 0; h < static_cast<Index>(slit.size()); ++h) {
        const Index a = piece.source_vertex[origin(piece.triangles, h)];
        const Index b = piece.source_vertex[target(piece.triangles, h)];
        slit[h] = chosen.contains(std::minmax(a, b));
    }
    return slit;
}

/// @param slit (3F) half-edges of the whole
void prefer_slits(PartMesh& part, const std::vector<char>& slit)
{
    part.slit.resize(3 * part.faces.size(), 0);
    for (std::size_t i = 0; i < part.faces.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (slit[3 * static_cast<std::size_t>(part.faces[i]) + k]) part.slit[3 * i + k] = 1;
}

/// @param opened (3F) half-edges of the whole, changed in place
void note_slit(const PartMesh& part, const FlatPart& flat, std::vector<char>& opened)
{
    for (std::size_t h = 0; h < part.surface.twin.size(); ++h)
        if (part.surface.twin[h] != no_twin && flat.surface.twin[h] == no_twin)
            opened[3 * static_cast<std::size_t>(part.faces[h / 3]) + h % 3] = 1;
}

/// The parts of a piece, flat.
void add_parts(const SurfacePiece& piece, const Vertices& vertices, const PartsOptions& options, PartsLayout& layout,
               std::vector<FlatPart>& flats, ExecutionContext& context)
{
    std::vector<Index> polygon;
    if (!options.polygon.empty())
        for (const Index f : piece.source_face) polygon.push_back(options.polygon[f]);
    CutSurface whole = cut_surface(vertices, piece.triangles, std::move(polygon));
    whole.slit = chosen_slits(piece, options.slits);
    SplitEffort effort;
    const SplitOptions prices{options.price, cut_share * options.price};
    std::vector<PartPointer> parts{whole_part(whole, context, effort)};
    for (int round = 0; round < rounds; ++round) {
        parts = split_parts(whole, prices, std::move(parts), context, effort);
        if (parts.size() == 1 || !merge_parts(whole, prices, parts, context, effort)) break;
    }
    const Mirror mirror = find_mirror(whole);
    make_symmetric(whole, prices, mirror, parts, context, effort);
    std::ranges::sort(parts, [](const PartPointer& a, const PartPointer& b) { return a->mesh.faces < b->mesh.faces; });
    layout.maps += effort.maps * static_cast<double>(piece.triangles.rows()) / static_cast<double>(layout.part.size());
    std::vector<char> opened(static_cast<std::size_t>(piece.triangles.size()), 0);
    for (const PartPointer& part : parts) {
        if (!mirror.image.empty() && part->map.kind == PartKind::tube)
            prefer_slits(part->mesh, mirrored_slits(whole, mirror, opened));
        FlatPart flat = flat_part(*part);
        note_slit(part->mesh, flat, opened);
        for (Index& f : flat.faces) f = piece.source_face[f];
        for (Index& v : flat.original) v = piece.source_vertex[v];
        for (VertexLoop& loop : flat.loops)
            for (Index& v : loop) v = piece.source_vertex[v];
        layout.slit_length += flat.slit;
        flats.push_back(std::move(flat));
    }
}

/// Whether a face of both has its vertices in the same cyclic order.
bool is_turn_of(const Triangles& a, const Triangles& b, Index f)
{
    for (int c = 0; c < 3; ++c)
        if (a(f, 0) == b(f, c)) return a(f, 1) == b(f, (c + 1) % 3);
    return false;
}

/// Left-out faces lie where the face is that they are like.
void place_left_out(const OpenedSurface& opened, PartsLayout& layout)
{
    for (const LeftOutFace& face : opened.left_out) {
        if (face.like < 0) continue;
        for (int k = 0; k < 3; ++k) {
            int corner = 0;
            for (int c = 0; c < 3; ++c)
                if (layout.triangles(face.like, c) == layout.triangles(face.face, k)) corner = c;
            layout.uv.row(3 * static_cast<Eigen::Index>(face.face) + k) =
                layout.uv.row(3 * static_cast<Eigen::Index>(face.like) + corner);
        }
    }
}

}  // namespace

PartsLayout parts_layout(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                         ExecutionContext& context)
{
    context.begin_stage("topology", 0.0, 0.05);
    const OpenedSurface opened = options.cut ? open_surface(vertices, triangles, {.polygon = options.polygon}, context)
                                             : strict_surface(vertices, triangles);
    PartsLayout layout;
    layout.vertices = of_area_one(vertices, triangles);
    layout.triangles = triangles;
    layout.uv = PlanarPoints::Zero(triangles.size(), 2);
    layout.part.assign(static_cast<std::size_t>(triangles.rows()), -1);
    layout.handles_cut = opened.handles;
    std::vector<FlatPart> flats;
    double share = 0.0;
    for (const SurfacePiece& piece : opened.pieces) {
        const double until =
            share + static_cast<double>(piece.triangles.rows()) / static_cast<double>(triangles.rows());
        context.begin_stage("split", 0.05 + 0.85 * share, 0.05 + 0.85 * until);
        share = until;
        add_parts(piece, layout.vertices(piece.source_vertex, Eigen::all), options, layout, flats, context);
    }
    context.begin_stage("pack", 0.9, 1.0);
    const std::vector<PlanarPoints> placed = packed(flats, context);
    for (std::size_t k = 0; k < flats.size(); ++k) {
        FlatPart& flat = flats[k];
        for (std::size_t i = 0; i < flat.faces.size(); ++i) {
            const Index f = flat.faces[i];
            const auto row = flat.surface.triangles.row(static_cast<Eigen::Index>(i));
            layout.part[f] = static_cast<Index>(k);
            if (!flat.one_to_one) layout.crossing.push_back(f);
            for (int c = 0; c < 3; ++c) {
                layout.triangles(f, c) = flat.original[row[c]];
                layout.uv.row(3 * static_cast<Eigen::Index>(f) + c) = placed[k].row(row[c]);
            }
            if (!is_turn_of(layout.triangles, triangles, f)) layout.reoriented.push_back(f);
        }
        layout.parts.push_back({flat.kind, std::move(flat.faces), std::move(flat.loops), 0.0});
    }
    std::ranges::sort(layout.reoriented);
    std::ranges::sort(layout.crossing);
    place_left_out(opened, layout);
    return layout;
}

}  // namespace koebe
