// The angle error lowered for all vertices at once.
#pragma once

#include "foldover/angle_map.h"

#include <memory>

namespace koebe {

/// Newton steps on the same map: the linear systems are analyzed once.
class AngleNewton {
public:
    explicit AngleNewton(const AngleMap& map);
    ~AngleNewton();

    /// The step to where sum_k w_k e_k^2 over all corners is least to first order, e_k the error of an angle and w_k =
    /// (e_k^2 + least^2)^-1/2: one linear system of two unknowns a free vertex, one a sliding vertex. The map's errors
    /// have to be up to date, and who moves the same each time.
    /// @param least radians
    /// @return whether the system could be solved
    bool solve(double least);
    /// Where the vertices are after a share of the step: (V).
    std::vector<Complex> places(double share) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace koebe
