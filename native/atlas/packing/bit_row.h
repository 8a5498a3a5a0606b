// Bits in words.
#pragma once

#include <algorithm>
#include <cstdint>

namespace koebe {

constexpr int word_bits = 64;

/// Sets the bits [from, to).
inline void set_bits(std::uint64_t* words, int from, int to)
{
    for (int word = from / word_bits; word * word_bits < to; ++word) {
        const int first = std::max(from - word * word_bits, 0),
                  count = std::min(to - word * word_bits, word_bits) - first;
        words[word] |= ~std::uint64_t{0} >> (word_bits - count) << first;
    }
}

}  // namespace koebe
