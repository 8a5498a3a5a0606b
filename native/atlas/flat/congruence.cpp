#include "flat/congruence.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "part_maps/part_mesh.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr double most_off = 2e-4;            // in roots of the whole's area,
constexpr double most_off_of_extent = 1e-3;  // and in the part's own extent
constexpr double same_area = 1e-3;           // of the area: areas of polygons depend on their diagonals
constexpr std::size_t most_others = 24;      // parts to which a part is compared
constexpr std::size_t most_starts = 64;      // edges from which a match is tried

/// The half-edges between polygons. Those inside a polygon are left out.
class PolygonEdges {
public:
    explicit PolygonEdges(const FlatPart& part)
        : part_(part), next_(part.surface.twin.size(), no_twin), previous_(next_), length_(next_.size(), 0.0)
    {
        for (Index h = 0; h < static_cast<Index>(next_.size()); ++h) {
            if (is_inner(h)) continue;
            Index after = next_halfedge(h);
            for (std::size_t k = 0; is_inner(after); ++k) {
                if (k == next_.size()) return;  // a vertex inside a polygon: its count stays too small
                after = next_halfedge(twin(after));
            }
            next_[h] = after;
            previous_[after] = h;
            ++count_;
            border_ += twin(h) == no_twin;
            length_[h] = (part.vertices.row(to(h)) - part.vertices.row(from(h))).norm();
        }
        for (Index h = 0; h < static_cast<Index>(next_.size()); ++h)
            if (may_start(h) && (first_ == no_twin || length_[h] > length_[first_])) first_ = h;
    }

    Index from(Index h) const { return origin(part_.surface.triangles, h); }
    Index to(Index h) const { return target(part_.surface.triangles, h); }
    Index twin(Index h) const { return part_.surface.twin[h]; }
    Index next(Index h) const { return next_[h]; }
    Index previous(Index h) const { return previous_[h]; }
    double length(Index h) const { return length_[h]; }
    std::size_t halfedges() const { return next_.size(); }
    Index count() const { return count_; }
    Index border() const { return border_; }
    Index longest() const { return first_; }  ///< on the border, if there is a border

    /// Edges like the longest one, the one of the same number first, then the most similar.
    std::vector<Index> like(const PolygonEdges& other, double slack) const
    {
        const double length = other.length_[other.first_];
        std::vector<Index> found;
        for (Index h = 0; h < static_cast<Index>(next_.size()); ++h)
            if (may_start(h) && std::abs(length_[h] - length) <= slack) found.push_back(h);
        std::ranges::stable_sort(found, {},
                                 [&](Index h) { return std::pair(h != other.first_, std::abs(length_[h] - length)); });
        if (found.size() > most_starts) found.resize(most_starts);
        return found;
    }

private:
    bool may_start(Index h) const { return next_[h] != no_twin && (border_ == 0 || twin(h) == no_twin); }
    bool is_inner(Index h) const
    {
        return !part_.polygon.empty() && twin(h) != no_twin &&
               part_.polygon[face_of(h)] == part_.polygon[face_of(twin(h))];
    }

    const FlatPart& part_;
    std::vector<Index> next_, previous_;  // round the polygons
    std::vector<double> length_;
    Index count_ = 0, border_ = 0, first_ = no_twin;
};

/// What is compared first.
struct PartSigns {
    std::array<Index, 4> counts = {};
    double area = 0.0, extent = 0.0;
};

PartSigns signs_of(const FlatPart& part, const PolygonEdges& edges)
{
    const auto& at = part.vertices;
    return {{edges.count(), edges.border(), static_cast<Index>(at.rows()),
             static_cast<Index>(part.surface.triangles.rows())},
            face_areas(at, part.surface.triangles).sum(),
            (at.colwise().maxCoeff() - at.colwise().minCoeff()).maxCoeff()};
}

/// The vertices of `other` that correspond to those of `part` if edge `start` of the one is edge `begin` of the other;
/// empty if the two differ.
std::vector<Index> matched(const PolygonEdges& part, const PolygonEdges& other, std::pair<Index, Index> start,
                           bool mirrored, std::size_t vertex_count, double slack)
{
    std::vector<Index> vertex(vertex_count, -1), back(vertex_count, -1), image(part.halfedges(), no_twin);
    std::vector<std::pair<Index, Index>> open{start};
    // Pairs two vertices, if neither has another partner.
    const auto pair = [&](Index v, Index w) {
        if (vertex[v] < 0 && back[w] < 0) {
            vertex[v] = w;
            back[w] = v;
        }
        return vertex[v] == w && back[w] == v;
    };
    Index count = 0;
    // From edge to edge: round the polygon, and across. One difference ends it.
    while (!open.empty()) {
        const auto [h, g] = open.back();
        open.pop_back();
        if (image[h] == g) continue;
        if (image[h] != no_twin || std::abs(part.length(h) - other.length(g)) > slack) return {};
        image[h] = g;
        ++count;
        if (!pair(part.from(h), mirrored ? other.to(g) : other.from(g))) return {};
        open.emplace_back(part.next(h), mirrored ? other.previous(g) : other.next(g));
        const Index across = part.twin(h), there = other.twin(g);
        if ((across == no_twin) != (there == no_twin)) return {};
        if (across != no_twin) open.emplace_back(across, there);
    }
    if (count != part.count() || std::ranges::count(vertex, -1) > 0) return {};
    return vertex;
}

/// Whether a rotation, or a reflection if `mirrored`, takes the points to the others (Kabsch 1976).
bool is_congruent(const Vertices& points, const Vertices& others, bool mirrored, double slack)
{
    const Vertices a = points.rowwise() - points.colwise().mean(), b = others.rowwise() - others.colwise().mean();
    const Eigen::Matrix3d product = a.transpose() * b;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double is = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    const Eigen::Vector3d sign(1.0, 1.0, (is > 0.0) == mirrored ? -1.0 : 1.0);
    const Eigen::Matrix3d turn = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    return (a * turn - b).rowwise().norm().maxCoeff() <= slack;
}

/// The first match that a rotation, or a reflection, makes: the vertices of the other part, and whether it is mirrored.
std::optional<Twin> congruence(const FlatPart& part, const PolygonEdges& edges, const FlatPart& other,
                               const PolygonEdges& others, double extent, bool may_mirror,
                               const std::function<bool(const Twin&)>& accepts)
{
    const double slack = std::min(most_off, most_off_of_extent * extent);
    if (edges.longest() == no_twin) return {};
    const std::vector<Index> starts = others.like(edges, 2.0 * slack);
    for (const bool mirrored : {false, true})
        for (const Index begin : starts) {
            if (mirrored && !may_mirror) return {};
            std::vector<Index> vertex = matched(edges, others, {edges.longest(), begin}, mirrored,
                                                static_cast<std::size_t>(part.vertices.rows()), 2.0 * slack);
            if (vertex.empty()) continue;
            if (!is_congruent(part.vertices, other.vertices(vertex, Eigen::all), mirrored, slack)) continue;
            Twin twin{0, mirrored, std::move(vertex)};
            if (accepts(twin)) return twin;
        }
    return {};
}

}  // namespace

std::vector<std::optional<Twin>>
congruent_parts(const std::vector<const FlatPart*>& parts, bool may_mirror,
                const std::function<bool(std::size_t)>& is_usable,
                const std::function<bool(std::size_t, std::size_t, const Twin&)>& accepts)
{
    std::vector<std::optional<Twin>> twins(parts.size());
    // Equal parts have equal signs: numbers of elements, and nearly the same area. In this order only few are compared.
    std::vector<PolygonEdges> edges;
    std::vector<PartSigns> signs;
    edges.reserve(parts.size());
    for (const FlatPart* part : parts) {
        edges.emplace_back(*part);
        signs.push_back(signs_of(*part, edges.back()));
    }
    std::vector<std::size_t> order = numbers_below<std::size_t>(parts.size());
    std::ranges::sort(order, {}, [&](std::size_t k) { return std::tuple(signs[k].counts, signs[k].area, k); });
    std::vector<std::size_t> firsts;  // without a twin, of this size and smaller ones
    for (const std::size_t k : order) {
        if (!is_usable(k)) continue;
        std::size_t tried = 0;
        // The first of each kind that fits.
        for (auto other = firsts.rbegin(); other != firsts.rend() && tried < most_others && !twins[k];
             ++other, ++tried) {
            if (signs[*other].counts != signs[k].counts) break;
            if (signs[k].area - signs[*other].area > same_area * signs[k].area) break;
            twins[k] = congruence(*parts[k], edges[k], *parts[*other], edges[*other], signs[k].extent, may_mirror,
                                  [&](const Twin& twin) { return accepts(k, *other, twin); });
            if (twins[k]) twins[k]->of = *other;
        }
        if (!twins[k]) firsts.push_back(k);
    }
    return twins;
}

}  // namespace koebe
