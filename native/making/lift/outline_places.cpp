#include "lift/outline_places.h"

#include "surface/nearest_triangles.h"

#include <cmath>
#include <numeric>

namespace koebe {

std::vector<SheetPlace> places_in_sheet(const FlatSheet& sheet, const std::vector<Complex>& places, double near)
{
    const PlanarPoints corners = planar_points(sheet.uv);
    Triangles faces(sheet.triangles.rows(), 3);
    std::iota(faces.data(), faces.data() + faces.size(), 0);
    std::vector<SheetPlace> found(places.size());
    for (const Complex shift : period_shifts(sheet.periods)) {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < places.size(); ++i)
            if (found[i].face < 0) open.push_back(i);
        if (open.empty()) break;
        PlanarPoints points(static_cast<Eigen::Index>(open.size()), 2);
        for (std::size_t i = 0; i < open.size(); ++i) {
            const Complex z = places[open[i]] + shift;
            points.row(static_cast<Eigen::Index>(i)) << z.real(), z.imag();
        }
        const PlacesInTriangles nearest = nearest_triangles(corners, faces, points);
        for (std::size_t i = 0; i < open.size(); ++i) {
            const Eigen::Index row = static_cast<Eigen::Index>(i);
            if (nearest.distance[row] < near) found[open[i]] = {nearest.face[row], shift, nearest.weights.row(row)};
        }
    }
    return found;
}

void locate_outlines(const FlatSheet& sheet, std::vector<DrawnOutline>& outlines)
{
    std::vector<Complex> first;
    for (const DrawnOutline& outline : outlines) first.push_back(outline.points[0]);
    const std::vector<SheetPlace> places = places_in_sheet(sheet, first, 1e-12);  // none begins so near to two borders
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        outlines[i].face = places[i].face;
        for (Complex& z : outlines[i].points) z += places[i].shift;
    }
}

Complex first_copy(const std::vector<Complex>& periods, Complex z)
{
    if (periods.size() == 1) return z - std::floor(z.real() / periods[0].real()) * periods[0];
    if (periods.size() < 2) return z;
    const auto cross = [](Complex a, Complex b) { return a.real() * b.imag() - a.imag() * b.real(); };
    const double whole = cross(periods[0], periods[1]);
    return z - std::floor(cross(z, periods[1]) / whole) * periods[0] -
           std::floor(cross(periods[0], z) / whole) * periods[1];
}

}  // namespace koebe
