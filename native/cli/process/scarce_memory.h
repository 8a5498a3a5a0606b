// Where memory is scarce: an error, and no waiting for ever.
#pragma once

namespace koebe::cli {

/// The line and the exit code of a command that ran out of memory. Nothing here asks for more.
[[noreturn]] void end_for_memory();

/// Whether memory ran out at any time: whatever else is said to be wrong then, as a number that a reader did not get,
/// comes of that.
bool memory_ran_out() noexcept;

/// Before other threads. Where an exception for memory would end the process, since it comes where none may,
/// end_for_memory does.
void prepare_for_scarce_memory();

}  // namespace koebe::cli
