// Circle domains with known circles, triangulated, and conformal lifts of them (docs/benchmarks.md, "Accuracy on exact
// domains").
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <string>
#include <vector>

namespace koebe::test {

/// The unit disk without round holes, as a triangle mesh whose boundary vertices lie exactly on the circles.
struct CircleDomain {
    std::vector<Circle> circles;    ///< the unit circle first
    VectorXcd points;               ///< (V) vertices
    Triangles triangles;            ///< counter-clockwise
    std::vector<VertexLoop> loops;  ///< as `circles`; the domain on the left
};

/// Points of a circle, in order: even, or crowded at angle pi the more the nearer `skew` is to 1.
/// @param turn -1: clockwise
VectorXcd points_on(const Circle& circle, Index count, double skew = 0.0, int turn = 1);

/// Four holes of different sizes in the unit disk: five circles.
std::vector<Circle> five_circles();

/// Quasi-uniform mesh of about so many faces.
/// @param circles the unit circle first, the others inside it and apart
CircleDomain make_circle_domain(const std::vector<Circle>& circles, Index target_faces);

/// A hole of radius 0.25 around 0.4 + 0.2i, of about so many faces.
CircleDomain eccentric_annulus(Index faces);

/// Concentric rings of equal sectors between radius `inner` and 1, each cell cut in two.
CircleDomain make_round_annulus(double inner, Index sectors, Index rings);

enum class Lift { plane, polynomial, sphere, enneper };
inline constexpr Lift curved_lifts[] = {Lift::polynomial, Lift::sphere, Lift::enneper};
std::string to_string(Lift lift);

/// Positions in space under a conformal immersion: the plane itself; z + 0.3 z^2 + 0.05 i z^3; inverse stereographic
/// projection; Enneper's surface.
Vertices lift(const VectorXcd& points, Lift kind);

/// The domain of five circles, of about so many faces, and its lift.
struct LiftedDomain {
    LiftedDomain(Index faces, Lift kind)
        : domain(make_circle_domain(five_circles(), faces)), vertices(lift(domain.points, kind))
    {
    }

    CircleDomain domain;
    Vertices vertices;
};

/// The vertex nearest to a place.
Index vertex_near(const CircleDomain& domain, Complex place);

/// Largest relative error of the inversive distances of all pairs: what no Moebius map changes.
double inversive_distance_error(const std::vector<Circle>& found, const std::vector<Circle>& expected);

}  // namespace koebe::test
