// Where an iteration on a shape near to others begins.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// The angles of a shape from those of the last shapes: angles follow the shape smoothly, so where it is a combination
/// of those seen, as the next frame of a motion nearly is, its angles nearly are the same combination of theirs.
class AngleForecast {
public:
    /// What tells a shape from another one on the same triangles, whatever its place and size: the logarithms of the
    /// lengths of some of its edges, their mean 0.
    static VectorXd shape_of(const Vertices& vertices, const Triangles& triangles);

    /// @param shape shape_of() @param angles of the vertices of each loop, increasing
    void add(VectorXd shape, std::vector<VectorXd> angles);

    /// @return of the last shape added; or the forecast, where that leaves at most half of the distance from the last
    /// shape and keeps each step along a loop near to the last one; none if no shape was added
    std::vector<VectorXd> angles_for(const VectorXd& shape) const;

private:
    struct Known {
        VectorXd shape;
        std::vector<VectorXd> angles;
    };
    std::vector<Known> known_;  // the last one last
};

}  // namespace koebe
