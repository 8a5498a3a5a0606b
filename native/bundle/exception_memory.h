// Memory for exceptions when no other memory is left. The library and the modules that call it each contain a C++
// runtime with a small reserve for that. An exception of the library may end in a module, whose runtime would return
// its memory to the wrong reserve. So the modules use the library's.
#pragma once

#include "core/api.h"

#include <cstddef>

namespace koebe {

/// As the libc++abi functions of these names (fallback_malloc.h). @returns nullptr if there is no memory
KOEBE_API void* exception_memory(std::size_t size);
KOEBE_API void* zeroed_exception_memory(std::size_t count, std::size_t size);
KOEBE_API void free_exception_memory(void* memory);
KOEBE_API void free_zeroed_exception_memory(void* memory);

}  // namespace koebe
