// Replaces functions of the C++ runtime: the linker takes these and leaves the runtime's out.
#include "bundle/exception_memory.h"

namespace __cxxabiv1 {

void* __aligned_malloc_with_fallback(std::size_t size) { return koebe::exception_memory(size); }
void* __calloc_with_fallback(std::size_t count, std::size_t size)
{
    return koebe::zeroed_exception_memory(count, size);
}
void __aligned_free_with_fallback(void* memory) { koebe::free_exception_memory(memory); }
void __free_with_fallback(void* memory) { koebe::free_zeroed_exception_memory(memory); }

}  // namespace __cxxabiv1
