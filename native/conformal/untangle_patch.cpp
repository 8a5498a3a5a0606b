#include "conformal/untangle_patch.h"

#include "conformal/foldover_free.h"
#include "conformal/patch_shapes.h"
#include "conformal/stored_uv.h"
#include "geometry/planar_predicates.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace koebe {
namespace {

constexpr double rounding = 3e-7;     // twice the area a face can lose by rounding, over its longest edge, disk units
constexpr double inward = 5e-7;       // disk units: half of what counts as on the circle, four roundings of 32-bit UVs
constexpr double least_edge = 1e-11;  // disk units: 1e5 times the rounding of 64-bit positions

}  // namespace

TangledMap::TangledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                       const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv)
    : vertices_(vertices),
      surface_(surface),
      loops_(loops),
      circles_(circles),
      uv_(uv),
      place_(surface.vertex_count, Place::inside),
      flap_(surface.vertex_count, 0),
      loop_of_(surface.vertex_count, -1),
      begin_(surface.vertex_count + 1, 0),
      faces_of_(surface.triangles.size())
{
    for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Index v : loops[k]) {
            loop_of_[v] = static_cast<int>(k);
            place_[v] = Place::on_circle;
        }
    for (const Index v : off_circle) {
        place_[v] = Place::off_circle;
        flap_[v] = 1;
    }
    const Triangles& triangles = surface.triangles;
    for (Eigen::Index i = 0; i < triangles.size(); ++i) ++begin_[triangles.data()[i] + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    std::vector<Index> cursor(begin_.begin(), begin_.end() - 1);
    for (Eigen::Index i = 0; i < triangles.size(); ++i)
        faces_of_[cursor[triangles.data()[i]]++] = static_cast<Index>(i / 3);
}

std::vector<Index> TangledMap::tangled() const
{
    std::vector<Index> result;
    for (Eigen::Index f = 0; f < triangles().rows(); ++f)
        if (const StoredFace face(triangles(), uv_, f); face.flipped() && !face.below_resolution())
            result.push_back(static_cast<Index>(f));
    return result;
}

std::vector<Index> TangledMap::tangled(const std::vector<Index>& faces) const
{
    std::vector<Index> result;
    for (const Index f : faces)
        if (const StoredFace face(triangles(), uv_, f); face.flipped() && !face.below_resolution()) result.push_back(f);
    return result;
}

std::size_t TangledMap::flipped(const std::vector<Index>& faces) const
{
    return std::count_if(faces.begin(), faces.end(),
                         [&](Index f) { return StoredFace(triangles(), uv_, f).flipped(); });
}

/// Whether nothing around a vertex is large enough for 64-bit positions to be moved with sense.
bool TangledMap::collapsed(Index vertex) const
{
    for (Index i = begin_[vertex]; i < begin_[vertex + 1]; ++i)
        for (int k = 0; k < 3; ++k)
            if ((uv_.row(triangles()(faces_of_[i], k)) - uv_.row(vertex)).norm() > least_edge) return false;
    return true;
}

bool TangledMap::mobile(Index vertex, PatchBoundary boundary) const
{
    const bool may = place_[vertex] == Place::inside || boundary == PatchBoundary::sliding ||
                     (place_[vertex] == Place::off_circle && boundary == PatchBoundary::freed);
    return may && !collapsed(vertex);
}

bool TangledMap::hangs(Index face) const
{
    return std::any_of(triangles().row(face).begin(), triangles().row(face).end(),
                       [&](Index v) { return flap_[v] != 0; });
}

bool TangledMap::near_circle(Index vertex) const
{
    const Circle& circle = circles_[loop_of_[vertex]];
    return std::abs(std::abs(Complex(uv_(vertex, 0), uv_(vertex, 1)) - circle.center) - circle.radius) <= inward;
}

std::vector<std::vector<Index>> TangledMap::patches(const std::vector<Index>& faces, int rings,
                                                    PatchBoundary boundary) const
{
    std::vector<char> taken(triangles().rows(), 0);
    std::vector<Index> region = faces;
    for (const Index f : faces) taken[f] = 1;
    std::size_t ring_begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const std::size_t ring_end = region.size();
        for (; ring_begin < ring_end; ++ring_begin)
            for (int k = 0; k < 3; ++k) {
                const Index v = triangles()(region[ring_begin], k);
                for (Index i = begin_[v]; i < begin_[v + 1]; ++i)
                    if (!std::exchange(taken[faces_of_[i]], 1)) region.push_back(faces_of_[i]);
            }
    }
    // Vertices on the edge of the region are held: groups meet only there.
    const auto moves = [&](Index v) {
        for (Index i = begin_[v]; i < begin_[v + 1]; ++i)
            if (!taken[faces_of_[i]]) return false;
        return mobile(v, boundary);
    };
    std::vector<char> grouped(triangles().rows(), 0);
    std::map<Index, bool> moves_cache;
    std::vector<std::vector<Index>> result;
    for (const Index seed : faces) {
        if (std::exchange(grouped[seed], 1)) continue;
        std::vector<Index> group{seed};
        for (std::size_t head = 0; head < group.size(); ++head)
            for (int k = 0; k < 3; ++k) {
                const Index v = triangles()(group[head], k);
                const auto [known, fresh] = moves_cache.try_emplace(v, false);
                if (!fresh) continue;  // its faces are in a group already, or it does not move
                known->second = moves(v);
                if (!known->second) continue;
                for (Index i = begin_[v]; i < begin_[v + 1]; ++i)
                    if (!std::exchange(grouped[faces_of_[i]], 1)) group.push_back(faces_of_[i]);
            }
        std::sort(group.begin(), group.end());
        result.push_back(std::move(group));
    }
    return result;
}

bool TangledMap::repair(const std::vector<Index>& patch, PatchShape shape, PatchBoundary boundary,
                        const ExecutionContext& context)
{
    const std::size_t tangled_before = tangled(patch).size(), lost_before = flipped(patch) - tangled_before;
    if (tangled_before == 0) return false;
    std::vector<Index> names;
    for (const Index f : patch)
        for (int k = 0; k < 3; ++k) names.push_back(triangles()(f, k));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    const auto rank = [&](Index v) {
        return static_cast<Index>(std::lower_bound(names.begin(), names.end(), v) - names.begin());
    };

    FoldoverProblem problem;
    problem.points = uv_(names, Eigen::all);
    problem.circles.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Index v = names[i];
        bool moves = mobile(v, boundary);
        for (Index j = begin_[v]; j < begin_[v + 1] && moves; ++j)
            moves = std::binary_search(patch.begin(), patch.end(), faces_of_[j]);
        if (loop_of_[v] >= 0) problem.circles[i] = circles_[loop_of_[v]];
        problem.mobility.push_back(!moves                          ? FoldoverProblem::Mobility::held
                                   : place_[v] == Place::on_circle ? FoldoverProblem::Mobility::sliding
                                                                   : FoldoverProblem::Mobility::free);
    }
    const auto is_held = [&](Index v) { return problem.mobility[rank(v)] == FoldoverProblem::Mobility::held; };
    std::vector<Index> faces;
    for (const Index f : patch)
        if (!(is_held(triangles()(f, 0)) && is_held(triangles()(f, 1)) && is_held(triangles()(f, 2))))
            faces.push_back(f);
    if (faces.empty()) return false;

    const PatchShapes wanted = patch_shapes(vertices_, triangles(), uv_, faces, shape);
    problem.reference = wanted.references;
    problem.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
    problem.floor = VectorXd::Zero(static_cast<Eigen::Index>(faces.size()));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Index f = faces[i];
        double area = wanted.areas[i];
        double longest = 1.5 * std::sqrt(area);
        for (int k = 0; k < 3; ++k) {
            problem.triangles(i, k) = rank(triangles()(f, k));
            longest = std::max(longest, (uv_.row(triangles()(f, k)) - uv_.row(triangles()(f, (k + 1) % 3))).norm());
        }
        const StoredFace face(triangles(), uv_, f);
        if (hangs(f) && !face.flipped()) {
            // A flap keeps the shape in which it fits into its hole.
            const auto corner = [&](int k) { return uv_.row(triangles()(f, k)).transpose(); };
            problem.reference[i] << corner(1) - corner(0), corner(2) - corner(0);
            area = 0.5 * problem.reference[i].determinant();
        }
        if (!face.below_resolution()) problem.floor[i] = rounding * longest / (2.0 * area);
        if (!face.flipped()) problem.floor[i] = std::min(problem.floor[i], 2.0 * face.area() / area);
    }
    minimize_foldover_free(problem, context);

    const PlanarPoints before = uv_(names, Eigen::all);
    std::vector<Index> moved_rim;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (problem.mobility[i] != FoldoverProblem::Mobility::held && loop_of_[names[i]] >= 0)
            moved_rim.push_back(names[i]);
    for (std::size_t i = 0; i < names.size(); ++i) uv_.row(names[i]) = problem.points.row(i);
    const std::size_t tangled_now = tangled(patch).size();
    if (problem.points.allFinite() && tangled_now < tangled_before && flipped(patch) - tangled_now <= lost_before &&
        !loops_cross(moved_rim))
        return true;
    for (std::size_t i = 0; i < names.size(); ++i) uv_.row(names[i]) = before.row(i);
    return false;
}

bool TangledMap::nudge(Index face)
{
    std::array<Index, 3> v{triangles()(face, 0), triangles()(face, 1), triangles()(face, 2)};
    for (const Index corner : v)
        if (loop_of_[corner] != 0 || place_[corner] != Place::on_circle) return false;
    // The middle one is opposite to the longest edge.
    const auto opposite = [&](int k) { return (uv_.row(v[(k + 1) % 3]) - uv_.row(v[(k + 2) % 3])).squaredNorm(); };
    const int middle = opposite(0) > std::max(opposite(1), opposite(2)) ? 0 : opposite(1) > opposite(2) ? 1 : 2;
    std::vector<Index> around;
    for (const int k : {(middle + 1) % 3, (middle + 2) % 3})
        around.insert(around.end(), faces_of_.begin() + begin_[v[k]], faces_of_.begin() + begin_[v[k] + 1]);
    const std::size_t tangled_before = tangled(around).size();
    const PlanarPoints before = uv_(v, Eigen::all);
    for (const int k : {(middle + 1) % 3, (middle + 2) % 3}) uv_.row(v[k]) *= (1.0 - inward) / uv_.row(v[k]).norm();
    if (tangled(around).size() < tangled_before) return true;
    for (int k = 0; k < 3; ++k) uv_.row(v[k]) = before.row(k);
    return false;
}

/// Whether an edge of a loop at one of these vertices meets another edge of any loop.
bool TangledMap::loops_cross(const std::vector<Index>& moved) const
{
    const auto at = [&](Index v) { return Complex(uv_(v, 0), uv_(v, 1)); };
    for (const VertexLoop& loop : loops_)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index a = loop[i], b = loop[(i + 1) % loop.size()];
            if (!std::binary_search(moved.begin(), moved.end(), a) &&
                !std::binary_search(moved.begin(), moved.end(), b))
                continue;
            for (const VertexLoop& other : loops_)
                for (std::size_t j = 0; j < other.size(); ++j) {
                    const Index c = other[j], d = other[(j + 1) % other.size()];
                    if (c != a && c != b && d != a && d != b && segments_meet(at(a), at(b), at(c), at(d))) return true;
                }
        }
    return false;
}

}  // namespace koebe
