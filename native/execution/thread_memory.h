// What the C library allocates behind a thread's back.
#pragma once

#include "core/api.h"

namespace koebe::detail {

/// Takes the thread-local variables of all loaded libraries for this thread. Later, at the first use of one, a lack of
/// memory ends the process (glibc).
/// @throws std::bad_alloc
KOEBE_API void take_thread_memory();

}  // namespace koebe::detail
