// The dense kernels that fit the processor.
#pragma once

namespace koebe::cli {

/// OpenBLAS chooses its kernels while it is loaded, and a release older than the processor falls back to those of
/// 2004 ("Prescott"), 3 to 6 times slower. Where that has happened on a processor with AVX2, the process starts
/// itself again with OPENBLAS_CORETYPE set (OpenBLAS manual, "Environment variables"), once; a value that the user
/// has set is left alone.
/// @param arguments as main() has them
void restart_with_fast_kernels(char** arguments);

/// Starts this program again with the environment as it is now; returns only where that cannot be.
void restart(char** arguments);

}  // namespace koebe::cli
