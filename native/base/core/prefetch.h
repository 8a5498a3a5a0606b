// Loads memory into the cache before it is needed.
#pragma once

#include <cstddef>

namespace koebe {

/// How many steps to look ahead in a walk whose path is known.
inline constexpr std::size_t steps_ahead = 16;

/// Brings memory at this place into the cache while other work goes on. A walk from face to face would otherwise wait
/// at nearly each face.
inline void prefetch(const void* place) { __builtin_prefetch(place); }

}  // namespace koebe
