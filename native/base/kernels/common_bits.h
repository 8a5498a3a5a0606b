// Counts bits that two columns of words have in common. For dense_kernels.cpp alone, which is compiled for each set.
#pragma once

#include <cstdint>

namespace koebe::kernels {
namespace KOEBE_OF_SET {

constexpr int rows_in_a_sum = 31;  // at most 8 bits of each in a byte of the sum
constexpr std::uint64_t even_bits = 0x5555555555555555, even_pairs = 0x3333333333333333,
                        low_halves = 0x0f0f0f0f0f0f0f0f, even_bytes = 0x00ff00ff00ff00ff,
                        each_word = 0x0001000100010001;

/// The loop has neither branches nor calls, so compilers do several rows at a time.
inline std::int64_t common_bits(const std::uint64_t* own, const std::uint64_t* left, const std::uint64_t* right,
                                int shift, int rows)
{
    std::int64_t sum = 0;
    for (int first = 0; first < rows; first += rows_in_a_sum) {
        const int end = rows - first < rows_in_a_sum ? rows : first + rows_in_a_sum;
        std::uint64_t bytes = 0;
        for (int row = first; row < end; ++row) {
            std::uint64_t bits = own[row] & (left[row] >> shift | right[row] << 1 << (63 - shift));
            bits -= bits >> 1 & even_bits;
            bits = (bits & even_pairs) + (bits >> 2 & even_pairs);
            bytes += (bits + (bits >> 4)) & low_halves;
        }
        sum += static_cast<std::int64_t>(((bytes & even_bytes) + (bytes >> 8 & even_bytes)) * each_word >> 48);
    }
    return sum;
}

}  // namespace KOEBE_OF_SET
}  // namespace koebe::kernels
