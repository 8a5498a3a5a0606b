#include "parts/sewing.h"

#include "core/complex_places.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "cut/disjoint_sets.h"
#include "flat/flat_part.h"
#include "mesh/topology.h"
#include "parts/parts.h"
#include "planar/rigid_fit.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace koebe {
namespace {

constexpr double only_necessary_cuts = 1e3;  // price of a part, as of the add-on's seams "only"

/// An edge of two faces, by their corners at its ends: of the lower vertex, and of the other.
struct EdgeCorners {
    std::array<Index, 2> low, high;  // of either face
    int faces = 0;
};

std::map<EdgeEnds, EdgeCorners> edge_corners(const Triangles& triangles)
{
    std::map<EdgeEnds, EdgeCorners> edges;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        for (int k = 0; k < 3; ++k) {
            Index start = 3 * f + k, end = 3 * f + (k + 1) % 3;
            Index a = triangles(f, k), b = triangles(f, (k + 1) % 3);
            EdgeCorners& edge = edges[sorted_ends(a, b)];
            if (a > b) std::swap(start, end);
            if (edge.faces < 2) {
                edge.low[edge.faces] = start;
                edge.high[edge.faces] = end;
            }
            ++edge.faces;
        }
    return edges;
}

/// The layer: which corners are one point, and which faces are in one island, before and after.
class LayerSeams {
public:
    LayerSeams(const Triangles& triangles, const SewingOptions& options)
        : corners(static_cast<std::size_t>(3 * triangles.rows())),
          before(static_cast<std::size_t>(triangles.rows())),
          after(static_cast<std::size_t>(triangles.rows()))
    {
        // Edges whose sides meet in the UVs already.
        const std::map<EdgeEnds, EdgeCorners> edges = edge_corners(triangles);
        const PlanarPoints& uv = options.uv;
        const auto same = [&](const std::array<Index, 2>& at) {
            return as_stored(uv(at[0], 0)) == as_stored(uv(at[1], 0)) &&
                   as_stored(uv(at[0], 1)) == as_stored(uv(at[1], 1));
        };
        for (const auto& [ends, edge] : edges) {
            if (edge.faces != 2 || !same(edge.low) || !same(edge.high)) continue;
            join(edge);
            before.join(edge.low[0] / 3, edge.low[1] / 3);
        }
        // Edges that are to be sewn.
        for (const auto& [a, b] : options.edges) {
            const auto found = edges.find(sorted_ends(a, b));
            if (found == edges.end()) throw InputError("a pair of vertices is no edge", ElementKind::edges, {a, b});
            const EdgeCorners& edge = found->second;
            if (edge.faces > 2)
                throw InputError("an edge of more than two faces cannot be sewn", ElementKind::edges, {a, b});
            if (edge.faces < 2 || (same(edge.low) && same(edge.high))) continue;
            join(edge);
            sewn.push_back({edge.low[0] / 3, found->first});
        }
        if (sewn.empty()) throw InputError("no edge is a cut of the UVs with a face on either side");
    }

    DisjointSets corners, before, after;           // of corners, and of faces
    std::vector<std::pair<Index, EdgeEnds>> sewn;  // a face at each edge

private:
    void join(const EdgeCorners& edge)
    {
        corners.join(edge.low[0], edge.low[1]);
        corners.join(edge.high[0], edge.high[1]);
        after.join(edge.low[0] / 3, edge.low[1] / 3);
    }
};

double area_in(const PlanarPoints& uv, Index f)
{
    const Eigen::RowVector2d a = uv.row(3 * f + 1) - uv.row(3 * f), b = uv.row(3 * f + 2) - uv.row(3 * f);
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
}

/// Whether each face that is mapped lies as the others do, and none is turned over, as stored.
bool is_upright(const PartsResult& made)
{
    const PlanarPoints stored = made.uv.unaryExpr([](double x) { return as_stored(x); });
    for (std::size_t f = 0; f < made.part.size(); ++f)
        if (made.part[f] >= 0 && !(area_in(stored, static_cast<Index>(f)) > 0.0)) return false;
    return true;
}

/// The faces of a new island.
class SewnIsland {
public:
    SewnIsland(std::vector<Index> faces, std::vector<Index> edges) : faces_(std::move(faces)), edges_(std::move(edges))
    {
    }

    const std::vector<Index>& faces() const { return faces_; }

    /// Maps it anew, and puts it where its largest old island lies in `uv`.
    void map(const Vertices& vertices, const Triangles& triangles, const SewingOptions& options, LayerSeams& seams,
             PlanarPoints& uv, ExecutionContext& context) const
    {
        // The vertices of the island: corners that are one point.
        std::map<Index, Index> number;
        Triangles own(static_cast<Eigen::Index>(faces_.size()), 3);
        Vertices positions(3 * own.rows(), 3);
        PartsOptions parts;
        for (std::size_t i = 0; i < faces_.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const auto [at, is_new] =
                    number.try_emplace(seams.corners.find(3 * faces_[i] + k), static_cast<Index>(number.size()));
                own(static_cast<Eigen::Index>(i), k) = at->second;
                if (is_new) positions.row(at->second) = vertices.row(triangles(faces_[i], k));
            }
        positions.conservativeResize(static_cast<Eigen::Index>(number.size()), 3);
        parts.polygon = values_at(options.polygon, faces_);
        parts.price = only_necessary_cuts;
        parts.darts = 0.0;
        parts.roomy = false;
        parts.no_hard = true;
        parts.even = options.even;
        parts.threads = 1;
        const PartsResult made = parts_of(positions, own, parts, context);
        if (made.parts.size() != 1 || made.cut_length > 0.0 || made.handles_cut > 0 || !made.converged ||
            !is_upright(made))
            throw SolverError("the sewn island cannot lie flat in one piece", ElementKind::edges, edges_);
        place(made.uv, seams, uv);
    }

private:
    /// By the similarity that fits the faces of the largest old island: same middle, mean square distance from it,
    /// and mean direction.
    void place(const PlanarPoints& made, LayerSeams& seams, PlanarPoints& uv) const
    {
        std::map<Index, double> area;
        for (const Index f : faces_) area[seams.before.find(f)] += std::abs(area_in(uv, f));
        const Index largest = std::ranges::max_element(area, {}, [](const auto& one) { return one.second; })->first;
        RigidFit fit;  // about a corner: far from the origin, sums of squares would lose what they differ in
        const Complex about =
            complex_at(uv, 3 * *std::ranges::find_if(faces_, [&](Index f) { return seams.before.find(f) == largest; }));
        for (std::size_t i = 0; i < faces_.size(); ++i)
            for (int k = 0; k < 3 && seams.before.find(faces_[i]) == largest; ++k)
                fit.add(complex_at(uv, 3 * faces_[i] + k) - about, complex_at(made, static_cast<Index>(3 * i) + k));
        const double scale = std::sqrt(fit.first_spread() / fit.second_spread());
        if (!std::isfinite(scale) || !(area[largest] > 0.0))
            throw InputError("the islands to sew have no area in the UVs", ElementKind::faces, faces_);
        for (std::size_t i = 0; i < faces_.size(); ++i)
            for (int k = 0; k < 3; ++k)
                put_complex(uv, 3 * faces_[i] + k,
                            about + fit.moved(complex_at(made, static_cast<Index>(3 * i) + k), scale));
    }

    std::vector<Index> faces_, edges_;  // edges: pairs of vertices of the mesh
};

}  // namespace

SewnLayer sew_islands(const Vertices& vertices, const Triangles& triangles, const SewingOptions& options,
                      ExecutionContext& context)
{
    validate_arrays(vertices, triangles);
    if (options.uv.rows() != 3 * triangles.rows() || !options.uv.allFinite())
        throw InputError("each corner of a face needs u and v, finite numbers");
    LayerSeams seams(triangles, options);
    SewnLayer result{options.uv, std::vector<Index>(static_cast<std::size_t>(triangles.rows()), -1)};
    result.sewn = static_cast<Index>(seams.sewn.size());
    // The new islands: faces that are together afterwards, if an edge was sewn there.
    std::map<Index, std::pair<std::vector<Index>, std::vector<Index>>> parts;  // faces, edges
    for (const auto& [face, edge] : seams.sewn) {
        std::vector<Index>& edges = parts[seams.after.find(face)].second;
        edges.push_back(edge.first);
        edges.push_back(edge.second);
    }
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        if (const auto found = parts.find(seams.after.find(f)); found != parts.end()) found->second.first.push_back(f);
    Index number = 0;
    for (auto& [root, part] : parts) {
        const SewnIsland island(std::move(part.first), std::move(part.second));
        std::vector<Index> old;
        for (const Index f : island.faces()) {
            old.push_back(seams.before.find(f));
            result.island[f] = number;
        }
        sort_unique(old);
        result.joined += static_cast<Index>(old.size());
        island.map(vertices, triangles, options, seams, result.uv, context);
        ++number;
    }
    return result;
}

}  // namespace koebe
