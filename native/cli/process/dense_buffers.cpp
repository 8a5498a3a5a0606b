#include "cli/process/dense_buffers.h"

#include "cli/process/exit_code.h"
#include "cli/process/scarce_memory.h"

#include <climits>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string_view>

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

extern "C" {
int openblas_get_num_threads();
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
}

namespace koebe::cli {
namespace {

constexpr std::size_t megabyte = std::size_t{1} << 20;
constexpr std::size_t buffer = 129 * megabyte;            // BUFFER_SIZE of OpenBLAS 0.3 with what it puts around it
constexpr std::size_t to_start = buffer + 32 * megabyte;  // and the stacks and the heap of the start

/// Whether there is room for so many bytes more, of the kind that OpenBLAS asks for.
bool is_room_for(std::size_t bytes)
{
    void* const room = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) return false;
    ::munmap(room, bytes);
    return true;
}

[[noreturn]] void end_start()
{
    constexpr std::string_view line = "OutOfMemory: about 250 MB of address space are needed to start\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
    ::_exit(cannot_be_mapped);
}

/// Called before the libraries start: without memory OpenBLAS would wait for ever or raise a signal, and exceptions of
/// what is made before main() would end the process in their own way.
void require_room_to_start(int, char**, char**)
{
    if (!is_room_for(to_start)) end_start();
    std::set_new_handler(end_start);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)(int, char**,
                                                                             char**) = require_room_to_start;

/// Called before OpenBLAS starts, where that is inside the program: of its threads none would ever be used, as dense
/// kernels run on the thread that calls them, and each is busy for its first tenth of a second, waiting for work.
[[gnu::constructor(101)]] void have_no_dense_threads() { ::setenv("OPENBLAS_NUM_THREADS", "1", 1); }

bool is_limited(int resource)
{
    rlimit limit{};
    return ::getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// Starts this program again with the environment as it is now; returns only where that cannot be.
void restart(char** arguments)
{
    char program[PATH_MAX] = {};  // by its own name, which is what the process is then called
    if (readlink("/proc/self/exe", program, sizeof program - 1) > 0) execv(program, arguments);
}

bool has_threads_without_room()
{
    const char* const chosen = std::getenv("OPENBLAS_NUM_THREADS");
    if (chosen != nullptr && chosen == std::string_view("1")) return false;
    const int threads = openblas_get_num_threads();
    return threads > 1 && (is_limited(RLIMIT_AS) || is_limited(RLIMIT_DATA) ||
                           !is_room_for(static_cast<std::size_t>(threads) * buffer));
}

}  // namespace

void restart_without_dense_threads(char** arguments)
{
    if (!has_threads_without_room()) return;
    ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
    restart(arguments);
}

void take_dense_buffer()
{
    if (!is_room_for(buffer)) end_for_memory();
    const int n = 1;
    int status = 0;
    double one = 1.0;
    dpotrf_("L", &n, &one, &n, &status);
}

}  // namespace koebe::cli
