#include "flat/divided_faces.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "cut/edge_runs.h"

#include <algorithm>
#include <set>
#include <span>
#include <utility>

namespace koebe {
namespace {

constexpr double crack_width = 1e-6;    // in the diagonal of the surface's box: coordinates with six digits
constexpr std::size_t most_edges = 64;  // of the boundary at one vertex: more are a soup, and not compared

class FaceDivider {
public:
    FaceDivider(const Vertices& vertices, const Triangles& triangles, const std::vector<std::array<Index, 2>>& kept)
        : vertices_(vertices),
          edges_(static_cast<std::size_t>(vertices.rows())),
          width_(crack_width * (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm())
    {
        for (const auto& edge : kept) kept_.insert(std::minmax(edge[0], edge[1]));
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            triangles_.push_back({triangles(f, 0), triangles(f, 1), triangles(f, 2)});
        face_ = numbers_below(triangles_.size());
        for_each_edge(triangles, static_cast<Index>(vertices.rows()), [&](std::span<const Index> halfedges) {
            if (halfedges.size() != 1) return;
            const Index h = halfedges.front();
            for (const Index v : {end(h, 0), end(h, 1)}) edges_[v].push_back(h);
        });
    }

    /// @return whether a face is divided
    bool divide()
    {
        std::vector<Index> waiting;
        for (std::size_t v = 0; v < edges_.size(); ++v)
            if (!edges_[v].empty()) waiting.push_back(static_cast<Index>(v));
        const std::size_t before = face_.size();
        while (!waiting.empty()) {
            const Index v = waiting.back();
            waiting.pop_back();
            while (divide_at(v, waiting)) continue;
        }
        return face_.size() > before;
    }

    DividedFaces take(const std::vector<Index>& polygon)
    {
        DividedFaces divided;
        divided.triangles =
            Eigen::Map<const Triangles>(triangles_.front().data(), static_cast<Eigen::Index>(triangles_.size()), 3);
        for (const Index f : face_) divided.polygon.push_back(polygon.empty() ? f : polygon[f]);
        divided.face = std::move(face_);
        divided.edges = std::move(divided_);
        return divided;
    }

private:
    Index end(Index h, int k) const
    {
        return triangles_[face_of(h)][static_cast<std::size_t>(h + k - 3 * face_of(h)) % 3];
    }
    Index other_end(Index h, Index v) const { return end(h, 0) == v ? end(h, 1) : end(h, 0); }

    /// Whether a vertex lies inside an edge from v.
    bool lies_on(Index h, Index v, Index vertex) const
    {
        const Index far = other_end(h, v);
        if (vertex == far || vertex == end(next_halfedge(next_halfedge(h)), 0) || kept_.contains(std::minmax(v, far)))
            return false;
        const Eigen::RowVector3d edge = vertices_.row(far) - vertices_.row(v),
                                 arm = vertices_.row(vertex) - vertices_.row(v);
        const double length = edge.norm(), along = arm.dot(edge) / length;
        return along > width_ && along < length - width_ && (arm - along / length * edge).norm() < width_;
    }

    /// Divides an edge at v where the end of another one lies on it. @return whether there is such an edge
    bool divide_at(Index v, std::vector<Index>& waiting)
    {
        const std::vector<Index>& edges = edges_[v];
        if (edges.size() > most_edges) return false;
        for (const Index h : edges)
            for (const Index shorter : edges) {
                const Index middle = other_end(shorter, v);
                if (face_of(h) == face_of(shorter) || !lies_on(h, v, middle)) continue;
                waiting.insert(waiting.end(), {middle, other_end(h, v)});
                divide_edge(h, middle);
                return true;
            }
        return false;
    }

    /// The face (a, b, c) with the half-edge from a to b becomes (a, middle, c) and (middle, b, c).
    void divide_edge(Index h, Index middle)
    {
        const Index next = next_halfedge(h), b = end(h, 1), c = end(next, 1);
        const Index piece = static_cast<Index>(triangles_.size());
        const auto from_start = [&](Index v) { return (vertices_.row(v) - vertices_.row(end(h, 0))).norm(); };
        divided_.push_back({face_[face_of(h)], end(h, 0), b, middle, from_start(middle) / from_start(b)});
        triangles_.push_back({middle, b, c});
        face_.push_back(face_[face_of(h)]);
        triangles_[face_of(h)][static_cast<std::size_t>(next - 3 * face_of(h))] = middle;
        std::ranges::replace(edges_[b], h, 3 * piece);
        for (const Index v : {b, c}) std::ranges::replace(edges_[v], next, 3 * piece + 1);
        edges_[middle].insert(edges_[middle].end(), {h, 3 * piece});
    }

    const Vertices& vertices_;
    std::vector<std::vector<Index>> edges_;  // (V) half-edges of the boundary at each vertex
    const double width_;
    std::set<std::pair<Index, Index>> kept_;
    std::vector<std::array<Index, 3>> triangles_;
    std::vector<Index> face_;
    std::vector<DividedEdge> divided_;
};

}  // namespace

DividedFaces divided_faces(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& polygon,
                           const std::vector<std::array<Index, 2>>& kept)
{
    FaceDivider divider(vertices, triangles, kept);
    return divider.divide() ? divider.take(polygon) : DividedFaces{triangles, polygon, {}};
}

}  // namespace koebe
