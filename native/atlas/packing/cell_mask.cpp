#include "packing/cell_mask.h"

#include "kernels/dense_kernels.h"
#include "packing/bit_row.h"

#include <algorithm>
#include <cstddef>

namespace koebe {

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
    const auto common_bits = kernels::chosen().common_bits;
    std::int64_t sum = 0;
    for (int word = 0; word < words; ++word, own += height_, others += other.height_)
        sum += common_bits(own, others, others + other.height_, column % word_bits, top - bottom);
    work += static_cast<std::int64_t>(top - bottom) * words;
    return sum;
}

}  // namespace koebe
