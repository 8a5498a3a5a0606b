#include "parts/pinholes.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/length.h"
#include "parts/darts.h"
#include "parts/tension.h"
#include "parts/through_cuts.h"
#include "surface/loop_edges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

namespace koebe {
namespace {

constexpr double longest_rim = 0.12;   // of a pinhole, over the root of the mesh's area: the eye of a mask has 0.15
constexpr double thinnest_fan = 1e-3;  // least area of a face that fills, over the square of its edge on the rim

/// The middle of a rim, if faces between it and the rim's edges are not too thin.
std::optional<Eigen::RowVector3d> middle_of(const Vertices& vertices, const VertexLoop& rim)
{
    const Eigen::RowVector3d middle = vertices(rim, Eigen::all).colwise().mean();
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const Eigen::RowVector3d a = vertices.row(rim[i]), b = vertices.row(rim[(i + 1) % rim.size()]);
        if (!(0.5 * length_of((a - middle).cross(b - middle)) > thinnest_fan * (b - a).squaredNorm())) return {};
    }
    return middle;
}

/// The loops to fill.
std::vector<const VertexLoop*> pinholes(const PieceInput& input, const Surface& surface)
{
    std::vector<char> at_cut(static_cast<std::size_t>(surface.vertex_count), 0);
    if (!input.seam.empty())
        for (Index h = 0; h < static_cast<Index>(surface.twin.size()); ++h)
            if (surface.twin[h] == no_twin && input.seam[h]) at_cut[origin(surface.triangles, h)] = 1;
    std::vector<const VertexLoop*> found;
    const VertexLoop* longest = nullptr;
    double most = 0.0;
    for (const VertexLoop& loop : surface.loops) {
        const double length = loop_edges(input.piece.vertices, loop).sum();
        if (!(length <= most)) {
            most = length;
            longest = &loop;
        }
        if (loop.size() >= 3 && length < longest_rim && std::ranges::none_of(loop, [&](Index v) { return at_cut[v]; }))
            found.push_back(&loop);
    }
    std::erase(found, longest);
    return found;
}

/// Draws corners apart that met only across a filled pinhole. @param source (V) the vertex that each was
void draw_corners_apart(const std::vector<Index>& source, FlatPart& piece)
{
    std::vector<Index> sorted = source;
    std::ranges::sort(sorted);
    std::vector<char> moves;
    for (const Index v : source) {
        const auto same = std::ranges::equal_range(sorted, v);
        moves.push_back(same.size() > 1);
    }
    if (std::ranges::count(moves, 1) > 0) draw_apart(piece, moves);
}

}  // namespace

std::optional<PieceInput> without_pinholes(const PieceInput& input, const Surface& surface)
{
    std::vector<std::array<Index, 3>> faces;
    PieceInput filled = input;
    SurfacePiece& piece = filled.piece;
    std::vector<Eigen::RowVector3d> middles;
    for (const VertexLoop* rim : pinholes(input, surface)) {
        const auto middle = middle_of(input.piece.vertices, *rim);
        if (!middle) continue;
        const Index own = static_cast<Index>(input.piece.vertices.rows()) + static_cast<Index>(middles.size());
        middles.push_back(*middle);
        piece.source_vertex.push_back(piece.source_vertex[rim->front()]);
        if (!input.shown.empty()) filled.shown.push_back(input.shown[rim->front()]);
        for (std::size_t i = 0; i < rim->size(); ++i) faces.push_back({(*rim)[(i + 1) % rim->size()], (*rim)[i], own});
    }
    if (middles.empty()) return {};
    const Eigen::Index first_vertex = piece.vertices.rows(), first_face = piece.triangles.rows();
    const auto count = static_cast<Eigen::Index>(faces.size());
    piece.vertices.conservativeResize(first_vertex + static_cast<Eigen::Index>(middles.size()), 3);
    for (std::size_t i = 0; i < middles.size(); ++i)
        piece.vertices.row(first_vertex + static_cast<Eigen::Index>(i)) = middles[i];
    piece.triangles.conservativeResize(first_face + count, 3);
    for (Eigen::Index f = 0; f < count; ++f)
        for (int k = 0; k < 3; ++k) piece.triangles(first_face + f, k) = faces[static_cast<std::size_t>(f)][k];
    piece.source_face.resize(piece.source_face.size() + faces.size(), -1);
    piece.turned.resize(piece.turned.size() + faces.size(), 0);
    if (!input.polygon.empty()) {
        Index next = *std::ranges::max_element(input.polygon);
        for (std::size_t f = 0; f < faces.size(); ++f) filled.polygon.push_back(++next);
    }
    for (std::vector<char>* marks : {&filled.slit, &filled.seam})
        if (!marks->empty()) marks->resize(marks->size() + 3 * faces.size(), 0);
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
    SeamedMesh mesh = seamed(part);
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
        if (mesh.twin[h] != no_twin && fills(h) != fills(mesh.twin[h])) mesh.cut(h);
    for (const SeamedMesh& own : connected_parts(mesh)) {
        if (part.faces[own.face.front()] >= faces) continue;
        std::vector<Index> source(static_cast<std::size_t>(own.fan_count));
        for (Eigen::Index c = 0; c < own.fans.size(); ++c) source[own.fans.data()[c]] = own.corners.data()[c];
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
