// Where memory is scarce: an error, and no waiting for ever. What ends the process before main() is in the source.
#pragma once

namespace koebe::cli {

/// Each of OpenBLAS's threads, one for each core from its start on, and each caller asks for a buffer of 128 MB, again
/// and again for ever if there is none. The dense kernels use one thread (SerialDenseKernels). Where the address space
/// is limited or has no room for all buffers, the process starts itself again with OPENBLAS_NUM_THREADS=1 (OpenBLAS
/// manual, "Environment variables"), once.
/// @param arguments as main() has them
void restart_without_dense_threads(char** arguments);

/// The line and the exit code of a command that ran out of memory. Nothing here asks for more.
[[noreturn]] void end_for_memory();

/// Whether memory ran out at any time: whatever else is said to be wrong then, as a number that a reader did not get,
/// comes of that.
bool memory_ran_out() noexcept;

/// Has OpenBLAS take the buffer that it will work in, which it keeps. Where the address space is limited, threads share
/// one arena: malloc would ask for new ones of 64 MB with every allocation. Where an exception for
/// memory would end the process, since it comes where none may, end_for_memory does. Before other threads.
/// @throws std::bad_alloc
void prepare_for_scarce_memory();

}  // namespace koebe::cli
