#include "parts/mesh_piece.h"

#include "cost/costs.h"
#include "hard/unfolding.h"
#include "parts/even_parts.h"
#include "parts/hard_surface.h"
#include "parts/pinholes.h"
#include "surface/ambient_visibility.h"
#include "surface/local_density.h"
#include "surface/mirror.h"
#include "surface/mirror_plane.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr Index proxy_from = 6000;   // faces: larger meshes are decided on proxies,
constexpr Index proxy_faces = 5500;  // with about so many faces,
constexpr Index least_proxy = 300;   // and each piece has at least so many
constexpr Index least_mirrored =
    1500;  // faces of a mesh without a proxy that is its mirror image but for its faces: it
constexpr double mirrored_share = 0.6;  // gets a mirrored proxy with this share of its faces

/// Makes cuts dearer where they are seen from more directions, and cheaper where from fewer: in the mean as dear. Then
/// makes them dearer where the mesh is fine. @param count (V) vertices of the input at each vertex
void price_by_sight(PieceInput& input, const VectorXd& count)
{
    const SurfacePiece& piece = input.piece;
    const std::vector<Index> image = find_mirror(piece.vertices, piece.triangles, input.polygon).vertex;
    const auto mirrored = [&](VectorXd own) {
        const VectorXd before = own;
        for (std::size_t v = 0; v < image.size(); ++v)
            if (image[v] >= 0) own[v] = 0.5 * (before[v] + before[image[v]]);
        return own;
    };
    const VectorXd seen = mirrored(ambient_visibility(piece.vertices, piece.triangles));
    VectorXd areas = VectorXd::Zero(seen.size());
    const VectorXd faces = face_areas(piece.vertices, piece.triangles);
    for (Eigen::Index c = 0; c < piece.triangles.size(); ++c) areas[piece.triangles.data()[c]] += faces[c / 3];
    if (input.shown.empty()) input.shown.assign(static_cast<std::size_t>(seen.size()), 1.0);
    VectorXd factor = visibility_factors(seen, areas);
    // Where vertices are farther apart than the scale, their density says nothing.
    if (std::sqrt(areas.sum() / (3.0 * count.sum())) < tuning::detail_scale) {
        const VectorXd density = local_density(piece.vertices, piece.triangles, count, areas, tuning::detail_scale);
        factor.array() *= detail_factors(mirrored(density), areas).array();
    }
    for (Eigen::Index v = 0; v < factor.size(); ++v) input.shown[v] *= factor[v];
}

/// (V) How many vertices of the fine surface went to each vertex of the proxy.
VectorXd vertices_of_proxy(const Proxy& proxy)
{
    VectorXd fine = VectorXd::Zero(static_cast<Eigen::Index>(proxy.coarse.vertex.size()));
    for (const Index v : proxy.coarse.vertex_at)
        if (v >= 0) fine[v] += 1.0;
    return fine(proxy.input.piece.source_vertex);
}

/// Whether a piece is its own mirror image, but not its triangulation.
bool is_only_nearly_mirror(const PieceInput& input)
{
    const auto& [vertices, triangles] = std::tie(input.piece.vertices, input.piece.triangles);
    return find_mirror(vertices, triangles, input.polygon).vertex.empty() && nearly_mirror(vertices, triangles);
}

/// Makes a proxy of a large piece, or of one that is its own mirror image but for its triangulation.
/// @param coarse faces of a large piece's proxy; 0: the piece is not large @param surface of the input; the proxy
/// takes it
void make_proxy(MeshPiece& own, Index coarse, PieceSurface& surface, const PartsOptions& options,
                ExecutionContext& context)
{
    const auto faces = static_cast<Index>(own.input.piece.triangles.rows());
    if (coarse > 0) {
        own.filled = rims_are_free(options) ? without_pinholes(own.input, surface.whole.surface) : std::nullopt;
        if (own.filled) own.open = std::exchange(surface, surface_of(*own.filled));
        own.proxy = proxy_of(own.filled ? *own.filled : own.input, std::exchange(surface, {}), coarse, context);
    } else if (faces >= least_mirrored && rims_are_free(options) && is_only_nearly_mirror(own.input)) {
        own.proxy =
            proxy_of(own.input, std::exchange(surface, {}), static_cast<Index>(mirrored_share * faces), context);
        if (own.proxy->is_mirrored) return;
        surface = std::move(own.proxy->fine);
        own.proxy.reset();
    }
}

}  // namespace

void decide_parts(MeshPiece& own, Eigen::Index total, const PartsOptions& options, int threads,
                  ExecutionContext& context, SplitEffort& effort)
{
    const Index faces = static_cast<Index>(own.input.piece.triangles.rows());
    const Index coarse = std::max(least_proxy, static_cast<Index>(proxy_faces * static_cast<double>(faces) / total));
    const bool by_proxy = total > proxy_from && faces > coarse && options.slits.empty();
    if (!by_proxy && faces <= proxy_from) price_by_sight(own.input, VectorXd::Ones(own.input.piece.vertices.rows()));
    PieceSurface surface = surface_of(own.input);

    // Unfold it. With few cuts nothing else is tried.
    std::optional<UnfoldedParts> true_to_size;
    if (may_unfold(options)) true_to_size = unfolded(surface.whole, context, unfolding_of(options));
    const auto take_unfolded = [&] {
        own.parts = std::move(true_to_size->parts);
        note_shown(own.input.shown, own.parts);
    };
    if (true_to_size && true_to_size->cut_length <= tuning::few_cuts * std::sqrt(surface.whole.areas.sum())) {
        take_unfolded();
        return;
    }
    make_proxy(own, by_proxy ? coarse : 0, surface, options, context);

    // Split it, on the proxy or on itself.
    if (own.proxy) {
        price_by_sight(own.proxy->input, vertices_of_proxy(*own.proxy));
        own.is_fine = false;
        PieceSurface judged = surface_of(own.proxy->input);
        judged.whole.purpose = MapPurpose::judging;
        own.parts = flat_piece(own.proxy->input, std::move(judged), options, threads, context, effort).parts;
        name_by_source(own.proxy->input.piece, own.parts);
    } else {
        own.parts = flat_piece(own.input, std::move(surface), options, threads, context, effort).parts;
    }
    if (!true_to_size) return;

    // Of both layouts the one stays that costs less once it is even.
    const EvenOptions evening = evening_of(options, false, threads);
    if (cost_when_even(true_to_size->parts, evening, context) > cost_when_even(own.parts, evening, context)) return;
    take_unfolded();
    own.proxy.reset();
    own.filled.reset();
    own.is_fine = true;
}

}  // namespace koebe
