#include "parts/sketched_cuts.h"

#include "core/connectivity.h"
#include "proxies/carried_net.h"

#include <algorithm>
#include <optional>

namespace koebe {
namespace {

/// Adds the edges on the boundaries of parts, each with its lower vertex first. @param name of a vertex
template <typename Name>
void add_boundaries(const std::vector<FlatPart>& parts, const Name& name, CutEdges& edges)
{
    for (const FlatPart& part : parts)
        for (Index h = 0; h < static_cast<Index>(part.surface.twin.size()); ++h) {
            if (part.surface.twin[h] != no_twin) continue;
            const Index a = part.original[origin(part.surface.triangles, h)];
            const Index b = part.original[target(part.surface.triangles, h)];
            if (a < 0 || b < 0) continue;
            const auto& [low, high] = sorted_ends(name(a), name(b));
            edges.push_back({low, high});
        }
}

/// The half-edges of a piece's fine surface along which it is cut.
Path carried_cuts(const MeshPiece& own, const ExecutionContext& context)
{
    const CutSurface& fine = own.proxy->fine.whole;
    Path cuts;
    for (Index h = 0; h < static_cast<Index>(fine.seam.size()); ++h)
        if (fine.surface.twin[h] == no_twin && fine.seam[h] != 0) cuts.push_back(h);
    if (const std::optional<CoarseNet> net = coarse_net(*own.proxy, own.parts))
        for (const CarriedPath& carried : straightened(*own.proxy, carried_paths(*own.proxy, *net, context), context))
            cuts.insert(cuts.end(), carried.path.begin(), carried.path.end());
    return cuts;
}

}  // namespace

CutEdges boundaries_of(const std::vector<FlatPart>& parts)
{
    CutEdges edges;
    add_boundaries(
        parts, [](Index v) { return v; }, edges);
    return edges;
}

CutEdges sketched_boundaries(const std::vector<MeshPiece>& pieces, const ExecutionContext& context)
{
    CutEdges edges;
    for (const MeshPiece& own : pieces) {
        const auto name = [&](Index v) { return own.named().source_vertex[v]; };
        if (own.is_fine) {
            add_boundaries(own.parts, name, edges);
        } else if (!own.parts.empty()) {
            const Triangles& triangles = own.proxy->fine.whole.surface.triangles;
            for (const Index h : carried_cuts(own, context)) {
                const auto& [low, high] = sorted_ends(name(origin(triangles, h)), name(target(triangles, h)));
                edges.insert(edges.end(), 2, {low, high});
            }
        }
    }
    return edges;
}

CutEdges repeated(CutEdges boundaries)
{
    std::ranges::sort(boundaries);
    CutEdges found;
    for (std::size_t i = 1; i < boundaries.size(); ++i)
        if (boundaries[i] == boundaries[i - 1] && (found.empty() || found.back() != boundaries[i]))
            found.push_back(boundaries[i]);
    return found;
}

}  // namespace koebe
