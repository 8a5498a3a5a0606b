// What a uniformization takes and gives: options, and the report that every front end passes on.
#pragma once

#include "core/types.h"
#include "core/warning.h"

#include <optional>
#include <string>
#include <vector>

namespace koebe {

enum class Method { gk, ck };            ///< generalized or conventional Koebe iteration (paper, section 4.4)
enum class Engine { condensed, mesh };   ///< docs/method.md: eliminated once, or patches as real triangles
/// automatic: the longest, but with Balance::area the one with the least area distortion.
enum class OuterLoop { automatic, longest, vertex };
enum class Balance { none, area };       ///< area: the disk automorphism with the least area distortion

struct UniformizeOptions {
    Method method = Method::gk;
    Engine engine = Engine::condensed;
    OuterLoop outer = OuterLoop::automatic;
    Index outer_vertex = -1;   ///< with OuterLoop::vertex: a vertex of the loop to put on the unit circle
    double tolerance = 1e-6;   ///< on the circles' change in a sweep, a length in the unit disk
    int max_sweeps = 50;
    Balance balance = Balance::none;
    bool polish = false;       ///< least angle error with the circles as they are, at the end (angle_polish.h)
    int threads = 0;           ///< at most; 0: all cores. Today one is used: the result is the same for any number
};

struct Circle {
    Complex center{0.0, 0.0};
    double radius = 1.0;
};

/// One step of the Koebe iteration. The condensed engine's steps of one sweep take effect together: they share the
/// sweep's change, and its roundness stands in the last of them, the one before in the others.
struct KoebeStep {
    int step = 0;
    std::pair<int, int> pair{0, 0};  ///< the two loops left open; (0, k) for the conventional form
    double change = 0.0;             ///< (sum |c' - c|^2 + |r' - r|^2)^(1/2) over all circles (paper, section 4.4)
    double mean_roundness = 0.0;     ///< mean e(gamma_k) over all loops (paper, section 5)
    std::vector<Circle> circles;     ///< of the loops after the step, or after those that take effect together
};

struct LoopReport {
    VertexLoop vertices;              ///< in order, the surface on the left
    Circle circle;                    ///< in the unit disk
    double roundness = 0.0;           ///< e(gamma_k) before the projection onto the circle
    double roundness_projected = 0.0; ///< and after it
    std::vector<Index> off_circle;    ///< vertices that are not on the circle
    bool shrunk = false;              ///< whether the circle is not the surface's: another than the iteration's, or lost in rounding
};

struct AngleError {  ///< degrees, |angle in UV - angle on the surface| over all corners
    double mean = 0.0, sd = 0.0, max = 0.0;
};

struct Beltrami {  ///< |mu| of the face-wise linear maps, dimensionless
    double mean = 0.0, max = 0.0;
};

/// log of (UV area / surface area), area-weighted on the surface, its mean subtracted: 0 is even texel density.
struct AreaDistortion {
    double log_sd = 0.0, log_min = 0.0, log_max = 0.0;
};

struct Distortion {
    AngleError angle_error_deg;
    Beltrami beltrami;
    AreaDistortion area;
    double conformal_energy = 0.0;       ///< Dirichlet energy - area of the map (0 iff conformal), unit-disk area units
    std::vector<Index> flipped;          ///< faces with signed area <= 0, u and v rounded to 32 bits
    std::vector<Index> below_resolution; ///< those of them whose longest UV edge is under 1e-6
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

struct UniformizeResult {
    PlanarPoints uv;  ///< (V, 2) points of the closed unit disk, in the input's vertex order
    Method method = Method::gk;
    Engine engine = Engine::condensed;
    Index vertex_count = 0, face_count = 0;
    std::vector<LoopReport> loops;  ///< the outer loop first
    int outer_loop = 0;             ///< lowest-vertex rank of the outer loop among the input's loops
    bool converged = false;
    int sweeps = 0, steps = 0;
    std::vector<KoebeStep> history;
    Distortion distortion;
    std::optional<AreaDistortion> unbalanced_area;  ///< before the balance, if one was asked for
    std::optional<AngleError> unpolished_angle_error_deg;  ///< before the polish, if one was asked for
    StageSeconds seconds;
    double peak_memory_mb = 0.0;
    std::vector<Warning> warnings;
};

}  // namespace koebe
