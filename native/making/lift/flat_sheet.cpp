#include "lift/flat_sheet.h"

#include "core/length.h"
#include "mesh/connected_pieces.h"
#include "planar/planar_predicates.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

Eigen::RowVector3d area_vector(const FlatSheet& sheet, Index f)
{
    const Eigen::RowVector3d a = sheet.vertices.row(sheet.triangles(f, 0));
    const Eigen::RowVector3d b = sheet.vertices.row(sheet.triangles(f, 1)) - a;
    const Eigen::RowVector3d c = sheet.vertices.row(sheet.triangles(f, 2)) - a;
    return b.cross(c);
}

void find_steps(FlatSheet& sheet)
{
    const Index count = static_cast<Index>(sheet.triangles.size());
    sheet.border.assign(count, 1);
    sheet.step.assign(count, 0.0);
    std::vector<char> upright(sheet.triangles.rows());
    for (Index f = 0; f < static_cast<Index>(upright.size()); ++f) upright[f] = sheet.twice_area(f) > 0.0;
    for (Index h = 0; h < count; ++h) {
        const Index t = sheet.twin[h];
        if (t == no_twin || !upright[face_of(h)] || !upright[face_of(t)]) continue;
        const Complex first = sheet.uv[next_halfedge(t)] - sheet.uv[h];
        const Complex second = sheet.uv[t] - sheet.uv[next_halfedge(h)];
        if (first != second) continue;
        sheet.border[h] = 0;
        sheet.step[h] = first;
    }
}

void number_sheets(FlatSheet& sheet)
{
    Index count = 0;
    sheet.sheet = joined_pieces(sheet.twin, count, [&](Index h) { return !sheet.border[h]; });
}

void measure(FlatSheet& sheet)
{
    const Eigen::Index count = sheet.vertices.rows();
    std::vector<double> on_surface(count, 0.0), in_uv(count, 0.0);
    sheet.normals = Vertices::Zero(count, 3);
    double flat = 0.0;
    for (Index f = 0; f < static_cast<Index>(sheet.triangles.rows()); ++f) {
        const Eigen::RowVector3d normal = area_vector(sheet, f);
        const double area = length_of(normal), uv_area = std::max(0.0, sheet.twice_area(f));
        sheet.area += 0.5 * area;
        flat += 0.5 * uv_area;
        for (int k = 0; k < 3; ++k) {
            const Index v = sheet.triangles(f, k);
            on_surface[v] += area;
            in_uv[v] += uv_area;
            if (!(area > 0.0)) continue;
            const Eigen::RowVector3d a = sheet.vertices.row(sheet.triangles(f, (k + 1) % 3)) - sheet.vertices.row(v);
            const Eigen::RowVector3d b = sheet.vertices.row(sheet.triangles(f, (k + 2) % 3)) - sheet.vertices.row(v);
            sheet.normals.row(v) += std::atan2(area, a.dot(b)) / area * normal;
        }
    }
    // Scale: root of the area on the surface over the area in the UVs. Normals: weighted by angles.
    sheet.mean_scale = flat > 0.0 ? std::sqrt(sheet.area / flat) : 1.0;
    sheet.scale.resize(count);
    for (Eigen::Index v = 0; v < count; ++v) {
        sheet.scale[v] = in_uv[v] > 0.0 ? std::sqrt(on_surface[v] / in_uv[v]) : sheet.mean_scale;
        const double length = length_of(sheet.normals.row(v));
        if (length > 0.0) sheet.normals.row(v) /= length;
    }
}

}  // namespace

double FlatSheet::twice_area(Index f) const { return cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0)); }

double FlatSheet::scale_at(Index f, const Eigen::RowVector3d& weights) const
{
    double result = 0.0;
    for (int k = 0; k < 3; ++k) result += weights[k] * scale[triangles(f, k)];
    return result;
}

double FlatSheet::grade_at(Index f, const Eigen::RowVector3d& weights) const
{
    if (grade.empty()) return 1.0;
    double result = 0.0;
    for (int k = 0; k < 3; ++k) result += weights[k] * grade[triangles(f, k)];
    return result;
}

Eigen::RowVector3d FlatSheet::position_at(Index f, const Eigen::RowVector3d& weights) const
{
    Eigen::RowVector3d result = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) result += weights[k] * vertices.row(triangles(f, k));
    return result;
}

Complex FlatSheet::uv_at(Index f, const Eigen::RowVector3d& weights) const
{
    return weights[0] * corner(f, 0) + weights[1] * corner(f, 1) + weights[2] * corner(f, 2);
}

Eigen::RowVector3d FlatSheet::weights_of(Index f, Complex place) const
{
    const double whole = twice_area(f);
    Eigen::RowVector3d weights;
    for (int k = 0; k < 3; ++k)
        weights[k] = cross(corner(f, (k + 1) % 3) - place, corner(f, (k + 2) % 3) - place) / whole;
    return weights;
}

FlatSheet flat_sheet(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& corner_uvs, double grid,
                     std::vector<Complex> periods)
{
    FlatSheet sheet;
    sheet.vertices = vertices;
    sheet.triangles = triangles;
    sheet.grid = grid;
    sheet.periods = std::move(periods);
    sheet.uv.resize(corner_uvs.rows());
    for (Eigen::Index c = 0; c < corner_uvs.rows(); ++c) sheet.uv[c] = {corner_uvs(c, 0), corner_uvs(c, 1)};
    sheet.twin = pair_halfedges(triangles, static_cast<Index>(vertices.rows()));
    find_steps(sheet);
    number_sheets(sheet);
    measure(sheet);
    return sheet;
}

std::vector<Complex> period_shifts(const std::vector<Complex>& periods)
{
    std::vector<Complex> shifts{0.0};
    for (const Complex period : periods) {
        const std::size_t n = shifts.size();
        for (const int times : {-1, 1, -2, 2})
            for (std::size_t i = 0; i < n; ++i) shifts.push_back(shifts[i] + static_cast<double>(times) * period);
    }
    return shifts;
}

PlanarPoints planar_points(const std::vector<Complex>& places)
{
    PlanarPoints points(static_cast<Eigen::Index>(places.size()), 2);
    for (std::size_t i = 0; i < places.size(); ++i)
        points.row(static_cast<Eigen::Index>(i)) << places[i].real(), places[i].imag();
    return points;
}

}  // namespace koebe
