#include "proxies/carried_places.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "darts/dart_rounds.h"
#include "flat/common_sequence.h"
#include "foldover/turn_upright.h"
#include "linear/sparse_cholesky.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double least_cotangent = 0.05;  // of a face's weight in the courses of its edges: needles count, too
constexpr int most_upright_failures = 2;  // attempts whose loops are right, but not their faces
constexpr double hold = 1e6;              // weight with which held vertices stay, over a cotangent

/// An attempt to hold crossing loops at the part's loops.
struct Attempt {
    double share;  ///< how near to them
    double bulge;  ///< of a coarse edge: how far its fine vertices lie outside, so that no face is flat
};
constexpr std::array attempts{Attempt{0.0, 0.0}, Attempt{0.9, 1e-3}, Attempt{1.0, 1e-3}, Attempt{1.0, 1e-4},
                              Attempt{1.0, 1e-5}};
constexpr std::size_t sequence_starts = 6;  // of a common sequence of names
constexpr double ear_height = 0.01;         // of a face at a corner that the part rounds, over its base

using HeldVertex = std::pair<Index, Complex>;  // and where it stays

Eigen::RowVector3d normal_of(const CornersInSpace& at) { return (at[1] - at[0]).cross(at[2] - at[0]); }

/// Turns vectors of one plane into another one, the shortest way.
Eigen::Matrix3d turn_between(const Eigen::RowVector3d& from, const Eigen::RowVector3d& to)
{
    return Eigen::Quaterniond::FromTwoVectors(from.transpose(), to.transpose()).toRotationMatrix();
}

/// Half of the cotangent at a corner, for the edge opposite to it.
double half_cotangent(const CornersInSpace& at, int k)
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
        const CornersInSpace at = corners_of(piece.vertices, piece.surface.triangles, f);
        const CornersInSpace there = corners_of(proxy.coarse.vertices, proxy.surface.triangles, face_near[f]);
        const auto row = part.surface.triangles.row(net.place[face_near[f]].face);
        // J = images (edges^T edges)^-1 edges^T, after the turn from the fine face into the plane of the coarse one.
        Eigen::Matrix<double, 3, 2> edges;
        edges << (there[1] - there[0]).transpose(), (there[2] - there[0]).transpose();
        Eigen::Matrix2d images;
        images << (part.points.row(row[1]) - part.points.row(row[0])).transpose(),
            (part.points.row(row[2]) - part.points.row(row[0])).transpose();
        const Eigen::Matrix2d gram = edges.transpose() * edges;
        Eigen::Matrix<double, 2, 3> map = images * gram.inverse() * edges.transpose();
        map = smaller * map * turn_between(normal_of(at), normal_of(there));
        if (!map.allFinite()) map.setZero();
        // Each edge: its course and its row of the Laplacian.
        for (int k = 0; k < 3; ++k) {
            const Index i = piece.surface.triangles(f, (k + 1) % 3), j = piece.surface.triangles(f, (k + 2) % 3);
            const double weight = half_cotangent(at, k);
            const Eigen::RowVector2d course =
                weight * (map * (at[(k + 2) % 3] - at[(k + 1) % 3]).transpose()).transpose();
            load.row(j) += course;
            load.row(i) -= course;
            entries.insert(entries.end(), {{i, i, weight}, {j, j, weight}, {i, j, -weight}, {j, i, -weight}});
        }
    }
    // Held vertices stay by a large weight.
    if (held.empty()) entries.emplace_back(0, 0, 1.0);  // the first vertex stays at the origin
    for (const auto& [v, at] : held) {
        entries.emplace_back(v, v, hold);
        load.row(v) += hold * Eigen::RowVector2d(at.real(), at.imag());
    }
    SparseMatrix matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return SparseCholesky(matrix).solve(load);
}

/// A part of the proxy and the piece that corresponds to it.
class Placing {
public:
    /// @param face_near (F) of the piece: the nearest coarse face
    Placing(const Proxy& proxy, const CoarseNet& net, const FlatPart& part, std::vector<Index> face_near)
        : proxy_(proxy), net_(net), part_(part), face_near_(std::move(face_near))
    {
    }

    /// @return whether the piece is one to one, also as stored
    bool place(FlatPart& piece, const ExecutionContext& context) const
    {
        if (std::ranges::count(face_near_, -1) > 0) return false;
        const std::vector<char> none(piece.original.size(), 0);
        const PlanarPoints freely = courses(piece, {});
        piece.points = freely;
        std::vector<char> is_held(piece.surface.loops.size(), 0);
        int failures = 0;
        for (const auto& [share, bulge] : attempts) {
            if (share > 0.0) {
                const std::vector<HeldVertex> by_rims = rims_of(piece, bulge);
                if (by_rims.empty()) return false;
                piece.points = courses(piece, held_between(piece, freely, by_rims, is_held, share));
            }
            if (!piece.points.allFinite()) return false;
            if (hold_crossing_loops(piece, is_held)) continue;
            if (turn_upright(piece.vertices, piece.surface.triangles, piece.surface.loops, none, piece.points,
                             context) &&
                lies_one_to_one(piece, piece.points) && survives_storing(piece))
                return true;
            if (++failures == most_upright_failures) return false;
            is_held.assign(is_held.size(), 1);
        }
        return false;
    }

private:
    /// Holds loops that cross themselves or another one, or are turned over; all loops, if these are held already.
    /// @return whether there are such loops
    static bool hold_crossing_loops(const FlatPart& piece, std::vector<char>& is_held)
    {
        std::vector<int> loop_of(piece.original.size(), -1);
        for (std::size_t k = 0; k < piece.surface.loops.size(); ++k)
            for (const Index v : piece.surface.loops[k]) loop_of[v] = static_cast<int>(k);
        const std::vector<char> before = is_held;
        bool crosses = false;
        const auto hold = [&](int loop) {
            crosses = true;
            is_held[loop] = 1;
        };
        for (const auto& [a, b] : crossing_boundary_edges(piece.surface.loops, piece.points, 0.0)) {
            hold(loop_of[a]);
            hold(loop_of[b]);
        }
        for (const int k : turned_loops(piece.surface.loops, piece.points, 0.0)) hold(k);
        if (crosses && is_held == before) is_held.assign(is_held.size(), 1);
        return crosses;
    }

    /// As places_of; not finite where that fails.
    PlanarPoints courses(const FlatPart& piece, const std::vector<HeldVertex>& held) const
    {
        try {
            return places_of(piece, part_, proxy_, net_, face_near_, held);
        } catch (const SolverError&) {
            return PlanarPoints::Constant(piece.points.rows(), 2, std::numeric_limits<double>::quiet_NaN());
        }
    }

    /// The vertices of held loops, between the free places, moved as a whole, and those on the part's boundary.
    static std::vector<HeldVertex> held_between(const FlatPart& piece, const PlanarPoints& freely,
                                                const std::vector<HeldVertex>& by_rims,
                                                const std::vector<char>& is_held, double share)
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

    /// Moves the tip of a face with two edges on the boundary inwards, if the face would not be upright: at such a
    /// corner the part has more than one face.
    static void turn_ears_upright(const FlatPart& piece, std::vector<HeldVertex>& held)
    {
        const Triangles& triangles = piece.surface.triangles;
        const std::vector<Index>& twin = piece.surface.twin;
        PlanarPoints points = piece.points;
        std::vector<char> is_held(piece.original.size(), 0);
        for (const auto& [v, at] : held) {
            put_complex(points, v, at);
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
    std::vector<HeldVertex> rims_of(const FlatPart& piece, double bulge) const
    {
        // The coarse vertex at each fine one on the boundary.
        std::vector<Index> coarse_of(static_cast<std::size_t>(proxy_.fine.whole.vertices.rows()), -1);
        for (const VertexLoop& rim : part_.surface.loops)
            for (const Index v : rim) coarse_of[proxy_.coarse.vertex[part_.original[v]]] = part_.original[v];
        std::vector<HeldVertex> held;
        std::vector<char> taken(part_.surface.loops.size(), 0);
        for (const VertexLoop& loop : piece.surface.loops) {
            // Vertices that both boundaries have, in the same order round both.
            std::vector<std::size_t> anchors;  // places in the loop of vertices that the part's boundary has
            std::vector<Index> names;
            for (std::size_t i = 0; i < loop.size(); ++i)
                if (const Index name = coarse_of[piece.original[loop[i]]]; name >= 0) {
                    anchors.push_back(i);
                    names.push_back(name);
                }
            const RimMatch match = match_of(names, taken);
            if (match.pairs.empty()) return {};
            // Between two of them the loop runs along the course of the part's boundary.
            const VertexLoop& rim = part_.surface.loops[match.loop];
            for (std::size_t k = 0; k < match.pairs.size(); ++k) {
                const auto [from, start] = match.pairs[k];
                const auto [to, end] = match.pairs[(k + 1) % match.pairs.size()];
                std::vector<Complex> course{complex_at(part_.points, rim[start])};
                for (std::size_t i = start; i == start || i != end;)
                    course.push_back(complex_at(part_.points, rim[i = (i + 1) % rim.size()]));
                hold_along(course, piece, loop, anchors[from], anchors[to], bulge, held);
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
            length.push_back(length.back() +
                             (piece.vertices.row(vertex(i + 1)) - piece.vertices.row(vertex(i))).norm());
        for (std::size_t i = 1; i < course.size(); ++i)
            course_length.push_back(course_length.back() + std::abs(course[i] - course[i - 1]));
        std::size_t k = 1;
        for (std::size_t i = 0; i < count; ++i) {
            const double here = length[i] / length.back() * course_length.back();
            while (k + 1 < course.size() && here > course_length[k]) ++k;
            const double edge = course_length[k] - course_length[k - 1];
            const double t = edge > 0.0 ? (here - course_length[k - 1]) / edge : 0.0;
            held.emplace_back(vertex(i),
                              course[k - 1] + Complex(t, -bulge * 4.0 * t * (1.0 - t)) * (course[k] - course[k - 1]));
        }
    }

    /// Names of a piece's loop and the places where the part's loop has them, in the same order round both.
    struct RimMatch {
        std::size_t loop = 0;                                    ///< of the part
        std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< number of the name, place in the loop
    };

    /// The part's loop that has most of these names one after the other; no pairs if none has half of them. It may have
    /// others between them: short darts may have no path. Names are left out where a path ends elsewhere on a loop.
    RimMatch match_of(const std::vector<Index>& names, std::vector<char>& taken) const
    {
        RimMatch best;
        for (std::size_t k = 0; k < part_.surface.loops.size() && best.pairs.size() < names.size(); ++k) {
            if (taken[k]) continue;
            const std::vector<Index> rim = values_at(part_.original, part_.surface.loops[k]);
            const auto turned = [](std::vector<Index> list, std::size_t first) {
                std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(first), list.end());
                return list;
            };
            for (const std::size_t first : starts(names, rim)) {
                const std::size_t there = std::ranges::find(rim, names[first]) - rim.begin();
                auto pairs = common_sequence(turned(names, first), turned(rim, there));
                for (auto& [i, j] : pairs) {
                    i = (i + first) % names.size();
                    j = (j + there) % rim.size();
                }
                if (pairs.size() > best.pairs.size()) best = {k, std::move(pairs)};
            }
        }
        if (2 * best.pairs.size() < names.size()) return {};
        if (!best.pairs.empty()) taken[best.loop] = 1;
        return best;
    }

    /// Some names that stand once in both lists, spread over the names; else the first one in both.
    static std::vector<std::size_t> starts(const std::vector<Index>& names, const std::vector<Index>& rim)
    {
        std::unordered_map<Index, std::pair<int, int>> counts;  // of a name, in both lists
        for (const Index name : names) ++counts[name].first;
        for (const Index name : rim) ++counts[name].second;
        std::vector<std::size_t> all, some;
        for (std::size_t i = 0; i < names.size(); ++i)
            if (counts.at(names[i]) == std::pair(1, 1)) all.push_back(i);
        for (std::size_t i = 0; i < names.size() && all.empty(); ++i)
            if (counts.at(names[i]).second > 0) all.push_back(i);
        for (std::size_t i = 0; i < std::min(sequence_starts, all.size()); ++i)
            some.push_back(all[i * all.size() / std::min(sequence_starts, all.size())]);
        return some;
    }

    const Proxy& proxy_;
    const CoarseNet& net_;
    const FlatPart& part_;
    std::vector<Index> face_near_;
};

}  // namespace

bool take_places(const Proxy& proxy, const CoarseNet& net, const NearFaces& near, const FlatPart& part, int number,
                 FlatPart& piece, const ExecutionContext& context)
{
    return Placing(proxy, net, part, near.of_piece(piece, net, part, number)).place(piece, context);
}

}  // namespace koebe
