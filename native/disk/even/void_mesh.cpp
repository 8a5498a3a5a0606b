#include "even/void_mesh.h"

#include "planar/boundary_crossings.h"
#include "planar/planar_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace koebe {
namespace {

constexpr double frame_margin = 0.25;  // of the extent, on each side
constexpr PlanarMeshOptions coarse{.gradation = 1.0, .smoothing = 0};

VectorXcd polygon_of(const VertexLoop& loop, const PlanarPoints& points)
{
    VectorXcd polygon(static_cast<Eigen::Index>(loop.size()));
    for (std::size_t i = 0; i < loop.size(); ++i)
        polygon[static_cast<Eigen::Index>(i)] = Complex(points(loop[i], 0), points(loop[i], 1));
    return polygon;
}

/// Its corners.
VectorXcd frame_of(const PlanarPoints& points)
{
    const Eigen::RowVector2d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
    const double margin = frame_margin * (high - low).maxCoeff();
    VectorXcd frame(4);
    frame << Complex(low[0] - margin, low[1] - margin), Complex(high[0] + margin, low[1] - margin),
        Complex(high[0] + margin, high[1] + margin), Complex(low[0] - margin, high[1] + margin);
    return frame;
}

}  // namespace

VoidMesh void_mesh(const std::vector<VertexLoop>& loops, const PlanarPoints& points)
{
    const VectorXcd frame = frame_of(points);
    const Index first_corner = static_cast<Index>(points.rows());
    std::vector<Complex> added(frame.begin(), frame.end());
    std::vector<Index> corners;
    /// @param names of the polygons' vertices; all others are new
    const auto add = [&](const PlanarMesh& mesh, const std::vector<Index>& names) {
        const Index known = static_cast<Index>(names.size());
        const Index first = first_corner + static_cast<Index>(added.size()) - known;
        for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
            for (const Index v : mesh.triangles.row(f)) corners.push_back(v < known ? names[v] : first + v);
        added.insert(added.end(), mesh.points.begin() + known, mesh.points.end());
    };
    const auto size = [&](const VertexLoop& loop) { return std::abs(enclosed_area(loop, points)); };
    const auto outer = std::ranges::max_element(loops, {}, size);
    std::vector<Index> names(4);
    std::iota(names.begin(), names.end(), first_corner);
    names.insert(names.end(), outer->begin(), outer->end());
    add(planar_mesh({frame, polygon_of(*outer, points)}, coarse), names);
    for (auto loop = loops.begin(); loop != loops.end(); ++loop)
        if (loop != outer) add(planar_mesh({polygon_of(*loop, points)}, coarse), *loop);

    VoidMesh mesh;
    mesh.points.resize(points.rows() + static_cast<Eigen::Index>(added.size()), 2);
    mesh.points.topRows(points.rows()) = points;
    for (std::size_t i = 0; i < added.size(); ++i)
        mesh.points.row(points.rows() + static_cast<Eigen::Index>(i)) << added[i].real(), added[i].imag();
    mesh.triangles = Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
    return mesh;
}

}  // namespace koebe
