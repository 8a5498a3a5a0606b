// Lowers the angle error for all vertices at once.
#pragma once

#include "foldover/angle_map.h"

#include <memory>

namespace koebe {

/// Takes Newton steps on one map. The linear systems are analyzed once.
class AngleNewton {
public:
    explicit AngleNewton(const AngleMap& map);
    ~AngleNewton();

    /// Computes the step that minimizes sum_k w_k e_k^2 over all corners to first order. e_k is the error of an angle,
    /// and w_k = (e_k^2 + least^2)^-1/2. The linear system has two unknowns for a free vertex, one for a sliding
    /// vertex. The map's errors must be up to date; the mobility of vertices must not change between calls.
    /// @param least radians
    /// @return whether the system could be solved
    bool solve(double least);
    /// (V) the places of the vertices after a share of the step.
    std::vector<Complex> places(double share) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace koebe
