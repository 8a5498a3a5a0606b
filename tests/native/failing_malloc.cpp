// A library to preload (LD_PRELOAD): memory ends where the environment says.
//
// KOEBE_FAIL_AT=k: the k-th allocation fails, and no other. KOEBE_FAIL_FROM=k: it and all after it.
// KOEBE_COUNT_FILE=path: how many there were is written there when the process ends.
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

std::atomic<long> allocations{0};
long fail_at = 0, fail_from = 0;  // none

[[gnu::constructor]] void read_environment()
{
    if (const char* k = std::getenv("KOEBE_FAIL_AT")) fail_at = std::atol(k);
    if (const char* k = std::getenv("KOEBE_FAIL_FROM")) fail_from = std::atol(k);
    allocations = 0;
}

[[gnu::destructor]] void write_count()
{
    const long count = allocations;
    fail_at = fail_from = 0;
    const char* path = std::getenv("KOEBE_COUNT_FILE");
    if (path == nullptr) return;
    if (std::FILE* file = std::fopen(path, "w")) {
        std::fprintf(file, "%ld\n", count);
        std::fclose(file);
    }
}

bool fails()
{
    const long number = ++allocations;
    if (number != fail_at && (fail_from == 0 || number < fail_from)) return false;
    errno = ENOMEM;
    return true;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return fails() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* memory, std::size_t size) { return fails() ? nullptr : __libc_realloc(memory, size); }
void* memalign(std::size_t alignment, std::size_t size) { return fails() ? nullptr : __libc_memalign(alignment, size); }
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** memory, std::size_t alignment, std::size_t size)
{
    void* const made = memalign(alignment, size);
    if (made == nullptr) return ENOMEM;
    *memory = made;
    return 0;
}

}  // extern "C"
