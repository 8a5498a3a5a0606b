// Compares a map's angles with the surface's, corner by corner, and knows how each vertex may move.
#pragma once

#include "circles/circle.h"
#include "mesh/topology.h"
#include "planar/planar_predicates.h"

#include <cmath>
#include <span>
#include <vector>

namespace koebe {

/// The error of an angle: arg w, where w is the corner's image turned back by the angle on the surface. Small errors
/// come from the series of the arctangent. The series is off by at most 1e-8 of the error, and several times as fast as
/// the library's function.
inline double angle_of(Complex w)
{
    const double x = w.real(), y = w.imag();
    if (!(std::abs(y) < 0.25 * x)) return std::atan2(y, x);
    const double t = y / x, s = t * t;
    return t * (1.0 + s * (-1.0 / 3.0 + s * (1.0 / 5.0 + s * (-1.0 / 7.0 + s * (1.0 / 9.0 - s / 11.0)))));
}

inline Complex times_conjugate(Complex a, Complex b)  // a b*, without the library's test for infinities
{
    return {a.real() * b.real() + a.imag() * b.imag(), a.imag() * b.real() - a.real() * b.imag()};
}

class AngleMap {
public:
    enum class Mobility : char { held, sliding, free };

    /// A corner of a face, seen from its vertex. It has the indices of its own error and of the errors of the next and
    /// the previous corner, and the vertices of these two corners.
    struct Corner {
        Index own, after, before;
        Index next, previous;
    };

    /// The circle of a sliding vertex, and its neighbours there.
    struct Slide {
        Circle circle;
        Index next, previous;  // the next and previous vertex on the circle
        double sense;          // 1 where the loop runs counter-clockwise, else -1
    };

    /// Errors of a face's corners, in the order seen from the first corner.
    struct FaceErrors {
        double own, after, before;
        double sum() const { return std::abs(own) + std::abs(after) + std::abs(before); }
    };

    AngleMap(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv);

    std::span<const Corner> star(Index v) const
    {
        return {corners_.data() + begin_[v], corners_.data() + begin_[v + 1]};
    }
    Index vertex_count() const { return static_cast<Index>(points.size()); }
    /// Whether the face has an area on the surface. Otherwise it has no angles.
    bool counts(const Corner& corner) const { return turn_[corner.own] != 0.0; }

    /// Errors of a corner's face whose edges lead to the next vertex and to the previous one.
    FaceErrors face_errors(const Corner& corner, Complex to_next, Complex to_previous) const
    {
        const double own = angle_of(times_conjugate(times_conjugate(to_previous, to_next), turn_[corner.own]));
        const double after =
            angle_of(times_conjugate(times_conjugate(to_next, to_next - to_previous), turn_[corner.after]));
        return {own, after, -own - after};
    }

    /// Twice the least area allowed for a face: what rounding to 32 bits can take, or its present area.
    double least_area(const Corner& corner) const { return least_area_[corner.own / 3]; }

    /// The place of a sliding vertex after it has moved along its circle. @param length of the way, over the radius
    Complex slid(Index v, double length) const;
    const Slide& slide(Index v) const { return slides_[slide_of_[v]]; }
    void let_slide(Index v, const Slide& slide);

    /// Computes all errors. @return the sum of their absolute values
    double measure();
    Index corner_count() const { return counted_; }

    std::vector<Complex> points;     // (V)
    std::vector<double> error;       // (3F) radians
    std::vector<Mobility> mobility;  // (V) free from the start

private:
    const Triangles& triangles_;
    std::vector<Complex> turn_;  // (3F) exp(i alpha) for a corner's angle alpha on the surface; 0 in faces without area
    std::vector<double> least_area_;
    std::vector<Index> begin_;
    std::vector<Corner> corners_;
    std::vector<Index> slide_of_;
    std::vector<Slide> slides_;
    Index counted_ = 0;
};

}  // namespace koebe
