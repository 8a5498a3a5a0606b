#include "cli/process/roomy_heap.h"

#if defined(__GLIBC__)

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

namespace koebe::cli {
namespace {

constexpr std::size_t room = std::size_t{512} << 20;  // bytes, for a surface of half a million faces
constexpr std::size_t large_page = std::size_t{2} << 20;
constexpr int separate = 32 << 20;         // bytes of a block that is returned to the system when freed
constexpr int most_separate_ones = 65536;  // glibc's own default

bool is_limited(decltype(RLIMIT_AS) resource)
{
    rlimit limit{};
    return ::getrlimit(resource, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY;
}

/// Asks for large pages inside a block. Without them the block works as any other.
void ask_for_large_pages(void* block, std::size_t bytes)
{
    const auto begin = (reinterpret_cast<std::uintptr_t>(block) + large_page - 1) / large_page * large_page;
    const auto end = (reinterpret_cast<std::uintptr_t>(block) + bytes) / large_page * large_page;
    ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace

void take_roomy_heap()
{
    if (is_limited(RLIMIT_AS) || is_limited(RLIMIT_DATA)) return;
    ::mallopt(M_ARENA_MAX, 1);
    ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    ::mallopt(M_MMAP_MAX, 0);
    if (void* const block = std::malloc(room)) {
        ask_for_large_pages(block, room);
        std::free(block);
    }
    ::mallopt(M_MMAP_MAX, most_separate_ones);
    ::mallopt(M_MMAP_THRESHOLD, separate);
}

}  // namespace koebe::cli

#else

void koebe::cli::take_roomy_heap() {}

#endif
