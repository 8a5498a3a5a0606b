// BLAS and LAPACK by their own names, for CHOLMOD, with the kernels that fit the processor.
#include "bundle/kernels/dense_kernels.h"

extern "C" {
#define KOEBE_SYMBOL(name, parameters, arguments)                                                                      \
    void name##_ parameters;                                                                                           \
    void name##_ parameters { koebe::kernels::chosen().name arguments; }
KOEBE_DENSE_KERNELS(KOEBE_SYMBOL)
#undef KOEBE_SYMBOL
}
