// How much a flat piece is stretched.
#pragma once

#include "core/types.h"
#include "flat/flat_part.h"
#include "flatten/flatten.h"
#include "quality/angle_error.h"

#include <algorithm>

namespace koebe {

class StretchSum {
public:
    void add(double area, double stretch)
    {
        area_ += area;
        sum_ += area * stretch;
        most_ = std::max(most_, stretch);
    }
    Stretch result() const { return {area_ > 0.0 ? 100.0 * sum_ / area_ : 0.0, 100.0 * most_}; }

private:
    double area_ = 0.0, sum_ = 0.0, most_ = 0.0;
};

/// @param face three vertices
FlatTriangle laid_flat(const Vertices& vertices, const Eigen::RowVector3i& face);

/// How much the lengths of a face differ at most from the lengths on the surface. @param corners three rows, in the
/// same unit
double stretch_of(const FlatTriangle& flat, const Eigen::Matrix<double, 3, 2>& corners);

/// Of all faces over their area, 0.01 for a per cent.
double mean_stretch(const FlatPart& part);

}  // namespace koebe
