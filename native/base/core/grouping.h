// Numbers that have something in common.
#pragma once

#include "core/numbering.h"

#include <algorithm>
#include <vector>

namespace koebe {

/// The places of each number, ascending. @param numbers from 0 to count
inline std::vector<std::vector<Index>> places_of_numbers(const std::vector<Index>& numbers, Index count)
{
    std::vector<std::vector<Index>> places(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < numbers.size(); ++i) places[numbers[i]].push_back(static_cast<Index>(i));
    return places;
}

/// For each number below `count` the lowest one with the same key.
template <class Key>
std::vector<Index> lowest_alike(Eigen::Index count, Key key)
{
    std::vector<Index> order = numbers_below(count), lowest(order.size());
    std::ranges::stable_sort(order, {}, key);
    for (std::size_t i = 0; i < order.size(); ++i)
        lowest[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? lowest[order[i - 1]] : order[i];
    return lowest;
}

}  // namespace koebe
