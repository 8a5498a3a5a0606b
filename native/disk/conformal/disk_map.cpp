#include "conformal/disk_map.h"

#include "circles/circle_fit.h"
#include "circles/moebius.h"
#include "conformal/annulus_map.h"
#include "conformal/closed_disk.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "linear/sparse_cholesky.h"
#include "surface/deepest_vertex.h"
#include "surface/harmonic_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace koebe {
namespace {

struct Metric {
    Triangles triangles;
    EdgeLengths lengths;
    Index vertex_count = 0;
};

/// 1 for unused vertices and boundary vertices.
std::vector<char> outer_vertices(const Metric& surface, const VertexLoop& loop)
{
    std::vector<char> outer = unused_vertices(surface.triangles, surface.vertex_count);
    for (const Index v : loop) outer[v] = 1;
    return outer;
}

/// Adds a vertex at the centroid of the largest face.
Metric split_largest_face(const Metric& surface)
{
    Eigen::Index largest = 0;
    double area = -1.0;
    for (Eigen::Index f = 0; f < surface.lengths.rows(); ++f) {
        const double a = triangle_area(surface.lengths(f, 0), surface.lengths(f, 1), surface.lengths(f, 2));
        if (a > area) {
            area = a;
            largest = f;
        }
    }
    const Eigen::RowVector3d edge = surface.lengths.row(largest), squared = edge.array().square();
    Eigen::RowVector3d arm;  // from each corner to the centroid: two thirds of the median
    for (int k = 0; k < 3; ++k)
        arm[k] = std::sqrt(std::max(2.0 * (squared[k] + squared[(k + 2) % 3]) - squared[(k + 1) % 3], 0.0)) / 3.0;
    Metric result{Triangles(surface.triangles.rows() + 2, 3), EdgeLengths(surface.triangles.rows() + 2, 3),
                  surface.vertex_count + 1};
    result.triangles.topRows(surface.triangles.rows()) = surface.triangles;
    result.lengths.topRows(surface.triangles.rows()) = surface.lengths;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Index f = k == 0 ? largest : surface.triangles.rows() + k - 1;
        const int next = (k + 1) % 3;
        result.triangles.row(f) << surface.triangles(largest, k), surface.triangles(largest, next),
            surface.vertex_count;
        result.lengths.row(f) << edge[k], arm[next], arm[k];
    }
    return result;
}

struct Punctured {
    Metric rest;
    VertexLoop hole;  // the rest of the surface on its left
};

/// Removes the star of p shrunk by 2^-halvings: each face p a b keeps that many layers of two faces.
Punctured remove_shrunk_star(const Metric& surface, Index p, int halvings)
{
    std::vector<Eigen::Index> kept;
    std::vector<std::pair<Index, Index>> star;  // face and the corner of p
    for (Index f = 0; f < static_cast<Index>(surface.triangles.rows()); ++f) {
        const auto row = surface.triangles.row(f);
        const Index corner = row[0] == p ? 0 : row[1] == p ? 1 : row[2] == p ? 2 : -1;
        if (corner < 0)
            kept.push_back(f);
        else
            star.emplace_back(f, corner);
    }
    // Rank of the link's vertices, in star order: the vertex after p in each face.
    std::vector<Index> rank(surface.vertex_count, -1);
    for (std::size_t s = 0; s < star.size(); ++s)
        rank[surface.triangles(star[s].first, (star[s].second + 1) % 3)] = static_cast<Index>(s);
    const Index degree = static_cast<Index>(star.size());
    const auto vertex = [&](Index link_vertex, int layer) {
        return layer == 0 ? link_vertex : surface.vertex_count + (layer - 1) * degree + rank[link_vertex];
    };

    Punctured result;
    result.rest.vertex_count = surface.vertex_count + halvings * degree;
    result.rest.triangles.resize(
        static_cast<Eigen::Index>(kept.size()) + 2 * static_cast<Eigen::Index>(halvings) * degree, 3);
    result.rest.lengths.resize(result.rest.triangles.rows(), 3);
    Eigen::Index row = 0;
    for (const Eigen::Index f : kept) {
        result.rest.triangles.row(row) = surface.triangles.row(f);
        result.rest.lengths.row(row++) = surface.lengths.row(f);
    }
    std::vector<Index> before(degree);
    for (Index s = 0; s < degree; ++s) {
        const auto [f, k] = star[s];
        const Index a = surface.triangles(f, (k + 1) % 3), b = surface.triangles(f, (k + 2) % 3);
        const double pa = surface.lengths(f, k), ab = surface.lengths(f, (k + 1) % 3),
                     bp = surface.lengths(f, (k + 2) % 3);
        // From a to the middle of p b.
        const double diagonal = 0.5 * std::sqrt(std::max(2.0 * (pa * pa + ab * ab) - bp * bp, 0.0));
        for (int layer = 0; layer < halvings; ++layer) {
            const double scale = std::ldexp(1.0, -layer);
            const Index a0 = vertex(a, layer), b0 = vertex(b, layer), a1 = vertex(a, layer + 1),
                        b1 = vertex(b, layer + 1);
            result.rest.triangles.row(row) << a0, b0, b1;
            result.rest.lengths.row(row++) << scale * ab, 0.5 * scale * bp, scale * diagonal;
            result.rest.triangles.row(row) << a0, b1, a1;
            result.rest.lengths.row(row++) << scale * diagonal, 0.5 * scale * ab, 0.5 * scale * pa;
        }
        before[rank[b]] = a;
    }
    // The star turns counter-clockwise from a to b, so its outside has b to a on the left.
    const Index first = surface.triangles(star[0].first, (star[0].second + 1) % 3);
    for (Index v = first; result.hole.size() < static_cast<std::size_t>(degree); v = before[rank[v]])
        result.hole.push_back(vertex(v, halvings));
    return result;
}

}  // namespace

DiskMap disk_map(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count, const VertexLoop& loop,
                 const DiskMapOptions& options)
{
    if (options.halvings < 1) throw InputError("the removed star must be shrunk at least once");
    DiskMap map;
    Metric surface{triangles, lengths, vertex_count};
    const std::vector<char> outer = outer_vertices(surface, loop);
    if (options.center >= 0 && (options.center >= vertex_count || outer[options.center]))
        throw InputError("vertex " + std::to_string(options.center) + " is no inner vertex", ElementKind::vertices,
                         {options.center});
    // p: the vertex that goes to 0, or a point in the largest face if no vertex is inside.
    map.center = options.center >= 0 ? options.center : deepest_vertex(triangles, lengths, outer);
    Index p = map.center;
    if (p < 0) {
        surface = split_largest_face(surface);
        p = vertex_count;
    }
    // S without a small star D_n around p is an annulus, and its map nearly the one of S.
    const Punctured punctured = remove_shrunk_star(surface, p, options.halvings);
    const AnnulusMap annulus =
        annulus_map(punctured.rest.triangles, punctured.rest.lengths, punctured.rest.vertex_count, loop, punctured.hole,
                    {.backend = options.backend, .inside = false});
    if (!annulus.converged) throw SolverError("the discrete Yamabe flow of the annulus did not converge");
    map.hole_radius = annulus.inner_radius;
    // The rim stays, the inside is harmonic again with the star, and p goes to 0 exactly.
    const VectorXcd filled = harmonic_map(surface.triangles, surface.lengths, surface.vertex_count, loop,
                                          gather_loop(annulus.positions, loop));
    map.positions = Moebius{filled[p], Complex(1.0, 0.0)}(filled).head(vertex_count);
    for (const Index v : loop) map.positions[v] /= std::abs(map.positions[v]);

    const std::vector<char> unused = unused_vertices(triangles, vertex_count);
    for (Index v = 0; v < vertex_count; ++v)
        if (unused[v]) map.positions[v] = 0.0;
    if (options.inside) require_in_closed_disk(map.positions);
    return map;
}

}  // namespace koebe
