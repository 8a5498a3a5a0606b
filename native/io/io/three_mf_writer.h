// Writes 3MF files, for 3D printing.
#pragma once

#include "core/types.h"
#include "files/atomic_file.h"

namespace koebe {

/// Writes a 3MF file [3MF Consortium, Core Specification 1.3]: a ZIP of XML, not compressed, with coordinates to the
/// last bit. The unit is the millimetre, as the vertices have none. The caller commits the file.
/// @param closed whether the mesh bounds a body; else it is written as a surface
/// @throws InputError the file would be larger than four gigabytes; FileError
void write_three_mf(AtomicFile& file, const Vertices& vertices, const Triangles& triangles, bool closed);

}  // namespace koebe
