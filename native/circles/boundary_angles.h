// The angles at which a loop's vertices sit on the rim of a round disk, defined up to an automorphism of the disk.
#pragma once

#include "core/types.h"

namespace koebe {

/// Angles from the flux through each boundary node. The flux density rho_b = q_b / l_b, l_b the length that the hat
/// function of node b stands for, is the derivative of the conjugate harmonic function along the loop; so an edge
/// takes its length times its mean density, scaled to 2 pi in all (docs/numerics.md, "The angles"): of fourth order
/// where edges and densities are about even, else the mean of its ends. The running sum of q itself agrees with the
/// latter on even edges; on uneven ones this keeps second order.
///
/// A step no longer than 1e-5 of the mean one is raised to that, so that nodes through which nothing flows keep
/// distinct angles.
/// @param flux (m) of one sign up to round-off
/// @param edges (m) length on the surface of the edge from each node to the next
/// @param raised incremented by the number of steps that had to be raised
VectorXd angles_from_flux(const VectorXd& flux, const VectorXd& edges, int& raised);

/// Angles in proportion to the length along the loop, from 0.
VectorXd arc_length_angles(const VectorXd& edges);

/// Share of each vertex in the length of its loop, half of its two edges: of sum 1.
VectorXd vertex_weights(const VectorXd& edges);

/// The representative of the angles, modulo automorphisms of the disk, whose weighted mean point is 0 (the conformal
/// barycentre, Douady and Earle 1986), by Newton's method; turned so that it lies closest to `reference` if that has
/// the same size, else so that the first angle is 0. Increasing, the first in [-pi, pi).
/// @param weights (m) positive, of sum 1
VectorXd centered_angles(const VectorXd& angles, const VectorXd& weights, const VectorXd& reference = {});

/// exp(i theta).
VectorXcd unit_circle_points(const VectorXd& angles);

}  // namespace koebe
