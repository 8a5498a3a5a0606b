// A square of cells in which shapes find room.
#pragma once

#include "parts/cell_shape.h"

#include <cstdint>
#include <vector>

namespace koebe {

/// Each row is kept as levels of words: bit x of level k says that one of the 2^k cells from x on is taken. So a run of
/// any length is tested at 64 columns by two words of a level.
class CellBoard {
public:
    /// @param side cells, a multiple of 64
    explicit CellBoard(int side);

    void clear();
    void take(const CellShape& shape, int x, int y);

    /// The first column at which the shape has room with its lowest row there; -1: none.
    /// @param order of its runs, in which they are tested
    int first_room(const CellShape& shape, const std::vector<CellRun>& order, int y) const;

    std::int64_t tests() const { return tests_; }  ///< of a run at 64 columns, so far

private:
    static constexpr int levels = 8;

    std::uint64_t* level(int row, int k) { return &words_[(static_cast<std::size_t>(row) * levels + k) * row_words_]; }
    std::uint64_t taken(int row, int k, int x) const;
    std::uint64_t blocked(const CellRun& run, int y, int x) const;

    int side_;
    std::size_t row_words_;  // two of them beyond the side, empty
    std::vector<std::uint64_t> words_;
    mutable std::int64_t tests_ = 0;
};

}  // namespace koebe
