// Cells of a shape as bits, to count the cells that two shapes share.
#pragma once

#include "packing/cell_shape.h"

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
    std::vector<std::uint64_t> words_;  // by columns of words, with an empty one at the left, and two at the right
};

}  // namespace koebe
