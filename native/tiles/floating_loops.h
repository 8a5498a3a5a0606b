// Harmonic functions on a ring.
#pragma once

#include "tiles/flat_map.h"

#include <vector>

namespace koebe {

/// A harmonic function with one free value for each of some loops, through which no flux runs.
class FloatingLoops {
public:
    /// @param domain must outlive it
    FloatingLoops(const PeriodicSurface& domain, bool holes_float);

    /// 0 on the outer rim, 1 on the inner one.
    VectorXd between_rims() const;

    /// What makes the shift harmonic.
    VectorXd round() const;

private:
    VectorXd spread(const VectorXd& values) const;

    const PeriodicSurface& domain_;
    std::vector<Index> representative_;
    Index count_ = 0;
    SparseMatrix matrix_;
};

}  // namespace koebe
