#include "pipeline/outer_loop.h"

#include "balance/area_balance.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace koebe {
namespace {

constexpr std::size_t most_candidates = 8;  // the longest loops
constexpr Eigen::Index sample = 2000;       // faces to judge by

template <typename T>
void move_to_front(std::vector<T>& list, int place)
{
    if (!list.empty()) std::rotate(list.begin(), list.begin() + place, list.begin() + place + 1);
}

}  // namespace

int better_outer_loop(const Domain& domain, const CircleMap& map)
{
    std::vector<int> longest(std::min(map.circles.size(), most_candidates));
    std::iota(longest.begin(), longest.end(), 0);
    return balanced_outer_loop(
        face_scales(domain.vertices, domain.surface.triangles, map.uv, sample, domain.importance), map.circles,
        longest);
}

void put_outside(int loop, Domain& whole, FlapCut& cut, std::optional<Domain>& core)
{
    for (Domain* domain : {&whole, core ? &*core : nullptr}) {
        if (!domain) continue;
        move_to_front(domain->loops, loop);
        move_to_front(domain->edges, loop);
    }
    whole.outer_rank = rank_by_lowest_vertex(whole, whole.loops[0]);
    if (core) core->outer_rank = whole.outer_rank;
    move_to_front(cut.loops, loop);
    for (Flap& flap : cut.flaps) {
        if (flap.loop == loop)
            flap.loop = 0;
        else if (flap.loop < loop)
            ++flap.loop;
    }
}

}  // namespace koebe
