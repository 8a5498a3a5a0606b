// How far a map is from conformal, judged on the input's own triangles.
#pragma once

#include "conformal/result.h"

namespace koebe {

/// Angle error, Beltrami coefficient, area distortion, conformal energy and flips of a map into the plane.
///
/// Angles are compared corner by corner, |angle in UV - angle on the surface|; corners of faces that have no area on
/// the surface have no angle and are left out. mu = f_zbar / f_z of the linear map of each face. The conformal energy
/// is the Dirichlet energy of the map less its area, 1/2 sum cot |dz|^2 - area (Pinkall and Polthier 1993).
/// Flips are judged with u and v rounded to 32-bit floats, in the UV convention u = (1 + x) / 2, v = (1 + y) / 2.
/// @param vertices (V, 3) @param triangles (F, 3) @param uv (V, 2) points of the unit disk
Distortion measure_distortion(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv);

/// Faces whose signed area is not positive with u and v rounded to 32-bit floats and the area computed in 64 bits.
std::vector<Index> flipped_faces(const Triangles& triangles, const PlanarPoints& uv);

}  // namespace koebe
