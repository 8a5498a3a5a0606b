// What every map reports, whatever its domain: the report that every front end passes on.
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
    std::optional<double> even = {};  ///< of a map that can be made more even: how much it is (relax/even_map.h)
    Index overlaps = 0;               ///< of such a map: pairs of boundary edges that cross, or parts with such
    bool converged = false;           ///< false: the map is not done, and a warning says why
    Distortion distortion;
    StageSeconds seconds;
    double peak_memory_mb = 0.0;
    std::vector<Warning> warnings;
};

/// A map of which each corner of a face has UVs of its own, so that the two sides of a cut can differ.
struct CornerMapReport : MapReport {
    PlanarPoints uv;            ///< (3F, 2) of corner 3 f + k of the input's face f
    std::vector<Index> turned;  ///< faces that were turned to the orientation of the others
};

}  // namespace koebe
