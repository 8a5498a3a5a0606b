#include "parts/grid_parts.h"

#include "core/connectivity.h"
#include "part_maps/part_mesh.h"
#include "parts/regions.h"
#include "parts/tension.h"
#include "quality/distortion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace koebe {
namespace {

constexpr std::size_t fewest_cells = 4;
constexpr double most_bending = 3.0;  // degrees of angle error of a rectangle that is made by itself,
constexpr double most_ratio = 1.6;    // and densest over least dense texels of its columns and rows

using Cell = std::array<Index, 4>;  ///< half-edges round a quadrilateral
using GridPlace = std::array<Index, 2>;

/// The polygons of the part, if all are quadrilaterals of two triangles.
std::optional<std::vector<Cell>> cells_of(const FlatPart& part)
{
    std::map<Index, std::size_t> size;
    for (const Index polygon : part.polygon) ++size[polygon];
    std::vector<Cell> cells;
    for (Index h = 0; h < static_cast<Index>(part.surface.twin.size()); ++h) {
        const Index t = part.surface.twin[h];
        if (t == no_twin || h > t || part.polygon[face_of(h)] != part.polygon[face_of(t)]) continue;
        cells.push_back({next_halfedge(h), previous_halfedge(h), next_halfedge(t), previous_halfedge(t)});
    }
    const bool all = std::ranges::all_of(size, [](const auto& one) { return one.second == 2; });
    if (!all || cells.size() != size.size() || cells.size() < fewest_cells) return {};
    return cells;
}

/// (V) column and row of each vertex, from 0, if the cells fill a rectangle.
std::optional<std::vector<GridPlace>> places_in_grid(const FlatPart& part, const std::vector<Cell>& cells)
{
    // Edge `first` of a cell runs along its row at the bottom; cells beside it follow from cells that are placed.
    std::map<Index, std::array<std::size_t, 2>> cell_at;  // by half-edge: the cell, and which of its edges
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) cell_at[cells[i][k]] = {i, k};
    struct Placed {
        GridPlace corner;
        std::size_t first;
    };
    constexpr std::array<GridPlace, 4> beside = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}},
                                       corners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::vector<std::optional<Placed>> placed(cells.size());
    std::vector<std::optional<GridPlace>> at(static_cast<std::size_t>(part.vertices.rows()));
    std::vector<std::size_t> queue{0};
    placed[0] = Placed{{0, 0}, 0};
    for (std::size_t head = 0; head < queue.size(); ++head) {
        const auto [corner, first] = *placed[queue[head]];
        for (std::size_t side = 0; side < 4; ++side) {
            const Index h = cells[queue[head]][(first + side) % 4];
            const GridPlace place = {corner[0] + corners[side][0], corner[1] + corners[side][1]};
            auto& known = at[static_cast<std::size_t>(origin(part.surface.triangles, h))];
            if (known && *known != place) return {};
            known = place;
            const Index t = part.surface.twin[h];
            if (t == no_twin) continue;
            const auto [cell, k] = cell_at.at(t);
            if (placed[cell]) continue;
            placed[cell] = Placed{{corner[0] + beside[side][0], corner[1] + beside[side][1]}, (k + 6 - side) % 4};
            queue.push_back(cell);
        }
    }
    // Every place of the rectangle is taken once.
    std::set<GridPlace> taken;
    GridPlace low{}, high{};
    for (const auto& place : at) {
        if (!place || !taken.insert(*place).second) return {};
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], (*place)[k]);
            high[k] = std::max(high[k], (*place)[k]);
        }
    }
    const auto columns = static_cast<std::size_t>(high[0] - low[0]), rows = static_cast<std::size_t>(high[1] - low[1]);
    if (queue.size() != cells.size() || cells.size() != columns * rows || taken.size() != (columns + 1) * (rows + 1))
        return {};
    std::vector<GridPlace> places;
    for (const auto& place : at) places.push_back({(*place)[0] - low[0], (*place)[1] - low[1]});
    return places;
}

/// The rectangle, scaled so that the mean of the log of its texel density is 0.
PlanarPoints rectangle(const FlatPart& part, const std::vector<Cell>& cells, const std::vector<GridPlace>& places)
{
    // Mean lengths of the edges of each column and row.
    std::array<std::map<Index, std::array<double, 2>>, 2> sums;  // length and number
    for (const Cell& cell : cells)
        for (const Index h : cell) {
            const Index v = origin(part.surface.triangles, h), w = target(part.surface.triangles, h);
            const std::size_t along = places[static_cast<std::size_t>(v)][0] == places[static_cast<std::size_t>(w)][0];
            auto& [length, count] = sums[along][std::min(places[static_cast<std::size_t>(v)][along],
                                                         places[static_cast<std::size_t>(w)][along])];
            length += (part.vertices.row(v) - part.vertices.row(w)).norm();
            count += 1.0;
        }
    std::array<std::vector<double>, 2> line{{{0.0}, {0.0}}};
    for (std::size_t k = 0; k < 2; ++k)
        for (const auto& [number, sum] : sums[k]) line[k].push_back(line[k].back() + sum[0] / sum[1]);
    PlanarPoints points(part.vertices.rows(), 2);
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        for (std::size_t k = 0; k < 2; ++k)
            points(v, static_cast<Eigen::Index>(k)) =
                line[k][static_cast<std::size_t>(places[static_cast<std::size_t>(v)][k])];
    return points;
}

/// The ratio of the largest and the least texel density of the part's faces; scales the points to a mean log of 0.
double scaled_to_size(const FlatPart& part, PlanarPoints& points)
{
    FlatPart drawn;
    drawn.surface.triangles = part.surface.triangles;
    drawn.points = points;
    const VectorXd areas = face_areas(part.vertices, part.surface.triangles);
    const FlatDensity density = flat_density(drawn, areas);
    points *= std::exp(-density.u.dot(areas) / areas.sum());
    return std::exp(density.u.maxCoeff() - density.u.minCoeff());
}

bool keeps_lengths(const FlatPart& part, double noise)
{
    if (is_true_to_size(part)) return true;
    const auto length = [&](const auto& places, Index h) {
        return (places.row(origin(part.surface.triangles, h)) - places.row(target(part.surface.triangles, h))).norm();
    };
    for (Index h = 0; h < static_cast<Index>(part.surface.twin.size()); ++h)
        if (!(std::abs(length(part.points, h) - length(part.vertices, h)) < noise_reach * noise)) return false;
    return true;
}

}  // namespace

void rectify_grids(std::vector<FlatPart>& parts, bool any, double noise)
{
    for (FlatPart& part : parts) {
        if (part.polygon.empty()) continue;
        const auto error = [&](const PlanarPoints& points) {
            return measure_distortion(part.vertices, part.surface.triangles, points).angle_error_deg.mean;
        };
        const std::optional<std::vector<Cell>> cells = cells_of(part);
        if (!cells) continue;
        const auto places = places_in_grid(part, *cells);
        if (!places) continue;
        PlanarPoints points = rectangle(part, *cells, *places);
        const double ratio = scaled_to_size(part, points);
        if (!lies_one_to_one(part, points)) continue;
        const double bent = error(points), before = error(part.points);
        const bool is_near = !keeps_lengths(part, noise) && bent <= most_bending && ratio <= most_ratio;
        if (!any && bent > before && !is_near) continue;
        part.points = std::move(points);
        part.one_to_one = true;
    }
}

}  // namespace koebe
