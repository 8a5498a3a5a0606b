#include "cli/process/scarce_memory.h"

#include "cli/process/exit_code.h"
#include "execution/detachable_run.h"
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

/// Where the address space is limited, threads share one arena: malloc would ask for new ones of 64 MB with every
/// allocation.
void share_arena()
{
#if defined(__GLIBC__)
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) ::mallopt(M_ARENA_MAX, 1);
#endif
}

/// Where OpenMP's own few bytes are not there, its library says so and calls exit(1), which no code of the command's
/// is.
void end_for_memory_of_others()
{
#if defined(__GLIBC__)
    {
        const detail::CountedRun first;
    }  // what it does at an exit comes after this then
    ::on_exit(
        [](int status, void*) {
            if (status != EXIT_FAILURE) return;
            AtomicFile::remove_temporary_files();
            end_for_memory();
        },
        nullptr);
#endif
}

}  // namespace

void end_for_memory()
{
    std::fputs("OutOfMemory: the mesh needs more memory than there is\n", stderr);
    std::_Exit(cannot_be_mapped);  // at an ordinary exit OpenBLAS joins threads that wait for memory for ever
}

bool memory_ran_out() noexcept { return ran_out; }

void prepare_for_scarce_memory()
{
    std::set_new_handler(note_and_throw);  // from here on there is somebody to catch exceptions
    std::set_terminate(end_of_exceptions);
    share_arena();
    end_for_memory_of_others();
}

}  // namespace koebe::cli
