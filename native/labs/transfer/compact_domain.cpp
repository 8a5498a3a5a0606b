#include "transfer/compact_domain.h"

#include "surface/laplacian.h"

#include <algorithm>
#include <cstddef>

namespace koebe {

CompactDomain compact(const MappedSurface& surface)
{
    CompactDomain domain;
    // Vertices in faces get numbers without gaps.
    std::vector<Index> place(static_cast<std::size_t>(surface.uv.rows()), -1);
    for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) place[surface.triangles.data()[i]] = 0;
    for (std::size_t v = 0; v < place.size(); ++v)
        if (place[v] == 0) {
            place[v] = static_cast<Index>(domain.original.size());
            domain.original.push_back(static_cast<Index>(v));
        }
    domain.surface.triangles = surface.triangles.unaryExpr([&](Index v) { return place[v]; });
    domain.surface.vertices = surface.vertices(domain.original, Eigen::all);
    domain.surface.uv = surface.uv(domain.original, Eigen::all);
    // Loops, circles and areas in these numbers.
    domain.surface.loops = surface.loops;
    for (LoopReport& loop : domain.surface.loops) {
        for (Index& v : loop.vertices) v = place[v];
        for (Index& v : loop.off_circle) v = place[v];
        std::ranges::sort(loop.off_circle);
        domain.circles.push_back(loop.circle);
        domain.loops.push_back(loop.vertices);
        domain.off_circle.insert(domain.off_circle.end(), loop.off_circle.begin(), loop.off_circle.end());
    }
    std::ranges::sort(domain.off_circle);
    const EdgeLengths lengths = edge_lengths(surface.vertices, surface.triangles);
    domain.areas.resize(lengths.rows());
    for (Eigen::Index f = 0; f < lengths.rows(); ++f)
        domain.areas[f] = triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
    return domain;
}

}  // namespace koebe
