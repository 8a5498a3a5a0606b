// What a uniformization gives: the map, and its report.
#pragma once

#include "core/types.h"
#include "iteration/koebe_outcome.h"
#include "pipeline/options.h"
#include "quality/report.h"

#include <optional>
#include <vector>

namespace koebe {

struct LoopReport {
    VertexLoop vertices;               ///< in order, the surface on the left
    Circle circle;                     ///< in the unit disk
    Roundness roundness;               ///< of the image before the projection onto the circle
    double roundness_projected = 0.0;  ///< deviation from the circle after it
    std::vector<Index> off_circle;     ///< vertices that are not on the circle
    bool shrunk =
        false;  ///< whether the circle is not the surface's: another than the iteration's, or lost in rounding
};

struct UniformizeResult : MapReport {
    PlanarPoints uv;  ///< (V, 2) points of the closed unit disk, in the input's vertex order
    Method method = Method::gk;
    Engine engine = Engine::condensed;
    std::vector<LoopReport> loops;  ///< the outer loop first
    int outer_loop = 0;             ///< lowest-vertex rank of the outer loop among the input's loops
    Index center = -1, point = -1;  ///< vertices at 0 and at 1, as they were asked for
    int sweeps = 0, steps = 0;
    std::vector<KoebeStep> history;
    /// (V, 2) per step, if asked for: its own image, the first loop that it opened on the unit circle; NaN for vertices
    /// that are not in it, or that it could not place.
    std::vector<PlanarPoints> step_images;
    std::optional<AreaDistortion> unbalanced_area;         ///< before the balance, if one was asked for
    std::optional<AngleError> unpolished_angle_error_deg;  ///< before the polish, if one was asked for
};

}  // namespace koebe
