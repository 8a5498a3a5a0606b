#include "holes/fan_filling.h"

#include "core/counted.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "planar/planar_predicates.h"

#include <cmath>
#include <string>

namespace koebe {
namespace {

/// Positions times a power of two, so that the largest coordinate is about 1. Scaling is exact, and no sum overflows.
struct ScaledPositions {
    Vertices positions;
    int exponent = 0;  ///< the positions are the input's times 2^-exponent

    explicit ScaledPositions(const Vertices& given)
    {
        const double largest = given.size() > 0 ? given.cwiseAbs().maxCoeff() : 0.0;
        if (largest > 0.0) exponent = std::ilogb(largest);
        positions = given.unaryExpr([this](double x) { return std::ldexp(x, -exponent); });
    }
};

VectorXd edge_lengths_of(const Vertices& loop)
{
    VectorXd lengths(loop.rows());
    for (Eigen::Index i = 0; i < loop.rows(); ++i)
        lengths[i] = (loop.row((i + 1) % loop.rows()) - loop.row(i)).stableNorm();
    return lengths;
}

Eigen::RowVector3d mean_vertex(const Vertices& given)
{
    const ScaledPositions scaled(given);
    const Vertices& loop = scaled.positions;
    // Rounding may lead out of the box, where the largest numbers become infinite.
    const Eigen::RowVector3d center =
        loop.colwise().mean().cwiseMax(loop.colwise().minCoeff()).cwiseMin(loop.colwise().maxCoeff());
    return center.unaryExpr([&](double x) { return std::ldexp(x, scaled.exponent); });
}

}  // namespace

SurfacePatch fill_on_surface(const Vertices& loop)
{
    const Index m = static_cast<Index>(loop.rows());
    SurfacePatch patch{Vertices(m + 1, 3), Triangles(m, 3)};
    patch.vertices << loop, mean_vertex(loop);
    for (Index i = 0; i < m; ++i) patch.triangles.row(i) << (i + 1) % m, i, m;
    return patch;
}

PlanarMesh planar_patch(const VectorXcd& polygon)
{
    double length = 0.0;
    for (Eigen::Index i = 0; i < polygon.size(); ++i) length += distance(polygon[(i + 1) % polygon.size()], polygon[i]);
    return planar_patch(polygon, {.longest = length / static_cast<double>(polygon.size())});
}

PlanarMesh planar_patch(const VectorXcd& polygon, const PlanarMeshOptions& options)
{
    return planar_mesh({polygon}, options);
}

std::vector<Index> chosen_ranks(const Surface& surface, const std::optional<std::vector<Index>>& loops)
{
    std::vector<Index> ranks = numbers_below(surface.loops.size());
    if (!loops) return ranks;
    for (const Index k : *loops)
        if (k < 0 || k >= static_cast<Index>(surface.loops.size()))
            throw InputError("there is no boundary loop " + std::to_string(k) + ": the surface has " +
                                 counted(surface.loops.size(), "loop") + ", numbered from 0",
                             ElementKind::loops, {k});
    ranks = *loops;
    sort_unique(ranks);
    return ranks;
}

Index longest_loop(const Vertices& vertices, const Surface& surface)
{
    const Vertices positions = ScaledPositions(vertices).positions;
    Index longest = 0;
    double length = -1.0;
    for (std::size_t k = 0; k < surface.loops.size(); ++k)
        if (const double l = edge_lengths_of(positions(surface.loops[k], Eigen::all)).sum(); l > length) {
            length = l;
            longest = static_cast<Index>(k);
        }
    return longest;
}

std::vector<Warning> filling_warnings(const std::vector<Index>& faces)
{
    if (faces.empty()) return {};
    return {
        {WarningKind::reoriented_faces,
         counted(faces.size(), "face") + " kept in the other orientation: patches have the orientation of the others",
         faces}};
}

FilledSurface fill_holes(const Vertices& vertices, const Triangles& triangles,
                         const std::optional<std::vector<Index>>& loops)
{
    validate_arrays(vertices, triangles);
    const Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    const std::vector<Index> ranks = chosen_ranks(surface, loops);
    // Room for a vertex in each hole and a face at each of its edges.
    Eigen::Index rows = triangles.rows();
    for (const Index k : ranks) rows += static_cast<Eigen::Index>(surface.loops[k].size());
    FilledSurface filled{Vertices(vertices.rows() + static_cast<Eigen::Index>(ranks.size()), 3), Triangles(rows, 3),
                         std::vector<Index>(surface.triangles.rows(), -1), filling_warnings(surface.reoriented)};
    filled.vertices.topRows(vertices.rows()) = vertices;
    filled.triangles.topRows(triangles.rows()) = triangles;
    auto added = static_cast<Index>(vertices.rows());
    Eigen::Index row = triangles.rows();
    // The fan's corners come in the loop's order, its hub last.
    for (const Index k : ranks) {
        const VertexLoop& loop = surface.loops[k];
        const SurfacePatch patch = fill_on_surface(vertices(loop, Eigen::all));
        filled.vertices.row(added) = patch.vertices.row(patch.vertices.rows() - 1);
        const auto global = [&](Index i) { return i < static_cast<Index>(loop.size()) ? loop[i] : added; };
        for (const auto corners : patch.triangles.rowwise())
            filled.triangles.row(row++) << global(corners[0]), global(corners[1]), global(corners[2]);
        filled.label.insert(filled.label.end(), patch.triangles.rows(), k);
        ++added;
    }
    return filled;
}

}  // namespace koebe
