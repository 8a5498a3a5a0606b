// Cotan weights corrected for the curvature of the surface that the mesh samples.
#pragma once

#include "surface/intrinsic_metric.h"
#include "surface/laplacian.h"

namespace koebe {

/// Multiplies the weight of each edge by 1 + K d^2 / 12, d its length and K the Gaussian curvature. Linear elements
/// have d^2 / 12 times the integral of |D^2 u|^2 too much energy, of which Bochner's formula leaves -K |grad u|^2
/// inside (docs/numerics.md, "The angles", N3). K of an inner vertex is the sine of its angle defect over the area of
/// its circumcentric cell, and +-1 over that area for defects above a right angle. A boundary vertex takes the mean of
/// its inner neighbours, an edge the mean of its ends. x = K d^2 / 12 is divided by 1 + (x / 0.01)^4, as large angle
/// defects are noise or a crease. Defects below 1e-12 count as 0, so that flat surfaces keep their weights.
/// @param weights in: half_cotangents of the metric's lengths
void correct_for_curvature(const IntrinsicMetric& metric, Index vertex_count, EdgeLengths& weights);

/// (F, 3) half_cotangents, so corrected.
EdgeLengths curvature_weights(const IntrinsicMetric& metric, Index vertex_count);

}  // namespace koebe
