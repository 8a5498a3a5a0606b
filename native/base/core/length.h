// Euclidean length without overflow or underflow.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace koebe {

/// The norm of a short vector in any unit. Uses Eigen's stableNorm, which takes ten times as long, only where the
/// square is out of range.
template <class Vector>
double length_of(const Eigen::MatrixBase<Vector>& vector)
{
    const typename Vector::PlainObject value = vector;
    const double square = value.squaredNorm();
    return square > 1e-280 && square < 1e280 ? std::sqrt(square) : value.stableNorm();
}

}  // namespace koebe
