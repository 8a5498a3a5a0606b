#include "lift/kept_sheet.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "lift/flat_sheet.h"
#include "lift/solid.h"
#include "surface/nearest_triangles.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace koebe {
namespace {

/// Faces that are no walls: they keep their direction when they move.
Triangles without_walls(const RaisedSheet& raised)
{
    const auto walls = std::ranges::count(raised.patch, 2);
    return raised.triangles.topRows(raised.triangles.rows() - static_cast<Eigen::Index>(walls));
}

/// As moved_along, with the surface's faces in the error.
Vertices moved_sheet(const Vertices& vertices, const Vertices& normals, const VectorXd& by, const Triangles& triangles,
                     const std::vector<Index>& face)
{
    try {
        return moved_along(vertices, normals, by, triangles);
    } catch (const InputError& error) {
        std::vector<Index> faces = values_at(face, error.elements());
        sort_unique(faces);
        throw InputError(error.what(), ElementKind::faces, std::move(faces));
    }
}

using EdgeKey = std::array<Index, 2>;  // the lower vertex first

EdgeKey edge_key(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// A face of the sheet at each of these edges, a raised one if there is. An edge from a vertex to itself stands for the
/// vertex.
std::map<EdgeKey, Index> faces_at(std::map<EdgeKey, Index> edges, const KeptSheet& sheet)
{
    const auto take = [&](Index a, Index b, Index f) {
        const auto at = edges.find(edge_key(a, b));
        if (at != edges.end() && (at->second < 0 || sheet.patch[f] == 1)) at->second = f;
    };
    for (Index h = 0; h < static_cast<Index>(sheet.triangles.size()); ++h) {
        take(origin(sheet.triangles, h), target(sheet.triangles, h), face_of(h));
        take(origin(sheet.triangles, h), origin(sheet.triangles, h), face_of(h));
    }
    return edges;
}

}  // namespace

KeptSheet kept_faces(const Overlay& overlay, const std::vector<char>& keep, Index original_count)
{
    const Index count = static_cast<Index>(overlay.vertices.rows());
    std::vector<Index> number(count, -1);
    KeptSheet sheet;
    std::vector<Index> corners;
    for (Index f = 0; f < static_cast<Index>(overlay.triangles.rows()); ++f) {
        if (!keep[f]) continue;
        for (int k = 0; k < 3; ++k) {
            number[overlay.triangles(f, k)] = 0;
            corners.push_back(overlay.triangles(f, k));
            sheet.uv.push_back(overlay.uv[3 * f + k]);
        }
        sheet.patch.push_back(overlay.in_pattern(f) ? 1 : 0);
        sheet.face.push_back(overlay.face[f]);
    }
    // Number the vertices that are left, in their order.
    std::vector<Index> used;
    for (Index v = 0; v < count; ++v) {
        if (number[v] < 0) continue;
        number[v] = static_cast<Index>(used.size());
        used.push_back(v);
        sheet.original.push_back(v < original_count ? v : -1);
    }
    sheet.vertices = overlay.vertices(used, Eigen::all);
    sheet.normals = overlay.normals(used, Eigen::all);
    for (Index& v : corners) v = number[v];
    sheet.triangles = Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
    return sheet;
}

RaisedSheet raised_sheet(const KeptSheet& sheet, const std::optional<double>& height)
{
    std::vector<Index> up = sheet.patch;
    if (!height) std::ranges::fill(up, 0);
    return raise_faces(sheet.triangles, sheet.uv, up, static_cast<Index>(sheet.vertices.rows()), height.value_or(0.0));
}

void finish_sheet(const KeptSheet& sheet, RaisedSheet raised, const LiftOptions& options, LiftResult& result)
{
    result.vertices = sheet.vertices(raised.source, Eigen::all);
    result.original.assign(raised.source.size(), -1);
    for (std::size_t v = 0; v < raised.source.size(); ++v)
        if (raised.height[static_cast<Eigen::Index>(v)] == 0.0) result.original[v] = sheet.original[raised.source[v]];
    if (options.height)
        result.vertices = moved_sheet(result.vertices, sheet.normals(raised.source, Eigen::all), raised.height,
                                      without_walls(raised), sheet.face);
    result.triangles = std::move(raised.triangles);
    result.uv = planar_points(raised.uv);
    result.patch = std::move(raised.patch);
}

void finish_solid(const KeptSheet& sheet, const RaisedSheet& raised, const LiftOptions& options, LiftResult& result)
{
    const double half = 0.5 * *options.thickness;
    if (options.height.value_or(0.0) <= -2.0 * half)
        throw InputError("the pattern is sunk through the solid: the height must be above minus the thickness");
    const Vertices outside =
        moved_sheet(sheet.vertices(raised.source, Eigen::all), sheet.normals(raised.source, Eigen::all),
                    (raised.height.array() + half).matrix(), without_walls(raised), sheet.face);
    const Vertices inside = moved_sheet(sheet.vertices, sheet.normals, VectorXd::Constant(sheet.vertices.rows(), -half),
                                        sheet.triangles, sheet.face);
    Solid solid = closed_solid(outside, raised.triangles, inside, sheet.triangles, raised.source);
    result.vertices = std::move(solid.vertices);
    result.triangles = std::move(solid.triangles);
    result.patch = std::move(solid.patch);
    result.original.assign(result.vertices.rows(), -1);
    const std::vector<Index> twin = pair_halfedges(result.triangles, static_cast<Index>(result.vertices.rows()));
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        if (twin[h] == no_twin || origin(result.triangles, h) != target(result.triangles, twin[h]))
            throw SolverError("the solid is not closed");
}

void tell_places(const KeptSheet& sheet, const Vertices& vertices, const Triangles& triangles,
                 const std::vector<Index>& source, std::size_t outer, LiftResult& result)
{
    const Index faces = static_cast<Index>(result.triangles.rows()), own = static_cast<Index>(sheet.face.size());
    const Index count = static_cast<Index>(source.size()), inner = static_cast<Index>(outer);
    const auto vertex = [&](Index f, int k) {  // of the sheet; the inner side has the sheet's own
        const Index v = result.triangles(f, k);
        return v < count ? source[v] : v - count;
    };
    const auto foot = [&](Index f) { return edge_key(vertex(f, 0), vertex(f, 1)); };  // of a wall, over one edge
    const auto is_wall = [&](Index f) { return f >= own && !(f >= inner && f < inner + own); };
    std::map<EdgeKey, Index> feet;
    for (Index f = 0; f < faces; ++f)
        if (is_wall(f)) feet.emplace(foot(f), -1);
    feet = faces_at(std::move(feet), sheet);
    result.weights.resize(3 * static_cast<Eigen::Index>(faces), 3);
    for (Index f = 0; f < faces; ++f) {
        const Index below = is_wall(f) ? feet.at(foot(f)) : f < own ? f : f - inner;
        result.face.push_back(sheet.face[below]);
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k) corners.row(k) = vertices.row(triangles(result.face[f], k));
        for (int k = 0; k < 3; ++k)
            result.weights.row(3 * f + k) = weights_in_triangle(sheet.vertices.row(vertex(f, k)), corners);
    }
}

}  // namespace koebe
