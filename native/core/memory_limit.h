// Memory is asked for before it is needed: a computation that cannot fit is refused, not killed half way.
#pragma once

namespace koebe {

/// Bytes that this process can still get: what the machine has free, less if a limit on the process or its control
/// group says so. Infinite where nobody tells (systems other than Linux).
double available_memory();

/// @param bytes that a step will take at least @param purpose what for, to go on after "memory for"
/// @throws OutOfMemory with both figures if they are not there
void require_memory(double bytes, const char* purpose);

}  // namespace koebe
