// Predicts memory before it is needed: a computation that cannot fit is refused, not killed half way.
#pragma once

#include <cstddef>

namespace koebe {

/// Bytes that this process can still get: the machine's free memory, or less by a limit on the process or its control
/// group. Infinite if unknown (macOS).
double available_memory();

/// @param bytes that a step takes at least @param purpose completes "memory for"
/// @throws OutOfMemory with both figures if they are not available
void require_memory(double bytes, const char* purpose);

/// Peak bytes for the map of a smooth surface with so many faces and few boundary vertices, including its factor.
double memory_for_faces(std::ptrdiff_t faces);

/// Requires memory before a map of so many faces starts. The additional memory for a long boundary, or for an uneven
/// surface's factor, is required once it is known.
void require_memory_for_faces(std::ptrdiff_t faces);

}  // namespace koebe
