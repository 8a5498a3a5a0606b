// BLAS and LAPACK by their own names, for CHOLMOD and linear/, with the kernels that fit the processor.
#include "bundle/kernels/dense_kernels.h"

namespace koebe::kernels {
namespace {

const DenseKernels& best()
{
#if defined(KOEBE_SEVERAL_INSTRUCTION_SETS)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl"))
        return avx512();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2();
#endif
    return baseline();
}

const DenseKernels& kernels()
{
    static const DenseKernels& chosen = best();
    return chosen;
}

}  // namespace
}  // namespace koebe::kernels

extern "C" {
#define KOEBE_SYMBOL(name, parameters, arguments)                                                                      \
    void name##_ parameters;                                                                                           \
    void name##_ parameters { koebe::kernels::kernels().name arguments; }
KOEBE_DENSE_KERNELS(KOEBE_SYMBOL)
#undef KOEBE_SYMBOL
}
