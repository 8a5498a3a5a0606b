// Harmonic functions on a ring.
#pragma once

#include "tiles/flat_map.h"

#include <vector>

namespace koebe {

/// A harmonic function with one free value on each of some loops, so that no net flux runs through them.
class FloatingLoops {
public:
    /// @param domain must outlive it
    FloatingLoops(const PeriodicSurface& domain, bool holes_float);

    /// The function that is 0 on the outer rim and 1 on the inner rim.
    VectorXd between_rims() const;

    /// The function that makes the shift harmonic.
    VectorXd round() const;

private:
    VectorXd spread(const VectorXd& values) const;

    const PeriodicSurface& domain_;
    std::vector<Index> representative_;
    Index count_ = 0;
    SparseMatrix matrix_;
};

}  // namespace koebe
