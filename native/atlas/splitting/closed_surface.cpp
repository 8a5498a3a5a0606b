#include "splitting/closed_surface.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/grouping.h"
#include "core/numbering.h"
#include "cost/tuning.h"
#include "splitting/halving.h"

#include <algorithm>

namespace koebe {

std::optional<CutSurface> closed_surface(const SurfacePiece& piece, const Vertices& vertices,
                                         const std::vector<Index>& polygon)
{
    // The lowest vertex of the piece at each vertex's place in the input.
    const std::vector<Index>& source = piece.source_vertex;
    const std::vector<Index> lowest =
        lowest_alike(static_cast<Eigen::Index>(source.size()), [&](Index v) { return source[v]; });
    Triangles triangles = piece.triangles;
    bool doubled = false;
    for (Eigen::Index i = 0; i < triangles.size(); ++i) {
        Index& v = triangles.data()[i];
        doubled |= lowest[v] != v;
        v = lowest[v];
    }
    if (!doubled) return {};
    try {
        Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
        if (!surface.loops.empty() || surface.genus != 0) return {};
        return cut_surface(vertices, std::move(surface), polygon);
    } catch (const TopologyError&) {  // vertices that were split for another reason
        return {};
    }
}

bool is_nearly_closed(const CutSurface& whole)
{
    double rim = 0.0;
    for (std::size_t h = 0; h < whole.surface.twin.size(); ++h)
        if (whole.surface.twin[h] == no_twin) rim += whole.lengths[static_cast<Eigen::Index>(h)];
    return whole.areas.sum() > tuning::nearly_closed * rim * rim;
}

bool is_between_cuts(const CutSurface& whole)
{
    if (whole.seam.empty() || whole.surface.loops.empty()) return false;
    for (std::size_t h = 0; h < whole.surface.twin.size(); ++h)
        if (whole.surface.twin[h] == no_twin && !whole.seam[h]) return false;
    return true;
}

std::vector<std::vector<Index>> halves(const CutSurface& whole)
{
    const PartMesh all = some_or_all(whole, numbers_below(whole.areas.size()));
    return pieces_of(all, halving(all));
}

}  // namespace koebe
