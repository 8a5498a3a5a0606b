#include "sphere/sphere_layout.h"

#include "core/numbering.h"
#include "core/sort_unique.h"
#include "core/uv_resolution.h"
#include "execution/each_in_pieces.h"
#include "mesh/vertex_faces.h"
#include "sphere/placed_face.h"
#include "sphere/sphere_check.h"
#include "sphere/sphere_polygons.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numbers>
#include <span>
#include <tuple>

namespace koebe {
namespace {

// The search for places without flipped faces.
constexpr double wanted_quality[] = {1e-3, 1e-2, 0.05, 0.15, 0.3};  // of faces near flipped ones, tried in turn
constexpr double good_quality = 0.2;                                // of faces round a cone point: enough
constexpr int rings_around = 4;                                     // of faces that may move for a flipped one
constexpr int most_rounds = 10;                                     // over these faces, for each quality
constexpr int tried_directions = 12;                                // tried around a vertex
constexpr int step_halvings = 10;                                   // from the longest edge around the vertex
constexpr double golden_angle = 2.399963;           // radians: turns the directions, so that they never repeat
constexpr std::size_t most_vertex_moves = 4000;     // of single vertices
constexpr std::size_t most_moves_in_vain = 400;     // on a folded sphere
constexpr std::size_t most_near_a_cone_point = 12;  // vertices that are tried at it
constexpr std::size_t most_ranks = 6;               // ways to bring a vertex to a cone point
constexpr double dragged_reach = 6.0;  // radius that moves with a vertex, over its way: sides change by at most 1/4

class LayoutSearch {
public:
    LayoutSearch(const LaidSurface& surface, SphereLayout layout, const ExecutionContext& context)
        : surface_(surface),
          triangles_(surface.triangles),
          layout_(layout),
          context_(context),
          places_(surface.points),
          uv_(surface.triangles.size(), 2),
          marks_{std::vector<char>(face_count(), 0), std::vector<char>(face_count(), 0)},
          held_(static_cast<std::size_t>(surface.points.rows()), 0)
    {
        gather_polygons();
        vertex_faces_ = VertexFaces(triangles_, static_cast<Index>(surface_.points.rows()));
    }

    PlanarPoints run(SphereLayoutReport& report)
    {
        // No layout of a folded sphere is upright: a second way to the cone points and a long search would be in vain.
        const bool folded = sphere_is_folded();
        if (folded) most_moves_ = most_moves_in_vain;
        for (std::size_t rank = 0; rank < (folded ? 1 : most_ranks) && (rank == 0 || !flipped_faces().empty());
             ++rank) {
            places_ = surface_.points;
            held_.assign(held_.size(), 0);
            each_in_pieces(static_cast<Index>(polygon_begin_.size() - 1), [&](Index g) { lay(g); });
            for (const SpherePoint& point : cone_points(layout_)) put_a_vertex_at(point, rank);
            // Vertices of loops may move only where the others alone leave flipped faces.
            for (const bool loops_move : {false, true}) turn_faces_back(loops_move);
        }
        report = {};
        report.kind = layout_;
        for (Index f = 0; f < static_cast<Index>(face_count()); ++f) {
            if (marks_.crossing[f]) report.crossing.push_back(f);
            if (marks_.torn[f]) report.torn.push_back(f);
            if (std::ranges::any_of(triangles_.row(f),
                                    [&](Index v) { return places_.row(v) != surface_.points.row(v); }))
                report.moved.push_back(f);
        }
        return std::move(uv_);
    }

private:
    std::size_t face_count() const { return static_cast<std::size_t>(triangles_.rows()); }

    /// Faces by polygon.
    void gather_polygons()
    {
        std::vector<Index> number = numbers_below(face_count());
        by_polygon_ = number;
        if (!surface_.polygon.empty()) {
            std::ranges::stable_sort(by_polygon_, {}, [&](Index f) { return surface_.polygon[f]; });
            for (std::size_t i = 0, g = 0; i < by_polygon_.size(); ++i) {
                if (i > 0 && surface_.polygon[by_polygon_[i]] != surface_.polygon[by_polygon_[i - 1]]) ++g;
                number[by_polygon_[i]] = static_cast<Index>(g);
            }
        }
        polygon_of_ = std::move(number);
        for (std::size_t i = 0; i < by_polygon_.size(); ++i)
            if (i == 0 || polygon_of_[by_polygon_[i]] != polygon_of_[by_polygon_[i - 1]])
                polygon_begin_.push_back(static_cast<Index>(i));
        polygon_begin_.push_back(static_cast<Index>(by_polygon_.size()));
    }

    bool sphere_is_folded() const
    {
        return !found_in_pieces(static_cast<Index>(face_count()), [&](Index f) {
                    return upright_on_sphere(triangles_, surface_.points, f) == (surface_.turned[f] != 0) &&
                           longest_edge_on_sphere(triangles_, surface_.points, f) >= sphere_resolution;
                }).empty();
    }

    SphereCorners corners(Index f) const
    {
        return {places_.row(triangles_(f, 0)), places_.row(triangles_(f, 1)), places_.row(triangles_(f, 2))};
    }

    /// Lays a polygon out.
    void lay(Index polygon)
    {
        const std::vector<Index> faces(by_polygon_.begin() + polygon_begin_[polygon],
                                       by_polygon_.begin() + polygon_begin_[polygon + 1]);
        for (const Index f : faces) {
            const PlacedFace placed = place_face(corners(f), layout_, surface_.turned[f] != 0);
            for (int k = 0; k < 3; ++k) uv_.row(3 * f + k) = placed.uv[static_cast<std::size_t>(k)];
            marks_.crossing[f] = placed.crossing ? 1 : 0;
            marks_.torn[f] = placed.torn ? 1 : 0;
        }
        if (faces.size() > 1) join_polygon(faces, triangles_, places_, layout_, uv_, marks_);
    }

    /// 4 sqrt(3) area / sum of squared sides: 1 for an equilateral face as wide as on the sphere, negative if flipped.
    /// Torn faces count as -1, faces that 32-bit UVs cannot hold as 1.
    double quality(Index f) const
    {
        if (marks_.torn[f]) return -1.0;
        Eigen::RowVector2d a = uv_.row(3 * f + 1) - uv_.row(3 * f), b = uv_.row(3 * f + 2) - uv_.row(3 * f);
        if (std::max({a.norm(), b.norm(), (b - a).norm()}) < uv_resolution) return 1.0;
        if (layout_ == SphereLayout::equirectangular) {
            const double width = 2.0 * std::sin(std::numbers::pi * uv_.middleRows(3 * f, 3).col(1).mean());
            a[0] *= width;
            b[0] *= width;
        }
        const double area = 0.5 * (a[0] * b[1] - a[1] * b[0]);
        return 4.0 * std::numbers::sqrt3 * (surface_.turned[f] ? -area : area) /
               (a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm());
    }

    /// Lays the faces around vertices out. @return the least quality
    double lay_around(std::span<const Index> vertices)
    {
        std::vector<Index> polygons;
        for (const Index v : vertices)
            for (const Index f : vertex_faces_[v]) polygons.push_back(polygon_of_[f]);
        sort_unique(polygons);
        double least = 1.0;
        for (const Index g : polygons) {
            lay(g);
            for (Index i = polygon_begin_[g]; i < polygon_begin_[g + 1]; ++i)
                least = std::min(least, quality(by_polygon_[i]));
        }
        return least;
    }

    double lay_around(Index v) { return lay_around({&v, 1}); }

    double lay_around(Index v, const SpherePoint& place)
    {
        places_.row(v) = place.transpose();
        return lay_around(v);
    }

    /// Moves a vertex of the face round a cone point there, alone or with its neighbourhood: takes the way of this rank
    /// among those that leave the worst face best.
    void put_a_vertex_at(const SpherePoint& point, std::size_t rank)
    {
        const std::vector<Index> around = found_in_pieces(static_cast<Index>(face_count()), [&](Index f) {
            const SphereCorners p = corners(f);
            return (p[0] + p[1] + p[2]).dot(point) > 0.0 && face_contains(p, point);
        });
        std::vector<Index> vertices;
        for (const Index f : around)
            for (const Index v : triangles_.row(f)) vertices.push_back(v);
        sort_unique(vertices);
        if (vertices.size() > most_near_a_cone_point) {  // only where the sphere is folded
            const auto distance = [&](Index v) { return (places_.row(v).transpose() - point).norm(); };
            std::ranges::stable_sort(vertices, {}, distance);
            vertices.resize(most_near_a_cone_point);
        }
        struct Way {
            std::tuple<bool, double, std::ptrdiff_t> rank;  // upright, the least quality, minus the vertices moved
            Index vertex;
            double reach;
        };
        std::vector<Way> ways;
        for (const Index v : vertices) {
            const double distance = (places_.row(v).transpose() - point).norm();
            if (distance == 0.0) {
                held_[v] = 1;
                return;
            }
            if (held_[v]) continue;
            for (const double reach : {0.0, dragged_reach * distance}) {
                const std::vector<Index> moved = movable_within(v, reach);
                const Vertices home = places_(moved, Eigen::all);
                const double least = drag(v, point, moved, reach);
                ways.push_back(
                    {{least > 0.0 && !surface_.on_loop[v], std::min(least, good_quality), -std::ssize(moved)},
                     v,
                     reach});
                places_(moved, Eigen::all) = home;
                lay_around(moved);
            }
        }
        if (ways.empty()) return;
        std::ranges::stable_sort(ways, std::greater(), &Way::rank);
        const Way& way = ways[std::min(rank, ways.size() - 1)];
        drag(way.vertex, point, movable_within(way.vertex, way.reach), way.reach);
        held_[way.vertex] = 1;
    }

    /// A vertex, and those near it that may move with it.
    std::vector<Index> movable_within(Index vertex, double reach) const
    {
        return found_in_pieces(static_cast<Index>(places_.rows()), [&](Index u) {
            return u == vertex ||
                   (!held_[u] && !surface_.on_loop[u] && (places_.row(u) - places_.row(vertex)).norm() < reach);
        });
    }

    /// Turns the sphere so that the vertex comes to a point, the others the less the farther they are from it.
    /// @return the least quality around
    double drag(Index vertex, const SpherePoint& point, const std::vector<Index>& moved, double reach)
    {
        const SpherePoint home = places_.row(vertex), axis = home.cross(point).normalized();
        const double angle = std::atan2(home.cross(point).norm(), home.dot(point));
        for (const Index u : moved) {
            if (u == vertex) continue;
            const double far = (places_.row(u).transpose() - home).norm() / reach, share = 1.0 - far * far;
            const SpherePoint from = places_.row(u);
            places_.row(u) = (Eigen::AngleAxisd(share * share * angle, axis) * from).normalized().transpose();
        }
        places_.row(vertex) = point.transpose();
        return lay_around(moved);
    }

    /// Faces within so many rings of some faces, ascending.
    std::vector<Index> near(const std::vector<Index>& faces) const
    {
        std::vector<Index> result = vertex_faces_.with_rings(triangles_, faces, rings_around);
        std::ranges::sort(result);
        return result;
    }

    bool flipped(Index f) const { return !(quality(f) > 0.0); }

    std::vector<Index> flipped_faces() const
    {
        return found_in_pieces(static_cast<Index>(face_count()), [&](Index f) { return flipped(f); });
    }

    void turn_faces_back(bool loops_move)
    {
        const std::vector<Index> seeds = flipped_faces();
        if (seeds.empty()) return;
        const std::vector<Index> faces = near(seeds);
        for (const double wanted : wanted_quality)
            for (int pass = 0; pass < most_rounds; ++pass) {
                if (std::ranges::none_of(faces, [&](Index f) { return flipped(f); })) return;
                std::vector<Index> vertices;
                for (const Index f : faces)
                    if (quality(f) < wanted)
                        for (const Index v : triangles_.row(f))
                            if (!held_[v] && (loops_move || !surface_.on_loop[v])) vertices.push_back(v);
                sort_unique(vertices);
                bool moved = false;
                for (const Index v : vertices) moved |= improve(v, wanted);
                if (!moved || moves_ >= most_moves_) break;
            }
    }

    /// Moves a vertex to where the worst face around it is better, by a pattern search. @return whether it moved
    bool improve(Index v, double wanted)
    {
        context_.checkpoint();
        double most = lay_around(v);
        if (most >= wanted || ++moves_ > most_moves_) return false;
        const SpherePoint home = places_.row(v);
        SpherePoint best = home;
        double step = 0.0;
        for (const Index f : vertex_faces_[v])
            for (const SpherePoint& p : corners(f)) step = std::max(step, (p - home).norm());
        for (int halving = 0; halving < step_halvings && most < wanted; ++halving, step *= 0.5) {
            const SpherePoint middle = best, x = middle.unitOrthogonal(), y = middle.cross(x);
            for (int k = 0; k < tried_directions; ++k) {
                const double angle = 2.0 * std::numbers::pi * k / tried_directions +
                                     golden_angle * static_cast<double>(moves_ + halving);
                const SpherePoint place = (middle + step * (std::cos(angle) * x + std::sin(angle) * y)).normalized();
                const double least = lay_around(v, place);
                if (!(least > most)) continue;
                most = least;
                best = place;
            }
        }
        lay_around(v, best);
        return best != home;
    }

    const LaidSurface& surface_;
    const Triangles& triangles_;
    const SphereLayout layout_;
    const ExecutionContext& context_;
    Vertices places_;  // (V, 3) of the layout
    PlanarPoints uv_;
    LayoutMarks marks_;
    std::vector<char> held_;  // (V) 1 for vertices at cone points
    std::vector<Index> by_polygon_, polygon_of_, polygon_begin_;
    VertexFaces vertex_faces_;
    std::size_t moves_ = 0, most_moves_ = most_vertex_moves;
};

}  // namespace

PlanarPoints sphere_layout(const LaidSurface& surface, SphereLayout layout, SphereLayoutReport& report,
                           const ExecutionContext& context)
{
    return LayoutSearch(surface, layout, context).run(report);
}

}  // namespace koebe
