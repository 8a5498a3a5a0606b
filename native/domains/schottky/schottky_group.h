// A cut surface in the plane, and the group that its cuts generate.
#pragma once

#include "circles/circle_fit.h"
#include "circles/moebius.h"
#include "schottky/group_word.h"
#include "schottky/handle_cut.h"
#include "schottky/linear_fractional.h"

#include <array>
#include <vector>

namespace koebe {

/// A map up to a Moebius map of the plane.
struct SchottkyPlane {
    VectorXcd z;                    ///< (V) of the cut surface, once its inside is computed
    std::vector<VectorXcd> images;  ///< of each loop's vertices: holes on their circles; the generator takes one side
                                    ///< of a cut exactly to the other
    std::vector<LinearFractional> generators;  ///< of each handle: takes the first side of its cut to the second
    std::vector<double> misfit;        ///< of the two sides before they were fitted: largest distance over the loop's
                                       ///< radius
    std::vector<Circle> holes;         ///< the first is the unit circle
    std::vector<Roundness> roundness;  ///< of the holes' images before they were put on their circles
    int outer_handle = -1;             ///< without holes: the handle whose generator is z -> lambda z, |lambda| < 1

    /// Shifts each loop by its own shift.
    void shift(const std::vector<Complex>& shifts);
    /// Moves the map by a Moebius map of the plane, except its holes: there are none, or the unit disk is kept.
    void move(const LinearFractional& map);
};

/// Fits circles and generators. @param images of the loops @throws SolverError no Moebius map fits the sides of a cut
SchottkyPlane schottky_plane(const HandleCut& cut, std::vector<VectorXcd> images);

/// Moves a surface without holes so that the fixed points of a handle's generator are 0 and infinity.
void make_annular(SchottkyPlane& plane, int handle);

/// Circles along which to cut the plane instead. A generator takes the first circle to the second, and the outside of
/// the first to the inside of the second. The outer handle's takes the inside of the unit circle to that of a smaller
/// one round 0.
struct FundamentalCircles {
    std::vector<std::array<Circle, 2>> pairs;  ///< of each handle
    bool apart = false;  ///< from each other and from the holes: then the plane outside the circles is a fundamental
                         ///< domain of the group (Klein's combination theorem; Maskit 1988, chapter VII)
};

/// Isometric circles of the generators (Ford 1929), which are equally large. Where these meet, other circles round the
/// same cuts that are apart, if there are any. Without holes the plane is scaled so that the outer circle, whose radius
/// is free, is clear of the others.
FundamentalCircles fundamental_circles(SchottkyPlane& plane);

/// Of some automorphisms of the unit disk after which isometric circles are apart, the one nearest to the identity; or
/// the identity. @param plane with holes
Moebius nearest_with_room(const SchottkyPlane& plane);

/// Other circles round the same cuts: the first of each pair is larger by a factor.
FundamentalCircles circles_beside(const SchottkyPlane& plane, const FundamentalCircles& circles, double factor);

/// The word that moves a point out of all circles.
GroupWord way_out(Complex at, const SchottkyPlane& plane, const FundamentalCircles& circles);

}  // namespace koebe
