#include "ears/least_arcs.h"

#include "core/connectivity.h"

#include <algorithm>
#include <numbers>

namespace koebe {
namespace {

constexpr double least_of_mean = 1e-3;          // dimensionless
constexpr double drawable = 1e-3;               // radians: s^2 / 2 is eight roundings of 32-bit UVs
constexpr double most_room = std::numbers::pi;  // radians that all such edges may take together

/// Marks the edges of the shorter side of every chord of the loop.
void mark_pockets(const Surface& core, const VertexLoop& outer, const std::vector<Index>& place,
                  std::vector<char>& mark)
{
    const Index n = static_cast<Index>(outer.size());
    for (Index h = 0; h < static_cast<Index>(core.twin.size()); ++h) {
        if (core.twin[h] < h) continue;
        const Index a = place[origin(core.triangles, h)], b = place[target(core.triangles, h)];
        if (a < 0 || b < 0) continue;
        const Index ahead = (b - a + n) % n;
        const Index begin = 2 * ahead <= n ? a : b, count = std::min(ahead, n - ahead);
        for (Index i = 0; i < count; ++i) mark[(begin + i) % n] = 1;
    }
}

}  // namespace

VectorXd least_arcs(const Surface& core, const VertexLoop& outer, const std::vector<Ear>& ears,
                    const std::vector<Index>& core_vertices)
{
    const Index n = static_cast<Index>(outer.size());
    std::vector<Index> place(core.vertex_count, -1);
    for (Index i = 0; i < n; ++i) place[outer[i]] = i;
    std::vector<char> pocket(n, 0);
    mark_pockets(core, outer, place, pocket);

    VectorXd extra = VectorXd::Zero(n);
    for (Index i = 0; i < n; ++i)
        if (pocket[i]) extra[i] = drawable;
    for (const Ear& ear : ears) {
        if (ear.loop != 0 || ear.rim.size() < 2) continue;  // a single ear is thickened later (untangle)
        const auto first = std::lower_bound(core_vertices.begin(), core_vertices.end(), ear.first);
        extra[place[static_cast<Index>(first - core_vertices.begin())]] =
            drawable * static_cast<double>(ear.rim.size() + 1);
    }
    if (extra.sum() > most_room) extra *= most_room / extra.sum();
    return extra.cwiseMax(least_of_mean * 2.0 * std::numbers::pi / static_cast<double>(n));
}

}  // namespace koebe
