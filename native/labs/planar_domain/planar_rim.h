// Boundary curves of planar domains: polygons, cubic Bezier curves, and smooth curves as Fourier sums.
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// A closed curve of the plane, in either direction. One of the two lists is empty.
struct PlanarRim {
    /// Cubic Bezier segments: a point, then three for each segment, the last one the first again. Any joint may be a
    /// corner. A straight side has its control points at the thirds.
    std::vector<Complex> curve = {};
    /// A smooth curve z(t) = sum_k fourier[k] exp(i (lowest + k) t), 0 <= t < 2 pi.
    std::vector<Complex> fourier = {};
    int lowest = 0;

    std::size_t pieces() const { return fourier.empty() ? curve.size() / 3 : 1; }
};

/// @param points the corners of a polygon, three at least, the first one not repeated
KOEBE_API PlanarRim polygon_rim(const std::vector<Complex>& points);
/// @param first_half_axis positive @param second_half_axis positive @param turn of the first axis, radians
KOEBE_API PlanarRim ellipse_rim(Complex center, double first_half_axis, double second_half_axis, double turn);

/// One smooth piece of a rim, with the parameter s from 0 to 1. Complex s: the continuation off the curve.
class RimPiece {
public:
    RimPiece(const PlanarRim& rim, std::size_t piece);

    Complex at(Complex s) const { return is_cubic_ ? begin_ + from_begin(s) : sum(s, 0); }
    Complex derivative(Complex s) const;
    Complex second_derivative(Complex s) const;
    /// at(s) - at(0) and at(1 - s) - at(1), exact to rounding for small s. Of cubic pieces.
    Complex from_begin(Complex s) const { return offset(arms_, s); }
    Complex from_end(Complex s) const { return offset(back_, s); }
    /// Unit tangents at the ends, each pointing into the piece. Of cubic pieces.
    Complex begin_direction() const { return direction(arms_); }
    Complex end_direction() const { return direction(back_); }
    bool is_cubic() const { return is_cubic_; }
    bool is_straight() const;

private:
    using Arms = std::array<Complex, 3>;  // the further control points, less the first one
    static Complex offset(const Arms& arms, Complex s);
    static Complex direction(const Arms& arms);
    Complex sum(Complex s, int derivative) const;

    bool is_cubic_;
    Complex begin_;
    Arms arms_{}, back_{};
    std::vector<Complex> fourier_;
    int lowest_ = 0;
};

/// A rim as a polygon, for tests of place and for distances.
struct RimPolygon {
    std::vector<Complex> points;
    std::vector<std::size_t> piece;  ///< of the edge that begins at the point
    double chord_error = 0.0;        ///< how far the rim is from its chords at most
    Complex center;                  ///< the deepest place inside

    double area() const;
    /// How often the polygon runs round a place that is not on it.
    int winding(Complex place) const;
    double distance(Complex place) const;
    /// The least t > 0 at which place + t direction meets an edge other than those from first to last; infinite if
    /// none.
    double hit(Complex place, Complex direction, std::size_t first, std::size_t last) const;
    /// The place inside with the greatest distance from the polygon, about.
    Complex deepest() const;
};

RimPolygon rim_polygon(const PlanarRim& rim);

/// @param rims in any order and direction
/// @return the rims, the outer one first, all counter-clockwise, and in `order` the number that each had
/// @throws InputError fewer than one rim, a rim with numbers that are not finite, without area, that meets itself or
/// another one, or that does not lie between the outer rim and the other holes (the rims listed as loops)
struct OrderedRims {
    std::vector<PlanarRim> rims;
    std::vector<RimPolygon> polygons;
    std::vector<int> order;
};
OrderedRims ordered_rims(const std::vector<PlanarRim>& rims);

}  // namespace koebe
