// The numbers of all elements of a kind, for an error that all of them cause.
#pragma once

#include "core/numbering.h"
#include "core/types.h"

#include <vector>

namespace koebe {

inline std::vector<Index> all_elements(Eigen::Index count)
{
    std::vector<Index> numbers = numbers_below(count);
    return numbers;
}

}  // namespace koebe
