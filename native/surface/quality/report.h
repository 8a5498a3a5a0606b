// The report that all maps share, for any domain. Every front end shows it.
#pragma once

#include "core/types.h"
#include "core/warning.h"
#include "quality/distortion.h"

#include <optional>
#include <vector>

namespace koebe {

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

struct MapReport {
    Index vertex_count = 0, face_count = 0;
    std::optional<double> even = {};  ///< of maps that can be made more even: how even the map is (even/even_map.h)
    Index overlaps = 0;               ///< of such maps: pairs of crossing boundary edges, or parts with such
    bool converged = false;           ///< false: the map is not finished, and a warning tells why
    Distortion distortion;
    StageSeconds seconds;
    double peak_memory_mb = 0.0;
    std::vector<Warning> warnings;
};

/// A map with UVs for each corner, so that the two sides of a cut can differ.
struct CornerMapReport : MapReport {
    PlanarPoints uv;            ///< (3F, 2) of corner 3 f + k of the input's face f
    std::vector<Index> turned;  ///< faces that were turned to the orientation of the others
};

/// Of a map whose circles move in sweeps.
struct SweptMapReport : CornerMapReport {
    int sweeps = 0;
    std::vector<double> changes;  ///< of the circles or the points, in each sweep
};

}  // namespace koebe
