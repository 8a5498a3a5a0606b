#include "parts/carried_parts.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "execution/side_by_side.h"
#include "foldover/turn_upright.h"
#include "linear/sparse_cholesky.h"
#include "mesh/connected_pieces.h"
#include "parts/dart_rounds.h"
#include "parts/tension.h"
#include "parts/through_cuts.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"
#include "surface/laplacian.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double least_cotangent = 0.05;  // of a face's weight in the courses of its edges: needles count, too

constexpr double hold = 1e6;              // weight with which held vertices stay, over a cotangent

/// An attempt to hold crossing loops at the part's loops.
struct Attempt {
    double share;  ///< how near to them
    double bulge;  ///< of a coarse edge: how far its fine vertices lie outside, so that no face is flat
};
constexpr std::array attempts{Attempt{0.0, 0.0},  Attempt{0.9, 1e-3}, Attempt{1.0, 1e-3}, Attempt{1.0, 1e-4},
                              Attempt{1.0, 1e-5}};
constexpr double ear_height = 0.01;  // of a face at a corner that the part rounds, over its base

using HeldVertex = std::pair<Index, Complex>;  // and where it stays
using Corners = std::array<Eigen::RowVector3d, 3>;

Corners corners_of(const Vertices& vertices, const Triangles& triangles, Index f)
{
    return {vertices.row(triangles(f, 0)), vertices.row(triangles(f, 1)), vertices.row(triangles(f, 2))};
}

Eigen::RowVector3d normal_of(const Corners& at) { return (at[1] - at[0]).cross(at[2] - at[0]); }

/// Squared distance of a point from a triangle.
double squared_distance(const Eigen::RowVector3d& p, const Corners& at)
{
    const Eigen::RowVector3d normal = normal_of(at);
    double least = std::numeric_limits<double>::infinity();
    bool is_inside = normal.squaredNorm() > 0.0;
    for (int k = 0; k < 3; ++k) {
        const Eigen::RowVector3d edge = at[(k + 1) % 3] - at[k], arm = p - at[k];
        is_inside = is_inside && normal.dot(edge.cross(arm)) >= 0.0;
        const double share = std::clamp(arm.dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0.0, 1.0);
        least = std::min(least, (arm - share * edge).squaredNorm());
    }
    if (is_inside) least = std::min(least, std::pow(normal.dot(p - at[0]), 2) / normal.squaredNorm());
    return least;
}

/// Which coarse faces are near a fine face: round the coarse vertices to which its corners went.
class NearFaces {
public:
    NearFaces(const Proxy& proxy) : proxy_(proxy), around_(proxy.coarse.vertex.size())
    {
        for (Index c = 0; c < static_cast<Index>(proxy.surface.triangles.size()); ++c)
            around_[proxy.surface.triangles(c / 3, c % 3)].push_back(c / 3);
    }

    /// The nearest one of those that count; -1: there is none.
    template <typename Counts>
    Index nearest(Index fine, const Counts& counts) const
    {
        const CutSurface& whole = proxy_.fine.whole;
        const Corners at = corners_of(whole.vertices, whole.surface.triangles, fine);
        const Eigen::RowVector3d middle = (at[0] + at[1] + at[2]) / 3.0;
        std::pair<double, Index> best{std::numeric_limits<double>::infinity(), -1};
        for (int k = 0; k < 3; ++k)
            for (const Index face : around_[proxy_.coarse.vertex_at[whole.surface.triangles(fine, k)]])
                if (counts(face)) {
                    const Corners there = corners_of(proxy_.coarse.vertices, proxy_.surface.triangles, face);
                    best = std::min(best, {squared_distance(middle, there), face});
                }
        return best.second;
    }

private:
    const Proxy& proxy_;
    std::vector<std::vector<Index>> around_;  // (V) coarse faces round each coarse vertex
};

/// For each piece of the fine surface the part to which it corresponds; empty if that is not one piece for each part.
/// @param piece (F) of the fine surface, from 0
std::vector<int> parts_of_pieces(const Proxy& proxy, const CoarseNet& net, const NearFaces& near,
                                 const std::vector<Index>& piece, std::size_t pieces, std::size_t parts)
{
    if (pieces != parts) return {};
    std::vector<std::vector<double>> votes(pieces, std::vector<double>(parts, 0.0));
    for (Index f = 0; f < static_cast<Index>(piece.size()); ++f) {
        const Index face = near.nearest(f, [](Index) { return true; });
        if (face >= 0) votes[piece[f]][net.place[face].part] += proxy.fine.whole.areas[f];
    }
    std::vector<int> part_of;
    for (const std::vector<double>& own : votes)
        part_of.push_back(static_cast<int>(std::ranges::max_element(own) - own.begin()));
    std::vector<int> sorted = part_of;
    std::ranges::sort(sorted);
    return std::ranges::adjacent_find(sorted) == sorted.end() ? part_of : std::vector<int>{};
}

/// The fine surface as one part, without places in the plane.
FlatPart whole_part(const CutSurface& whole)
{
    FlatPart flat;
    flat.faces.resize(static_cast<std::size_t>(whole.areas.size()));
    flat.original.resize(static_cast<std::size_t>(whole.vertices.rows()));
    std::iota(flat.faces.begin(), flat.faces.end(), 0);
    std::iota(flat.original.begin(), flat.original.end(), 0);
    flat.vertices = whole.vertices;
    flat.surface = whole.surface;
    flat.points = PlanarPoints::Zero(whole.vertices.rows(), 2);
    flat.held.assign(flat.original.size(), 0);
    flat.polygon = whole.polygon;
    flat.shown = whole.shown;
    return flat;
}

/// Turns vectors of one plane into another one, the shortest way.
Eigen::Matrix3d turn_between(const Eigen::RowVector3d& from, const Eigen::RowVector3d& to)
{
    return Eigen::Quaterniond::FromTwoVectors(from.transpose(), to.transpose()).toRotationMatrix();
}

/// Half of the cotangent at a corner, for the edge opposite to it.
double half_cotangent(const Corners& at, int k)
{
    const Eigen::RowVector3d a = at[(k + 1) % 3] - at[k], b = at[(k + 2) % 3] - at[k];
    return 0.5 * std::max(a.dot(b) / std::max(a.cross(b).norm(), 1e-300), least_cotangent);
}

/// Places in the plane whose edges have, in the mean over their faces, the courses that the part's map gives them:
/// minimizes sum cot |u_j - u_i - J (x_j - x_i)|^2 / 2. J is the map of the nearest face of the part, turned into the
/// plane of the fine face (Sumner and Popovic 2004 give a mesh its gradients so).
/// @param face_near (F) of the piece: the coarse face @param held vertices and where they stay
PlanarPoints places_of(const FlatPart& piece, const FlatPart& part, const Proxy& proxy, const CoarseNet& net,
                       const std::vector<Index>& face_near, const std::vector<HeldVertex>& held)
{
    const double smaller = std::sqrt(face_areas(proxy.coarse.vertices, proxy.surface.triangles).sum() /
                                     proxy.fine.whole.areas.sum());  // the part is as large as the fine surface
    const Eigen::Index count = piece.vertices.rows();
    std::vector<Eigen::Triplet<double>> entries;
    MatrixXd load = MatrixXd::Zero(count, 2);
    for (Index f = 0; f < static_cast<Index>(face_near.size()); ++f) {
        const Corners at = corners_of(piece.vertices, piece.surface.triangles, f);
        const Corners there = corners_of(proxy.coarse.vertices, proxy.surface.triangles, face_near[f]);
        const auto row = part.surface.triangles.row(net.place[face_near[f]].face);
        Eigen::Matrix<double, 3, 2> edges;
        edges << (there[1] - there[0]).transpose(), (there[2] - there[0]).transpose();
        Eigen::Matrix2d images;
        images << (part.points.row(row[1]) - part.points.row(row[0])).transpose(),
            (part.points.row(row[2]) - part.points.row(row[0])).transpose();
        const Eigen::Matrix2d gram = edges.transpose() * edges;
        Eigen::Matrix<double, 2, 3> map = images * gram.inverse() * edges.transpose();
        map = smaller * map * turn_between(normal_of(at), normal_of(there));
        if (!map.allFinite()) map.setZero();
        for (int k = 0; k < 3; ++k) {
            const Index i = piece.surface.triangles(f, (k + 1) % 3), j = piece.surface.triangles(f, (k + 2) % 3);
            const double weight = half_cotangent(at, k);
            const Eigen::RowVector2d course = weight * (map * (at[(k + 2) % 3] - at[(k + 1) % 3]).transpose()).transpose();
            load.row(j) += course;
            load.row(i) -= course;
            entries.insert(entries.end(), {{i, i, weight}, {j, j, weight}, {i, j, -weight}, {j, i, -weight}});
        }
    }
    if (held.empty()) entries.emplace_back(0, 0, 1.0);  // the first vertex stays at the origin
    for (const auto& [v, at] : held) {
        entries.emplace_back(v, v, hold);
        load.row(v) += hold * Eigen::RowVector2d(at.real(), at.imag());
    }
    SparseMatrix matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return SparseCholesky(matrix).solve(load);
}

/// A piece of the fine surface for each part.
class Carrying {
public:
    Carrying(const Proxy& proxy, const std::vector<FlatPart>& parts, const CoarseNet& net,
             std::vector<CarriedPath> paths)
        : proxy_(proxy), parts_(parts), net_(net), paths_(std::move(paths)), near_(proxy)
    {
    }

    std::vector<FlatPart> pieces(int threads, ExecutionContext& context)
    {
        const FlatPart whole = whole_part(proxy_.fine.whole);
        SeamedMesh mesh = seamed(whole, whole.shown);
        for (const auto& [chain, path] : paths_)
            for (const Index h : path) mesh.cut(h);
        std::vector<FlatPart> pieces;
        std::vector<Index> piece_of(whole.faces.size());
        for (const SeamedMesh& own : connected_parts(mesh)) {
            std::vector<Index> source(static_cast<std::size_t>(own.fan_count));
            for (Eigen::Index c = 0; c < own.fans.size(); ++c) source[own.fans.data()[c]] = own.corners.data()[c];
            auto piece = opened_piece(whole, own.face, own.fans, source);
            if (!piece) return {};
            for (const Index f : own.face) piece_of[f] = static_cast<Index>(pieces.size());
            pieces.push_back(std::move(*piece));
        }
        part_of_ = parts_of_pieces(proxy_, net_, near_, piece_of, pieces.size(), parts_.size());
        if (part_of_.empty()) return {};
        note_lengths(pieces, piece_of);
        side_by_side(pieces.size(), threads, context, [&](std::size_t k, ExecutionContext& own) {
            pieces[k].is_near = place(pieces[k], part_of_[k], own);
            if (!pieces[k].is_near) map_by_itself(pieces[k], own);
        });
        return pieces;
    }

private:
    /// @return whether the piece is one to one, also as stored
    bool place(FlatPart& piece, int part, const ExecutionContext& context) const
    {
        const std::vector<Index> face_near = faces_near(piece, parts_[part], part);
        if (std::ranges::count(face_near, -1) > 0) return false;
        const std::vector<char> none(piece.original.size(), 0);
        const PlanarPoints freely = courses(piece, parts_[part], face_near, {});
        piece.points = freely;
        std::vector<char> is_held(piece.surface.loops.size(), 0);
        for (const auto& [share, bulge] : attempts) {
            if (share > 0.0) {
                const std::vector<HeldVertex> by_rims = rims_of(piece, parts_[part], bulge);
                if (by_rims.empty()) return false;
                piece.points = courses(piece, parts_[part], face_near, held_between(piece, freely, by_rims, is_held, share));
            }
            if (!piece.points.allFinite()) return false;
            const bool is_upright = turn_upright(piece.vertices, piece.surface.triangles, piece.surface.loops, none,
                                                 piece.points, context);
            if (is_upright && lies_one_to_one(piece, piece.points) && survives_storing(piece)) return true;
            hold_crossing_loops(piece, is_held);
        }
        return false;
    }

    /// Loops that cross themselves or another one, or are turned over, or all but.
    static void hold_crossing_loops(const FlatPart& piece, std::vector<char>& is_held)
    {
        std::vector<int> loop_of(piece.original.size(), -1);
        for (std::size_t k = 0; k < piece.surface.loops.size(); ++k)
            for (const Index v : piece.surface.loops[k]) loop_of[v] = static_cast<int>(k);
        const auto before = std::ranges::count(is_held, 1);
        for (const auto& [a, b] : crossing_boundary_edges(piece.surface.loops, piece.points, 0.0))
            is_held[loop_of[a]] = is_held[loop_of[b]] = 1;
        for (const int k : turned_loops(piece.surface.loops, piece.points, 0.0)) is_held[k] = 1;
        if (std::ranges::count(is_held, 1) == before) is_held.assign(is_held.size(), 1);
    }

    /// (F) For each face of a piece the nearest coarse face of its part, on its side of all cuts: found by walks in the
    /// part, from faces that lie off its boundary.
    std::vector<Index> faces_near(const FlatPart& piece, const FlatPart& part, int number) const
    {
        const std::vector<char> outside = boundary_mask(part.surface);
        std::vector<Index> near(piece.faces.size(), -1), queue;
        const auto take = [&](std::size_t f, Index face) {
            near[f] = face;
            queue.push_back(static_cast<Index>(f));
        };
        for (const bool anywhere : {false, true})
            for (std::size_t f = 0; f < near.size() && (!anywhere || queue.empty()); ++f) {
                const Index face = near_.nearest(piece.faces[f], [&](Index) { return true; });
                if (face < 0 || net_.place[face].part != number) continue;
                const auto row = part.surface.triangles.row(net_.place[face].face);
                if (anywhere || !(outside[row[0]] || outside[row[1]] || outside[row[2]])) take(f, face);
            }
        for (std::size_t i = 0; i < queue.size(); ++i)
            for (Index h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h)
                if (const Index t = piece.surface.twin[h]; t != no_twin && near[face_of(t)] < 0)
                    take(static_cast<std::size_t>(face_of(t)), walk(piece, face_of(t), part, near[queue[i]]));
        return near;
    }

    /// Goes on in a part from face to face, as long as that is nearer to the middle of a fine face.
    Index walk(const FlatPart& piece, Index fine, const FlatPart& part, Index face) const
    {
        const Corners at = corners_of(piece.vertices, piece.surface.triangles, fine);
        const Eigen::RowVector3d middle = (at[0] + at[1] + at[2]) / 3.0;
        const auto distance = [&](Index own) {
            return squared_distance(middle, corners_of(proxy_.coarse.vertices, proxy_.surface.triangles, own));
        };
        double least = distance(face);
        for (bool is_nearer = true; std::exchange(is_nearer, false);) {
            const Index here = net_.place[face].face;
            for (Index h = 3 * here; h < 3 * here + 3; ++h)
                if (const Index t = part.surface.twin[h]; t != no_twin)
                    if (const double own = distance(part.faces[face_of(t)]); own < least) {
                        least = own;
                        face = part.faces[face_of(t)];
                        is_nearer = true;
                    }
        }
        return face;
    }

    /// As places_of; not finite where that fails.
    PlanarPoints courses(const FlatPart& piece, const FlatPart& part, const std::vector<Index>& face_near,
                         const std::vector<HeldVertex>& held) const
    {
        try {
            return places_of(piece, part, proxy_, net_, face_near, held);
        } catch (const SolverError&) {
            return PlanarPoints::Constant(piece.points.rows(), 2, std::numeric_limits<double>::quiet_NaN());
        }
    }

    /// The vertices of held loops, between the free places, moved as a whole, and those on the part's boundary.
    static std::vector<HeldVertex> held_between(const FlatPart& piece, const PlanarPoints& freely,
                                                const std::vector<HeldVertex>& by_rims, const std::vector<char>& is_held,
                                                double share)
    {
        Complex shift = 0.0;
        for (const auto& [v, at] : by_rims) shift += at - complex_at(freely, v);
        shift /= static_cast<double>(by_rims.size());
        std::vector<char> counts(piece.original.size(), 0);
        for (std::size_t k = 0; k < is_held.size(); ++k)
            if (is_held[k])
                for (const Index v : piece.surface.loops[k]) counts[v] = 1;
        std::vector<HeldVertex> held;
        for (const auto& [v, at] : by_rims)
            if (counts[v]) held.emplace_back(v, share * at + (1.0 - share) * (complex_at(freely, v) + shift));
        turn_ears_upright(piece, held);
        return held;
    }

    /// Moves the tip of a face with two edges on the boundary inwards, if the face would not be upright: at such a corner
    /// the part has more than one face.
    static void turn_ears_upright(const FlatPart& piece, std::vector<HeldVertex>& held)
    {
        const Triangles& triangles = piece.surface.triangles;
        const std::vector<Index>& twin = piece.surface.twin;
        PlanarPoints points = piece.points;
        std::vector<char> is_held(piece.original.size(), 0);
        for (const auto& [v, at] : held) {
            points.row(v) << at.real(), at.imag();
            is_held[v] = 1;
        }
        std::vector<Index> ear(piece.original.size(), no_twin);  // the half-edge that leaves its tip
        for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
            if (twin[h] == no_twin && twin[previous_halfedge(h)] == no_twin &&
                std::ranges::all_of(triangles.row(face_of(h)), [&](Index v) { return is_held[v] != 0; }) &&
                !(signed_area(points, triangles, face_of(h)) > 0.0))
                ear[origin(triangles, h)] = h;
        for (auto& [v, at] : held)
            if (ear[v] != no_twin) {
                const Complex from = complex_at(points, origin(triangles, previous_halfedge(ear[v])));
                at = from + Complex(0.5, -ear_height) * (complex_at(points, target(triangles, ear[v])) - from);
            }
    }

    /// The boundary's vertices on the boundary of the relaxed part, at the same share of its length from one common
    /// vertex to the next. Empty if the loops do not correspond.
    std::vector<HeldVertex> rims_of(const FlatPart& piece, const FlatPart& part, double bulge) const
    {
        std::vector<Index> coarse_of(static_cast<std::size_t>(proxy_.fine.whole.vertices.rows()), -1);
        for (const VertexLoop& rim : part.surface.loops)
            for (const Index v : rim) coarse_of[proxy_.coarse.vertex[part.original[v]]] = part.original[v];
        std::vector<HeldVertex> held;
        std::vector<char> taken(part.surface.loops.size(), 0);
        for (const VertexLoop& loop : piece.surface.loops) {
            std::vector<std::size_t> anchors;  // places in the loop of vertices that the part's boundary has
            std::vector<Index> names;
            for (std::size_t i = 0; i < loop.size(); ++i)
                if (const Index name = coarse_of[piece.original[loop[i]]]; name >= 0) {
                    anchors.push_back(i);
                    names.push_back(name);
                }
            const VertexLoop rim = rim_of(names, part, taken);
            if (rim.empty()) return {};
            std::size_t next = 0;
            for (std::size_t k = 0; k < anchors.size(); ++k) {
                std::vector<Complex> course{complex_at(part.points, rim[next])};
                const Index to_name = names[(k + 1) % names.size()];
                do course.push_back(complex_at(part.points, rim[++next % rim.size()]));
                while (next % rim.size() != 0 && (k + 1 == anchors.size() || part.original[rim[next]] != to_name));
                hold_along(course, piece, loop, anchors[k], anchors[(k + 1) % anchors.size()], bulge, held);
            }
        }
        return held;
    }

    /// Spreads the vertices of a loop from one place in it up to the next along a course in the plane.
    static void hold_along(const std::vector<Complex>& course, const FlatPart& piece, const VertexLoop& loop,
                           std::size_t from, std::size_t to, double bulge, std::vector<HeldVertex>& held)
    {
        const std::size_t count = to > from ? to - from : to + loop.size() - from;
        const auto vertex = [&](std::size_t i) { return loop[(from + i) % loop.size()]; };
        std::vector<double> length{0.0}, course_length{0.0};
        for (std::size_t i = 0; i < count; ++i)
            length.push_back(length.back() + (piece.vertices.row(vertex(i + 1)) - piece.vertices.row(vertex(i))).norm());
        for (std::size_t i = 1; i < course.size(); ++i)
            course_length.push_back(course_length.back() + std::abs(course[i] - course[i - 1]));
        std::size_t k = 1;
        for (std::size_t i = 0; i < count; ++i) {
            const double here = length[i] / length.back() * course_length.back();
            while (k + 1 < course.size() && here > course_length[k]) ++k;
            const double edge = course_length[k] - course_length[k - 1];
            const double t = edge > 0.0 ? (here - course_length[k - 1]) / edge : 0.0;
            held.emplace_back(vertex(i), course[k - 1] + Complex(t, -bulge * 4.0 * t * (1.0 - t)) * (course[k] - course[k - 1]));
        }
    }

    /// The part's loop that has these names one after the other, from the first of them; empty if there is none. It may
    /// have others between them: short darts may have no path, and a path may end elsewhere on a loop.
    static VertexLoop rim_of(const std::vector<Index>& names, const FlatPart& part, std::vector<char>& taken)
    {
        for (std::size_t k = 0; k < part.surface.loops.size(); ++k) {
            VertexLoop rim = part.surface.loops[k];
            if (taken[k] || names.empty()) continue;
            for (std::size_t turn = 0; turn < rim.size(); ++turn, std::ranges::rotate(rim, rim.begin() + 1)) {
                if (part.original[rim.front()] != names.front()) continue;
                std::size_t found = 0;
                for (const Index v : rim) found += found < names.size() && part.original[v] == names[found];
                if (found < names.size()) continue;
                taken[k] = 1;
                return rim;
            }
        }
        return {};
    }

    void map_by_itself(FlatPart& piece, ExecutionContext& context) const
    {
        PartMesh mesh;
        mesh.faces = piece.faces;
        mesh.original = piece.original;
        mesh.vertices = piece.vertices;
        mesh.surface = piece.surface;
        mesh.areas = face_areas(piece.vertices, piece.surface.triangles);
        mesh.area = mesh.areas.sum();
        mesh.border.assign(piece.original.size(), 0);
        const PartMap map = map_part(mesh, context);
        PlanarPoints points(map.positions.size(), 2);
        points << map.positions.real(), map.positions.imag();
        piece.points = flat_as_mapped(mesh, points).points;
        PlanarPoints uv = (piece.points.rowwise() - piece.points.colwise().minCoeff()) / packed_side;
        repair_flips(piece, uv, context);
        embed_safely(piece, uv, context);
        piece.points = packed_side * uv;
    }

    /// Lengths of slits and darts, as much longer than the coarse ones as the paths are; and the tips of darts, where
    /// one path ends inside.
    void note_lengths(std::vector<FlatPart>& pieces, const std::vector<Index>& piece_of) const
    {
        const CutSurface& fine = proxy_.fine.whole;
        const Triangles& triangles = fine.surface.triangles;
        std::vector<double> own(pieces.size(), 0.0), coarse(pieces.size(), 0.0);
        std::vector<char> ends = boundary_mask(fine.surface);  // (V) how many paths end there, or the boundary
        for (const auto& [chain, path] : paths_) {
            ends[origin(triangles, path.front())] += 1;
            ends[target(triangles, path.back())] += 1;
            if (net_.parts_differ(proxy_.surface, chain.front())) continue;
            const Index k = piece_of[face_of(path.front())];
            own[k] += path_length(fine.vertices, triangles, path);
            coarse[k] += path_length(proxy_.coarse.vertices, proxy_.surface.triangles, chain);
        }
        const std::vector<char> outside = boundary_mask(fine.surface);
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const FlatPart& part = parts_[part_of_[k]];
            const double share = coarse[k] > 0.0 ? own[k] / coarse[k] : 1.0;
            pieces[k].slit = share * part.slit;
            pieces[k].dart_length = share * part.dart_length;
            pieces[k].kind = part.kind;
            for (std::size_t v = 0; v < pieces[k].original.size(); ++v)
                if (const Index name = pieces[k].original[v]; ends[name] == 1 && !outside[name])
                    pieces[k].tips.push_back(static_cast<Index>(v));
        }
    }

    const Proxy& proxy_;
    const std::vector<FlatPart>& parts_;
    const CoarseNet& net_;
    std::vector<CarriedPath> paths_;
    NearFaces near_;
    std::vector<int> part_of_;  // (pieces)
};

}  // namespace

std::vector<std::vector<Index>> carried_faces(const Proxy& proxy, const std::vector<FlatPart>& parts,
                                              const ExecutionContext& context)
{
    const auto net = coarse_net(proxy, parts);
    if (!net) return {};
    std::vector<Index> twin = proxy.fine.whole.surface.twin;
    for (const auto& [chain, path] : carried_paths(proxy, *net, context))
        if (net->parts_differ(proxy.surface, chain.front()))
            for (const Index h : path) twin[proxy.fine.whole.surface.twin[h]] = twin[h] = no_twin;
    Index count = 0;
    const std::vector<int> same(static_cast<std::size_t>(proxy.fine.whole.areas.size()), 0);
    const std::vector<Index> piece = connected_pieces(twin, same, count);
    const std::vector<int> part_of =
        parts_of_pieces(proxy, *net, NearFaces(proxy), piece, static_cast<std::size_t>(count), parts.size());
    if (part_of.empty()) return {};
    std::vector<std::vector<Index>> faces(parts.size());
    for (std::size_t f = 0; f < piece.size(); ++f) faces[part_of[piece[f]]].push_back(static_cast<Index>(f));
    return faces;
}

std::vector<FlatPart> carried_parts(const Proxy& proxy, const std::vector<FlatPart>& parts, int threads,
                                    ExecutionContext& context)
{
    const auto net = coarse_net(proxy, parts);
    if (!net) return {};
    return Carrying(proxy, parts, *net, carried_paths(proxy, *net, context)).pieces(threads, context);
}

}  // namespace koebe
