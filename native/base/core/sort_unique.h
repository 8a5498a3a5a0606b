// Lists of numbers as sets.
#pragma once

#include <algorithm>

namespace koebe {

/// Sorts a vector and leaves each of its items once.
template <class Items>
void sort_unique(Items& items)
{
    std::ranges::sort(items);
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace koebe
