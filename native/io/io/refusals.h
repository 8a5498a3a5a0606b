// Errors of all readers: more elements than an index can number or a file can hold, and damaged elements.
#pragma once

#include "core/types.h"

#include <cstddef>
#include <limits>
#include <string>

namespace koebe::io {

/// Vertices, faces or corners beyond this number have no 32-bit index.
inline constexpr std::size_t most_elements = std::numeric_limits<Index>::max();

/// @throws InputError always
[[noreturn]] void refuse_size();

/// @param element "vertex", "face" ... @throws InputError always
[[noreturn]] void refuse(const std::string& element, std::size_t number, const char* complaint);

/// Checks that the file has at least one byte for each vertex or face that its header declares. Otherwise a header
/// could ask for any amount of memory.
/// @throws InputError
void require_count_fits(std::size_t count, const std::string& element, std::size_t bytes);

}  // namespace koebe::io
