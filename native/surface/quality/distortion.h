// Measures how far a map is from conformal, on the input's own triangles.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "quality/angle_error.h"
#include "quality/verdict.h"

namespace koebe {

struct Beltrami {  ///< |mu| of the face-wise linear maps, dimensionless
    double mean = 0.0, max = 0.0;
};

/// log of (UV area / surface area), area-weighted on the surface, minus its mean: 0 is even texel density.
struct AreaDistortion {
    double log_sd = 0.0, log_min = 0.0, log_max = 0.0;
};

/// Measures of the map in 64 bits.
struct ComputedDistortion {
    AngleError angle_error_deg;
    Beltrami beltrami;
    AreaDistortion area;
    double conformal_energy = 0.0;  ///< Dirichlet energy - area of the map (0 iff conformal), unit-disk area units
};

/// Measures of the map as computed and as stored.
struct Distortion : ComputedDistortion, Verdict {};

/// Angle error, Beltrami coefficient, area distortion and conformal energy of a map into the plane.
///
/// Angles are compared corner by corner, |angle in UV - angle on the surface|; faces without area on the surface are
/// left out. mu = f_zbar / f_z of the linear map of each face. The conformal energy is the Dirichlet energy of the map
/// minus its area, 1/2 sum cot |dz|^2 - area (Pinkall and Polthier 1993).
/// @param vertices (V, 3) @param triangles (F, 3) @param uv (V, 2) points of the unit disk
KOEBE_API ComputedDistortion measure_distortion(const Vertices& vertices, const Triangles& triangles,
                                                const PlanarPoints& uv);

/// Measures a map with a point for each corner. @param corners (3F, 2) of corner 3 f + k of face f
ComputedDistortion measure_corner_distortion(const Vertices& vertices, const Triangles& triangles,
                                             const PlanarPoints& corners);

}  // namespace koebe
