#include "bundle/exception_memory.h"

namespace __cxxabiv1 {

void* __aligned_malloc_with_fallback(std::size_t size);
void* __calloc_with_fallback(std::size_t count, std::size_t size);
void __aligned_free_with_fallback(void* memory);
void __free_with_fallback(void* memory);

}  // namespace __cxxabiv1

namespace koebe {

void* exception_memory(std::size_t size) { return __cxxabiv1::__aligned_malloc_with_fallback(size); }
void* zeroed_exception_memory(std::size_t count, std::size_t size)
{
    return __cxxabiv1::__calloc_with_fallback(count, size);
}
void free_exception_memory(void* memory) { __cxxabiv1::__aligned_free_with_fallback(memory); }
void free_zeroed_exception_memory(void* memory) { __cxxabiv1::__free_with_fallback(memory); }

}  // namespace koebe
