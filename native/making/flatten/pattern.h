// A pattern as it is drawn: lines and labels on sheets, in millimetres.
#pragma once

#include "core/page.h"
#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

enum class LineKind {
    cut,   ///< where the material is cut
    seam,  ///< where it is sewn, inside of the allowance
    mark,  ///< a notch, at the same point on both sides of a seam
};

struct PatternLine {
    LineKind kind = LineKind::cut;
    int piece = 0;        ///< from 1
    bool closed = false;  ///< the last point is joined with the first
    PlanarPoints points;  ///< (n, 2) on the sheet, from its lower left corner
};

struct PatternLabel {
    std::string text;
    int piece = 0;
    Eigen::RowVector2d at;   ///< the middle of the text
    double height = 0.0;     ///< of capitals
    double angle_deg = 0.0;  ///< counter-clockwise
};

/// A sheet is one page, or a grid of pages whose frames meet.
struct PatternSheet {
    double width = 0.0, height = 0.0;  ///< of all frames
    int columns = 1, rows = 1;
    std::vector<PatternLine> lines;
    std::vector<PatternLabel> labels;

    int pages() const { return columns * rows; }
};

struct Pattern {
    Page page;
    std::vector<PatternSheet> sheets;

    int pages() const;
};

}  // namespace koebe
