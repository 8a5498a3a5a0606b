// What CHOLMOD's analysis names and this library does not need, in place of what Debian's archive has. So the archive
// can be inside a shared library, which its messages to stdout keep it from, and wants no METIS.
#include <cholmod.h>

extern "C" {

/// Says nothing: who calls CHOLMOD reads the status.
int cholmod_error(int status, const char*, int, const char*, cholmod_common* common)
{
    common->status = status;
    return 1;
}

int cholmod_metis(cholmod_sparse*, int*, size_t, int, int*, cholmod_common* common)
{
    common->status = CHOLMOD_NOT_INSTALLED;
    return 0;
}

SuiteSparse_long cholmod_nested_dissection(cholmod_sparse*, int*, size_t, int*, int*, int*, cholmod_common* common)
{
    common->status = CHOLMOD_NOT_INSTALLED;
    return -1;
}

}  // extern "C"
