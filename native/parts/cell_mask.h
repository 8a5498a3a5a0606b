// Cells of a shape as rows of bits, to count the cells that two shapes share.
#pragma once

#include "parts/cell_shape.h"

#include <cstdint>
#include <vector>

namespace koebe {

class CellMask {
public:
    CellMask() = default;
    explicit CellMask(const CellShape& shape);

    int width() const { return width_; }
    int height() const { return height_; }

    /// Cells that this mask shares with another mask whose lower left corner is at (x, y) of this mask.
    /// @param work grows by the words that were compared
    std::int64_t shared(const CellMask& other, int x, int y, std::int64_t& work) const;

private:
    int width_ = 0, height_ = 0;
    std::size_t row_words_ = 0;  // with an empty word before the first column, and two empty words behind the last
    std::vector<std::uint64_t> words_;
};

}  // namespace koebe
