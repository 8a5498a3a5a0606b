/* CHOLMOD names BLAS's complex kernels, and never calls them for real numbers. */
#include <stdlib.h>

#define KOEBE_ABSENT(name) \
    void name(void);       \
    void name(void) { abort(); }

KOEBE_ABSENT(zgemm_)
KOEBE_ABSENT(zgemv_)
KOEBE_ABSENT(zherk_)
KOEBE_ABSENT(zpotrf_)
KOEBE_ABSENT(ztrsm_)
KOEBE_ABSENT(ztrsv_)
