// Circle packing metrics: a circle at each vertex, and an intersection angle on each edge.
#pragma once

#include "core/types.h"
#include "surface/laplacian.h"

namespace koebe {

/// The allowed intersections of an edge's two circles.
enum class Packing {
    acute,      ///< Thurston's: they intersect at 0 to 90 degrees (Jin, Kim, Luo, Gu 2008); the metric is approximated
    inversive,  ///< they may be apart (Yang, Guo, Luo, Hu, Gu 2009; Luo 2011): the metric is reproduced exactly
};

struct CirclePacking {
    VectorXd log_radii;  ///< (V) of the circles that match the surface's metric
    EdgeLengths
        weights;  ///< (F, 3) per half-edge: inversive distance eta, the cosine of the angle where they intersect
    double changed = 0.0;  ///< largest relative change of an edge length by the approximation, dimensionless
};

/// The packing of a metric: l_ij^2 = r_i^2 + r_j^2 + 2 eta_ij r_i r_j. For acute packings r_i is the mean over the
/// corners at i of (l_ij + l_ik - l_jk) / 2, and eta is clamped to [0, 1]. For inversive packings r_i is their minimum,
/// which makes all eta >= 1.
/// @param lengths (F, 3) with strict triangle inequalities
CirclePacking circle_packing(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count, Packing kind);

/// (F, 3) edge lengths for other radii.
EdgeLengths packing_lengths(const Triangles& triangles, const CirclePacking& packing, const VectorXd& log_radii);

/// (F, 3) per half-edge: signed distance of the face's power centre from the edge, over the edge's length; 0 in
/// collapsed faces. It is the derivative of the angle at one end by the logarithm of the radius at the other
/// (Glickenstein 2005), so the Hessian of the Ricci energy is the Laplacian with these weights.
EdgeLengths power_weights(const Triangles& triangles, const EdgeLengths& lengths, const VectorXd& log_radii);

}  // namespace koebe
