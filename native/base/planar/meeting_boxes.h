// Pairs of boxes that meet, by CGAL's sweep. For .cpp files only.
#pragma once

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <vector>

namespace koebe::detail {

/// Visits all pairs of boxes that share a point. Few boxes are swept from left to right.
/// @tparam Box CGAL::Box_intersection_d::Box_with_info_d of two dimensions
template <typename Box, typename Visit>
void visit_meeting_boxes(std::vector<Box>& boxes, const Visit& visit)
{
    constexpr std::size_t most_swept = 4096;  // with more boxes CGAL's search is faster, however they lie
    if (boxes.size() > most_swept) {
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), visit);
        return;
    }
    std::ranges::sort(boxes, {}, [](const Box& box) { return box.min_coord(0); });
    for (auto first = boxes.begin(); first != boxes.end(); ++first)
        for (auto second = first + 1; second != boxes.end() && second->min_coord(0) <= first->max_coord(0); ++second)
            if (second->min_coord(1) <= first->max_coord(1) && first->min_coord(1) <= second->max_coord(1))
                visit(*first, *second);
}

}  // namespace koebe::detail
