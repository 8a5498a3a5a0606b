// A fuzzer's bytes as a program that makes a mesh: a base surface, edits of it, and options for the map.
#pragma once

#include "core/types.h"
#include "pipeline/result.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace koebe::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A mesh that nobody has checked.
struct Soup {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<Index, 3>> faces;

    Vertices vertices() const;
    Triangles triangles() const;
};

// Records of a fixed length, so that a mutator can insert, drop and swap them.
inline constexpr std::size_t base_bytes = 8;
inline constexpr std::size_t option_bytes = 6;
inline constexpr std::size_t edit_bytes = 6;
inline constexpr std::size_t header_bytes = base_bytes + option_bytes;
inline constexpr std::size_t most_edits = 48;

struct Limits {
    std::size_t side;   ///< most vertices along a side of the base surface
    std::size_t faces;  ///< more than these get no further ones
};

/// What the bytes say; those that are missing count as 0.
/// Layout: base surface (8 bytes), options (6), edits (6 each, 48 at most).
struct Program {
    Soup soup;
    UniformizeOptions options;
    std::uint8_t choice = 0;  ///< a byte that the options leave to the target
};

Program run_program(Bytes bytes, const Limits& limits);

/// The kinds of base surfaces and edits there are; a byte is taken modulo these.
int base_kind_count();
int edit_kind_count();

/// The edits from this one on break what a mesh must have; a mutator takes them seldom.
int first_breaking_edit();

}  // namespace koebe::fuzz
