// The large buffers that OpenBLAS works in, where memory is scarce. Not in the releases, whose kernels need none.
#pragma once

namespace koebe::cli {

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
