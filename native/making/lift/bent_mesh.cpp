#include "lift/bent_mesh.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "lift/outline_places.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace koebe {
namespace {

constexpr double at_rim = 1e-9;  // in the UVs: so far outside a vertex is on the rim
constexpr Eigen::Index most_bent_faces = 4'000'000;

using Corners = std::array<Complex, 3>;
using NumberedBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, Index>;

NumberedBox box_of(const std::vector<Complex>& points, Index number)
{
    const PlaneBox box = box_around(points);
    double low[2] = {box.low.real(), box.low.imag()}, high[2] = {box.high.real(), box.high.imag()};
    return {low, high, number};
}

/// Whether a segment lies over a triangle, more than at its rim: no line separates the two.
bool lies_over(const Corners& face, Complex p, Complex q)
{
    const auto separates = [&](Complex along) {
        const double length = std::abs(along);
        if (!(length > 0.0)) return false;
        const Complex axis = Complex(0.0, 1.0) * along / length;
        const auto [low, high] = std::minmax({dot(face[0], axis), dot(face[1], axis), dot(face[2], axis)});
        const auto [first, last] = std::minmax({dot(p, axis), dot(q, axis)});
        return high <= first + at_rim || last <= low + at_rim;
    };
    return !separates(face[1] - face[0]) && !separates(face[2] - face[1]) && !separates(face[0] - face[2]) &&
           !separates(q - p);
}

/// The number of the connected part of each vertex.
std::vector<Index> parts_of_mesh(const Triangles& triangles, Index count)
{
    std::vector<Index> part = numbers_below(count);
    const auto root = [&](Index v) {
        while (part[v] != v) v = part[v] = part[part[v]];
        return v;
    };
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 1; k < 3; ++k) part[root(triangles(f, k))] = root(triangles(f, 0));
    for (Index v = 0; v < count; ++v) part[v] = root(v);
    return part;
}

/// One copy of the mesh, flat.
class Copy {
public:
    Copy(const FlatSheet& sheet, std::vector<Complex> places, const Triangles& triangles,
         const std::vector<Index>& part)
        : sheet_(sheet),
          places_(std::move(places)),
          triangles_(triangles),
          part_(part),
          found_(places_in_sheet(sheet, places_, at_rim)),
          fits_(places_.size(), 1)
    {
        for (std::size_t v = 0; v < places_.size(); ++v)
            if (found_[v].face < 0 || !(sheet.twice_area(found_[v].face) > 0.0)) fits_[part[v]] = 0;
        refuse_borders();
    }

    bool fits(Index vertex) const { return fits_[part_[vertex]] != 0; }
    Complex place(Index vertex) const { return places_[vertex]; }
    const SheetPlace& in_sheet(Index vertex) const { return found_[vertex]; }

private:
    /// Takes out parts with faces over a border of the sheet, in every copy of the sheet.
    void refuse_borders()
    {
        std::vector<NumberedBox> faces;
        for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f)
            if (const Corners face = corners(f); fits(triangles_(f, 0)))
                faces.push_back(box_of({face[0], face[1], face[2]}, f));
        const std::vector<Complex> shifts = period_shifts(sheet_.periods);
        std::vector<std::array<Complex, 2>> edges;
        std::vector<NumberedBox> borders;
        for (Index h = 0; h < static_cast<Index>(sheet_.uv.size()); ++h) {
            if (!sheet_.border[h] || !(sheet_.twice_area(face_of(h)) > 0.0)) continue;
            for (const Complex shift : shifts) {
                edges.push_back({sheet_.uv[h] + shift, sheet_.uv[next_halfedge(h)] + shift});
                borders.push_back(box_of({edges.back()[0], edges.back()[1]}, static_cast<Index>(edges.size()) - 1));
            }
        }
        CGAL::box_intersection_d(faces.begin(), faces.end(), borders.begin(), borders.end(),
                                 [&](const NumberedBox& face, const NumberedBox& border) {
                                     const auto& [p, q] = edges[border.info()];
                                     if (lies_over(corners(face.info()), p, q))
                                         fits_[part_[triangles_(face.info(), 0)]] = 0;
                                 });
    }

    Corners corners(Index f) const
    {
        return {places_[triangles_(f, 0)], places_[triangles_(f, 1)], places_[triangles_(f, 2)]};
    }

    const FlatSheet& sheet_;
    std::vector<Complex> places_;
    const Triangles& triangles_;
    const std::vector<Index>& part_;
    std::vector<SheetPlace> found_;
    std::vector<char> fits_;  // by the part's number
};

/// Adds the parts of a copy that fit.
class Bending {
public:
    Bending(const FlatSheet& sheet, const Vertices& mesh, const Triangles& triangles, double unit)
        : sheet_(sheet), mesh_(mesh), triangles_(triangles), unit_(unit)
    {
    }

    void add(const Copy& copy, const std::vector<Index>& part)
    {
        std::vector<Index> missing;
        const std::vector<Index> number = add_vertices(copy);
        for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f) {
            if (!copy.fits(triangles_(f, 0))) {
                missing.push_back(part[triangles_(f, 0)]);
                for (int k = 0; k < 3; ++k)
                    if (const Index at = copy.in_sheet(triangles_(f, k)).face; at >= 0) left_at_.push_back(at);
                continue;
            }
            std::array<StoredPoint, 3> stored{};
            for (int k = 0; k < 3; ++k) {
                const Index v = triangles_(f, k);
                corners_.push_back(number[v]);
                uv_.push_back(copy.place(v));
                stored[k] = {as_stored(copy.place(v).real()), as_stored(copy.place(v).imag())};
            }
            if (StoredFace(stored[0], stored[1], stored[2]).flipped()) ++upside_down_;
            face_.push_back(f);
        }
        sort_unique(missing);
        left_out_ += static_cast<Index>(missing.size());
    }

    BentMesh result()
    {
        BentMesh bent;
        bent.vertices.resize(static_cast<Eigen::Index>(points_.size()), 3);
        for (std::size_t v = 0; v < points_.size(); ++v) bent.vertices.row(static_cast<Eigen::Index>(v)) = points_[v];
        bent.triangles =
            Eigen::Map<const Triangles>(corners_.data(), static_cast<Eigen::Index>(corners_.size() / 3), 3);
        bent.uv = std::move(uv_);
        bent.original = std::move(face_);
        bent.left_out = left_out_;
        sort_unique(left_at_);
        bent.left_at = std::move(left_at_);
        bent.upside_down = upside_down_;
        return bent;
    }

private:
    /// Lifts the vertices of faces that fit, in their order. @return their numbers in the result
    std::vector<Index> add_vertices(const Copy& copy)
    {
        std::vector<Index> number(mesh_.rows(), -1);
        for (Eigen::Index c = 0; c < triangles_.size(); ++c) number[triangles_.data()[c]] = 0;
        for (Index v = 0; v < static_cast<Index>(number.size()); ++v) {
            if (number[v] < 0 || !copy.fits(v)) continue;
            number[v] = static_cast<Index>(points_.size());
            points_.push_back(lifted(v, copy.in_sheet(v)));
        }
        return number;
    }

    Eigen::RowVector3d lifted(Index v, const SheetPlace& place) const
    {
        Eigen::RowVector3d normal = Eigen::RowVector3d::Zero();
        for (int k = 0; k < 3; ++k) normal += place.weights[k] * sheet_.normals.row(sheet_.triangles(place.face, k));
        const double length = normal.norm();
        if (length > 0.0) normal /= length;
        return sheet_.position_at(place.face, place.weights) + unit_ * mesh_(v, 2) * normal;
    }

    const FlatSheet& sheet_;
    const Vertices& mesh_;
    const Triangles& triangles_;
    double unit_;
    std::vector<Eigen::RowVector3d> points_;
    std::vector<Index> corners_, face_, left_at_;
    std::vector<Complex> uv_;
    Index left_out_ = 0, upside_down_ = 0;
};

}  // namespace

BentMesh bent_mesh(const FlatSheet& sheet, const Vertices& mesh, const Triangles& triangles, const PatternPlace& place,
                   double heights)
{
    const Complex turn = unit_turn(place.turn);
    std::vector<Complex> flat(static_cast<std::size_t>(mesh.rows())), used;
    for (std::size_t v = 0; v < flat.size(); ++v) {
        const Eigen::Index row = static_cast<Eigen::Index>(v);
        flat[v] = turn * Complex(mesh(row, 0), mesh(row, 1));
    }
    for (Eigen::Index c = 0; c < triangles.size(); ++c) used.push_back(flat[triangles.data()[c]]);
    // The mesh in the plane, and its frame in the UVs.
    const PlaneBox box = box_around(used);
    const double width = box.size().real();
    if (!(width > 0.0 && box.size().imag() > 0.0 && std::isfinite(width) && std::isfinite(box.size().imag())))
        throw InputError("the mesh has no width in x or no height in y, or is too large");
    const PlacedFrame frame =
        placed_frame(sheet, box.size().imag() / width, place, "mesh", place.repeats > 1 ? 1.0 : 0.9);
    if (triangles.rows() * static_cast<Eigen::Index>(frame.centres.size()) > most_bent_faces)
        throw InputError("the repeated mesh has over four million faces");

    // Bend a copy at each centre.
    const double size = frame.width * frame.scale;
    const std::vector<Index> part = parts_of_mesh(triangles, static_cast<Index>(mesh.rows()));
    Bending bending(sheet, mesh, triangles, heights * size / width);
    for (const Complex centre : frame.centres) {
        std::vector<Complex> places(flat.size(), centre);
        for (const Index v : std::vector<Index>(triangles.data(), triangles.data() + triangles.size()))
            places[v] = centre + frame.width / width * (flat[v] - box.middle());
        bending.add(Copy(sheet, std::move(places), triangles, part), part);
    }
    BentMesh bent = bending.result();
    bent.size = size;
    return bent;
}

}  // namespace koebe
