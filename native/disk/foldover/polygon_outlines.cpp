#include "foldover/polygon_outlines.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <utility>

namespace koebe {
namespace {

constexpr double least_turn = 1e-6;  // of a corner's triangle, over the polygon's area

/// Whether each corner turns left, and all corners go round once.
/// @param left (a, b, c) -> whether the corner b turns left
template <class Left>
bool goes_round_convex(std::span<const Complex> points, const Left& left)
{
    const std::size_t n = points.size();
    int changes = 0;  // of the half-plane in which an edge points: two in one turn
    const auto points_down = [](Complex d) { return d.imag() < 0.0 || (d.imag() == 0.0 && d.real() < 0.0); };
    for (std::size_t i = 0; i < n; ++i) {
        const Complex a = points[i], b = points[(i + 1) % n], c = points[(i + 2) % n];
        if (!left(a, b, c)) return false;
        changes += points_down(b - a) != points_down(c - b) ? 1 : 0;
    }
    return changes == 2;
}

bool is_convex_as_stored(std::span<const Complex> uv)
{
    const auto stored = [](Complex z) { return StoredPoint{as_stored(z.real()), as_stored(z.imag())}; };
    return goes_round_convex(
        uv, [&](Complex a, Complex b, Complex c) { return !StoredFace(stored(a), stored(b), stored(c)).doubtful(); });
}

/// Whether a polygon's projection onto the plane of its area vector is convex.
bool is_convex_in_space(std::span<const Eigen::Vector3d> corners)
{
    // In units of the polygon, so that no square over- or underflows.
    std::vector<Eigen::Vector3d> p;
    double unit = 0.0;
    for (const Eigen::Vector3d& corner : corners) {
        p.push_back(0.5 * corner - 0.5 * corners.front());
        unit = std::max(unit, p.back().lpNorm<Eigen::Infinity>());
    }
    if (!(unit > 0.0)) return false;
    for (Eigen::Vector3d& corner : p) corner /= unit;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < p.size(); ++i) normal += p[i].cross(p[(i + 1) % p.size()]);
    const double area = normal.norm();  // twice
    if (!(area > 0.0)) return false;
    const Eigen::Vector3d across = normal.unitOrthogonal(), up = (normal / area).cross(across);
    std::vector<Complex> flat;
    for (const Eigen::Vector3d& corner : p) flat.emplace_back(corner.dot(across), corner.dot(up));
    return goes_round_convex(flat,
                             [&](Complex a, Complex b, Complex c) { return cross(b - a, c - a) > least_turn * area; });
}

}  // namespace

PolygonOutlines::PolygonOutlines(const SurfacePolygons& surface)
    : surface_(surface), turned_(surface.triangles.rows(), 0)
{
    const std::vector<Index>& polygon = surface.polygon;
    if (polygon.empty()) return;
    if (polygon.size() != turned_.size()) throw InputError("there must be a polygon for each face");
    for (const Index f : surface.turned) turned_[f] = 1;
    std::vector<Index> order = numbers_below(polygon.size());
    if (!std::ranges::is_sorted(polygon)) std::ranges::stable_sort(order, {}, [&](Index f) { return polygon[f]; });
    std::vector<char> out(turned_.size(), 0);
    for (const Index f : surface.left_out) out[f] = 1;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        while (end < order.size() && polygon[order[end]] == polygon[order[begin]]) ++end;
        const std::span<const Index> faces(order.data() + begin, order.data() + end);
        if (faces.size() > 1 && std::ranges::none_of(faces, [&](Index f) { return out[f] != 0; })) add(faces);
    }
}

bool PolygonOutlines::convex_in_space(Index i) const
{
    std::vector<Eigen::Vector3d> corners;
    for (const Index c : outline(i)) corners.push_back(surface_.vertices.row(vertex(c)).transpose());
    return !corners.empty() && is_convex_in_space(corners);
}

bool PolygonOutlines::convex_in(Index i, const PlanarPoints& uv) const
{
    const std::span<const Index> around = outline(i);
    std::vector<Complex> places;
    for (const Index c : around) places.emplace_back(uv(c, 0), uv(c, 1));
    return !around.empty() && is_convex_as_stored(places) && !torn(i, uv);
}

bool PolygonOutlines::torn(Index i, const PlanarPoints& uv) const
{
    std::vector<std::pair<Index, Index>> corners;
    for (const Index f : faces(i))
        for (Index c = 3 * f; c < 3 * f + 3; ++c) corners.emplace_back(vertex(c), c);
    std::ranges::sort(corners);
    for (std::size_t k = 1; k < corners.size(); ++k)
        if (corners[k].first == corners[k - 1].first && !(uv.row(corners[k].second) == uv.row(corners[k - 1].second)))
            return true;
    return false;
}

void PolygonOutlines::add(std::span<const Index> faces)
{
    faces_.insert(faces_.end(), faces.begin(), faces.end());
    face_begin_.push_back(faces_.size());
    add_outline(faces);
    outline_begin_.push_back(outlines_.size());
}

void PolygonOutlines::add_outline(std::span<const Index> faces)
{
    edges_.clear();
    for (const Index f : faces)
        for (int k = 0; k < 3; ++k)
            edges_.push_back({vertex(corner(f, k)), vertex(corner(f, (k + 1) % 3)), corner(f, k)});
    const auto ends = [](const Edge& edge) { return std::pair(edge.from, edge.to); };
    std::ranges::sort(edges_, {}, ends);
    outer_.clear();
    for (const Edge& edge : edges_)
        if (!std::ranges::binary_search(edges_, std::pair(edge.to, edge.from), {}, ends)) outer_.push_back(edge);
    if (outer_.size() != faces.size() + 2) return;
    const std::size_t begin = outlines_.size();
    Index at = outer_.front().from;
    do {
        const auto next = std::ranges::lower_bound(outer_, at, {}, &Edge::from);
        const bool is_only = next != outer_.end() && next->from == at &&
                             (std::next(next) == outer_.end() || std::next(next)->from != at);
        if (!is_only || outlines_.size() - begin == outer_.size()) return outlines_.resize(begin);
        outlines_.push_back(next->corner);
        at = next->to;
    } while (at != outer_.front().from);
    if (outlines_.size() - begin != outer_.size()) outlines_.resize(begin);
}

}  // namespace koebe
