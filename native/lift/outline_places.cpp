#include "lift/outline_places.h"

#include "transfer/nearest_triangles.h"

#include <cmath>

namespace koebe {

std::vector<SheetPlace> places_in_sheet(const FlatSheet& sheet, const std::vector<Complex>& places, double near)
{
    std::vector<Complex> shifts{0.0};
    for (const Complex period : sheet.periods) {
        const std::size_t n = shifts.size();
        for (const int times : {-1, 1, -2, 2})
            for (std::size_t i = 0; i < n; ++i) shifts.push_back(shifts[i] + static_cast<double>(times) * period);
    }
    const Index count = static_cast<Index>(sheet.triangles.rows());
    PlanarPoints corners(3 * count, 2);
    Triangles faces(count, 3);
    for (Index c = 0; c < 3 * count; ++c) {
        corners.row(c) << sheet.uv[c].real(), sheet.uv[c].imag();
        faces.data()[c] = c;
    }
    std::vector<SheetPlace> found(places.size());
    for (const Complex shift : shifts) {
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
