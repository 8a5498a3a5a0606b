#include "hard/grid_parts.h"

#include "core/connectivity.h"
#include "cost/tolerances.h"
#include "darts/tension.h"
#include "darts/through_cuts.h"
#include "flat/regions.h"
#include "part_maps/part_mesh.h"
#include "planar/planar_predicates.h"
#include "quality/distortion.h"
#include "surface/face_vectors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t fewest_cells = 4;
constexpr double most_bending = 3.0;  // degrees of angle error of a rectangle that is made by itself,
constexpr double most_ratio = 1.6;    // and densest over least dense texels of its columns and rows

constexpr double most_ring_bending = 8.0;     // of a ring's rectangle, and of its cells' texels:
constexpr double most_ring_ratio = 2.5;       // there a person takes one, too
constexpr double round_fold = 2.0;            // hard angles: a tube that is bent by more at an edge is not round
constexpr double least_curvature = 1.0;       // in sum: a tube with less unfolds
constexpr double equal_lengths = 1.0 - 1e-6;  // of two lines: the first one is taken

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

/// A piece of a grid as a rectangle, with its angle error and ratio of densities.
struct LaidGrid {
    FlatPart part;
    double bent = 0.0, ratio = 0.0;
};

double angle_error_at(const FlatPart& part, const PlanarPoints& points)
{
    return measure_distortion(part.vertices, part.surface.triangles, points).angle_error_deg.mean;
}

std::optional<LaidGrid> laid_grid(const FlatPart& part)
{
    const auto cells = cells_of(part);
    const auto places = cells ? places_in_grid(part, *cells) : std::nullopt;
    if (!places) return {};
    LaidGrid laid{part};
    laid.part.points = rectangle(part, *cells, *places);
    laid.ratio = scaled_to_size(laid.part, laid.part.points);
    if (!lies_one_to_one(laid.part, laid.part.points)) return {};
    laid.bent = angle_error_at(laid.part, laid.part.points);
    return laid;
}

/// The lines of edges of a grid that closes like a tube or a ring.
class RolledGrid {
public:
    explicit RolledGrid(const CutSurface& surface)
        : surface_(surface),
          net_(seamed(surface.vertices, surface.surface, surface.polygon, surface.shown)),
          all_(whole_part(surface))
    {
        all_.shown.clear();  // as in all flat parts of hard surfaces
    }

    /// Whether no edge is bent by more than this, in radians, and whether a tube is curved in both directions: others
    /// unfold.
    bool is_round(double most_fold) const
    {
        const Triangles& triangles = surface_.surface.triangles;
        const std::vector<Index>& twin = surface_.surface.twin;
        const std::vector<char> outside = boundary_mask(surface_.surface);
        VectorXd defect(surface_.vertices.rows());
        for (std::size_t v = 0; v < outside.size(); ++v) defect[v] = outside[v] ? 0.0 : 2.0 * std::numbers::pi;
        for (Index h = 0; h < net_.halfedge_count(); ++h) {
            const auto at = [&](Index own) { return surface_.vertices.row(origin(triangles, own)); };
            const Eigen::RowVector3d a = at(next_halfedge(h)) - at(h), b = at(previous_halfedge(h)) - at(h);
            if (!outside[origin(triangles, h)]) defect[origin(triangles, h)] -= std::atan2(a.cross(b).norm(), a.dot(b));
            if (net_.whole[h] || twin[h] < h) continue;
            const Eigen::RowVector3d m = twice_area_vector(surface_.vertices, triangles, face_of(h)),
                                     n = twice_area_vector(surface_.vertices, triangles, face_of(twin[h]));
            if (std::atan2(m.cross(n).norm(), m.dot(n)) > most_fold) return false;
        }
        return defect.cwiseAbs().sum() > least_curvature;
    }

    /// Opens it along its shortest lines, and cuts it across into pieces that are no longer than this, and as long as
    /// each other. @return empty: it is no such grid, or bends too much
    std::vector<FlatPart> laid(double longest)
    {
        const auto cells = cells_of(all_);
        if (!cells) return {};
        beside_.assign(net_.twin.size(), no_twin);
        for (const Cell& cell : *cells)
            for (std::size_t k = 0; k < 4; ++k) beside_[cell[k]] = cell[(k + 1) % 4];

        // One line lengthwise, and if it closes, one round.
        const bool is_ring = surface_.surface.loops.empty();
        const Index first = is_ring ? cells->front()[0] : start_of_tube();
        const std::vector<Index> along = shortest_across(line(first));
        const std::vector<Index> round = is_ring ? shortest_across(along) : line(first);
        if (along.empty() || round.empty()) return {};
        cut(along);
        if (is_ring) cut(round);
        std::vector<LaidGrid> whole = laid_pieces();
        if (whole.size() != 1 || whole.front().bent > (is_ring ? most_ring_bending : most_bending) ||
            whole.front().ratio > (is_ring ? most_ring_ratio : most_ratio))
            return {};

        // The longer direction is cut into equal pieces.
        const int count = static_cast<int>(std::ceil(box_size(whole.front().part.points).maxCoeff() / longest));
        if (count > 1) {
            const bool is_long = length_of(along) > length_of(round);
            if (!is_ring && !is_long) return {};
            cut_equally(is_long ? along : round, count);
            whole = laid_pieces();
            if (static_cast<int>(whole.size()) != count) return {};
        }
        std::vector<FlatPart> parts;
        for (LaidGrid& own : whole) parts.push_back(std::move(own.part));
        return parts;
    }

private:
    Index straight(Index h) const
    {
        const Index t = surface_.surface.twin[beside_[h]];
        return t == no_twin ? no_twin : beside_[t];
    }

    /// From a half-edge straight on, until it closes or ends.
    std::vector<Index> line(Index h) const
    {
        std::vector<Index> own{h};
        for (Index next = straight(h); next != no_twin && next != h; next = straight(next)) own.push_back(next);
        return own;
    }

    double length_of(const std::vector<Index>& own) const
    {
        double length = 0.0;
        for (const Index h : own) length += net_.length[h];
        return length;
    }

    std::vector<Index> shortest_across(const std::vector<Index>& own) const
    {
        std::vector<Index> best;
        double least = std::numeric_limits<double>::infinity();
        std::size_t edges = 0;
        for (const Index h : own) {
            std::vector<Index> other = line(beside_[h]);
            edges += other.size();
            if (edges > surface_.polygon.size()) return {};  // the lines are spirals
            if (const double length = length_of(other); length < equal_lengths * least) {
                least = length;
                best = std::move(other);
            }
        }
        return best;
    }

    Index start_of_tube() const
    {
        const VertexLoop& loop = surface_.surface.loops.front();
        for (Index h = 0; h < net_.halfedge_count(); ++h)
            if (surface_.surface.twin[h] == no_twin && origin(surface_.surface.triangles, h) == loop.front()) return h;
        return no_twin;
    }

    void cut(const std::vector<Index>& own)
    {
        for (const Index h : own) net_.cut(h);
    }

    void cut_equally(const std::vector<Index>& own, int count)
    {
        const double step = length_of(own) / count;
        double passed = 0.0;
        int made = 1;
        for (const Index h : own) {
            passed += net_.length[h];
            if (made < count && passed + 0.5 * net_.length[h] > made * step) {
                cut(line(beside_[h]));
                ++made;
            }
        }
    }

    std::vector<LaidGrid> laid_pieces()
    {
        number_fans(net_);
        std::vector<LaidGrid> laid;
        for (const SeamedMesh& own : connected_parts(net_)) {
            auto piece = opened_piece(all_, own.face, own.fans, vertices_of_fans(own));
            auto grid = piece ? laid_grid(*piece) : std::nullopt;
            if (!grid) return {};
            for (Index h = 0; h < own.halfedge_count(); ++h)
                if (const Index t = surface_.surface.twin[3 * own.face[face_of(h)] + h % 3];
                    own.twin[h] == no_twin && t != no_twin && std::ranges::binary_search(own.face, face_of(t)))
                    grid->part.slit += 0.5 * surface_.lengths[t];
            laid.push_back(std::move(*grid));
        }
        return laid;
    }

    const CutSurface& surface_;
    SeamedMesh net_;
    FlatPart all_;
    std::vector<Index> beside_;  // (3F) the next edge of the cell
};

}  // namespace

std::vector<FlatPart> rolled_grid(const CutSurface& surface, double hard_angle, double longest)
{
    const std::size_t loops = surface.surface.loops.size();
    if (surface.polygon.empty() ||
        !((surface.surface.genus == 1 && loops == 0) || (surface.surface.genus == 0 && loops == 2)))
        return {};
    RolledGrid grid(surface);
    const double most_fold = round_fold * hard_angle * std::numbers::pi / 180.0 + tolerance::off_axis;
    return grid.is_round(most_fold) ? grid.laid(longest) : std::vector<FlatPart>{};
}

void rectify_grids(std::vector<FlatPart>& parts, bool any, double noise)
{
    for (FlatPart& part : parts) {
        if (part.polygon.empty()) continue;
        std::optional<LaidGrid> laid = laid_grid(part);
        if (!laid) continue;
        const bool is_near = !keeps_lengths(part, noise) && laid->bent <= most_bending && laid->ratio <= most_ratio;
        if (!any && !is_near && laid->bent > angle_error_at(part, part.points)) continue;
        part.points = std::move(laid->part.points);
        part.one_to_one = true;
    }
}

}  // namespace koebe
