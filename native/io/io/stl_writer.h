// Writes STL files.
#pragma once

#include "core/types.h"
#include "files/atomic_file.h"

namespace koebe {

/// Writes a binary STL file: 32-bit floats, no shared vertices. The caller commits the file.
/// @throws InputError different vertices become one as 32-bit floats (elements: these vertices), so that the file would
/// have other edges than the mesh; FileError
void write_stl(AtomicFile& file, const Vertices& vertices, const Triangles& triangles);

}  // namespace koebe
