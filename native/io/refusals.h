// What the readers of all formats refuse: more elements than an index can number or a file can hold, and damaged ones.
#pragma once

#include "core/types.h"

#include <cstddef>
#include <limits>
#include <string>

namespace koebe::io {

/// More vertices, faces or corners than this have no 32-bit index.
inline constexpr std::size_t most_elements = std::numeric_limits<Index>::max();

/// @throws InputError always
[[noreturn]] void refuse_size();

/// @param element "vertex", "face" ... @throws InputError always
[[noreturn]] void refuse(const std::string& element, std::size_t number, const char* complaint);

/// Every vertex and face takes a byte at least. Without this, a header could ask for any amount of memory.
/// @throws InputError
void require_count_fits(std::size_t count, const std::string& element, std::size_t bytes);

}  // namespace koebe::io
