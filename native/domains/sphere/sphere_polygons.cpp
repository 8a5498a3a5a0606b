#include "sphere/sphere_polygons.h"

#include "quality/stored_uv.h"
#include "sphere/placed_face.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr double farthest_whole = 2.0;  // up to here 32-bit UVs hold multiples of 2^-23

using CornerPlace = Eigen::RowVector2d;

/// A motion of the plane that keeps the pattern: u -> sign u + shift.
struct PatternMotion {
    double sign = 1.0;
    CornerPlace shift = CornerPlace::Zero();

    CornerPlace operator()(const CornerPlace& at) const { return sign * at + shift; }
    bool moves() const { return sign < 0.0 || shift != CornerPlace::Zero(); }
};

/// An edge of a triangle, smaller vertex first.
struct InnerEdge {
    Index low, high, face;
    bool operator<(const InnerEdge& other) const
    {
        return std::tie(low, high, face) < std::tie(other.low, other.high, other.face);
    }
    bool same(const InnerEdge& other) const { return low == other.low && high == other.high; }
};

class PolygonJoiner {
public:
    PolygonJoiner(const Triangles& triangles, const Vertices& points, SphereLayout layout, PlanarPoints& uv,
                  LayoutMarks& marks)
        : triangles_(triangles), points_(points), layout_(layout), uv_(uv), marks_(marks)
    {
    }

    /// @param faces of one polygon
    void join(const std::vector<Index>& faces)
    {
        const std::vector<std::pair<InnerEdge, Index>> pairs = neighbours(faces);
        std::vector<Index> order{*std::ranges::max_element(faces, {}, [&](Index f) { return rank(f); })};
        std::vector<Index> left = faces;
        std::erase(left, order.front());
        for (std::size_t next = 0; !left.empty(); ++next) {
            if (next == order.size()) {  // the polygon's triangles are not connected
                order.push_back(left.front());
                left.erase(left.begin());
            }
            const Index parent = order[next];
            for (auto at = std::ranges::lower_bound(pairs, parent, {}, [](const auto& p) { return p.first.face; });
                 at != pairs.end() && at->first.face == parent; ++at) {
                const auto child = std::ranges::find(left, at->second);
                if (child == left.end()) continue;
                continue_over(at->first, *child);
                order.push_back(*child);
                left.erase(child);
            }
        }
        if (layout_ == SphereLayout::equirectangular) finish_longitudes(faces);
        keep_whole(faces);
    }

private:
    /// All pairs of faces of the polygon with a common edge, in both orders.
    std::vector<std::pair<InnerEdge, Index>> neighbours(const std::vector<Index>& faces) const
    {
        std::vector<InnerEdge> edges;
        for (const Index f : faces)
            for (int k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(triangles_(f, k), triangles_(f, (k + 1) % 3));
                edges.push_back({low, high, f});
            }
        std::sort(edges.begin(), edges.end());
        std::vector<std::pair<InnerEdge, Index>> pairs;
        for (std::size_t i = 1; i < edges.size(); ++i)
            if (edges[i].same(edges[i - 1])) {
                pairs.emplace_back(edges[i - 1], edges[i].face);
                pairs.emplace_back(edges[i], edges[i - 1].face);
            }
        std::ranges::sort(pairs, {}, [](const auto& p) { return std::tuple(p.first.face, p.second); });
        return pairs;
    }

    /// Sorts the largest whole face first.
    std::pair<bool, double> rank(Index f) const
    {
        const CornerPlace a = place(f, 1) - place(f, 0), b = place(f, 2) - place(f, 0);
        return {marks_.torn[static_cast<std::size_t>(f)] == 0, std::abs(a[0] * b[1] - a[1] * b[0])};
    }

    CornerPlace place(Index f, int k) const { return uv_.row(3 * f + k); }

    int corner(Index f, Index vertex) const
    {
        int k = 0;
        while (triangles_(f, k) != vertex) ++k;
        return k;
    }

    bool at_pole(Index vertex) const
    {
        return layout_ == SphereLayout::equirectangular && points_(vertex, 0) == 0.0 && points_(vertex, 1) == 0.0;
    }

    /// Puts a face where the pattern continues its neighbour over the edge.
    void continue_over(const InnerEdge& edge, Index child)
    {
        const Index parent = edge.face;
        const std::array<Index, 2> ends{edge.low, edge.high};
        std::array<CornerPlace, 2> there, own;
        for (std::size_t i = 0; i < 2; ++i) {
            there[i] = place(parent, corner(parent, ends[i]));
            own[i] = place(child, corner(child, ends[i]));
        }
        PatternMotion best;
        double least = INFINITY;
        for (std::size_t i = 0; i < 2; ++i) {  // measured at that end
            for (const double sign : {1.0, -1.0}) {
                if (sign < 0.0 && layout_ == SphereLayout::equirectangular) continue;
                if (at_pole(ends[i]) && !at_pole(ends[1 - i])) continue;
                const PatternMotion motion{sign, whole_shift(there[i] - sign * own[i], sign)};
                double off = 0.0;
                for (std::size_t j = 0; j < 2; ++j)
                    if (!at_pole(ends[j])) off += (motion(own[j]) - there[j]).norm();
                if (off >= least) continue;
                least = off;
                best = motion;
            }
        }
        for (int k = 0; k < 3; ++k) uv_.row(3 * child + k) = best(place(child, k));
        for (std::size_t i = 0; i < 2; ++i) uv_.row(3 * child + corner(child, ends[i])) = there[i];
        if (best.moves()) marks_.crossing[static_cast<std::size_t>(child)] = 1;
        if (least > 0.0) marks_.torn[static_cast<std::size_t>(child)] = 1;
    }

    /// The pattern's shift that is nearest to this one.
    CornerPlace whole_shift(const CornerPlace& shift, double sign) const
    {
        CornerPlace whole(std::round(shift[0]), layout_ == SphereLayout::equirectangular ? 0.0 : std::round(shift[1]));
        if (layout_ == SphereLayout::equirectangular) return whole;
        // Half turns round the sides' middles, (1/2, 0) and the like, have an odd sum; products of two an even one.
        const bool odd = std::fmod(std::abs(whole[0] + whole[1]), 2.0) == 1.0;
        if (odd == (sign < 0.0)) return whole;
        const CornerPlace rest = shift - whole;
        const Eigen::Index axis = std::abs(rest[0]) > std::abs(rest[1]) ? 0 : 1;
        whole[axis] += rest[axis] < 0.0 ? -1.0 : 1.0;
        return whole;
    }

    /// Puts poles over the middle of the other corners, and the least longitude into [0, 1).
    void finish_longitudes(const std::vector<Index>& faces)
    {
        double least = INFINITY, most = -INFINITY;
        for (const Index f : faces)
            for (int k = 0; k < 3; ++k)
                if (!at_pole(triangles_(f, k))) {
                    least = std::min(least, place(f, k)[0]);
                    most = std::max(most, place(f, k)[0]);
                }
        if (least > most) return;
        for (const Index f : faces)
            for (int k = 0; k < 3; ++k) {
                double& u = uv_(3 * f + k, 0);
                if (at_pole(triangles_(f, k))) u = on_uv_steps(0.5 * (least + most));
                u -= std::floor(least);
            }
        for (const Index f : faces) {
            const bool crossing = uv_.middleRows(3 * f, 3).col(0).maxCoeff() >= 1.0;
            marks_.crossing[static_cast<std::size_t>(f)] = crossing ? 1 : 0;
        }
    }

    void keep_whole(const std::vector<Index>& faces)
    {
        for (const Index f : faces) {
            auto own = uv_.middleRows(3 * f, 3);
            if (own.cwiseAbs().maxCoeff() <= farthest_whole) continue;
            own = own.unaryExpr(&as_stored).eval();
            marks_.torn[static_cast<std::size_t>(f)] = 1;
        }
    }

    const Triangles& triangles_;
    const Vertices& points_;
    SphereLayout layout_;
    PlanarPoints& uv_;
    LayoutMarks& marks_;
};

}  // namespace

void join_polygon(const std::vector<Index>& faces, const Triangles& triangles, const Vertices& points,
                  SphereLayout layout, PlanarPoints& uv, LayoutMarks& marks)
{
    PolygonJoiner(triangles, points, layout, uv, marks).join(faces);
}

}  // namespace koebe
