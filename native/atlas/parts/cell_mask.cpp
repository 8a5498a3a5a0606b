#include "parts/cell_mask.h"

#include "parts/bit_row.h"

#include <algorithm>
#include <cstddef>

namespace koebe {
namespace {

constexpr int rows_in_a_sum = 31;  // at most 8 bits of each in a byte of the sum
constexpr std::uint64_t even_bits = 0x5555555555555555, even_pairs = 0x3333333333333333,
                        low_halves = 0x0f0f0f0f0f0f0f0f, even_bytes = 0x00ff00ff00ff00ff,
                        each_word = 0x0001000100010001;

/// Bits that are set in both `own` and the columns `left` and `right`, moved by `shift` bits. The loop has neither
/// branches nor calls, so compilers do several rows at a time on any processor.
std::int64_t count_shared(const std::uint64_t* own, const std::uint64_t* left, const std::uint64_t* right, int shift,
                          int rows)
{
    std::int64_t sum = 0;
    for (int first = 0; first < rows; first += rows_in_a_sum) {
        const int end = std::min(rows, first + rows_in_a_sum);
        std::uint64_t bytes = 0;
        for (int row = first; row < end; ++row) {
            std::uint64_t bits = own[row] & (left[row] >> shift | right[row] << 1 << (word_bits - 1 - shift));
            bits -= bits >> 1 & even_bits;
            bits = (bits & even_pairs) + (bits >> 2 & even_pairs);
            bytes += (bits + (bits >> 4)) & low_halves;
        }
        sum += static_cast<std::int64_t>(((bytes & even_bytes) + (bytes >> 8 & even_bytes)) * each_word >> 48);
    }
    return sum;
}

}  // namespace

CellMask::CellMask(const CellShape& shape) : width_(shape.width), height_(shape.height)
{
    const int row_words = (shape.width + word_bits - 1) / word_bits + 3;
    const auto height = static_cast<std::size_t>(shape.height);
    std::vector<std::uint64_t> row(static_cast<std::size_t>(row_words));
    words_.resize(row.size() * height, 0);
    for (const CellRun& run : shape.runs) {
        std::ranges::fill(row, 0);
        set_bits(&row[1], run.from, run.to);
        for (std::size_t word = 0; word < row.size(); ++word)
            words_[word * height + static_cast<std::size_t>(run.row)] |= row[word];
    }
}

std::int64_t CellMask::shared(const CellMask& other, int x, int y, std::int64_t& work) const
{
    const int bottom = std::max(0, y), top = std::min(height_, y + other.height_);
    const int left = std::max(0, x), right = std::min(width_, x + other.width_);
    if (bottom >= top || left >= right) return 0;
    const int first = left / word_bits, words = (right - 1) / word_bits - first + 1;
    const int column = (first + 1) * word_bits - x;  // of the other's, after its empty word
    const std::uint64_t* own = &words_[static_cast<std::size_t>(first + 1) * static_cast<std::size_t>(height_) +
                                       static_cast<std::size_t>(bottom)];
    const std::uint64_t* others =
        &other.words_[static_cast<std::size_t>(column / word_bits) * static_cast<std::size_t>(other.height_) +
                      static_cast<std::size_t>(bottom - y)];
    std::int64_t sum = 0;
    for (int word = 0; word < words; ++word, own += height_, others += other.height_)
        sum += count_shared(own, others, others + other.height_, column % word_bits, top - bottom);
    work += static_cast<std::int64_t>(top - bottom) * words;
    return sum;
}

}  // namespace koebe
