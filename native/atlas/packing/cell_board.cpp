#include "packing/cell_board.h"

#include "packing/bit_row.h"

#include <algorithm>
#include <bit>

namespace koebe {

CellBoard::CellBoard(int side)
    : side_(side),
      row_words_(static_cast<std::size_t>(side / word_bits) + 2),
      words_(static_cast<std::size_t>(side) * levels * row_words_, 0)
{
}

void CellBoard::clear() { std::ranges::fill(words_, 0); }

void CellBoard::take(const CellShape& shape, int x, int y)
{
    // The words of all levels that may change: bits up to 2^levels before the shape.
    int right = x;
    for (const CellRun& run : shape.runs) right = std::max(right, x + run.to);
    const auto first = static_cast<std::size_t>(std::max(0, x - (1 << levels)) / word_bits);
    const std::size_t end = std::min(row_words_ - 2, static_cast<std::size_t>(right / word_bits) + 1);
    for (std::size_t i = 0; i < shape.runs.size();) {
        const int row = y + shape.runs[i].row;
        std::uint64_t* words = level(row, 0);
        for (; i < shape.runs.size() && y + shape.runs[i].row == row; ++i)
            set_bits(words, x + shape.runs[i].from, x + shape.runs[i].to);
        for (int k = 0; k + 1 < levels; ++k) {
            const int shift = 1 << k;
            const std::uint64_t* below = level(row, k);
            std::uint64_t* above = level(row, k + 1);
            for (std::size_t word = first; word < end; ++word)
                above[word] =
                    below[word] | (shift == word_bits ? below[word + 1]
                                                      : below[word] >> shift | below[word + 1] << (word_bits - shift));
        }
    }
}

/// Bit i: one of the 2^k cells from x + i on is taken.
std::uint64_t CellBoard::taken(int row, int k, int x) const
{
    const std::uint64_t* words =
        &words_[(static_cast<std::size_t>(row) * levels + static_cast<std::size_t>(k)) * row_words_ +
                static_cast<std::size_t>(x / word_bits)];
    const int shift = x % word_bits;
    return shift == 0 ? words[0] : words[0] >> shift | words[1] << (word_bits - shift);
}

/// Bit i: the run meets a cell that is taken if the shape is at x + i.
std::uint64_t CellBoard::blocked(const CellRun& run, int y, int x) const
{
    const int length = run.to - run.from, row = y + run.row;
    const int k = std::min(levels - 1, static_cast<int>(std::bit_width(static_cast<unsigned>(length))) - 1);
    std::uint64_t met = taken(row, k, x + run.to - (1 << k));
    for (int from = run.from; from + (1 << k) < run.to; from += 1 << k) met |= taken(row, k, x + from);
    return met;
}

int CellBoard::first_room(const CellShape& shape, const std::vector<CellRun>& order, int y, int from) const
{
    const int last = side_ - shape.width;
    for (int x = from; x <= last; x += word_bits) {
        std::uint64_t room = ~std::uint64_t{0};
        if (last - x < word_bits - 1) room = (std::uint64_t{1} << (last - x + 1)) - 1;
        for (const CellRun& run : order) {
            ++tests_;
            room &= ~blocked(run, y, x);
            if (room == 0) break;
        }
        if (room != 0) return x + std::countr_zero(room);
    }
    return -1;
}

}  // namespace koebe
