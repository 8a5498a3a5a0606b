#include "parts/flat_mesh.h"

#include "core/all_elements.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "cut/edge_runs.h"
#include "cut/open_surface.h"
#include "execution/side_by_side.h"
#include "parts/even_parts.h"
#include "parts/flat_parts.h"
#include "parts/hard_surface.h"
#include "parts/unfolding.h"
#include "splitting/closed_surface.h"
#include "splitting/coarse_surface.h"
#include "splitting/fine_labels.h"
#include "splitting/hidden_cuts.h"
#include "splitting/splitting.h"
#include "surface/importance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <unordered_set>
#include <utility>

namespace koebe {
namespace {

constexpr double own_piece = 0.25;         // of the area: in a smaller piece parts cost less,
constexpr double small_piece = 0.01;       // and below this in proportion to the piece's area
constexpr int rounds = 2;                  // of splitting and merging
constexpr double eager = 0.37;             // of the prices: parts are split at these, and merged at the whole prices
constexpr double price_like_cut = 0.0037;  // at which a split of a flat part costs as a cut as long as the root
constexpr double vain = 0.9;               // of the overflow: cuts that leave more are in vain
constexpr Eigen::Index large = 100000;     // faces: from there on the parts are decided on a coarse surface
constexpr Index coarse_faces = 40000;
constexpr double few_cuts = 3.6;  // roots of a piece's area: a piece unfolded with fewer is not tried otherwise

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

double overflow_of(const std::vector<PartPointer>& parts)
{
    double sum = 0.0;
    for (const PartPointer& part : parts) sum += part->map.overflow;
    return sum;
}

/// Splits and merges parts, and maps them. A cut that pays only together with later cuts is found at lower prices;
/// merging takes back what did not pay in the end. The parts stay as they were if cuts bring next to nothing, for
/// example between many tight holes. @param first faces of the first parts; empty: one part with all faces
std::vector<PartPointer> even_parts(const CutSurface& whole, std::vector<std::vector<Index>> first,
                                    const SplitOptions& options, ExecutionContext& context, SplitEffort& effort)
{
    std::vector<PartPointer> uncut = first_parts(whole, std::move(first), context, effort);
    std::vector<PartPointer> parts = uncut;
    const SplitOptions eagerly{eager * options.part_price, eager * options.cut_price, options.threads};
    RefusedMerges refused;
    for (int round = 0; round < rounds; ++round) {
        parts = split_parts(whole, eagerly, std::move(parts), context, effort);
        if (parts.size() > uncut.size() && overflow_of(parts) > vain * overflow_of(uncut)) return uncut;
        if (parts.size() == 1 || !merge_parts(whole, options, parts, refused, context, effort)) break;
    }
    merge_crumbs(whole, options, parts, context, effort);
    return parts;
}

/// Decides the parts of a large surface on a coarse surface. @return empty if it is closed and stays whole
std::vector<PartPointer> parts_by_coarse_surface(const CutSurface& whole, const SplitOptions& options,
                                                 ExecutionContext& context, SplitEffort& effort)
{
    const CoarseSurface coarse = coarse_surface(whole.vertices, whole.surface.triangles, coarse_faces, {}, context);
    const bool is_closed = whole.surface.loops.empty();
    const CutSurface surface =
        cut_surface(coarse.vertices, analyze_surface(coarse.triangles, static_cast<Index>(coarse.vertices.rows())), {});
    std::vector<int> label(coarse.face.size(), 0);
    int count = 0;
    std::vector<std::vector<Index>> first;
    if (is_closed) {
        first = halves(surface);
        if (first.empty()) return {};
    }
    std::vector<PartPointer> coarse_parts = even_parts(surface, std::move(first), options, context, effort);

    for (const PartPointer& part : coarse_parts) {
        for (const Index f : part->mesh.faces) label[f] = count;
        ++count;
    }
    std::vector<std::vector<Index>> faces(count);
    const std::vector<int> fine = fine_labels(whole, coarse, label, count, context);
    for (std::size_t f = 0; f < fine.size(); ++f) faces[fine[f]].push_back(static_cast<Index>(f));
    std::erase_if(faces, [](const auto& own) { return own.empty(); });
    if (is_closed && faces.size() < 2) return {};
    std::vector<PartPointer> parts;
    for (auto& own : faces) parts.push_back(std::make_shared<Part>(Part{part_mesh(whole, std::move(own)), {}, {}}));
    return parts;
}

struct FlatPiece {
    std::vector<FlatPart> parts;  ///< by numbers of the piece's mesh
    double maps = 0.0;            ///< faces mapped
};

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

/// The prices in a piece. The price is for the whole surface: with it a small piece would never be split, even if it
/// lost all its faces. Lengths of cuts are in roots of the whole's area, so cuts of a small piece are short.
/// @param area of the piece; that of the whole is 1
SplitOptions prices_for(double area, double price, int threads)
{
    const double share = area < small_piece ? std::sqrt(small_piece / own_piece) * area / small_piece
                                            : std::min(1.0, std::sqrt(area / own_piece));
    return {share * price, std::min(1.0, share / std::sqrt(area)) * price, threads};
}

EvenOptions evening_of(const PartsOptions& options, bool roomy, int threads)
{
    const bool round = options.loops == LoopForm::round || (options.loops == LoopForm::automatic && options.round_cuts);
    return {options.even,  round ? LoopForm::round : LoopForm::free,
            options.darts, options.price / price_like_cut,
            roomy,         threads};
}

/// Whether a piece may be unfolded true to size: E is not 0, and neither round loops nor slits are asked for.
bool may_unfold(const PartsOptions& options)
{
    return options.even != 0.0 && options.darts > 0.0 && !options.round_cuts && options.loops != LoopForm::round &&
           options.slits.empty();
}

/// The parts of a piece, flat.
FlatPiece flat_piece(const SurfacePiece& piece, const Vertices& vertices, const SeamPlaces& seams,
                     const PartsOptions& options, int threads, ExecutionContext& context)
{
    std::vector<Index> polygon;
    if (!options.polygon.empty())
        for (const Index f : piece.source_face) polygon.push_back(options.polygon[f]);
    const bool is_large = piece.triangles.rows() > large;
    const Vertices own = vertices(piece.source_vertex, Eigen::all);
    std::vector<double> shown;
    if (!options.show.empty())
        for (const Index v : piece.source_vertex) shown.push_back(options.show[v]);
    std::optional<CutSurface> closed = closed_surface(piece, own, polygon);
    std::vector<std::vector<Index>> first;
    if (closed) closed->shown = shown;
    if (closed && !is_large) first = halves(*closed);
    const bool stays_closed = closed && (is_large || !first.empty());
    const auto opened = [&] { return cut_surface(own, piece.triangles, polygon); };
    CutSurface whole = stays_closed ? *std::exchange(closed, std::nullopt) : opened();
    whole.slit = chosen_slits(piece, options.slits);
    whole.seam = seams.of(piece);
    whole.shown = shown;
    std::optional<UnfoldedParts> true_to_size;
    if (may_unfold(options) && !is_large) true_to_size = unfolded(whole, context);
    const auto take_unfolded = [&] {
        name_by_input(piece, options.show, true_to_size->parts);
        return FlatPiece{std::move(true_to_size->parts), 0.0};
    };
    if (true_to_size && true_to_size->cut_length <= few_cuts * std::sqrt(whole.areas.sum())) return take_unfolded();
    SplitEffort effort;
    const SplitOptions prices = prices_for(whole.areas.sum(), options.price, threads);
    std::vector<PartPointer> parts = is_large ? parts_by_coarse_surface(whole, prices, context, effort)
                                              : even_parts(whole, std::move(first), prices, context, effort);
    if (parts.empty()) {  // no curve cuts it in two
        const CutSurface before = std::exchange(whole, opened());
        whole.slit = before.slit;
        whole.seam = before.seam;
        whole.shown = shown;
        parts = parts_by_coarse_surface(whole, prices, context, effort);
    }
    const Mirror mirror = is_large ? Mirror{} : find_mirror(whole.vertices, whole.surface.triangles, whole.polygon);
    const bool is_symmetric = make_symmetric(whole, prices, mirror, parts, context, effort);
    if (!is_large) {
        const std::vector<PartPointer> before = parts;
        hide_cuts(whole, prices, parts, context, effort);
        if (is_symmetric && !make_symmetric(whole, prices, mirror, parts, context, effort)) parts = before;
        merge_crumbs(whole, prices, parts, context, effort);
    }
    std::ranges::sort(parts, [](const PartPointer& a, const PartPointer& b) { return a->mesh.faces < b->mesh.faces; });
    std::shared_ptr<const Part> root = parts.front();
    while (root->parent) root = root->parent;
    if (root->mesh.faces.size() != static_cast<std::size_t>(whole.areas.size())) root = nullptr;
    const bool is_cut = parts.size() > 1;
    FlatParts flats = flat_parts(whole, mirror, parts, {prices.cut_price, prices.part_price, options.round_cuts},
                                 threads, context, effort);
    // A part that was cut for its flaws has been tried as one part.
    if (!is_large && (is_cut || flats.parts.size() == 1))
        if (auto one = better_as_one(stays_closed ? opened() : whole, root.get(), flats, prices.part_price, context)) {
            flats.parts.clear();
            flats.parts.push_back(std::move(*one));
        }
    if (true_to_size) {
        const EvenOptions evening = evening_of(options, false, threads);
        if (cost_when_even(true_to_size->parts, evening, context) <= cost_when_even(flats.parts, evening, context))
            return take_unfolded();
    }
    FlatPiece flat{std::move(flats.parts), 0.0};
    flat.maps = effort.maps * static_cast<double>(piece.triangles.rows());
    if (!mirror.vertex.empty())
        for (FlatPart& part : flat.parts)
            for (const Index v : part.original) part.image.push_back(piece.source_vertex[mirror.vertex[v]]);
    name_by_input(piece, options.show, flat.parts);
    return flat;
}

/// Large pieces one after the other on all threads, the others side by side.
std::vector<FlatPiece> flat_pieces(const OpenedSurface& opened, const Vertices& vertices, const PartsOptions& options,
                                   ExecutionContext& context)
{
    Eigen::Index total = 0;
    if (opened.pieces.empty()) return {};
    for (const SurfacePiece& piece : opened.pieces) total += piece.triangles.rows();
    std::vector<std::size_t> small, big;
    for (std::size_t i = 0; i < opened.pieces.size(); ++i)
        (8 * opened.pieces[i].triangles.rows() > total ? big : small).push_back(i);
    std::vector<FlatPiece> flats(opened.pieces.size());
    const SeamPlaces seams(opened, vertices);
    double done = 0.0;
    const auto stage = [&](double faces) {
        const double from = done;
        done = std::min(1.0, done + faces / static_cast<double>(total));
        context.begin_stage("split", 0.05 + 0.75 * from, 0.05 + 0.75 * done);
    };
    for (const std::size_t i : big) {
        stage(static_cast<double>(opened.pieces[i].triangles.rows()));
        flats[i] = flat_piece(opened.pieces[i], vertices, seams, options, options.threads, context);
    }
    stage(static_cast<double>(total));
    side_by_side(small.size(), options.threads, context, [&](std::size_t k, ExecutionContext& own) {
        flats[small[k]] = flat_piece(opened.pieces[small[k]], vertices, seams, options, 1, own);
    });
    return flats;
}

/// Tells faces how large they should be, and scales each part to the sum of its faces.
void ask_for_sizes(const PartsLayout& layout, const std::vector<double>& importance, std::vector<FlatPart>& parts)
{
    const Eigen::Map<const VectorXd> own(importance.data(), static_cast<Eigen::Index>(importance.size()));
    const VectorXd sizes = size_factors(layout.vertices, layout.triangles, own);
    if (sizes.size() == 0) return;
    const VectorXd areas = face_areas(layout.vertices, layout.triangles);
    for (FlatPart& part : parts) {
        double area = 0.0, wanted = 0.0;
        for (const Index f : part.faces) {
            part.sizes.push_back(sizes[f]);
            area += areas[f];
            wanted += areas[f] * sizes[f];
        }
        if (area > 0.0) part.points *= std::sqrt(wanted / area);
    }
}

}  // namespace

std::vector<Index> first_in_place(const Vertices& vertices)
{
    std::vector<Index> order(static_cast<std::size_t>(vertices.rows())), place(order.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](Index v) { return std::array{vertices(v, 0), vertices(v, 1), vertices(v, 2)}; };
    std::ranges::stable_sort(order, {}, key);
    for (std::size_t i = 0; i < order.size(); ++i)
        place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
    return place;
}

double root_of_area(const Vertices& vertices, const Triangles& triangles)
{
    return of_area_one(vertices, triangles).length_of_unit;
}

FlatMesh flat_mesh(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options, bool roomy,
                   ExecutionContext& context)
{
    context.begin_stage("topology", 0.0, 0.05);
    const bool hard_first = options.cut && may_unfold(options);
    const OpenOptions opening{.polygon = options.polygon, .slit_beside_handles = false, .open = !hard_first};
    OpenedSurface opened =
        options.cut ? open_surface(vertices, triangles, opening, context) : strict_surface(vertices, triangles);
    FlatMesh mesh;
    PartsLayout& layout = mesh.layout;
    layout.vertices = of_area_one(vertices, triangles).vertices;
    layout.triangles = triangles;
    std::vector<FlatPart> hard;
    if (hard_first)
        opened =
            opened_without_hard_parts(vertices, triangles, layout.vertices, std::move(opened), options, hard, context);
    layout.handles_cut = opened.handles;
    for (FlatPiece& piece : flat_pieces(opened, layout.vertices, options, context)) {
        layout.maps += piece.maps / static_cast<double>(triangles.rows());
        std::ranges::move(piece.parts, std::back_inserter(mesh.parts));
    }
    if (!options.importance.empty()) std::ranges::move(std::exchange(hard, {}), std::back_inserter(mesh.parts));
    ask_for_sizes(layout, options.importance, mesh.parts);
    context.begin_stage("even", 0.8, 0.9);
    const EvenParts even = make_parts_even(mesh.parts, evening_of(options, roomy, options.threads), context);
    layout.even = even.even;
    for (const std::size_t k : even.left)
        layout.not_even.insert(layout.not_even.end(), mesh.parts[k].faces.begin(), mesh.parts[k].faces.end());
    std::ranges::sort(layout.not_even);
    std::ranges::move(hard, std::back_inserter(mesh.parts));  // they are exact: nothing relaxes or cuts them
    sum_cuts(mesh);
    mesh.left_out = std::move(opened.left_out);
    return mesh;
}

}  // namespace koebe
