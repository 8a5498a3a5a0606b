#include "lift/outline_places.h"

#include "transfer/nearest_triangle.h"

#include <cmath>

namespace koebe {

void locate_outlines(const FlatSheet& sheet, std::vector<DrawnOutline>& outlines)
{
    std::vector<Complex> shifts{0.0};
    for (const Complex period : sheet.periods) {
        const std::size_t n = shifts.size();
        for (const int times : {-1, 1, -2, 2})
            for (std::size_t i = 0; i < n; ++i) shifts.push_back(shifts[i] + static_cast<double>(times) * period);
    }
    const Index count = static_cast<Index>(sheet.triangles.rows());
    PlanarPoints corners(3 * count, 2), points(static_cast<Eigen::Index>(outlines.size()), 2);
    Triangles faces(count, 3);
    for (Index c = 0; c < 3 * count; ++c) {
        corners.row(c) << sheet.uv[c].real(), sheet.uv[c].imag();
        faces.data()[c] = c;
    }
    std::vector<double> nearest(outlines.size(), 1e-12);  // no outline starts that near to two copies' borders
    for (const Complex shift : shifts) {
        for (std::size_t i = 0; i < outlines.size(); ++i) {
            const Complex z = outlines[i].points[0] + shift;
            points.row(static_cast<Eigen::Index>(i)) << z.real(), z.imag();
        }
        const PlacesInTriangles places = nearest_triangles(corners, faces, points);
        for (std::size_t i = 0; i < outlines.size(); ++i) {
            if (outlines[i].face >= 0 || !(places.distance[static_cast<Eigen::Index>(i)] < nearest[i])) continue;
            outlines[i].face = places.face[static_cast<Eigen::Index>(i)];
            for (Complex& z : outlines[i].points) z += shift;
        }
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
