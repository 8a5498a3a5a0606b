// Numbers of elements, and values by number.
#pragma once

#include "core/types.h"

#include <numeric>
#include <vector>

namespace koebe {

/// 0, 1, ... count - 1.
template <typename Number = Index, typename Count>
std::vector<Number> numbers_below(Count count)
{
    std::vector<Number> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), Number{0});
    return numbers;
}

/// The value at each of these places; empty if there are no values.
template <typename Value, typename Places>
std::vector<Value> values_at(const std::vector<Value>& values, const Places& places)
{
    std::vector<Value> found;
    if (!values.empty())
        for (const auto place : places) found.push_back(values[static_cast<std::size_t>(place)]);
    return found;
}

}  // namespace koebe
