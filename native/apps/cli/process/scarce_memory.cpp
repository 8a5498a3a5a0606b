#include "cli/process/scarce_memory.h"

#include "exit_code.h"
#include "io/atomic_file.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#if defined(__GLIBC__)
#include <malloc.h>
#include <sys/resource.h>
#endif

namespace koebe::cli {
namespace {

std::atomic<bool> ran_out{false};

[[noreturn]] void note_and_throw()
{
    ran_out = true;
    throw std::bad_alloc();
}

[[noreturn]] void end_of_exceptions()
{
    if (!ran_out) std::abort();
    AtomicFile::remove_temporary_files();
    end_for_memory();
}

/// Makes threads share one arena if the address space is limited: malloc would otherwise ask for new ones of 64 MB with
/// every allocation.
void share_arena()
{
#if defined(__GLIBC__)
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) ::mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace

void end_for_memory()
{
    std::fputs("OutOfMemory: the mesh needs more memory than there is\n", stderr);
    std::_Exit(cannot_be_mapped);  // an ordinary exit waits for threads, which wait for memory
}

bool memory_ran_out() noexcept { return ran_out; }

void prepare_for_scarce_memory()
{
    std::set_new_handler(note_and_throw);  // from here on exceptions are caught
    std::set_terminate(end_of_exceptions);
    share_arena();
}

}  // namespace koebe::cli
