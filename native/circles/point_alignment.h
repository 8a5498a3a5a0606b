// One map of the disk laid over another, as well as an automorphism can.
#pragma once

#include "circles/moebius.h"

namespace koebe {

/// The automorphism g of the disk that takes points nearest to others, sum w |g(z) - t|^2 least: Gauss and Newton's
/// method on its three parameters, from the identity, with steps halved until the sum falls.
/// @param points, targets (n) of the closed unit disk @param weights (n) positive
Moebius nearest_automorphism(const VectorXcd& points, const VectorXcd& targets, const VectorXd& weights);

}  // namespace koebe
