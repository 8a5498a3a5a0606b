// Memory is predicted and asked for before it is needed: a computation that cannot fit is refused, not killed half way.
#pragma once

#include <cstddef>

namespace koebe {

/// Bytes that this process can still get: what the machine has free, less if a limit on the process or its control
/// group says so. Infinite where nobody tells (macOS).
double available_memory();

/// @param bytes that a step will take at least @param purpose what for, to go on after "memory for"
/// @throws OutOfMemory with both figures if they are not there
void require_memory(double bytes, const char* purpose);

/// Bytes at the peak of the map of a smooth surface of so many faces with few boundary vertices, its factor included.
double memory_for_faces(std::ptrdiff_t faces);

/// The same before a map of so many faces is begun. What a long boundary takes, or an uneven surface in its factor, is
/// asked for when it is known.
void require_memory_for_faces(std::ptrdiff_t faces);

}  // namespace koebe
