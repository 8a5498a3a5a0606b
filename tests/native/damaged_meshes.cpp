#include "damaged_meshes.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace koebe::test {
namespace {

using std::numbers::pi;
using Cell = std::array<int, 3>;

Triangles to_triangles(const std::vector<Index>& corners)
{
    return Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
}

Vertices to_vertices(const std::vector<double>& positions)
{
    return Eigen::Map<const Vertices>(positions.data(), static_cast<Eigen::Index>(positions.size() / 3), 3);
}

/// The faces between cells that are in the set and cells that are not.
NamedMesh cube_surface(const std::set<Cell>& cells, std::string name)
{
    std::map<Cell, Index> number;
    std::vector<double> positions;
    std::vector<Index> corners;
    const auto vertex = [&](const Cell& p) {
        const auto [place, fresh] = number.emplace(p, static_cast<Index>(number.size()));
        if (fresh) positions.insert(positions.end(), {double(p[0]), double(p[1]), double(p[2])});
        return place->second;
    };
    for (const Cell& cell : cells)
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) {
                Cell beyond = cell;
                beyond[axis] += side == 1 ? 1 : -1;
                if (cells.count(beyond)) continue;
                const int s = (axis + 1) % 3, t = (axis + 2) % 3;
                std::array<Index, 4> quad;
                for (int k = 0; k < 4; ++k) {
                    Cell p = cell;
                    p[axis] += side;
                    p[s] += k == 1 || k == 2 ? 1 : 0;
                    p[t] += k >= 2 ? 1 : 0;
                    quad[k] = vertex(p);
                }
                if (side == 0) std::swap(quad[1], quad[3]);
                corners.insert(corners.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
            }
    return {std::move(name), to_vertices(positions), to_triangles(corners)};
}

/// Cells (i, j) of a grid, two triangles each; vertex(i, j) says how the grid is glued.
Triangles grid(Index m, Index n, const std::function<Index(Index, Index)>& vertex)
{
    std::vector<Index> corners;
    for (Index i = 0; i < m; ++i)
        for (Index j = 0; j < n; ++j) {
            const Index a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            corners.insert(corners.end(), {a, b, c, a, c, d});
        }
    return to_triangles(corners);
}

Index below(Index limit, std::mt19937& random) { return static_cast<Index>(random() % static_cast<unsigned>(limit)); }

}  // namespace

NamedMesh plate_with_holes(int holes, int refined)
{
    std::set<Cell> cells;
    for (int x = 0; x < (2 * holes + 1) * refined; ++x)
        for (int y = 0; y < 3 * refined; ++y)
            for (int z = 0; z < refined; ++z)
                if (!((x / refined) % 2 == 1 && y / refined == 1)) cells.insert({x, y, z});
    return cube_surface(cells, "plate with " + std::to_string(holes) + " holes");
}

NamedMesh coarse_torus(Index m, Index n, double thick)
{
    Vertices vertices(m * n, 3);
    for (Index i = 0; i < m; ++i)
        for (Index j = 0; j < n; ++j) {
            const double a = 2.0 * pi * i / m, b = 2.0 * pi * j / n, r = 1.0 + thick * std::cos(b);
            vertices.row(i * n + j) << r * std::cos(a), r * std::sin(a), thick * std::sin(b);
        }
    return {"torus", vertices, grid(m, n, [=](Index i, Index j) { return (i % m) * n + j % n; })};
}

NamedMesh coarse_sphere(Index rings, Index sectors)
{
    Vertices vertices(2 + (rings - 1) * sectors, 3);
    vertices.row(0) << 0.0, 0.0, 1.0;
    vertices.row(1) << 0.0, 0.0, -1.0;
    for (Index i = 1; i < rings; ++i)
        for (Index j = 0; j < sectors; ++j) {
            const double a = pi * i / rings, b = 2.0 * pi * j / sectors;
            vertices.row(2 + (i - 1) * sectors + j) << std::sin(a) * std::cos(b), std::sin(a) * std::sin(b),
                std::cos(a);
        }
    const auto vertex = [=](Index i, Index j) { return 2 + (i - 1) * sectors + j % sectors; };
    std::vector<Index> corners;
    for (Index j = 0; j < sectors; ++j) {
        corners.insert(corners.end(), {0, vertex(1, j), vertex(1, j + 1)});
        for (Index i = 1; i + 1 < rings; ++i) {
            const Index a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            corners.insert(corners.end(), {a, b, c, a, c, d});
        }
        corners.insert(corners.end(), {1, vertex(rings - 1, j + 1), vertex(rings - 1, j)});
    }
    return {"sphere", vertices, to_triangles(corners)};
}

NamedMesh moebius_band(Index cells, Index width)
{
    Vertices vertices(cells * (width + 1), 3);
    for (Index i = 0; i < cells; ++i)
        for (Index j = 0; j <= width; ++j) {
            const double a = 2.0 * pi * i / cells, s = 0.6 * (double(j) / width - 0.5), r = 1.0 + s * std::cos(a / 2);
            vertices.row(i * (width + 1) + j) << r * std::cos(a), r * std::sin(a), s * std::sin(a / 2);
        }
    return {"Moebius band", vertices,
            grid(cells, width, [=](Index i, Index j) { return i == cells ? width - j : i * (width + 1) + j; })};
}

NamedMesh klein_bottle(Index m, Index n)
{
    Vertices vertices(m * n, 3);
    for (Index i = 0; i < m; ++i)
        for (Index j = 0; j < n; ++j) {
            const double a = 2.0 * pi * i / m, b = 2.0 * pi * j / n;
            const double r = 2.0 + std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
            vertices.row(i * n + j) << r * std::cos(a), r * std::sin(a),
                std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b);
        }
    return {"Klein bottle", vertices,
            grid(m, n, [=](Index i, Index j) { return i == m ? (n - j) % n : i * n + j % n; })};
}

NamedMesh random_cubes(int side, double share, std::mt19937& random)
{
    std::set<Cell> cells{{0, 0, 0}};
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z)
                if (random() % 1000 < 1000 * share) cells.insert({x, y, z});
    return cube_surface(cells, "random cubes");
}

NamedMesh random_soup(Index vertices, Index faces, std::mt19937& random)
{
    NamedMesh soup{"random soup", Vertices(vertices, 3), Triangles(faces, 3)};
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    for (Eigen::Index i = 0; i < soup.vertices.size(); ++i) soup.vertices.data()[i] = place(random);
    for (Eigen::Index i = 0; i < soup.triangles.size(); ++i) soup.triangles.data()[i] = below(vertices, random);
    return soup;
}

NamedMesh damaged(NamedMesh mesh, std::mt19937& random)
{
    mesh.name = "damaged " + mesh.name;
    std::vector<Index> corners;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        std::array<Index, 3> face{mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2)};
        const auto fate = random() % 40;
        if (fate == 0) continue;
        if (fate == 1) std::swap(face[1], face[2]);
        if (fate == 2) corners.insert(corners.end(), {face[1], face[0], face[2]});
        if (fate == 3) corners.insert(corners.end(), {face[0], face[0], face[2]});
        corners.insert(corners.end(), face.begin(), face.end());
    }
    const Index count = static_cast<Index>(mesh.vertices.rows());
    for (int glued = static_cast<int>(random() % 4); glued > 0; --glued) {
        const Index from = below(count, random), to = below(count, random);
        for (Index& v : corners)
            if (v == from) v = to;
    }
    mesh.triangles = to_triangles(corners);
    return mesh;
}

NamedMesh together(const NamedMesh& a, const NamedMesh& b)
{
    NamedMesh both{a.name + " and " + b.name, Vertices(a.vertices.rows() + b.vertices.rows(), 3), {}};
    both.vertices << a.vertices, b.vertices;
    std::vector<Index> corners;
    for (Eigen::Index f = 0; f < std::max(a.triangles.rows(), b.triangles.rows()); ++f) {
        if (f < a.triangles.rows())
            for (int k = 0; k < 3; ++k) corners.push_back(a.triangles(f, k));
        if (f < b.triangles.rows())
            for (int k = 0; k < 3; ++k) corners.push_back(b.triangles(f, k) + static_cast<Index>(a.vertices.rows()));
    }
    both.triangles = to_triangles(corners);
    return both;
}

NamedMesh random_mesh(std::uint32_t seed)
{
    std::mt19937 random(seed);
    const auto any = [&random](Index from, Index to) { return from + below(to - from + 1, random); };
    NamedMesh mesh;
    switch (random() % 9) {
    case 0: mesh = random_soup(any(3, 30), any(1, 60), random); break;
    case 1: mesh = random_cubes(any(1, 4), 0.5, random); break;
    case 2: mesh = coarse_torus(any(3, 12), any(3, 9), 0.3); break;
    case 3: mesh = coarse_sphere(any(2, 8), any(3, 10)); break;
    case 4: mesh = moebius_band(any(3, 12), any(1, 4)); break;
    case 5: mesh = klein_bottle(any(3, 10), any(3, 8)); break;
    case 6: mesh = plate_with_holes(any(0, 5)); break;
    case 7: mesh = together(coarse_sphere(any(2, 5), any(3, 6)), coarse_torus(any(3, 6), any(3, 6), 0.4)); break;
    default: mesh = random_cubes(any(2, 3), 0.8, random); break;
    }
    return random() % 3 == 0 ? mesh : damaged(std::move(mesh), random);
}

}  // namespace koebe::test
