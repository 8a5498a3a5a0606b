// Replaces functions of Debian's archive that CHOLMOD's analysis names and this library does not need. So a shared
// library can contain the archive, whose messages to stdout prevent that otherwise, and METIS is not needed.
#include <cholmod.h>

extern "C" {

/// Prints nothing: callers of CHOLMOD read the status.
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
