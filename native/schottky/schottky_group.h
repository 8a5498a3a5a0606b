// A cut surface in the plane, with the group that its cuts generate.
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
    VectorXcd z;                    ///< (V) of the cut surface, once its inside is known
    std::vector<VectorXcd> images;  ///< of each loop's vertices: holes on their circles; the two sides of a cut exactly
                                    ///< the generator apart
    std::vector<LinearFractional> generators;  ///< of each handle: from the first side of its cut to the second
    std::vector<double> misfit;        ///< of the two sides before they were made to fit: largest distance over the
                                       ///< loop's radius
    std::vector<Circle> holes;         ///< the first is the unit circle
    std::vector<Roundness> roundness;  ///< of the holes' images before they were put on their circles
    int outer_handle = -1;             ///< without holes: the one whose generator is z -> lambda z, |lambda| < 1

    /// Each loop shifted by itself.
    void shift(const std::vector<Complex>& shifts);
    /// Moved by a Moebius map of the plane, but for its holes, which have to be none or the unit disk's.
    void move(const LinearFractional& map);
};

/// @param images of the loops @throws SolverError no Moebius map fits the sides of a cut
SchottkyPlane schottky_plane(const HandleCut& cut, std::vector<VectorXcd> images);

/// A surface without holes: moved so that the fixed points of a handle's generator are 0 and infinity.
void make_annular(SchottkyPlane& plane, int handle);

/// Where the plane is cut instead: the generator takes the first circle to the second, the outside of one to the
/// inside of the other; of the outer handle the inside of the unit circle to that of a smaller one round 0.
struct FundamentalCircles {
    std::vector<std::array<Circle, 2>> pairs;  ///< of each handle
    bool apart = false;  ///< from each other and from the holes: then the plane outside them is a fundamental domain
                         ///< of the group (Klein's combination theorem; Maskit 1988, chapter VII)
};

/// Isometric circles of the generators (Ford 1929), which are equally large; where these meet, others round the same
/// cuts that keep apart, if there are such. Without holes the plane is scaled so that the outer one, which can have any
/// radius, keeps clear of the others.
FundamentalCircles fundamental_circles(SchottkyPlane& plane);

/// The automorphism of the unit disk nearest to the identity after which isometric circles are apart, of some that are
/// tried; the identity if there is none. @param plane with holes
Moebius nearest_with_room(const SchottkyPlane& plane);

/// Others round the same cuts: the first one of each pair so many times as large.
FundamentalCircles circles_beside(const SchottkyPlane& plane, const FundamentalCircles& circles, double factor);

/// What brings a point out of all circles.
GroupWord way_out(Complex at, const SchottkyPlane& plane, const FundamentalCircles& circles);

}  // namespace koebe
