// What a uniformization gives: the map, and the report that every front end passes on.
#pragma once

#include "core/types.h"
#include "core/warning.h"
#include "pipeline/options.h"
#include "quality/distortion.h"

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

struct StageSeconds {
    double read = 0.0, topology = 0.0, metric = 0.0, factor = 0.0, iterate = 0.0, finish = 0.0, write = 0.0,
           total = 0.0;

    StageSeconds& operator+=(const StageSeconds& other)
    {
        read += other.read;
        topology += other.topology;
        metric += other.metric;
        factor += other.factor;
        iterate += other.iterate;
        finish += other.finish;
        write += other.write;
        total += other.total;
        return *this;
    }
};

/// What every map reports, whatever its domain.
struct MapReport {
    Index vertex_count = 0, face_count = 0;
    bool converged = false;  ///< false: the map is not done, and a warning says why
    Distortion distortion;
    StageSeconds seconds;
    double peak_memory_mb = 0.0;
    std::vector<Warning> warnings;
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
