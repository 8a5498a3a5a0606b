#include "cut/left_out_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace koebe {
namespace {

using Corners = std::array<Index, 3>;

bool is_degenerate(const Triangles& triangles, Index f)
{
    return triangles(f, 0) == triangles(f, 1) || triangles(f, 1) == triangles(f, 2) ||
           triangles(f, 2) == triangles(f, 0);
}

Corners sorted_corners(const Triangles& triangles, Index f)
{
    Corners corners{triangles(f, 0), triangles(f, 1), triangles(f, 2)};
    std::ranges::sort(corners);
    return corners;
}

/// (F) the first face with the same vertices, perhaps the face itself.
std::vector<Index> first_alike(const Triangles& triangles)
{
    std::vector<Index> order;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        if (!is_degenerate(triangles, f)) order.push_back(f);
    std::ranges::stable_sort(
        order, [&](Index f, Index g) { return sorted_corners(triangles, f) < sorted_corners(triangles, g); });
    std::vector<Index> first(static_cast<std::size_t>(triangles.rows()));
    std::iota(first.begin(), first.end(), 0);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (sorted_corners(triangles, order[i]) == sorted_corners(triangles, order[i - 1]))
            first[order[i]] = first[order[i - 1]];
    return first;
}

/// Removes the duplicate's mark from polygons that do not duplicate one other polygon as a whole.
void keep_partial_polygons(const std::vector<Index>& polygon, std::vector<Index>& first)
{
    std::map<Index, std::vector<Index>> faces;
    for (std::size_t f = 0; f < first.size(); ++f) faces[polygon[f]].push_back(static_cast<Index>(f));
    for (const auto& one : faces) {
        const Index number = one.first;
        const std::vector<Index>& own = one.second;
        const Index other = polygon[first[own.front()]];
        const bool whole = std::ranges::all_of(
            own, [&](Index f) { return first[f] != f && polygon[first[f]] == other && other != number; });
        if (!whole)
            for (const Index f : own) first[f] = f;
    }
}

/// (V) a face at each vertex that is not left out, or -1.
std::vector<Index> face_at(const Triangles& triangles, Index vertex_count, const std::vector<Index>& first)
{
    std::vector<Index> face(vertex_count, -1);
    for (Index f = static_cast<Index>(triangles.rows()) - 1; f >= 0; --f)
        if (first[f] == f && !is_degenerate(triangles, f))
            for (int k = 0; k < 3; ++k) face[triangles(f, k)] = f;
    return face;
}

}  // namespace

std::vector<LeftOutFace> left_out_faces(const Triangles& triangles, Index vertex_count,
                                        const std::vector<Index>& polygon)
{
    std::vector<Index> first = first_alike(triangles);
    if (!polygon.empty()) keep_partial_polygons(polygon, first);
    const std::vector<Index> at = face_at(triangles, vertex_count, first);
    std::vector<LeftOutFace> result;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        if (is_degenerate(triangles, f)) {
            Index like = -1;
            for (int k = 0; k < 3 && like < 0; ++k) like = at[triangles(f, k)];
            result.push_back({f, like, true});
        } else if (first[f] != f) {
            result.push_back({f, first[f], false});
        }
    }
    return result;
}

}  // namespace koebe
