// The quick functions, each with what it promises. Inputs they are not made for end in a KoebeError.
#pragma once

#include "program.h"

#include <span>

namespace koebe::fuzz {

using ArrayCheck = void (*)(const Program&);

/// Of connectivity and shape: topology, canonical form, ears, holes, metric.
std::span<const ArrayCheck> surface_checks();

/// Of the plane: maps of disks and annuli, distortion, planar meshes, circle domains.
std::span<const ArrayCheck> planar_checks();

}  // namespace koebe::fuzz
