// A planar mesh between polygons, for bench/table_surfaces.py:
//
//   planar_mesher VERTICES     from standard input: the polygons, the outer one first, as [[[x, y], ...], ...]
//                              to standard output: {"points": [[x, y], ...], "triangles": [[a, b, c], ...]}
//
// The polygons' points come first and are kept. There are at least VERTICES vertices, and at most a few per cent more.
#include "planar/planar_mesh.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <complex>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace koebe;

namespace {

std::vector<VectorXcd> read_polygons(std::istream& in)
{
    std::vector<VectorXcd> polygons;
    for (const auto& points : nlohmann::json::parse(in)) {
        VectorXcd polygon(static_cast<Eigen::Index>(points.size()));
        for (std::size_t i = 0; i < points.size(); ++i)
            polygon[static_cast<Eigen::Index>(i)] =
                Complex(points[i].at(0).get<double>(), points[i].at(1).get<double>());
        polygons.push_back(polygon);
    }
    if (polygons.empty()) throw std::invalid_argument("no polygon");
    return polygons;
}

double enclosed_area(const VectorXcd& polygon)
{
    double doubled = 0.0;
    for (Eigen::Index i = 0; i < polygon.size(); ++i)
        doubled += std::imag(std::conj(polygon[i]) * polygon[(i + 1) % polygon.size()]);
    return std::abs(doubled) / 2.0;
}

/// The longest edge that the area suggests, made shorter or longer until the number of vertices fits.
PlanarMesh mesh_of_size(const std::vector<VectorXcd>& polygons, Index vertices)
{
    double area = enclosed_area(polygons.front());
    for (std::size_t k = 1; k < polygons.size(); ++k) area -= enclosed_area(polygons[k]);
    // Two equilateral faces of area sqrt(3)/4 h^2 for each vertex.
    double longest = std::sqrt(2.0 * area / (std::sqrt(3.0) * vertices));
    for (int tries = 0; tries < 12; ++tries) {
        PlanarMesh mesh = planar_mesh(polygons, {.longest = longest, .gradation = 1.0, .smoothing = 4});
        const double ratio = static_cast<double>(mesh.points.size()) / vertices;
        if (ratio >= 1.0 && ratio < 1.03) return mesh;
        longest *= std::sqrt(ratio / 1.015);
    }
    throw std::runtime_error("no edge length gives so many vertices");
}

nlohmann::ordered_json to_json(const PlanarMesh& mesh)
{
    nlohmann::ordered_json json{{"points", nlohmann::json::array()}, {"triangles", nlohmann::json::array()}};
    for (const Complex& z : mesh.points) json["points"].push_back({z.real(), z.imag()});
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        json["triangles"].push_back({mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2)});
    return json;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        if (argc != 2) throw std::invalid_argument("usage: planar_mesher VERTICES <polygons.json");
        const auto vertices = static_cast<Index>(std::stol(argv[1]));
        std::cout << to_json(mesh_of_size(read_polygons(std::cin), vertices)).dump() << '\n';
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
    return 0;
}
