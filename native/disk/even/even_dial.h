// A map made more or less even again and again, each time from where it is: for a slider.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "even/even_map.h"
#include "execution/execution.h"

#include <memory>
#include <vector>

namespace koebe {

/// Keeps the surface, its loops, the map as the last call left it, and the analysis of Newton's equations.
class KOEBE_API EvenDial {
public:
    /// @param vertices (V, 3) @param triangles (F, 3) with at least one boundary loop @param points (V, 2) one to one
    /// @param round true: loops that lie on circles now stay on circles
    /// @throws InputError, TopologyError; InputError a map that is not one to one
    EvenDial(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points, bool round);

    /// Relaxes the map towards E by at most so many Newton steps (even/even_map.h).
    /// @return whether the map moved @throws InputError E is not from 0 to 1; Cancelled: the map stays
    bool move(double even, int most_steps, ExecutionContext& context);

    /// (V, 2) in the unit of the points at first.
    PlanarPoints points() const { return points_ / scale_; }

private:
    Vertices vertices_;
    Triangles triangles_;
    std::vector<VertexLoop> loops_;
    PlanarPoints points_;  // in the unit of the vertices
    std::vector<RoundLoop> round_;
    std::shared_ptr<NewtonPattern> pattern_;  // of the last call
    double scale_ = 1.0, extent_ = 1.0;
};

}  // namespace koebe
