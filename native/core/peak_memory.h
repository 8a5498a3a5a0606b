// What the process has needed at most.
#pragma once

#include <sys/resource.h>

namespace koebe {

/// The largest resident size so far, in megabytes.
inline double peak_memory_mb()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace koebe
