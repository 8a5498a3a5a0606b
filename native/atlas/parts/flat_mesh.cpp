#include "parts/flat_mesh.h"

#include "core/all_elements.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "core/grouping.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "cut/edge_runs.h"
#include "cut/open_surface.h"
#include "execution/stopwatch.h"
#include "flat/divided_faces.h"
#include "flat/straight_middles.h"
#include "parts/hard_surface.h"
#include "parts/mesh_parts.h"
#include "parts/sketched_cuts.h"
#include "splitting/closed_surface.h"
#include "splitting/pockets.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <unordered_set>
#include <utility>

namespace koebe {
namespace {

constexpr int most_divisions = 4;  // of faces, each without the edges that the ones before have torn

/// First into the unit cube, as areas of huge or tiny meshes are beyond the range of a double.
struct Sized {
    Vertices vertices;      ///< of area 1
    double length_of_unit;  ///< in the unit of the mesh
};

Sized of_area_one(const Vertices& vertices, const Triangles& triangles)
{
    const Eigen::RowVector3d low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
    const Eigen::RowVector3d middle = 0.5 * low + 0.5 * high;
    const double extent = (0.5 * high - 0.5 * low).maxCoeff();
    if (!(extent > 0.0))
        throw InputError("all vertices lie on one point", ElementKind::vertices, all_elements(vertices.rows()));
    const Vertices scaled = (vertices.rowwise() - middle) / extent;
    const double area = face_areas(scaled, triangles).sum();
    if (!(area > 0.0)) throw InputError("the surface has no area", ElementKind::faces, all_elements(triangles.rows()));
    return {scaled / std::sqrt(area), extent * std::sqrt(area)};
}

/// The mesh itself as one piece, if it can be mapped directly.
OpenedSurface strict_surface(const Vertices& vertices, const Triangles& triangles)
{
    validate_arrays(vertices, triangles);
    const Surface surface = require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows()));
    OpenedSurface opened;
    opened.pieces.push_back(whole_piece(vertices, surface.triangles));
    return opened;
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

/// The boundary edges of each piece that are cuts, because another boundary edge lies in the same place. One vertex of
/// the input stands for all vertices of a place.
class SeamPlaces {
public:
    SeamPlaces(const OpenedSurface& opened, const Vertices& vertices) : place_(first_in_place(vertices))
    {
        Triangles places(0, 3);
        Eigen::Index count = 0;
        for (const SurfacePiece& piece : opened.pieces) count += piece.triangles.rows();
        places.resize(count, 3);
        count = 0;
        for (const SurfacePiece& piece : opened.pieces)
            for (Eigen::Index f = 0; f < piece.triangles.rows(); ++f, ++count)
                for (int k = 0; k < 3; ++k) places(count, k) = place_[piece.source_vertex[piece.triangles(f, k)]];
        for_each_edge(places, static_cast<Index>(place_.size()), [&](std::span<const Index> halfedges) {
            if (halfedges.size() == 1) border_.insert(ends(origin(places, halfedges[0]), target(places, halfedges[0])));
        });
    }
    /// (3F) of a piece.
    std::vector<char> of(const SurfacePiece& piece) const
    {
        std::vector<char> seam(static_cast<std::size_t>(piece.triangles.size()), 0);
        const auto place = [&](Index v) { return place_[piece.source_vertex[v]]; };
        for (Index h = 0; h < static_cast<Index>(seam.size()); ++h)
            seam[h] = !border_.contains(ends(place(origin(piece.triangles, h)), place(target(piece.triangles, h))));
        return seam;
    }

private:
    static std::uint64_t ends(Index a, Index b)
    {
        return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
    }

    std::vector<Index> place_;  // (V) the first vertex in the same place
    std::unordered_set<std::uint64_t> border_;
};

std::vector<FlatPiece> mesh_pieces(OpenedSurface& opened, const Vertices& vertices, const std::vector<Index>& face,
                                   const PartsOptions& options)
{
    const SeamPlaces seams(opened, vertices);
    std::vector<FlatPiece> pieces;
    for (SurfacePiece& own : opened.pieces) {
        PieceInput input{std::move(own)};
        input.slit = chosen_slits(input.piece, options.slits);
        input.seam = seams.of(input.piece);
        input.piece.vertices = vertices(input.piece.source_vertex, Eigen::all);
        input.polygon = values_at(options.polygon, input.piece.source_face);
        input.face = values_at(face, input.piece.source_face);
        input.shown = cut_prices(options.show, input.piece.source_vertex);
        pieces.push_back({std::move(input)});
    }
    return pieces;
}

struct Pockets {
    CutEdges rims = {};           ///< by vertices of the input
    bool may_be_a_sheet = false;  ///< one of the surfaces that have them might lie flat as it is
};

/// The pockets of all pieces.
Pockets pockets_of(const std::vector<FlatPiece>& pieces)
{
    Pockets pockets;
    for (const FlatPiece& own : pieces) {
        const SurfacePiece& piece = own.input.piece;
        const CutSurface whole = whole_of(own.input);
        if (!(whole.areas.sum() > 2.0 * tuning::least_pocket)) continue;  // a pocket is less than half of its piece
        const auto rims = pocket_rims(whole);
        for (const auto& [a, b] : rims) pockets.rims.push_back({piece.source_vertex[a], piece.source_vertex[b]});
        pockets.may_be_a_sheet |= !rims.empty() && !is_nearly_closed(whole);
    }
    return pockets;
}

/// @param kept gets the edges that must not be divided @param pockets gets the pockets; null: nobody asks for them
/// @return no value if edges must be kept, or pockets be cut off
std::optional<FlatMesh> flat_mesh_of(DividedFaces faces, const Vertices& vertices, const Triangles& undivided,
                                     const PartsOptions& given, std::vector<std::array<Index, 2>>& kept,
                                     Pockets* pockets, ExecutionContext& context)
{
    Stopwatch stage;
    context.begin_stage("topology", 0.0, 0.05);
    const Triangles& triangles = faces.triangles;
    PartsOptions options = given;
    options.polygon = faces.polygon;
    const bool hard_first = options.cut && may_unfold(options);
    const OpenOptions opening{
        .polygon = options.polygon, .seams = options.cuts, .slit_beside_handles = false, .open = !hard_first};
    OpenedSurface opened =
        options.cut ? open_surface(vertices, triangles, opening, context) : strict_surface(vertices, triangles);
    // Flat and rolled regions of hard surfaces first.
    FlatMesh mesh;
    PartsLayout& layout = mesh.layout;
    layout.vertices = of_area_one(vertices, triangles).vertices;
    layout.triangles = triangles;
    std::vector<FlatPart> hard;
    if (hard_first) {
        HardSurfaces found =
            opened_without_hard_parts(vertices, faces, layout.vertices, std::move(opened), options, context);
        hard = std::move(found.parts);
        opened = std::move(found.rest);
        layout.noise = found.noise;
    }
    if (options.sketch) {
        options.sketch = [around = boundaries_of(hard), &given](CutEdges edges) {
            edges.insert(edges.end(), around.begin(), around.end());
            given.sketch(repeated(std::move(edges)));
        };
        if (!hard.empty()) options.sketch({});
    }
    // Pieces of divided faces must be able to become whole again.
    const std::size_t given_edges = kept.size();
    const auto keep_bent = [&](std::vector<FlatPart>& parts) {
        if (faces.face.empty()) return false;
        for (const auto& edge : lay_middles_straight(faces, opened.left_out, parts)) kept.push_back(edge);
        return kept.size() > given_edges;
    };
    if (keep_bent(hard)) return {};
    mesh.polygon = options.polygon;
    layout.handles_cut = opened.handles;
    // Then the parts of the other pieces. With importance hard parts are stretched, too.
    std::vector<FlatPiece> pieces = mesh_pieces(opened, layout.vertices, faces.face, options);
    if (pockets) *pockets = pockets_of(pieces);
    if (pockets && !pockets->rims.empty() && !pockets->may_be_a_sheet) return {};
    if (!hard.empty() && !options.importance.empty())
        pieces.push_back({{whole_piece(layout.vertices, triangles)}, std::exchange(hard, {})});
    mesh.seconds.topology = stage.lap();
    const bool only_uncut = pockets && !pockets->rims.empty();
    std::optional<MeshParts> parts = mesh_parts(std::move(pieces), options, only_uncut, context);
    if (!parts) return {};
    mesh.seconds.iterate = stage.lap();
    layout.even = parts->even;
    layout.not_even = std::move(parts->not_even);
    layout.maps = parts->maps;
    mesh.parts = std::move(parts->parts);
    if (keep_bent(mesh.parts)) return {};
    std::ranges::move(hard, std::back_inserter(mesh.parts));  // they are exact: nothing relaxes or cuts them
    sum_cuts(mesh);
    mesh.left_out = std::move(opened.left_out);
    if (!faces.face.empty()) mesh.undivided = undivided;
    mesh.divided = std::move(faces);
    return mesh;
}

}  // namespace

std::vector<Index> first_in_place(const Vertices& vertices)
{
    return lowest_alike(vertices.rows(), [&](Index v) {
        return std::array{vertices(v, 0), vertices(v, 1), vertices(v, 2)};
    });
}

double root_of_area(const Vertices& vertices, const Triangles& triangles)
{
    return of_area_one(vertices, triangles).length_of_unit;
}

FlatMesh flat_mesh(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                   ExecutionContext& context)
{
    // Faces of flat regions may be laid flat in pieces, so that cracks without width separate nothing.
    std::vector<std::array<Index, 2>> kept = options.cuts;
    const bool may_divide = options.cut && may_unfold(options) && options.importance.empty();
    for (int attempt = 0; may_divide && attempt < most_divisions; ++attempt) {
        DividedFaces divided = divided_faces(vertices, triangles, options.polygon, kept);
        if (divided.face.empty()) break;
        if (attempt == 0) of_area_one(vertices, triangles);  // an error names faces of the input
        if (std::optional<FlatMesh> mesh =
                flat_mesh_of(std::move(divided), vertices, triangles, options, kept, nullptr, context))
            return std::move(*mesh);
    }

    // Pockets become pieces of their own, but a sheet that lies flat without a cut gets none.
    const DividedFaces undivided{triangles, options.polygon, {}, {}};
    Pockets pockets;
    const bool may_have_pockets = options.cut && rims_are_free(options);
    std::optional<FlatMesh> mesh =
        flat_mesh_of(undivided, vertices, triangles, options, kept, may_have_pockets ? &pockets : nullptr, context);
    const bool is_uncut = mesh && mesh->parts.size() == 1 && !mesh->parts.front().is_cut_open();
    if (mesh && (pockets.rims.empty() || is_uncut)) return std::move(*mesh);
    PartsOptions cut = options;
    cut.cuts.insert(cut.cuts.end(), pockets.rims.begin(), pockets.rims.end());
    return *flat_mesh_of(undivided, vertices, triangles, cut, kept, nullptr, context);
}

}  // namespace koebe
