#include "parts/cell_mask.h"

#include "parts/bit_row.h"

#include <algorithm>

namespace koebe {
namespace {

/// Bits that are set. Without a processor's own instruction the library's function is slower.
int count_bits(std::uint64_t bits)
{
    bits -= bits >> 1 & 0x5555555555555555;
    bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
    return static_cast<int>(((bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56);
}

}  // namespace

CellMask::CellMask(const CellShape& shape)
    : width_(shape.width),
      height_(shape.height),
      row_words_(static_cast<std::size_t>((shape.width + word_bits - 1) / word_bits) + 3),
      words_(row_words_ * static_cast<std::size_t>(shape.height), 0)
{
    for (const CellRun& run : shape.runs)
        set_bits(&words_[row_words_ * static_cast<std::size_t>(run.row) + 1], run.from, run.to);
}

std::int64_t CellMask::shared(const CellMask& other, int x, int y, std::int64_t& work) const
{
    const int bottom = std::max(0, y), top = std::min(height_, y + other.height_);
    const int left = std::max(0, x), right = std::min(width_, x + other.width_);
    if (bottom >= top || left >= right) return 0;
    const int first = left / word_bits, words = (right - 1) / word_bits - first + 1;
    const int column = (first + 1) * word_bits - x;  // of the other's, after its empty word
    const int shift = column % word_bits;
    const std::uint64_t* own =
        &words_[row_words_ * static_cast<std::size_t>(bottom) + 1 + static_cast<std::size_t>(first)];
    const std::uint64_t* others = &other.words_[other.row_words_ * static_cast<std::size_t>(bottom - y) +
                                                static_cast<std::size_t>(column / word_bits)];
    std::int64_t sum = 0;
    for (int row = bottom; row < top; ++row, own += row_words_, others += other.row_words_)
        for (int word = 0; word < words; ++word)
            if (const std::uint64_t both =
                    own[word] & (others[word] >> shift | others[word + 1] << 1 << (word_bits - 1 - shift));
                both != 0)
                sum += count_bits(both);
    work += static_cast<std::int64_t>(top - bottom) * words;
    return sum;
}

}  // namespace koebe
