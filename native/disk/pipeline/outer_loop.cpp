#include "pipeline/outer_loop.h"

#include "core/numbering.h"

#include <algorithm>
#include <vector>

namespace koebe {
namespace {

constexpr std::size_t most_candidates = 8;  // the longest loops
constexpr double worth_changing = 0.8;      // ratio of distortions, as a change turns the map inside out
constexpr Eigen::Index sample = 2000;       // number of faces used to judge

template <typename T>
void move_to_front(std::vector<T>& list, int place)
{
    if (!list.empty()) std::rotate(list.begin(), list.begin() + place, list.begin() + place + 1);
}

}  // namespace

int balanced_outer_loop(const FaceScales& scales, const std::vector<Circle>& circles,
                        const std::vector<int>& candidates)
{
    double to_beat = 0.0;
    least_area_distortion(scales, to_beat);
    to_beat *= worth_changing;
    int best = 0;
    for (const int k : candidates) {
        if (k == 0) continue;
        FaceScales turned = scales;
        const auto arm = scales.centers.array() - circles[k].center;
        turned.centers = circles[k].radius / arm;
        turned.log_ratio.array() += 2.0 * std::log(circles[k].radius) - 4.0 * arm.abs().log();  // 2 log |w'|
        double distortion = 0.0;
        least_area_distortion(turned, distortion);
        if (distortion < to_beat) {
            to_beat = distortion;
            best = k;
        }
    }
    return best;
}

int better_outer_loop(const MapInput& input, const CircleMap& map)
{
    std::vector<int> longest = numbers_below<int>(std::min(map.circles.size(), most_candidates));
    return balanced_outer_loop(face_scales(input.vertices, input.surface.triangles, map.uv, sample, input.importance),
                               map.circles, longest);
}

void put_outside(int loop, MapInput& whole, EarCut& cut, std::optional<MapInput>& core)
{
    for (MapInput* input : {&whole, core ? &*core : nullptr}) {
        if (!input) continue;
        move_to_front(input->loops, loop);
        move_to_front(input->edges, loop);
    }
    whole.outer_rank = rank_by_lowest_vertex(whole, whole.loops[0]);
    if (core) core->outer_rank = whole.outer_rank;
    move_to_front(cut.loops, loop);
    for (Ear& ear : cut.ears) {
        if (ear.loop == loop)
            ear.loop = 0;
        else if (ear.loop < loop)
            ++ear.loop;
    }
}

}  // namespace koebe
