#include "flat/common_sequence.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>

namespace koebe {

std::vector<std::pair<std::size_t, std::size_t>> common_sequence(const std::vector<Index>& a,
                                                                 const std::vector<Index>& b)
{
    std::unordered_map<Index, std::vector<std::size_t>> places;  // in b, in order
    for (std::size_t j = 0; j < b.size(); ++j) places[b[j]].push_back(j);
    // starting[k]: pairs (i, j) of equal names with which a longest sequence of k + 1 names begins; i falls, j rises.
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> starting;
    for (std::size_t i = a.size(); i-- > 0;) {
        const auto equal = places.find(a[i]);
        if (equal == places.end()) continue;
        for (const std::size_t j : equal->second) {
            // The longest sequence that begins later in both.
            const auto longer =
                std::ranges::partition_point(starting, [&](const auto& pairs) { return pairs.back().second > j; });
            (longer == starting.end() ? starting.emplace_back() : *longer).emplace_back(i, j);
        }
    }
    std::vector<std::pair<std::size_t, std::size_t>> result;
    for (std::size_t k = starting.size(), i = 0, j = 0; k-- > 0;) {
        // The name at j with its first place from i on; else the last place in a of any later one.
        const auto& pairs = starting[k];
        auto next = std::ranges::partition_point(
            pairs, [&](const auto& pair) { return pair.second < j || (pair.second == j && pair.first >= i); });
        if (next != pairs.begin() && std::prev(next)->second == j) --next;
        result.push_back(*next);
        i = next->first + 1;
        j = next->second + 1;
    }
    return result;
}

}  // namespace koebe
