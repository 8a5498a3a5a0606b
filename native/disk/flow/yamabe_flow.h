// Discrete Yamabe flow: finds the conformally equivalent metric with given curvature.
#pragma once

#include "flow/convex_newton.h"
#include "surface/laplacian.h"

#include <vector>

namespace koebe {

struct YamabeOptions {
    /// Flips edges that are not Delaunay at u, with lengths by Ptolemy's relation.
    bool flips = true;
    NewtonOptions newton;
};

struct YamabeResult {
    VectorXd u;               ///< (V) logarithmic scale factors, of mean 0
    Triangles triangles;      ///< (F, 3) the input's, except for flips
    EdgeLengths lengths;      ///< (F, 3) of the new metric
    std::vector<Index> twin;  ///< (3F)
    int flips = 0;
    std::vector<Index> collapsed;  ///< faces whose new lengths break the triangle inequality
    NewtonReport newton;
    bool converged = false;  ///< Newton's method converged and no face collapsed
};

/// The energy of the discrete conformal metrics l_ij exp((u_i + u_j) / 2): its gradient is the curvature less the
/// target, its Hessian the cotan Laplacian of the scaled lengths (Luo 2004; Springborn, Schroeder, Pinkall 2008,
/// section 4). With flips the triangulation is Delaunay in the scaled metric at every u, which removes the limits of a
/// fixed triangulation (Gu, Luo, Sun, Wu 2018; Gillespie, Springborn, Crane 2021). A flip takes the length of the new
/// diagonal from Ptolemy's relation, which commutes with the scaling, even where the triangle inequality fails. Only
/// inner edges flip, and no new edge joins a vertex to itself. The surface is not doubled along its boundary, so faces
/// on boundary edges may still collapse.
class YamabeEnergy : public ConvexEnergy {
public:
    /// @param target (V) wanted curvature, radians, sum 2 pi chi
    YamabeEnergy(const Triangles& triangles, const EdgeLengths& lengths, const VectorXd& target, bool flips);

    VectorXd gradient(const VectorXd& u) override;
    SparseMatrix hessian() const override;

    const Triangles& triangles() const { return triangles_; }
    const EdgeLengths& scaled_lengths() const { return scaled_; }  ///< at the point of the last gradient
    const std::vector<Index>& twin() const { return twin_; }
    int flips() const { return flips_; }

private:
    void make_delaunay(const VectorXd& u);
    double scaled_length(Index h, const VectorXd& u) const;
    double cosine(Index h, const VectorXd& u) const;

    Triangles triangles_;
    EdgeLengths lengths_, scaled_;
    std::vector<Index> twin_;
    std::vector<char> boundary_;
    VectorXd target_;
    bool flipping_;
    int flips_ = 0;
};

/// Minimizes that energy by Newton's method from u = 0. Without flips the energy, extended beyond the triangle
/// inequality, may have its minimum where faces have collapsed: then no metric of the class on this triangulation has
/// the curvature.
/// @param triangles (F, 3) oriented, manifold @param lengths (F, 3) in any unit, may break the triangle inequality
/// @throws InputError the target's size or sum is wrong; Cancelled. Non-convergence is reported.
YamabeResult yamabe_flow(const Triangles& triangles, const EdgeLengths& lengths, const VectorXd& target,
                         const YamabeOptions& options, ExecutionContext& context);

}  // namespace koebe
