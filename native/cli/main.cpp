#include "cli/commands/command.h"

#if !defined(KOEBE_OWN_KERNELS)
#include "cli/process/dense_buffers.h"
#endif

int main(int argc, char** argv)
{
#if !defined(KOEBE_OWN_KERNELS)
    koebe::cli::restart_without_dense_threads(argv);
    koebe::cli::take_dense_buffer();
#endif
    return koebe::cli::command(argc, argv);
}
