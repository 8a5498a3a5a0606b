#include "lift/bridges.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/sort_unique.h"

#include <CGAL/box_intersection_d.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr double slack = 0.05;         // of the width: as an outline may be moved onto vertices
constexpr std::size_t kept_ways = 16;  // of a pair of openings: the nearest ones
constexpr Index most_pairs = 100'000'000;

/// Half-edges of two openings, and their nearest points.
struct Way {
    double length = 0.0;
    Index from = 0, to = 0;
    double from_share = 0.0, to_share = 0.0;  // along the half-edges
};

Way nearest_way(const std::array<Eigen::Vector3d, 2>& first, const std::array<Eigen::Vector3d, 2>& second)
{
    Way best{.length = INFINITY};
    const auto try_it = [&](double s, double t) {
        const double length = (first[0] + s * (first[1] - first[0]) - second[0] - t * (second[1] - second[0])).norm();
        if (length < best.length) best = {.length = length, .from_share = s, .to_share = t};
    };
    const Eigen::Vector3d u = first[1] - first[0], v = second[1] - second[0], w = first[0] - second[0];
    const double a = u.squaredNorm(), b = u.dot(v), c = v.squaredNorm(), d = u.dot(w), e = v.dot(w);
    const auto share = [](double along, double whole) {
        return whole > 0.0 ? std::clamp(along / whole, 0.0, 1.0) : 0.0;
    };
    if (const double whole = a * c - b * b; whole > 1e-12 * a * c) {
        const double s = (b * e - c * d) / whole, t = (a * e - b * d) / whole;
        if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) try_it(s, t);
    }
    try_it(0.0, share(e, c));
    try_it(1.0, share(e + b, c));
    try_it(share(-d, a), 0.0);
    try_it(share(b - d, a), 1.0);
    return best;
}

class Openings {
public:
    Openings(const FlatSheet& sheet, const Overlay& overlay, const std::vector<char>& keep, double width,
             const ExecutionContext& context)
        : overlay_(overlay),
          keep_(keep),
          width_(width),
          context_(context),
          twin_(pair_halfedges(overlay.triangles, static_cast<Index>(overlay.vertices.rows())))
    {
        number_openings(sheet);
        note_touching();
    }

    ThinBridges thin()
    {
        collect_ways();
        ThinBridges found;
        for (auto& [pair, ways] : ways_) {
            context_.checkpoint();
            std::ranges::sort(ways, {}, &Way::length);
            for (const Way& way : ways) {
                std::vector<Index> faces;
                const double length = length_over_surface(way, faces);
                if (!(length < (1.0 - slack) * width_)) continue;
                ++found.count;
                found.thinnest = std::min(found.thinnest.value_or(length), length);
                for (const Index f : faces) found.faces.push_back(overlay_.face[f]);
                break;
            }
        }
        sort_unique(found.faces);
        return found;
    }

private:
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

    bool kept(Index h) const { return h != no_twin && keep_[face_of(h)] != 0; }
    bool at_edge(Index h) const { return keep_[face_of(h)] != 0 && !kept(twin_[h]); }
    Eigen::Vector3d at(Index vertex) const { return overlay_.vertices.row(vertex); }
    Eigen::Vector3d start(Index h) const { return at(origin(overlay_.triangles, h)); }
    Eigen::Vector3d end(Index h) const { return at(target(overlay_.triangles, h)); }

    /// Outlines have their own numbers, then follow the gaps of a filled sheet, then loops that have none.
    void number_openings(const FlatSheet& sheet)
    {
        opening_.assign(twin_.size(), -1);
        const Index outlines = static_cast<Index>(overlay_.outlines.size());
        Index next = outlines + (sheet.gap.empty() ? 0 : std::ranges::max(sheet.gap) + 1);
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) {
            if (!at_edge(h) || opening_[h] >= 0) continue;
            if (twin_[h] == no_twin) {
                for (Index k = h; opening_[k] < 0; k = next_at_edge(k)) opening_[k] = next;
                ++next;
                continue;
            }
            const Index beyond = face_of(twin_[h]), gap = sheet.gap.empty() ? -1 : sheet.gap[overlay_.face[beyond]];
            opening_[h] = gap >= 0 ? outlines + gap : overlay_.region[beyond];
        }
    }

    Index next_at_edge(Index h) const
    {
        Index next = next_halfedge(h);
        while (!at_edge(next)) next = next_halfedge(twin_[next]);
        return next;
    }

    void note_touching()
    {
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) {
            if (!at_edge(h)) continue;
            const Index own = opening_[h], other = opening_[next_at_edge(h)];
            if (own != other) touching_.insert({std::min(own, other), std::max(own, other)});
        }
    }

    void collect_ways()
    {
        // Boxes of edges at openings, grown by half of the width: nearer edges have boxes that meet.
        std::vector<Box> boxes;
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) {
            if (!at_edge(h)) continue;
            Eigen::Vector3d low = start(h).cwiseMin(end(h)).array() - 0.5 * width_;
            Eigen::Vector3d high = start(h).cwiseMax(end(h)).array() + 0.5 * width_;
            boxes.emplace_back(low.data(), high.data(), h);
        }
        const Index outlines = static_cast<Index>(overlay_.outlines.size());
        Index pairs = 0;
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& first, const Box& second) {
            if (++pairs % 65536 == 0) context_.checkpoint();
            if (pairs > most_pairs)
                throw InputError("the bridge is too wide to be checked: give one that is narrower than the outlines");
            // Keep the shortest ways of each pair of openings that do not touch.
            Index h = first.info(), g = second.info();
            if (opening_[h] > opening_[g]) std::swap(h, g);
            if (opening_[h] == opening_[g] || opening_[h] >= outlines) return;
            const std::array<Index, 2> key{opening_[h], opening_[g]};
            Way way = nearest_way({start(h), end(h)}, {start(g), end(g)});
            if (!(way.length < (1.0 - slack) * width_) || touching_.contains(key)) return;
            way.from = h;
            way.to = g;
            std::vector<Way>& ways = ways_[key];
            ways.push_back(way);
            if (ways.size() < 4 * kept_ways) return;
            std::ranges::nth_element(ways, ways.begin() + kept_ways, {}, &Way::length);
            ways.resize(kept_ways);
        });
    }

    /// The faces that stay around a point of a half-edge at an opening.
    std::vector<Index> faces_at(Index h, double share) const
    {
        if (share > 0.0 && share < 1.0) return {face_of(h)};
        std::vector<Index> faces;
        Index k = h;
        if (share >= 1.0) {
            for (k = next_halfedge(h); faces.push_back(face_of(k)), kept(twin_[k]);) k = next_halfedge(twin_[k]);
            return faces;
        }
        for (k = previous_halfedge(h); faces.push_back(face_of(k)), kept(twin_[k]);) k = previous_halfedge(twin_[k]);
        return faces;
    }

    Eigen::Vector3d normal(Index f) const
    {
        const Eigen::Vector3d a = at(overlay_.triangles(f, 0));
        return (at(overlay_.triangles(f, 1)) - a).cross(at(overlay_.triangles(f, 2)) - a).normalized();
    }

    /// Walks from the one point to the other in the plane through both, along the normals between.
    /// @return infinity if the way ends elsewhere, or is longer than the width @param faces the way's
    double length_over_surface(const Way& way, std::vector<Index>& faces) const
    {
        const Eigen::Vector3d from = start(way.from) + way.from_share * (end(way.from) - start(way.from));
        const Eigen::Vector3d to = start(way.to) + way.to_share * (end(way.to) - start(way.to));
        const std::vector<Index> begin = faces_at(way.from, way.from_share), last = faces_at(way.to, way.to_share);
        // Both points in one face.
        for (const Index f : begin)
            if (std::ranges::find(last, f) != last.end()) {
                faces = {f};
                return (to - from).norm();
            }
        // Leave the first face where the plane goes farthest towards the other point.
        const Eigen::Vector3d plane = (to - from).cross(normal(face_of(way.from)) + normal(face_of(way.to)));
        const auto side = [&](Index v) { return plane.dot(at(v) - from) >= 0.0; };
        const auto crosses = [&](Index h) {
            return side(origin(overlay_.triangles, h)) != side(target(overlay_.triangles, h));
        };
        const auto crossing = [&](Index h) -> Eigen::Vector3d {
            const double a = plane.dot(start(h) - from), b = plane.dot(end(h) - from);
            return start(h) + a / (a - b) * (end(h) - start(h));
        };
        Index exit = no_twin;
        double ahead = 0.0;
        for (const Index f : begin)
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (h == way.from || !crosses(h)) continue;
                const double forward = (crossing(h) - from).dot(to - from);
                if (forward > ahead) std::tie(ahead, exit) = std::pair(forward, h);
            }
        // Cross one edge after another, up to the other opening or the last face.
        double length = 0.0;
        Eigen::Vector3d place = from;
        while (exit != no_twin) {
            faces.push_back(face_of(exit));
            const Eigen::Vector3d next = crossing(exit);
            length += (next - place).norm();
            place = next;
            if (!(length < width_)) break;
            if (!kept(twin_[exit])) return opening_[exit] == opening_[way.to] ? length : INFINITY;
            const Index f = face_of(twin_[exit]);
            if (std::ranges::find(last, f) != last.end()) {
                faces.push_back(f);
                return length + (to - place).norm();
            }
            const Index one = next_halfedge(twin_[exit]);
            exit = crosses(one) ? one : next_halfedge(one);
            if (!crosses(exit)) break;
        }
        return INFINITY;
    }

    const Overlay& overlay_;
    const std::vector<char>& keep_;
    double width_;
    const ExecutionContext& context_;
    std::vector<Index> twin_, opening_;
    std::set<std::array<Index, 2>> touching_;
    std::map<std::array<Index, 2>, std::vector<Way>> ways_;
};

}  // namespace

ThinBridges thin_bridges(const FlatSheet& sheet, const Overlay& overlay, const std::vector<char>& keep, double width,
                         const ExecutionContext& context)
{
    return Openings(sheet, overlay, keep, width, context).thin();
}

}  // namespace koebe
