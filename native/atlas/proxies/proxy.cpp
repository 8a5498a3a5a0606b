#include "proxies/proxy.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "execution/profile.h"
#include "splitting/mirrored_coarse.h"
#include "surface/mirror.h"
#include "surface/mirror_plane.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace koebe {
namespace {

/// The coarse piece, opened if it is closed. Its area is the fine one's, as chords are shorter than arcs.
SurfacePiece coarse_piece(const CoarseSurface& coarse, const Surface& surface, double area, ExecutionContext& context)
{
    const double larger = std::sqrt(area / face_areas(coarse.vertices, coarse.triangles).sum());
    const Vertices vertices = larger * coarse.vertices;
    if (surface.loops.empty())
        return std::move(open_surface(vertices, coarse.triangles, {.slit_beside_handles = false}, context).pieces[0]);
    return whole_piece(vertices, coarse.triangles);
}

/// (3F) of the coarse piece: on the boundary as the fine half-edge that leaves the same vertex.
std::vector<char> coarse_seams(const CutSurface& fine, const CoarseSurface& coarse, const Surface& surface)
{
    std::vector<char> seam(surface.twin.size(), 1), leaving(static_cast<std::size_t>(fine.vertices.rows()), 1);
    for (Index h = 0; h < static_cast<Index>(fine.surface.twin.size()); ++h)
        if (fine.surface.twin[h] == no_twin) leaving[origin(fine.surface.triangles, h)] = fine.seam[h];
    for (Index h = 0; h < static_cast<Index>(seam.size()); ++h)
        if (surface.twin[h] == no_twin) seam[h] = leaving[coarse.vertex[origin(surface.triangles, h)]];
    return seam;
}

}  // namespace

Proxy proxy_of(const PieceInput& input, PieceSurface fine, Index faces, ExecutionContext& context)
{
    const ProfiledStage profiled("proxy");
    Proxy proxy{std::move(fine), {}, {}, false, {}};
    const CutSurface& whole = proxy.fine.whole;
    const std::vector<Index> image = find_mirror(whole.vertices, whole.surface.triangles, whole.polygon).vertex;
    std::optional<MirrorPlane> plane;
    if (image.empty()) {  // one that is not exact is found on the coarse surface
        proxy.coarse = coarse_surface(whole.vertices, whole.surface.triangles, faces, image, context);
        plane = nearly_mirror(proxy.coarse.vertices, proxy.coarse.triangles);
    } else {
        plane = plane_between(whole.vertices, image);
    }
    std::optional<CoarseSurface> mirrored;
    if (plane) mirrored = mirrored_coarse_surface(whole, *plane, image, faces, context);
    proxy.is_mirrored = mirrored.has_value();
    if (mirrored)
        proxy.coarse = std::move(*mirrored);
    else if (!image.empty())
        proxy.coarse = coarse_surface(whole.vertices, whole.surface.triangles, faces, image, context);
    proxy.surface = analyze_surface(proxy.coarse.triangles, static_cast<Index>(proxy.coarse.vertex.size()));
    proxy.input.piece = coarse_piece(proxy.coarse, proxy.surface, whole.areas.sum(), context);
    proxy.input.seam = coarse_seams(whole, proxy.coarse, proxy.surface);
    proxy.input.shown = values_at(values_at(input.shown, proxy.coarse.vertex), proxy.input.piece.source_vertex);
    return proxy;
}

}  // namespace koebe
