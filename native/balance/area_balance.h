// The automorphism of the disk, and the outer loop, with the least area distortion.
#pragma once

#include "circles/moebius.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// Where the faces of a map lie and how much it shrinks them.
struct FaceScales {
    VectorXcd centers;   ///< (F) centroids in the unit disk
    VectorXd log_ratio;  ///< (F) log(UV area / surface area) less that of an even map onto the whole disk
    VectorXd weights;    ///< (F) area on the surface
};

/// Texel density (a length over a length) that is asked for at importance 1, over that at 0.
inline constexpr double most_important = 4.0;

/// (F) by what the area of each face is multiplied for its importance: most_important^(2 w), w the mean of its
/// vertices.
VectorXd importance_factors(const Triangles& triangles, const VectorXd& importance);

/// @param most roughly how many faces are picked, evenly; those without area on the surface or in the map are left out
/// @param importance (V) 0 to 1, or empty: areas on the surface count importance_factors times
FaceScales face_scales(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv, Eigen::Index most,
                       const VectorXd& importance = {});

/// The automorphism f(z) = (z - a) / (1 - conj(a) z) that makes texel density most even: least variance of the log
/// ratio, weighted by surface area, plus a tenth of its squared mean, without which the whole map would often shrink
/// into a point of the rim. f adds 2 log |f'| = 2 log(1 - |a|^2) - 4 log |1 - conj(a) z|; Gauss-Newton's method on a,
/// from the map's present position and with a line search. The identity where the variance would not fall.
/// @param distortion the root of the sum that is left
Moebius least_area_distortion(const FaceScales& scales, double& distortion);

}  // namespace koebe
