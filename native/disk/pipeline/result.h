// The result of a uniformization: the map and its report.
#pragma once

#include "circles/circle.h"
#include "circles/mapped_loop.h"
#include "core/types.h"
#include "iteration/koebe_outcome.h"
#include "pipeline/options.h"
#include "quality/report.h"

#include <optional>
#include <vector>

namespace koebe {

struct LoopReport : MappedLoop {
    Circle circle;                     ///< in the unit disk
    double roundness_projected = 0.0;  ///< deviation from the circle after the projection
    bool shrunk = false;  ///< whether the circle differs from the surface's own: replaced, or lost in rounding
};

/// The circle domain of the surface itself, by which shapes are compared.
struct ConformalDomain {
    PlanarPoints uv;                ///< (V, 2) points of the closed unit disk
    std::vector<LoopReport> loops;  ///< the outer loop first
};

struct UniformizeResult : MapReport {
    PlanarPoints uv;  ///< (V, 2) points of the closed unit disk, in the input's vertex order
    Method method = Method::gk;
    Engine engine = Engine::condensed;
    std::vector<LoopReport> loops;  ///< the outer loop first
    int outer_loop = 0;             ///< rank of the outer loop among the input's loops, sorted by lowest vertex
    Index center = -1, point = -1;  ///< vertices at 0 and at 1, as in the options
    int sweeps = 0, steps = 0;
    std::vector<KoebeStep> history;
    /// If asked for: per step (V, 2), the step's image, with the first loop that it opened on the unit circle. NaN for
    /// vertices that the image lacks.
    std::vector<PlanarPoints> step_images;
    std::optional<AreaDistortion> unbalanced_area;         ///< before the balance, with a balance
    std::optional<AngleError> unpolished_angle_error_deg;  ///< before the polish, with a polish
    /// The conformal domain, if `uv` and `loops` are another one: more even, or fitted to a template. Same order.
    std::optional<ConformalDomain> conformal;

    /// The loops that shapes are compared by.
    const std::vector<LoopReport>& conformal_loops() const { return conformal ? conformal->loops : loops; }
    const PlanarPoints& conformal_uv() const { return conformal ? conformal->uv : uv; }
};

}  // namespace koebe
