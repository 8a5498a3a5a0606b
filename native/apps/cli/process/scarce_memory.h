// Reports an error when memory runs out, instead of waiting for ever.
#pragma once

namespace koebe::cli {

/// Prints the error of a command that ran out of memory, and exits. Allocates no memory.
[[noreturn]] void end_for_memory();

/// Whether memory ran out at any time. Then other errors, such as a number that could not be read, come from that.
bool memory_ran_out() noexcept;

/// Call before other threads start. Makes end_for_memory end the process where an exception for memory would otherwise
/// do so, because no exception may pass there.
void prepare_for_scarce_memory();

}  // namespace koebe::cli
