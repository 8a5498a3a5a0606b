// Memory asked for before it is needed.
#pragma once

#include <cstddef>

namespace koebe {

/// How far ahead of a walk whose way is known, in its steps.
inline constexpr std::size_t steps_ahead = 16;

/// Brings what lies there into the cache while other work goes on: a walk over a surface from face to face would wait
/// for nearly each.
inline void prefetch(const void* place) { __builtin_prefetch(place); }

}  // namespace koebe
