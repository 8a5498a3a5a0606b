#include "ears/least_arcs.h"

#include "core/connectivity.h"

#include <algorithm>
#include <numbers>

namespace koebe {
namespace {

constexpr double least_of_mean = 1e-3;          // dimensionless
constexpr double drawable = 1e-3;               // radians: s^2 / 2 is eight roundings of 32-bit UVs
constexpr double most_room = std::numbers::pi;  // radians that all such edges may take together

/// (n) Whether an edge of the loop lies on the shorter side of a chord.
std::vector<char> pockets(const Surface& core, const VertexLoop& outer, const std::vector<Index>& place)
{
    const Index n = static_cast<Index>(outer.size());
    std::vector<int> begun(2 * outer.size() + 1, 0);  // chords that begin at a place, less those that end there
    for (Index h = 0; h < static_cast<Index>(core.twin.size()); ++h) {
        if (core.twin[h] < h) continue;
        const Index a = place[origin(core.triangles, h)], b = place[target(core.triangles, h)];
        if (a < 0 || b < 0) continue;
        const Index ahead = (b - a + n) % n, begin = 2 * ahead <= n ? a : b;
        ++begun[begin];
        --begun[begin + std::min(ahead, n - ahead)];
    }
    std::vector<char> result(outer.size(), 0);
    int open = 0;
    for (Index i = 0; i < 2 * n; ++i)
        if ((open += begun[i]) > 0) result[i % n] = 1;
    return result;
}

}  // namespace

VectorXd least_arcs(const Surface& core, const VertexLoop& outer, const std::vector<Ear>& ears,
                    const std::vector<Index>& core_vertices)
{
    const Index n = static_cast<Index>(outer.size());
    std::vector<Index> place(core.vertex_count, -1);
    for (Index i = 0; i < n; ++i) place[outer[i]] = i;
    const std::vector<char> pocket = pockets(core, outer, place);

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
