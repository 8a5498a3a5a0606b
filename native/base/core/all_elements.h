// The numbers of all elements of a kind, for an error that all of them cause.
#pragma once

#include "core/types.h"

#include <numeric>
#include <vector>

namespace koebe {

inline std::vector<Index> all_elements(Eigen::Index count)
{
    std::vector<Index> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

}  // namespace koebe
