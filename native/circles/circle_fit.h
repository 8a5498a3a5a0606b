// Circles through the image of a boundary loop, and how round that image is (paper, section 5).
#pragma once

#include "circles/circle.h"
#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// The points of a loop, in its order.
VectorXcd gather_loop(const VectorXcd& positions, const VertexLoop& loop);

/// (n) share of each vertex in the length of the closed polygon: half of its two edges over the whole; sums to 1.
/// The paper's w_i (section 5) are the two whole edges over the length and so sum to 2: these are w_i / sum(w).
/// Points that all coincide share evenly.
VectorXd length_weights(const VectorXcd& points);

/// The paper's circle (section 5): centre c = sum(w_i v_i) / sum(w_i), radius R = (1/n) sum |v_i - c|. The print
/// divides the centre by n once more, which cannot be meant. Exact for equally spaced points of a circle; off by O(h^2)
/// for uneven ones.
/// @param points (n) closed polygon in order, n >= 1
Circle fit_circle_paper(const VectorXcd& points);

/// The circle of least squared distance: minimizes sum (|v_i - c| - r)^2 over c and r, every point alike. Algebraic
/// start (Kasa 1976), then Gauss-Newton on the distances. Exact for points of a circle, however they are spaced.
/// Points of a line, within an eighth of a turn, or fewer than three, fall back to fit_circle_paper: a loop that has
/// collapsed for want of flux is no part of a large circle.
KOEBE_API Circle fit_circle_least_squares(const VectorXcd& points);

/// How far the image of a loop is from a circle, dimensionless, by two measures.
struct Roundness {
    /// The paper's e(gamma_k) (section 5): (1/R) sqrt((1/n) sum (|v_i - c| - R)^2) with the c and R of
    /// fit_circle_paper. Uneven points of a circle have an e > 0 too. 1 for points that all coincide, 0 for none.
    double paper = 0.0;
    /// Deviation from the circle it is put on: sqrt(sum w_i (|v_i - c| - r)^2 / sum w_i) / r, 0 on it.
    double least_squares = 0.0;
};

/// The means over all loops and over all but the outer one, the first: 0 without any.
struct MeanRoundness {
    Roundness all, holes;
};

double paper_roundness(const VectorXcd& points);
double deviation_from(const Circle& circle, const VectorXcd& points);

/// @param circle fit_circle_least_squares of the points, or another that they are put on
Roundness roundness(const VectorXcd& points, const Circle& circle);

MeanRoundness mean_roundness(const std::vector<Roundness>& loops);

/// Intersection of two circles, free of Moebius maps: |r_a^2 + r_b^2 - |c_a - c_b|^2| / (2 r_a r_b).
double inversive_distance(const Circle& a, const Circle& b);

}  // namespace koebe
