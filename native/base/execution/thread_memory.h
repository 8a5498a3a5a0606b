// Allocates early what the C library would allocate on a thread's first use.
#pragma once

#include "core/api.h"

namespace koebe::detail {

/// Allocates the thread-local variables of all loaded libraries for this thread. Later, at their first use, a lack of
/// memory would end the process (glibc).
/// @throws std::bad_alloc
KOEBE_API void take_thread_memory();

}  // namespace koebe::detail
