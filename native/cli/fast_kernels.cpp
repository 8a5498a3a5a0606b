#include "cli/fast_kernels.h"

#include <unistd.h>

#include <climits>
#include <cstdlib>
#include <string_view>

extern "C" char* openblas_get_corename();

namespace koebe::cli {

void restart(char** arguments)
{
    char program[PATH_MAX] = {};  // by its own name, which is what the process is then called
    if (readlink("/proc/self/exe", program, sizeof program - 1) > 0) execv(program, arguments);
}

void restart_with_fast_kernels(char** arguments)
{
#if defined(__x86_64__)
    constexpr const char* choice = "OPENBLAS_CORETYPE";
    if (std::getenv(choice) != nullptr || openblas_get_corename() != std::string_view("Prescott")) return;
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return;
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    setenv(choice, wide ? "SKYLAKEX" : "HASWELL", 1);
    restart(arguments);  // the slow kernels do it where it cannot be
#else
    (void)arguments;
#endif
}

}  // namespace koebe::cli
