// Fits circles to the image of a boundary loop and measures its roundness (paper, section 5).
#pragma once

#include "circles/circle.h"
#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// The points of a loop in its order.
VectorXcd gather_loop(const VectorXcd& positions, const VertexLoop& loop);

/// (n) share of each vertex in the length of the closed polygon: half of its two edges over the length; sums to 1. The
/// paper's w_i (section 5) are the two whole edges over the length, and sum to 2. So the shares are w_i / sum(w). If
/// all points coincide, the shares are equal.
VectorXd length_weights(const VectorXcd& points);

/// The paper's circle (section 5): centre c = sum(w_i v_i) / sum(w_i), radius R = (1/n) sum |v_i - c|. The print
/// divides the centre by n once more, which must be an error. This circle is exact for equally spaced points of a
/// circle, and off by O(h^2) for uneven spacing.
/// @param points (n) closed polygon in order, n >= 1
Circle fit_circle_paper(const VectorXcd& points);

/// The circle of least squared distance: minimizes sum (|v_i - c| - r)^2 over c and r, with equal weights. The start is
/// algebraic (Kasa 1976), and Gauss-Newton steps on the distances follow. Exact for points of a circle with any
/// spacing. Fewer than three points, points of a line, and points within an eighth of a turn get fit_circle_paper: a
/// loop that collapsed without flux is not a part of a large circle.
KOEBE_API Circle fit_circle_least_squares(const VectorXcd& points);

/// Two dimensionless measures of how far a loop's image is from a circle.
struct Roundness {
    /// The paper's e(gamma_k) (section 5): (1/R) sqrt((1/n) sum (|v_i - c| - R)^2) with the c and R of
    /// fit_circle_paper. Unevenly spaced points of a circle have e > 0 too. e is 1 if all points coincide, and 0
    /// without points.
    double paper = 0.0;
    /// Deviation from the circle that the loop is put on: sqrt(sum w_i (|v_i - c| - r)^2 / sum w_i) / r. It is 0 on the
    /// circle.
    double least_squares = 0.0;
};

/// The means over all loops, and over the holes, which are all loops but the first. 0 without loops.
struct MeanRoundness {
    Roundness all, holes;
};

double paper_roundness(const VectorXcd& points);
double deviation_from(const Circle& circle, const VectorXcd& points);

/// @param circle on which the points are put: fit_circle_least_squares of them, or another circle
Roundness roundness(const VectorXcd& points, const Circle& circle);

MeanRoundness mean_roundness(const std::vector<Roundness>& loops);

/// Inversive distance of two circles, invariant under Moebius maps: |r_a^2 + r_b^2 - |c_a - c_b|^2| / (2 r_a r_b).
double inversive_distance(const Circle& a, const Circle& b);

}  // namespace koebe
