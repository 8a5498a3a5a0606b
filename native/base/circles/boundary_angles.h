// The angles of a loop's vertices on the rim of a round disk, up to an automorphism of the disk.
#pragma once

#include "core/types.h"

namespace koebe {

/// Angles from the flux through each boundary node. The flux density rho_b = q_b / l_b is the derivative of the
/// conjugate harmonic function along the loop; l_b is the length that belongs to node b. So the angle of an edge is its
/// length times its mean density, scaled to 2 pi in all (docs/numerics.md, "The angles", N1). The mean density is of
/// fourth order where edges and densities are about even. Elsewhere it is the mean of the densities at the ends, and is
/// of second order on uneven edges too. A running sum of q is of second order on even edges only.
///
/// A step shorter than 1e-5 of the mean step is raised to this length, so that nodes without flux keep distinct angles.
/// @param flux (m) of one sign up to round-off
/// @param edges (m) length on the surface of the edge from each node to the next
/// @param raised incremented by the number of steps that had to be raised
VectorXd angles_from_flux(const VectorXd& flux, const VectorXd& edges, int& raised);

/// Angles in proportion to the length along the loop, from 0.
VectorXd arc_length_angles(const VectorXd& edges);

/// Share of each vertex in the length of its loop, half of its two edges. The shares sum to 1.
VectorXd vertex_weights(const VectorXd& edges);

/// Moves the angles by the automorphism of the disk that brings their weighted mean point to 0 (the conformal
/// barycentre, Douady and Earle 1986; docs/method.md, M10), by Newton's method. Then it turns the angles. If
/// `reference` has the same size, they come as close to it as possible, else the first angle becomes 0. The result
/// increases, and its first angle is in [-pi, pi).
/// @param weights (m) positive, sum 1
VectorXd centered_angles(const VectorXd& angles, const VectorXd& weights, const VectorXd& reference = {});

/// exp(i theta).
VectorXcd unit_circle_points(const VectorXd& angles);

}  // namespace koebe
