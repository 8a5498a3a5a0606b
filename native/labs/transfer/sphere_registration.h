// Bends one map to the sphere over another, until fields agree and landmarks meet.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "execution/execution.h"
#include "quality/distortion.h"

#include <vector>

namespace koebe {

/// A closed surface and its map to the unit sphere, one to one.
struct SphereSurface {
    Vertices vertices;    ///< (V, 3)
    Triangles triangles;  ///< (F, 3)
    Vertices points;      ///< (V, 3) unit vectors
    MatrixXd fields;      ///< (V, k), NaN where they are unknown; k = 0: none
};

/// A vertex of the source that goes to a point of the target's sphere.
struct SphereLandmark {
    Index vertex = 0;
    Eigen::Vector3d place{0.0, 0.0, 1.0};
};

struct SphereRegistration {
    Vertices points;         ///< (V) the source's vertices on the target's sphere
    Beltrami beltrami;       ///< of the bending
    double log_area_sd = 0;  ///< standard deviation of the log of its area factor, by the source's area
    int steps = 0;           ///< Newton steps
    bool settled = false;    ///< whether the last level ended by itself
};

/// Minimizes (1/2) mean((fields_target(y) - fields_source)^2) + stiffness * elastic energy (sphere/elastic_sphere.h)
/// over the places y of the source's vertices on the target's sphere. Means are by the source's area, and the fields
/// have mean 0 and standard deviation 1. The rest shape is the source's sphere as given, so lay it over the target's
/// before.
///
/// First landmarks are moved to their places, in steps that are halved until no face turns over, with the biharmonic
/// displacement for the other vertices. Then the energy is minimized with fields that heat flow on their surfaces has
/// smoothed, with less and less smoothing and stiffness, and at last as given. No step turns a face over, and the
/// result covers the sphere once: both are checked in the end. Without fields only the elastic energy is minimized.
/// @param stiffness > 0, dimensionless
/// @throws InputError landmarks with one vertex or one place; fields without values, or that are constant. SolverError
/// with the landmarks that block each other; Cancelled
KOEBE_API SphereRegistration register_spheres(const SphereSurface& target, const SphereSurface& source,
                                              const std::vector<SphereLandmark>& landmarks, double stiffness,
                                              ExecutionContext& context);

}  // namespace koebe
