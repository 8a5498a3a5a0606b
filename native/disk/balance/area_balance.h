// Finds the automorphism of the disk, and the outer loop, with the least area distortion.
#pragma once

#include "circles/moebius.h"
#include "core/types.h"

namespace koebe {

/// Where a map puts each face, and how much it shrinks the face.
struct FaceScales {
    VectorXcd centers;   ///< (F) centroids in the unit disk
    VectorXd log_ratio;  ///< (F) log(UV area / surface area) less the same number of an even map onto the whole disk
    VectorXd weights;    ///< (F) area on the surface
};

/// @param most roughly how many faces to pick, evenly; faces without area on the surface or in the map are left out
/// @param importance (V) 0 to 1, or empty; it multiplies areas on the surface by importance_factors
FaceScales face_scales(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv, Eigen::Index most,
                       const VectorXd& importance = {});

/// The automorphism f(z) = (z - a) / (1 - conj(a) z) with the most even texel density. It minimizes the variance of the
/// log ratio, weighted by surface area, plus a tenth of its squared mean; without the mean the whole map would often
/// shrink towards a point of the rim. f adds 2 log |f'| = 2 log(1 - |a|^2) - 4 log |1 - conj(a) z|. Gauss-Newton method
/// on a with a line search, from the present map. The identity where the variance would not fall.
/// @param distortion out: the root of the minimum
Moebius least_area_distortion(const FaceScales& scales, double& distortion);

}  // namespace koebe
