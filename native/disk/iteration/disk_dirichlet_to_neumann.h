// The Dirichlet-to-Neumann matrix of a round disk that fills a hole, in closed form for nodes at given angles.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// T(theta), (m, m), symmetric positive semidefinite, T 1 = 0. u' T u is the energy, the integral of |grad U|^2, of the
/// harmonic function U with the values u_a at theta_a, as equilateral faces between the nodes would give it. For m even
/// nodes, d apart, the mode cos(k theta) has energy pi k (1 - k d^2 / 6 + zeta(3) / (4 pi^3) (k d)^3) up to the fourth
/// order.
///
/// T = S' G S - P. G is the Galerkin matrix of |d/d theta| on periodic hat functions (docs/method.md, "The condensed
/// engine", M6 and M7): G_ab = W_(a-1)(b-1) - W_(a-1)b - W_a(b-1) + W_ab with W_ef = -(1/pi) times the mean of ln |2
/// sin((s - t) / 2)| for s on arc e = [theta_e, theta_(e+1)] and t on arc f. S corrects the error of hat functions, k^2
/// d^2 / 6 of a mode. P subtracts the segments between the circle and the chords, d_e / 6 (u_e - u_(e+1))^2 for each
/// (docs/numerics.md, "The angles", N2).
///
/// @param angles (m >= 2) radians, strictly increasing, spanning less than 2 pi
MatrixXd disk_dirichlet_to_neumann(const VectorXd& angles);

/// The disk of a loop with many nodes on fewer of them, each at a weighted mean of some.
struct CoarseDisk {
    MatrixXd stiffness;           ///< T of the means
    std::vector<VectorXd> means;  ///< weights of each mean, sum 1
};

/// Projects functions on the loop to hats on every few of its vertices by least squares, and takes T there. The flux of
/// a smooth function then reaches the loop's vertices by their arcs: a flux that alternates between nodes would leave
/// an error of the first order in their spacing. T is scaled so that exp(i theta), which the map of a circle domain is
/// on each loop, has the energy that it has for T(theta). A mean's weights are a hat times the arc around each vertex.
/// @param angles as above @param places per mean: its nodes in order, between the vertices of the means beside it
CoarseDisk coarse_disk(const VectorXd& angles, const std::vector<std::vector<Index>>& places);

/// sum over j >= 1 of cos(j t) / j^3, for any t.
double clausen_cosine_3(double t);

}  // namespace koebe
