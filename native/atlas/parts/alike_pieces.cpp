#include "parts/alike_pieces.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "cut/disjoint_sets.h"
#include "flat/congruence.h"
#include "mesh/topology.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double shorter = 1.0 - 1e-6;  // outlines over those of another piece: rounding does not choose

/// A piece of the mesh: the faces of parts that share vertices, as one surface without places.
struct Piece {
    FlatPart whole;  ///< no half-edge table: it is no manifold
    std::vector<std::size_t> parts;
    double outlines = 0.0;  ///< length of the parts' outlines
};

std::vector<Piece> pieces_in(const FlatMesh& mesh)
{
    // Parts are joined by their vertices.
    DisjointSets sets(mesh.parts.size());
    std::vector<Index> part_at(static_cast<std::size_t>(mesh.layout.vertices.rows()), -1);
    for (std::size_t k = 0; k < mesh.parts.size(); ++k)
        for (const Index v : mesh.parts[k].original) {
            if (part_at[v] >= 0) sets.join(static_cast<Index>(k), part_at[v]);
            part_at[v] = static_cast<Index>(k);
        }
    std::vector<Piece> pieces;
    std::vector<Index> piece_of(mesh.parts.size(), -1);  // by the set
    for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
        Index& own = piece_of[sets.find(static_cast<Index>(k))];
        if (own < 0) {
            own = static_cast<Index>(pieces.size());
            pieces.emplace_back();
        }
        pieces[own].parts.push_back(k);
    }
    // The surface of each piece, its faces in the order of the mesh.
    for (Piece& piece : pieces) {
        FlatPart& whole = piece.whole;
        std::vector<std::pair<Index, std::array<Index, 3>>> faces;
        for (const std::size_t k : piece.parts) {
            const FlatPart& part = mesh.parts[k];
            for (std::size_t i = 0; i < part.faces.size(); ++i) {
                const auto corner = [&](int c) {
                    return part.original[part.surface.triangles(static_cast<Index>(i), c)];
                };
                faces.push_back({part.faces[i], {corner(0), corner(1), corner(2)}});
            }
            for (const VertexLoop& loop : part.surface.loops)
                for (std::size_t i = 0; i < loop.size(); ++i)
                    piece.outlines +=
                        (part.vertices.row(loop[i]) - part.vertices.row(loop[(i + 1) % loop.size()])).norm();
        }
        std::ranges::sort(faces);
        for (const auto& [face, corners] : faces)
            whole.original.insert(whole.original.end(), corners.begin(), corners.end());
        sort_unique(whole.original);
        whole.vertices = mesh.layout.vertices(whole.original, Eigen::all);
        whole.surface.triangles.resize(static_cast<Index>(faces.size()), 3);
        for (std::size_t i = 0; i < faces.size(); ++i) {
            whole.faces.push_back(faces[i].first);
            for (int c = 0; c < 3; ++c)
                whole.surface.triangles(static_cast<Index>(i), c) = static_cast<Index>(
                    std::ranges::lower_bound(whole.original, faces[i].second[c]) - whole.original.begin());
        }
        try {
            whole.surface.twin = pair_halfedges(whole.surface.triangles, static_cast<Index>(whole.original.size()));
        } catch (const TopologyError&) {  // an edge of more than two faces: the piece has no copies
        }
    }
    return pieces;
}

/// The face of the other piece for each face of the mesh in this piece; empty if faces or polygons do not correspond.
std::map<Index, Index> faces_of_twin(const Piece& piece, const Piece& other, const Twin& twin,
                                     const std::vector<Index>& polygon)
{
    const auto key = [](std::array<Index, 3> corners) {
        std::ranges::sort(corners);
        return corners;
    };
    // The other piece's faces by their corners, in any order.
    std::map<std::array<Index, 3>, Index> there;
    for (Index f = 0; f < static_cast<Index>(other.whole.faces.size()); ++f) {
        const auto row = other.whole.surface.triangles.row(f);
        there[key({row[0], row[1], row[2]})] = other.whole.faces[f];
    }
    // Each face has an image, and polygons go to polygons one to one.
    std::map<Index, Index> face, polygon_there, polygon_here;
    for (Index f = 0; f < static_cast<Index>(piece.whole.faces.size()); ++f) {
        const auto row = piece.whole.surface.triangles.row(f);
        const auto found = there.find(key({twin.vertex[row[0]], twin.vertex[row[1]], twin.vertex[row[2]]}));
        if (found == there.end()) return {};
        const Index own = piece.whole.faces[f];
        face[own] = found->second;
        if (polygon.empty()) continue;
        const Index a = polygon[own], b = polygon[found->second];
        if (polygon_there.try_emplace(a, b).first->second != b || polygon_here.try_emplace(b, a).first->second != a)
            return {};
    }
    if (there.size() != face.size()) return {};
    return face;
}

/// A part with the numbers and vertices of a copy of its piece. @param vertex, face of the mesh, by the part's own
FlatPart copied(const FlatPart& part, const std::map<Index, Index>& vertex, const std::map<Index, Index>& face,
                bool mirrored, const FlatMesh& mesh)
{
    FlatPart copy = part;
    for (Index& f : copy.faces) f = face.at(f);
    const auto name = [&](std::vector<Index>& vertices) {
        for (Index& v : vertices) v = vertex.at(v);
    };
    name(copy.original);
    name(copy.image);
    for (VertexLoop& loop : copy.loops) name(loop);
    copy.vertices = mesh.layout.vertices(copy.original, Eigen::all);
    if (!mirrored) return copy;
    copy.points.col(0) *= -1.0;
    copy.surface.triangles.col(1).swap(copy.surface.triangles.col(2));
    copy.surface = analyze_surface(copy.surface.triangles, copy.surface.vertex_count);
    for (VertexLoop& loop : copy.loops) std::reverse(loop.begin() + 1, loop.end());
    return copy;
}

}  // namespace

void cut_alike(FlatMesh& mesh)
{
    const std::vector<Piece> pieces = pieces_in(mesh);
    if (pieces.size() < 2) return;
    std::vector<const FlatPart*> wholes;
    std::vector<Index> polygon;
    for (const Piece& piece : pieces) wholes.push_back(&piece.whole);
    for (const FlatPart& part : mesh.parts)
        for (std::size_t i = 0; i < part.polygon.size(); ++i) {
            polygon.resize(static_cast<std::size_t>(mesh.layout.triangles.rows()), -1);
            polygon[part.faces[i]] = part.polygon[i];
        }
    std::vector<std::map<Index, Index>> faces(pieces.size());  // by the faces of a piece, of the piece that it is like
    const auto is_usable = [&](std::size_t k) { return !pieces[k].whole.surface.twin.empty(); };
    const auto accepts = [&](std::size_t k, std::size_t other, const Twin& twin) {
        faces[k] = faces_of_twin(pieces[k], pieces[other], twin, polygon);
        return !faces[k].empty();
    };
    const std::vector<std::optional<Twin>> twins = congruent_parts(wholes, true, is_usable, accepts);
    // In each class the piece with the shortest outlines is the model.
    std::vector<std::size_t> model = numbers_below<std::size_t>(pieces.size());
    for (std::size_t k = 0; k < pieces.size(); ++k)
        if (twins[k] && pieces[k].outlines < shorter * pieces[model[twins[k]->of]].outlines) model[twins[k]->of] = k;
    std::vector<std::vector<FlatPart>> anew(mesh.parts.size());  // parts of a piece, at its first part
    std::set<Index> not_even(mesh.layout.not_even.begin(), mesh.layout.not_even.end());
    std::vector<char> replaced(mesh.parts.size(), 0);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const std::size_t first = twins[k] ? twins[k]->of : k, like = model[first];
        if (like == k) continue;
        // From the model to the first piece of the class, and on to this one.
        const auto to_first = [&](std::size_t piece, Index i) { return twins[piece] ? twins[piece]->vertex[i] : i; };
        std::map<Index, Index> vertex, face, of_first;
        for (Index i = 0; i < static_cast<Index>(pieces[k].whole.original.size()); ++i)
            of_first[to_first(k, i)] = pieces[k].whole.original[i];
        for (Index i = 0; i < static_cast<Index>(pieces[like].whole.original.size()); ++i)
            vertex[pieces[like].whole.original[i]] = of_first.at(to_first(like, i));
        std::map<Index, Index> face_of_first;
        const auto face_to_first = [&](std::size_t piece, Index f) { return twins[piece] ? faces[piece].at(f) : f; };
        for (const Index f : pieces[k].whole.faces) face_of_first[face_to_first(k, f)] = f;
        for (const Index f : pieces[like].whole.faces) face[f] = face_of_first.at(face_to_first(like, f));
        const bool mirrored = (twins[k] && twins[k]->mirrored) != (twins[like] && twins[like]->mirrored);
        for (const std::size_t part : pieces[like].parts) {
            FlatPart copy = copied(mesh.parts[part], vertex, face, mirrored, mesh);
            if (!polygon.empty())
                for (std::size_t i = 0; i < copy.faces.size(); ++i) copy.polygon[i] = polygon[copy.faces[i]];
            anew[pieces[k].parts.front()].push_back(std::move(copy));
        }
        for (const auto& [from, to] : face)
            not_even.contains(from) ? (void)not_even.insert(to) : (void)not_even.erase(to);
        for (const std::size_t part : pieces[k].parts) replaced[part] = 1;
    }
    std::vector<FlatPart> parts;
    for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
        if (!replaced[k]) parts.push_back(std::move(mesh.parts[k]));
        std::ranges::move(anew[k], std::back_inserter(parts));
    }
    mesh.parts = std::move(parts);
    mesh.layout.not_even.assign(not_even.begin(), not_even.end());
    sum_cuts(mesh);
}

}  // namespace koebe
