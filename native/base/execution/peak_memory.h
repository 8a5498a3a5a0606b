// The peak memory of the process.
#pragma once

namespace koebe {

/// The largest resident size so far, in megabytes.
double peak_memory_mb();

}  // namespace koebe
