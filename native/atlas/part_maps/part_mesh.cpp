#include "part_maps/part_mesh.h"

#include "core/connectivity.h"
#include "core/length.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "mesh/connected_pieces.h"
#include "surface/face_vectors.h"

#include <algorithm>

namespace koebe {
namespace {

Index root_of(std::vector<Index>& parent, Index i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

}  // namespace

VectorXd face_areas(const Vertices& vertices, const Triangles& triangles)
{
    VectorXd areas(triangles.rows());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        areas[f] = 0.5 * length_of(twice_area_vector(vertices, triangles, f));
    return areas;
}

CutSurface cut_surface(const Vertices& vertices, const Triangles& triangles, std::vector<Index> polygon)
{
    return cut_surface(vertices, require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows())),
                       std::move(polygon));
}

CutSurface cut_surface(const Vertices& vertices, Surface surface, std::vector<Index> polygon)
{
    CutSurface whole;
    whole.surface = std::move(surface);
    whole.vertices = vertices;
    whole.areas = face_areas(whole.vertices, whole.surface.triangles);
    whole.lengths.resize(whole.surface.triangles.size());
    for (Index h = 0; h < static_cast<Index>(whole.lengths.size()); ++h)
        whole.lengths[h] = length_of(whole.vertices.row(origin(whole.surface.triangles, h)) -
                                     whole.vertices.row(target(whole.surface.triangles, h)));
    whole.polygon = std::move(polygon);
    return whole;
}

double length_as_cut(const CutSurface& whole, Index halfedge)
{
    const Triangles& triangles = whole.surface.triangles;
    return whole.lengths[halfedge] *
           price_of_edge(whole.shown, origin(triangles, halfedge), target(triangles, halfedge));
}

PartMesh part_mesh(const CutSurface& whole, std::vector<Index> faces)
{
    std::sort(faces.begin(), faces.end());
    const Triangles& triangles = whole.surface.triangles;
    std::vector<Index> local(triangles.rows(), -1);
    for (std::size_t i = 0; i < faces.size(); ++i) local[faces[i]] = static_cast<Index>(i);

    // Corners that meet at a vertex are one if an edge inside the part leads from one's face to the other's.
    std::vector<Index> parent = numbers_below(3 * faces.size());
    const auto corner = [&](Index h) { return 3 * local[face_of(h)] + h % 3; };
    for (const Index f : faces)
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index t = whole.surface.twin[h];
            if (t == no_twin || t < h || local[face_of(t)] < 0) continue;
            const auto join = [&](Index a, Index b) {
                parent[root_of(parent, corner(a))] = root_of(parent, corner(b));
            };
            join(h, next_halfedge(t));
            join(next_halfedge(h), t);
        }

    PartMesh part;
    Triangles own(static_cast<Eigen::Index>(faces.size()), 3);
    std::vector<Index> number(parent.size(), -1);
    for (Index c = 0; c < static_cast<Index>(parent.size()); ++c) {
        const Index root = root_of(parent, c);
        if (number[root] < 0) {
            number[root] = static_cast<Index>(part.original.size());
            part.original.push_back(triangles(faces[c / 3], c % 3));
        }
        own(c / 3, c % 3) = number[root];
    }
    part.vertices = whole.vertices(part.original, Eigen::all);
    part.surface = require_bordered_genus_zero(own, static_cast<Index>(part.original.size()));
    part.areas = whole.areas(faces);
    part.area = part.areas.sum();
    part.polygon = values_at(whole.polygon, faces);
    if (!whole.slit.empty())
        for (const Index f : faces)
            for (Index h = 3 * f; h < 3 * f + 3; ++h) part.slit.push_back(whole.slit[h]);
    part.shown = values_at(whole.shown, part.original);
    part.border.assign(part.original.size(), 0);
    for (Index h = 0; h < static_cast<Index>(own.size()); ++h) {
        const Index of_whole = 3 * faces[h / 3] + h % 3;
        if (whole.surface.twin[of_whole] != no_twin || (!whole.seam.empty() && whole.seam[of_whole])) continue;
        part.border[origin(own, h)] = part.border[target(own, h)] = 1;
    }
    part.faces = std::move(faces);
    return part;
}

PartMesh some_or_all(const CutSurface& whole, std::vector<Index> faces)
{
    const bool is_closed = faces.size() == static_cast<std::size_t>(whole.areas.size()) && whole.surface.loops.empty();
    if (!is_closed) return part_mesh(whole, std::move(faces));
    PartMesh all;
    all.faces = numbers_below(faces.size());
    all.original = numbers_below(whole.vertices.rows());
    all.vertices = whole.vertices;
    all.surface = whole.surface;
    all.areas = whole.areas;
    all.polygon = whole.polygon;
    all.shown = whole.shown;
    all.area = all.areas.sum();
    return all;
}

std::vector<Index> connected_pieces(const PartMesh& part, const std::vector<int>& label, Index& count)
{
    return connected_pieces(part.surface.twin, label, count);
}

std::vector<std::vector<Index>> pieces_of(const PartMesh& part, const std::vector<int>& label)
{
    if (label.empty()) return {};
    Index count = 0;
    const std::vector<Index> piece = connected_pieces(part, label, count);
    std::vector<std::vector<Index>> faces(count);
    for (std::size_t f = 0; f < piece.size(); ++f) faces[piece[f]].push_back(part.faces[f]);
    return faces;
}

}  // namespace koebe
