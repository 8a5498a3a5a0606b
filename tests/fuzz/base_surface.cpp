#include "base_surface.h"

#include "random.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace koebe::fuzz {
namespace {

using Maker = Soup (*)(const BaseChoice&, Random&);

void add_quad(Soup& soup, Index a, Index b, Index c, Index d, bool other_diagonal)
{
    if (other_diagonal) {
        soup.faces.push_back({a, b, d});
        soup.faces.push_back({b, c, d});
    } else {
        soup.faces.push_back({a, b, c});
        soup.faces.push_back({a, c, d});
    }
}

/// n by m cells, closed to a tube in the first direction or not.
Soup lattice(std::size_t n, std::size_t m, bool closed, Random& random)
{
    Soup soup;
    const std::size_t columns = closed ? n : n + 1;
    for (std::size_t j = 0; j <= m; ++j)
        for (std::size_t i = 0; i < columns; ++i) {
            const double x = static_cast<double>(i), y = static_cast<double>(j);
            if (closed) {
                const double angle = 2.0 * std::numbers::pi * x / static_cast<double>(n);
                soup.points.push_back({std::cos(angle), std::sin(angle), y / static_cast<double>(n)});
            } else {
                soup.points.push_back({x, y, 0.0});
            }
        }
    const auto at = [&](std::size_t i, std::size_t j) { return static_cast<Index>(j * columns + i % columns); };
    for (std::size_t j = 0; j < m; ++j)
        for (std::size_t i = 0; i < n; ++i)
            add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), random.below(4) == 0);
    return soup;
}

void drop_face(Soup& soup, std::size_t face)
{
    std::swap(soup.faces[face], soup.faces.back());
    soup.faces.pop_back();
}

/// Takes out faces at random: the holes of a closed surface, or more of an open one.
void punch(Soup& soup, std::size_t count, Random& random)
{
    for (; count > 0 && soup.faces.size() > 2; --count) drop_face(soup, random.below(soup.faces.size()));
}

/// Takes out all faces around some vertices.
void punch_stars(Soup& soup, std::size_t count, Random& random)
{
    for (; count > 0 && soup.faces.size() > 8; --count) {
        const Index v = static_cast<Index>(random.below(soup.points.size()));
        Soup left = soup;
        std::erase_if(left.faces, [v](const auto& face) { return std::ranges::count(face, v) > 0; });
        if (left.faces.size() > 2) soup = std::move(left);
    }
}

Soup grid(const BaseChoice& choice, Random& random) { return lattice(choice.n, choice.m, false, random); }

Soup plate(const BaseChoice& choice, Random& random)
{
    Soup soup = lattice(choice.n, choice.m, false, random);
    punch_stars(soup, choice.holes, random);
    return soup;
}

Soup tube(const BaseChoice& choice, Random& random)
{
    Soup soup = lattice(std::max<std::size_t>(choice.n, 3), choice.m, true, random);
    punch(soup, choice.holes / 2, random);
    return soup;
}

Soup strip(const BaseChoice& choice, Random& random) { return lattice(choice.n * choice.m, 1, false, random); }

Soup ring(const BaseChoice& choice, Random& random)
{
    return lattice(std::max<std::size_t>(choice.n * choice.m, 3), 1, true, random);
}

Soup sphere(const BaseChoice& choice, Random& random)
{
    const std::size_t n = std::max<std::size_t>(choice.n, 3), m = std::max<std::size_t>(choice.m, 2);
    Soup soup = lattice(n, m, true, random);
    // The first and the last row become poles: their faces close up.
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
        const double latitude = std::numbers::pi * (static_cast<double>(v / n) / static_cast<double>(m) - 0.5);
        soup.points[v][0] *= std::cos(latitude);
        soup.points[v][1] *= std::cos(latitude);
        soup.points[v][2] = std::sin(latitude);
    }
    const Index last_row = static_cast<Index>(n * m);
    for (auto& face : soup.faces)
        for (Index& v : face) v = v < static_cast<Index>(n) ? 0 : std::min(v, last_row);
    std::erase_if(soup.faces,
                  [](const auto& face) { return face[0] == face[1] || face[1] == face[2] || face[2] == face[0]; });
    punch(soup, 1, random);
    punch_stars(soup, choice.holes, random);
    return soup;
}

/// A triangle or a tetrahedron, and vertices put into faces of it.
Soup stacked(std::size_t count, bool closed, Random& random)
{
    Soup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    soup.faces = {{0, 1, 2}};
    if (closed) {
        soup.points.push_back({0, 0, 1});
        soup.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    }
    for (; count > 0; --count) {
        const std::size_t f = random.below(soup.faces.size());
        const auto [a, b, c] = soup.faces[f];
        std::array<double, 3> middle;
        for (std::size_t k = 0; k < 3; ++k)
            middle[k] = (soup.points[a][k] + soup.points[b][k] + soup.points[c][k]) / (closed ? 2.5 : 3.0);
        const Index v = static_cast<Index>(soup.points.size());
        soup.points.push_back(middle);
        soup.faces[f] = {a, b, v};
        soup.faces.push_back({b, c, v});
        soup.faces.push_back({c, a, v});
    }
    return soup;
}

Soup stacked_disk(const BaseChoice& choice, Random& random)
{
    Soup soup = stacked(choice.n * choice.m, false, random);
    punch(soup, choice.holes / 2, random);
    return soup;
}

Soup stacked_sphere(const BaseChoice& choice, Random& random)
{
    Soup soup = stacked(choice.n * choice.m, true, random);
    punch(soup, 1 + choice.holes, random);
    return soup;
}

/// A strip with teeth.
Soup comb(const BaseChoice& choice, Random& random)
{
    Soup soup = lattice(2 * choice.n, choice.m, false, random);
    const double columns = static_cast<double>(2 * choice.n);
    std::erase_if(soup.faces, [&](const auto& face) {
        double x = 0.0, y = 0.0;
        for (const Index v : face) {
            x += soup.points[v][0] / 3.0;
            y += soup.points[v][1] / 3.0;
        }
        return y > 1.0 && x < columns && static_cast<int>(x) % 2 == 1;
    });
    return soup;
}

/// Triangles around one vertex, closed or not.
Soup fan(const BaseChoice& choice, Random&)
{
    Soup soup;
    const Index count = static_cast<Index>(std::max<std::size_t>(choice.n * choice.m, 3));
    const bool closed = choice.holes % 2 == 0;
    soup.points.push_back({0, 0, 0});
    for (Index i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / (count + (closed ? 0 : 1));
        soup.points.push_back({std::cos(angle), std::sin(angle), 0.0});
        if (i + 1 < count || closed) soup.faces.push_back({0, 1 + i, 1 + (i + 1) % count});
    }
    return soup;
}

/// The grid's quads as the only thing there is: a few triangles without any plan.
Soup few_faces(const BaseChoice& choice, Random& random)
{
    Soup soup;
    const std::size_t vertex_count = 3 + choice.n;
    for (std::size_t v = 0; v < vertex_count; ++v)
        soup.points.push_back({random.symmetric(), random.symmetric(), random.symmetric()});
    for (std::size_t f = 0; f < choice.m; ++f) {
        std::array<Index, 3> face;
        for (Index& v : face) v = static_cast<Index>(random.below(vertex_count));
        soup.faces.push_back(face);
    }
    return soup;
}

constexpr Maker makers[] = {grid, plate, tube, strip, ring, sphere, stacked_disk, stacked_sphere, comb, fan, few_faces};

/// Moves the points: lifted, uneven, rough, or anywhere.
void shape_points(Soup& soup, int shape, Random& random)
{
    for (auto& p : soup.points) switch (shape % 8) {
        case 1: p[2] += 0.1 * (p[0] * p[0] - p[1] * p[1]); break;
        case 2: p = {p[0] * p[0] * p[0], p[1], p[2] + 0.5 * std::sin(3.0 * p[0])}; break;
        case 3:
            for (double& x : p) x += 0.2 * random.symmetric();
            break;
        case 4: p = {random.symmetric(), random.symmetric(), random.symmetric()}; break;
        case 5: p = {p[0], 1e-3 * p[1], p[2]}; break;
        case 6: p = {std::exp(p[0]), std::exp(0.5 * p[1]) * p[1], p[2]}; break;
        case 7: p = {p[0] * (1.0 + 0.9 * p[2]), p[1] * (1.0 + 0.9 * p[2]), p[2] + random.symmetric()}; break;
        default: break;
        }
}

}  // namespace

int base_kind_count() { return static_cast<int>(std::size(makers)); }

Soup base_surface(const BaseChoice& choice)
{
    Random random(choice.seed);
    Soup soup = makers[choice.kind % base_kind_count()](choice, random);
    shape_points(soup, choice.shape, random);
    return soup;
}

}  // namespace koebe::fuzz
