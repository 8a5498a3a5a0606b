// Chooses the best kernels for the processor, or those that KOEBE_KERNELS names.
#include "kernels/dense_kernels.h"

#include <cstdlib>
#include <string_view>

namespace koebe::kernels {
namespace {

const DenseKernels& fitting()
{
#if defined(KOEBE_SEVERAL_INSTRUCTION_SETS)
    const char* const named = std::getenv("KOEBE_KERNELS");
    const std::string_view most = named != nullptr ? named : "";
    __builtin_cpu_init();
    if (most == "sse2" || !__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return baseline();
    if (most == "avx2" || !__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") ||
        !__builtin_cpu_supports("avx512bw") || !__builtin_cpu_supports("avx512vl"))
        return avx2();
    return avx512();
#else
    return baseline();
#endif
}

}  // namespace

const DenseKernels& chosen()
{
    static const DenseKernels& kernels = fitting();
    return kernels;
}

}  // namespace koebe::kernels
