// What OpenBLAS needs of the process before it works in it. Not in the releases, which bring their own kernels.
#pragma once

namespace koebe::cli {

/// OpenBLAS chooses its kernels while it is loaded, and a release older than the processor falls back to those of
/// 2004 ("Prescott"), 3 to 6 times slower. Where that has happened on a processor with AVX2, the process starts
/// itself again with OPENBLAS_CORETYPE set (OpenBLAS manual, "Environment variables"), once; a value that the user
/// has set is left alone.
/// @param arguments as main() has them
void restart_with_fast_kernels(char** arguments);

/// Each of OpenBLAS's threads, one for each core from its start on, and each caller asks for a buffer of 128 MB, again
/// and again for ever if there is none. The dense kernels use one thread (SerialDenseKernels). Where the address space
/// is limited or has no room for all buffers, the process starts itself again with OPENBLAS_NUM_THREADS=1 (OpenBLAS
/// manual, "Environment variables"), once.
/// @param arguments as main() has them
void restart_without_dense_threads(char** arguments);

/// Has OpenBLAS take the buffer that it will work in, which it keeps; without room the process
/// ends. Before other threads.
void take_dense_buffer();

}  // namespace koebe::cli
