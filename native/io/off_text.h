// What is read of an OFF file beside its header, which CGAL reads.
#pragma once

#include "core/types.h"
#include "io/text_numbers.h"

#include <string_view>
#include <vector>

namespace koebe::io {

/// CGAL computes with the counts in 32 bits before anybody can look at them.
/// @throws InputError the file is not a text in three dimensions, or a count is more than the file can hold
void require_off_header(std::string_view bytes);

/// The next line that says something: three coordinates, which a fourth number divides if they are homogeneous, and
/// perhaps a normal, a colour or texture coordinates.
/// @return false: the line is missing, or is not these numbers
bool read_off_vertex(TextLines& lines, bool is_homogeneous, double* point);

/// The next line that says something: a number of corners, as many vertices from `first` on, and perhaps a colour.
/// @return false: the line is missing, is cut short or names a vertex that is not there
bool read_off_face(TextLines& lines, std::vector<Index>& corners, Index first, std::size_t vertex_count);

}  // namespace koebe::io
