// Lays a map of the disk over another map by an automorphism.
#pragma once

#include "circles/moebius.h"

namespace koebe {

/// The automorphism g of the disk that minimizes sum w |g(z) - t|^2: the Gauss-Newton method on its three parameters,
/// from the identity, with steps halved until the sum falls.
/// @param points, targets (n) of the closed unit disk @param weights (n) positive
Moebius nearest_automorphism(const VectorXcd& points, const VectorXcd& targets, const VectorXd& weights);

}  // namespace koebe
