// A square of cells in which shapes find room.
#pragma once

#include "packing/cell_shape.h"

#include <cstdint>
#include <vector>

namespace koebe {

/// Each row has levels of words. Bit x of level k is set if any of the 2^k cells from x on is taken. So two words of a
/// level test a run of any length at 64 columns.
class CellBoard {
public:
    /// @param side cells, a multiple of 64
    explicit CellBoard(int side);

    void clear();
    void take(const CellShape& shape, int x, int y);

    /// The first column, from a column on, at which the shape has room if its lowest row is row y; -1: there is none.
    /// @param order the shape's runs, in the order in which they are tested
    int first_room(const CellShape& shape, const std::vector<CellRun>& order, int y, int from = 0) const;

    std::int64_t tests() const { return tests_; }  ///< number of tests so far, each of a run at 64 columns

private:
    static constexpr int levels = 8;

    std::uint64_t* level(int row, int k) { return &words_[(static_cast<std::size_t>(row) * levels + k) * row_words_]; }
    std::uint64_t taken(int row, int k, int x) const;
    std::uint64_t blocked(const CellRun& run, int y, int x) const;

    int side_;
    std::size_t row_words_;  // with two empty words beyond the side
    std::vector<std::uint64_t> words_;
    mutable std::int64_t tests_ = 0;
};

}  // namespace koebe
