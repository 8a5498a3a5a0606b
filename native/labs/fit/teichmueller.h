// The extremal quasiconformal map of one circle domain to another, and the Teichmueller distance.
#pragma once

#include "circles/circle.h"
#include "core/api.h"
#include "execution/execution.h"
#include "transfer/landmark_map.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace koebe {

struct TeichmuellerMap {
    double dilatation = 1.0;  ///< K of the extremal map, near the root of `lower` and the map's mean K along q
    double lower = 1.0;       ///< no map in the same isotopy class has a smaller largest dilatation, up to the mesh
    double largest = 1.0;     ///< largest dilatation of a face of this map, so K is at most this, up to the mesh
    VectorXd mu;              ///< (F) |mu| of each face, from a's circle domain; 1: a face without area there
    PlanarPoints uv;          ///< (V, 2) of a's vertices in b's domain
    std::vector<int> match;   ///< b's loop for each of a's
    bool straight = true;     ///< whether centres went straight; else on bows, which chose the isotopy class
    std::size_t refused = 0;  ///< matches that may have a smaller K, but for which no map was found
    std::size_t flipped = 0;  ///< faces that were upright in a's domain, and are not in b's
    int newton_steps = 0;

    double distance() const { return 0.5 * std::log(dilatation); }
};

/// A point of a's surface, and the place in b's domain where it goes.
struct HeldPoint {
    SurfacePoint point;
    Complex place;
};

struct TeichmuellerOptions {
    std::vector<int> match = {};  ///< b's loop for each of a's, 0 for 0; empty: match_loops, or align_by_landmarks
    std::vector<HeldPoint> landmarks = {};
    bool least_match = false;  ///< the match with the least K of all that keep the outer loops together
};

/// The map of a's domain to b's with the least largest |mu|, as near as the mesh comes: circles move to their places
/// without meeting (bend_between), and then sums of |mu| to rising powers are minimized, up to the 128th. Rim vertices
/// slide. K is bounded by Reich's and Strebel's inequalities (dilatation_bounds), and for a ring by the two moduli.
/// The Teichmueller distance is log(K) / 2. How holes wind around each other is chosen as in fit_circles.
///
/// Landmarks are held (map_with_landmarks), also those on rims. Four on the rim of a surface without holes are the
/// corners of a quadrilateral: then K is the ratio of the two moduli, and the affine map between two rectangles is
/// extremal.
///
/// With `least_match` the maps of all matches are computed whose K may be least. A map of dilatation K extends by
/// reflections to a map of the sphere of dilatation K. So no separation of two circles (conformal_separation) changes
/// by more than the factor K, and a match whose separations do is left out.
/// @param a all loops with circles of its own @param b circles, the unit circle first
/// @throws InputError different numbers of loops, not a circle domain, circles that are not the surface's own, not a
/// permutation, a radius under 1e-6, landmarks as map_with_landmarks; more than 100 matches may have the least K;
/// SolverError no such map was found (a's loops or the landmarks listed); Cancelled
KOEBE_API TeichmuellerMap teichmueller_map(const MappedSurface& a, const std::vector<Circle>& b,
                                           const TeichmuellerOptions& options, ExecutionContext& context);

}  // namespace koebe
