// A map's angles against those of the surface, corner by corner, and what each vertex of it may do.
#pragma once

#include "circles/circle.h"
#include "mesh/topology.h"
#include "planar/planar_predicates.h"

#include <cmath>
#include <span>
#include <vector>

namespace koebe {

/// The error of an angle: arg w, w its image turned back by the angle on the surface. Where it is small, by the series
/// of the arctangent, 1e-8 of it off at worst: several times as fast as the library's.
inline double angle_of(Complex w)
{
    const double x = w.real(), y = w.imag();
    if (!(std::abs(y) < 0.25 * x)) return std::atan2(y, x);
    const double t = y / x, s = t * t;
    return t * (1.0 + s * (-1.0 / 3.0 + s * (1.0 / 5.0 + s * (-1.0 / 7.0 + s * (1.0 / 9.0 - s / 11.0)))));
}

inline Complex times_conjugate(Complex a, Complex b)  // a b*, without the library's care for infinities
{
    return {a.real() * b.real() + a.imag() * b.imag(), a.imag() * b.real() - a.real() * b.imag()};
}

class AngleMap {
public:
    enum class Mobility : char { held, sliding, free };

    /// A corner of a face, seen from its vertex: where its own error stands, those of the next and the previous corner,
    /// and their vertices.
    struct Corner {
        Index own, after, before;
        Index next, previous;
    };

    /// What a sliding vertex keeps to: its circle, and its place between two vertices of the loop.
    struct Slide {
        Circle circle;
        Index next, previous;  // those on the circle
        double sense;          // 1 where the loop runs counter-clockwise
    };

    /// Errors of a face's corners, the second and third in the order in which the first sees them.
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
    /// Whether the face has an area on the surface, and so angles.
    bool counts(const Corner& corner) const { return turn_[corner.own] != 0.0; }

    /// Of the face of a corner whose edges lead to the next vertex and to the previous one.
    FaceErrors face_errors(const Corner& corner, Complex to_next, Complex to_previous) const
    {
        const double own = angle_of(times_conjugate(times_conjugate(to_previous, to_next), turn_[corner.own]));
        const double after =
            angle_of(times_conjugate(times_conjugate(to_next, to_next - to_previous), turn_[corner.after]));
        return {own, after, -own - after};
    }

    /// Twice the area below which a face may not fall: what rounding to 32 bits can take, or what it has.
    double least_area(const Corner& corner) const { return least_area_[corner.own / 3]; }

    /// The place at a turn of a sliding vertex along its circle, length / radius.
    Complex slid(Index v, double length) const;
    const Slide& slide(Index v) const { return slides_[slide_of_[v]]; }
    void let_slide(Index v, const Slide& slide);

    /// Takes the errors anew. @return the sum of their sizes
    double measure();
    Index corner_count() const { return counted_; }

    std::vector<Complex> points;     // (V)
    std::vector<double> error;       // (3F) radians
    std::vector<Mobility> mobility;  // (V) free from the start

private:
    const Triangles& triangles_;
    std::vector<Complex> turn_;  // (3F) of length 1, by the angle on the surface; 0 where there is none
    std::vector<double> least_area_;
    std::vector<Index> begin_;
    std::vector<Corner> corners_;
    std::vector<Index> slide_of_;
    std::vector<Slide> slides_;
    Index counted_ = 0;
};

}  // namespace koebe
