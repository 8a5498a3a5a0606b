// A map made more or less even again and again, each time from where it is: for a slider.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "even/even_map.h"
#include "even/pinned_map.h"
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

    /// Moves vertices to places where they stay from now on: one pin by a translation, two pins by a similarity, three
    /// pins and more by a relaxation at E in which all loops are free, and at the size that suits the pins. Replaces
    /// the pins of the last call.
    /// @param pins places in the unit of the points at first
    /// @throws InputError pins (require_pins), E, or three pins and round loops; SolverError no one-to-one map was
    /// found that has the pins in their places: the elements are the pins that are in the way; Cancelled. Nothing is
    /// moved then.
    void pin(const Pins& pins, double even, ExecutionContext& context);

    /// (V, 2) in the unit of the points at first. Pins are exactly at their places.
    PlanarPoints points() const;

private:
    struct Form {
        PlanarPoints points;  // in the unit of the vertices
        std::vector<RoundLoop> round;
        double scale = 1.0;   // of the points, over their unit at first
        double extent = 1.0;  // as in make_even
    };

    FlatSurface view(Form& form) const { return {vertices_, triangles_, loops_, form.points, form.round}; }
    static void place(const Pins& pins, Form& form);
    void bend(const Pins& pins, double even, Form& form, ExecutionContext& context) const;

    Vertices vertices_;
    Triangles triangles_;
    std::vector<VertexLoop> loops_;
    Form form_;
    Pins pins_;                               // in the unit of the points at first
    std::shared_ptr<NewtonPattern> pattern_;  // of the last call
};

}  // namespace koebe
