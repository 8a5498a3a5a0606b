#include "foldover/void_mesh.h"

#include "core/types.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_mesh.h"

#include <Eigen/LU>

#include <algorithm>
#include <numeric>

namespace koebe {
namespace {

constexpr double most_widened = 4.0;   // factor by which a narrow triangle wants to be wider
constexpr double frame_margin = 0.25;  // of the extent, on each side

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

VoidMesh void_mesh(const std::vector<VertexLoop>& loops, const PlanarPoints& points, VoidPoints wanted)
{
    const VectorXcd frame = frame_of(points);
    const Index first_corner = static_cast<Index>(points.rows());
    std::vector<Complex> added(frame.begin(), frame.end());
    std::vector<Index> corners;
    /// @param names of the polygons' vertices; all others are new
    const auto add = [&](const std::vector<VectorXcd>& polygons, const std::vector<Index>& names) {
        const PlanarMesh mesh =
            planar_mesh(polygons, {.gradation = 1.0, .smoothing = 0, .bare = wanted == VoidPoints::frame});
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
    add({frame, polygon_of(*outer, points)}, names);
    for (auto loop = loops.begin(); loop != loops.end(); ++loop)
        if (loop != outer) add({polygon_of(*loop, points)}, *loop);

    VoidMesh mesh;
    mesh.points.resize(points.rows() + static_cast<Eigen::Index>(added.size()), 2);
    mesh.points.topRows(points.rows()) = points;
    for (std::size_t i = 0; i < added.size(); ++i)
        mesh.points.row(points.rows() + static_cast<Eigen::Index>(i)) << added[i].real(), added[i].imag();
    mesh.triangles = Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
    return mesh;
}

void add_void(const VoidMesh& around, double weight, double gap, FoldoverProblem& problem)
{
    const Eigen::Index own = problem.triangles.rows(), vertices = problem.points.rows();
    std::vector<Index> kept;
    std::vector<Eigen::Matrix2d> shapes;
    for (Eigen::Index f = 0; f < around.triangles.rows(); ++f) {
        const auto row = around.triangles.row(f);
        Eigen::Matrix2d edges;
        edges << (around.points.row(row[1]) - around.points.row(row[0])).transpose(),
            (around.points.row(row[2]) - around.points.row(row[0])).transpose();
        if (!(edges.determinant() > 0.0)) continue;
        kept.push_back(static_cast<Index>(f));
        shapes.push_back(edges);
    }
    const Eigen::Index count = own + static_cast<Eigen::Index>(kept.size());
    if (problem.weight.size() == 0) problem.weight = VectorXd::Ones(own);
    problem.triangles.conservativeResize(count, 3);
    problem.weight.conservativeResize(count);
    problem.floor.conservativeResize(count);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const Eigen::Index f = own + static_cast<Eigen::Index>(i);
        problem.triangles.row(f) = around.triangles.row(kept[i]);
        problem.weight[f] = weight;
        // The wanted shape: as it is, or wider if it is a narrow one.
        Eigen::Matrix2d& shape = shapes[i];
        const Eigen::Vector2d a = shape.col(0), b = shape.col(1), c = b - a;
        const Eigen::Vector2d longest =
            a.norm() < b.norm() ? (b.norm() < c.norm() ? c : b) : (a.norm() < c.norm() ? c : a);
        const double width = shape.determinant() / longest.norm();
        const double wider = std::clamp(gap / width, 1.0, most_widened);
        const Eigen::Vector2d across = Eigen::Vector2d(-longest[1], longest[0]).normalized();
        shape += (wider - 1.0) * across * (across.transpose() * shape);
        problem.reference.push_back(shape);
        problem.floor[f] = std::min(gap / width, 0.5) / wider;
    }
    problem.points = around.points;
    problem.mobility.resize(static_cast<std::size_t>(around.points.rows()), FoldoverProblem::Mobility::free);
    for (int corner = 0; corner < 4; ++corner)
        problem.mobility[static_cast<std::size_t>(vertices) + corner] = FoldoverProblem::Mobility::held;
    problem.track_of.resize(problem.mobility.size(), -1);
}

}  // namespace koebe
