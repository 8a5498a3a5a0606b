// The Dirichlet-to-Neumann matrix of a round disk with boundary nodes at given angles: a filled hole, in closed form.
#pragma once

#include "core/types.h"

namespace koebe {

/// T(theta), (m, m), symmetric positive semidefinite, T 1 = 0: u' T u = integral over the disk of |grad U|^2, U the
/// harmonic function whose boundary values are piecewise linear in the angle with u_a at theta_a.
///
/// T is the Galerkin matrix of |d/d theta| on periodic hat functions (docs/method.md, "The condensed
/// engine"): T_ab = W_(a-1)(b-1) - W_(a-1)b - W_a(b-1) + W_ab with W_ef = -(1/pi) times the mean of
/// ln |2 sin((s - t) / 2)| for s on arc e = [theta_e, theta_(e+1)] and t on arc f.
///
/// @param angles (m >= 2) radians, strictly increasing, spanning less than 2 pi
MatrixXd disk_dirichlet_to_neumann(const VectorXd& angles);

/// sum over j >= 1 of cos(j t) / j^3, for any t.
double clausen_cosine_3(double t);

}  // namespace koebe
