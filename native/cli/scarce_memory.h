// Where memory is scarce: an error, and no waiting for ever. What ends the process before main() is in the source.
#pragma once

namespace koebe::cli {

/// Each of OpenBLAS's threads, one for each core from its start on, and each caller asks for a buffer of 128 MB, again
/// and again for ever if there is none. The dense kernels use one thread (SerialDenseKernels). Where the address space
/// is limited or has no room for all buffers, the process starts itself again with OPENBLAS_NUM_THREADS=1 (OpenBLAS
/// manual, "Environment variables"), once.
/// @param arguments as main() has them
void restart_without_dense_threads(char** arguments);

/// Has OpenBLAS take the buffer that it will work in, which it keeps. Where the address space is limited, threads share
/// one arena: malloc would ask for new ones of 64 MB with every allocation. Before other threads.
/// @throws std::bad_alloc
void prepare_for_scarce_memory();

}  // namespace koebe::cli
