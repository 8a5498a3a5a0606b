// Forecasts the angles that an iteration starts with, from earlier shapes.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// Forecasts angles, which depend smoothly on the shape. If a shape is a combination of earlier shapes, as the next
/// frame of a motion nearly is, its angles are nearly the same combination of theirs.
class AngleForecast {
public:
    /// The logarithms of the lengths of some edges, with mean 0. They tell shapes on the same triangles apart, in any
    /// position and size.
    static VectorXd shape_of(const Vertices& vertices, const Triangles& triangles);

    /// @param shape shape_of() @param angles of the vertices of each loop, increasing
    void add(VectorXd shape, std::vector<VectorXd> angles);

    /// @return the forecast, if it leaves at most half of the distance from the last shape and keeps each step along a
    /// loop near to the last one; else the angles of the last shape; empty if no shape was added
    std::vector<VectorXd> angles_for(const VectorXd& shape) const;

private:
    struct Known {
        VectorXd shape;
        std::vector<VectorXd> angles;
    };
    std::vector<Known> known_;  // the newest last
};

}  // namespace koebe
