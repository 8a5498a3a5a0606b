// Where exceptions live when no memory is left. The library and the modules that call it have each a C++ runtime
// inside, and each runtime a small reserve of its own for that; but an exception of the library may end in a module,
// whose runtime would give its memory back to a reserve it never came from. So the modules use the library's.
#pragma once

#include "core/api.h"

#include <cstddef>

namespace koebe {

/// As libc++abi's functions of such names (fallback_malloc.h). @returns nullptr where there is no memory
KOEBE_API void* exception_memory(std::size_t size);
KOEBE_API void* zeroed_exception_memory(std::size_t count, std::size_t size);
KOEBE_API void free_exception_memory(void* memory);
KOEBE_API void free_zeroed_exception_memory(void* memory);

}  // namespace koebe
