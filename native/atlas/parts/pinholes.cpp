#include "parts/pinholes.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "darts/darts.h"
#include "darts/tension.h"
#include "darts/through_cuts.h"
#include "holes/fan_filling.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace koebe {
namespace {

constexpr double longest_rim = 0.12;   // of a pinhole, over the root of the mesh's area: the eye of a mask has 0.15
constexpr double thinnest_fan = 1e-3;  // least area of a face that fills, over the square of its edge on the rim

/// Whether no face between a rim's edges and the middle of the rim is too thin.
bool can_be_filled(const Vertices& rim, const VectorXd& edges)
{
    const SurfacePatch fan = fill_on_surface(rim);
    return (face_areas(fan.vertices, fan.triangles).array() > thinnest_fan * edges.array().square()).all();
}

/// The ranks of the loops to fill.
std::vector<Index> pinholes(const PieceInput& input, const Surface& surface)
{
    const Vertices& vertices = input.piece.vertices;
    std::vector<char> at_cut(static_cast<std::size_t>(surface.vertex_count), 0);
    if (!input.seam.empty())
        for (Index h = 0; h < static_cast<Index>(surface.twin.size()); ++h)
            if (surface.twin[h] == no_twin && input.seam[h]) at_cut[origin(surface.triangles, h)] = 1;
    const Index longest = longest_loop(vertices, surface);
    std::vector<Index> found;
    for (Index k = 0; k < static_cast<Index>(surface.loops.size()); ++k) {
        const VertexLoop& loop = surface.loops[k];
        const VectorXd edges = loop_edges(vertices, loop);
        if (k != longest && edges.sum() < longest_rim && can_be_filled(vertices(loop, Eigen::all), edges) &&
            std::ranges::none_of(loop, [&](Index v) { return at_cut[v]; }))
            found.push_back(k);
    }
    return found;
}

/// Draws corners apart that met only across a filled pinhole. @param source (V) the vertex that each was
void draw_corners_apart(const std::vector<Index>& source, FlatPart& piece)
{
    std::vector<Index> sorted = source;
    std::ranges::sort(sorted);
    std::vector<char> moves;
    for (const Index v : source) {
        const auto next = std::next(std::ranges::lower_bound(sorted, v));
        moves.push_back(next != sorted.end() && *next == v);
    }
    if (std::ranges::count(moves, 1) > 0) draw_apart(piece, moves);
}

}  // namespace

std::optional<PieceInput> without_pinholes(const PieceInput& input, const Surface& surface)
{
    const std::vector<Index> ranks = pinholes(input, surface);
    if (ranks.empty()) return {};
    PieceInput filled = input;
    filled.face.clear();
    SurfacePiece& piece = filled.piece;
    // A fan in each pinhole: a vertex and as many faces as the rim has edges.
    FilledSurface fans = fill_holes(piece.vertices, piece.triangles, ranks);
    const auto added = static_cast<std::size_t>(fans.triangles.rows() - piece.triangles.rows());
    piece.vertices = std::move(fans.vertices);
    piece.triangles = std::move(fans.triangles);
    piece.source_face.resize(piece.source_face.size() + added, -1);
    piece.turned.resize(piece.turned.size() + added, 0);
    // New faces have no source. A hub has that of a vertex beside it.
    for (const Index k : ranks) {
        const Index beside = surface.loops[k].front();
        piece.source_vertex.push_back(piece.source_vertex[beside]);
        if (!input.shown.empty()) filled.shown.push_back(input.shown[beside]);
    }
    if (!input.polygon.empty()) {
        Index next = *std::ranges::max_element(input.polygon);
        for (std::size_t f = 0; f < added; ++f) filled.polygon.push_back(++next);
    }
    for (std::vector<char>* marks : {&filled.slit, &filled.seam})
        if (!marks->empty()) marks->resize(marks->size() + 3 * added, 0);
    return filled;
}

std::vector<FlatPart> with_pinholes(FlatPart part, Index faces)
{
    const auto fills = [&](Index h) { return part.faces[face_of(h)] >= faces; };
    std::vector<FlatPart> pieces;
    if (std::ranges::all_of(part.faces, [&](Index f) { return f < faces; })) {
        pieces.push_back(std::move(part));
        return pieces;
    }
    // Cut the fans out.
    SeamedMesh mesh = seamed(part);
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
        if (mesh.twin[h] != no_twin && fills(h) != fills(mesh.twin[h])) mesh.cut(h);
    for (const SeamedMesh& own : connected_parts(mesh)) {
        if (part.faces[own.face.front()] >= faces) continue;
        // Each piece keeps what the part is. Corners that met only across a fan are drawn apart.
        const std::vector<Index> source = vertices_of_fans(own);
        std::optional<FlatPart> piece = opened_piece(part, own.face, own.fans, source);
        if (!piece) throw SolverError("a part is no surface any more with its pinholes");
        piece->kind = part.kind;
        piece->up = part.up;
        piece->along_axes = part.along_axes;
        piece->has_copy = part.has_copy;
        piece->one_to_one = part.one_to_one;
        piece->is_near = part.is_near;
        for (std::size_t v = 0; v < source.size(); ++v)
            if (std::ranges::count(part.tips, source[v]) > 0) piece->tips.push_back(static_cast<Index>(v));
        draw_corners_apart(source, *piece);
        pieces.push_back(std::move(*piece));
    }
    if (!pieces.empty()) {
        pieces.front().slit = part.slit;
        pieces.front().dart_length = part.dart_length;
    }
    return pieces;
}

}  // namespace koebe
