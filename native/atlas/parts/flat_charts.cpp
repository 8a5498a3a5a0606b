#include "parts/flat_charts.h"

#include "cut/edge_graph.h"
#include "parts/tension.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double least_fold = std::numbers::pi / 6;  // angle between the faces of a crease
constexpr double flat_angle = 1e-3;    // radians by which the angles round a flat vertex may miss a full turn
constexpr double same_place = 1e-5;    // in roots of the surface's area
constexpr std::size_t most_tips = 64;  // inner vertices of charts that are not flat
constexpr std::size_t most_charts = 300;

using FacePlaces = std::array<Complex, 3>;

class ChartLayer {
public:
    explicit ChartLayer(const CutSurface& surface) : surface_(surface)
    {
        net_ = seamed(surface.vertices, surface.surface, surface.polygon, surface.shown);
        charts_.at.resize(net_.twin.size());
        charts_.near = same_place * std::sqrt(surface.areas.sum());
    }

    /// @return whether all charts lie flat
    bool lay_charts()
    {
        for (Index h = 0; h < net_.halfedge_count(); ++h)
            if (is_crease(h)) net_.cut(h);
        number_fans(net_);
        if (tips_of(net_).size() > most_tips) return false;
        std::vector<SeamedMesh> charts = connected_parts(net_);
        if (charts.size() > most_charts) return false;
        for (const SeamedMesh& chart : charts)
            if (!lay(chart)) open(chart);
        charts = connected_parts(net_);
        for (SeamedMesh& chart : charts) {
            if (!lay(chart)) return false;
            charts_.faces.push_back(std::move(chart.face));
        }
        return true;
    }

    FlatCharts take() { return std::move(charts_); }

private:
    static Index in_net(const SeamedMesh& chart, Index h) { return 3 * chart.face[face_of(h)] + h % 3; }

    Eigen::RowVector3d place(Index h) const { return surface_.vertices.row(origin(net_.corners, h)); }
    Eigen::RowVector3d normal(Index f) const
    {
        return (place(3 * f + 1) - place(3 * f)).cross(place(3 * f + 2) - place(3 * f));
    }
    bool same(Complex a, Complex b) const { return std::abs(a - b) < charts_.near; }

    bool is_crease(Index h) const
    {
        if (net_.twin[h] == no_twin || net_.whole[h]) return false;
        const Eigen::RowVector3d a = normal(face_of(h)), b = normal(face_of(net_.twin[h]));
        return std::atan2(a.cross(b).norm(), a.dot(b)) > least_fold;
    }

    /// Half-edges, one each, from the inner vertices whose angles do not sum to a full turn.
    std::vector<Index> tips_of(const SeamedMesh& mesh) const
    {
        std::vector<double> sum(static_cast<std::size_t>(mesh.fan_count), 0.0);
        std::vector<Index> leaving(sum.size(), no_twin);
        std::vector<char> outside(sum.size(), 0);
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            const Index v = origin(mesh.fans, h), here = in_net(mesh, h);
            const Eigen::RowVector3d to = place(next_halfedge(here)) - place(here);
            const Eigen::RowVector3d from = place(previous_halfedge(here)) - place(here);
            sum[v] += std::atan2(to.cross(from).norm(), to.dot(from));
            leaving[v] = h;
            if (mesh.twin[h] == no_twin) outside[v] = outside[target(mesh.fans, h)] = 1;
        }
        std::vector<Index> tips;
        for (std::size_t v = 0; v < sum.size(); ++v)
            if (!outside[v] && std::abs(sum[v] - 2.0 * std::numbers::pi) > flat_angle) tips.push_back(leaving[v]);
        return tips;
    }

    /// The places of a face's corners, from a half-edge on. @param a, b places of the half-edge's ends
    FacePlaces beside(Index h, Complex a, Complex b) const
    {
        const Eigen::RowVector3d along = place(next_halfedge(h)) - place(h);
        const Eigen::RowVector3d third = place(previous_halfedge(h)) - place(h);
        const double squared = along.squaredNorm();
        FacePlaces places;
        places[h % 3] = a;
        places[next_halfedge(h) % 3] = b;
        places[previous_halfedge(h) % 3] =
            a + (b - a) * Complex(along.dot(third), along.cross(third).norm()) / (squared > 0.0 ? squared : 1.0);
        return places;
    }

    FacePlaces first_face(Index f) const { return beside(3 * f, 0.0, (place(3 * f + 1) - place(3 * f)).norm()); }

    /// Lays a chart flat, face by face. @return whether it closes round all its holes
    bool lay(const SeamedMesh& chart)
    {
        std::vector<char> laid(chart.face.size(), 0);
        const auto put = [&](Index f, const FacePlaces& places) {
            laid[f] = 1;
            std::ranges::copy(places, charts_.at.begin() + 3 * static_cast<std::ptrdiff_t>(chart.face[f]));
        };
        put(0, first_face(chart.face[0]));
        bool closes = true;
        std::vector<Index> queue{0};
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
                const Index t = chart.twin[h];
                if (t == no_twin) continue;
                const Complex a = charts_.at[in_net(chart, next_halfedge(h))], b = charts_.at[in_net(chart, h)];
                if (!laid[face_of(t)]) {
                    put(face_of(t), beside(in_net(chart, t), a, b));
                    queue.push_back(face_of(t));
                } else if (!same(charts_.at[in_net(chart, t)], a) ||
                           !same(charts_.at[in_net(chart, next_halfedge(t))], b)) {
                    closes = false;
                }
            }
        return closes;
    }

    /// Whether the faces along a loop, laid flat one after the other, come back to their place.
    bool closes_round(const SeamedMesh& chart, Index start) const
    {
        const FacePlaces first = first_face(chart.face[face_of(start)]);
        FacePlaces places = first;
        Index h = start;
        do {
            h = next_halfedge(h);
            for (Index t = chart.twin[h]; t != no_twin; t = chart.twin[h]) {
                places = beside(in_net(chart, t), places[next_halfedge(h) % 3], places[h % 3]);
                h = next_halfedge(t);
            }
        } while (h != start);
        for (std::size_t k = 0; k < 3; ++k)
            if (!same(places[k], first[k])) return false;
        return true;
    }

    /// Cuts short paths that connect the chart's tips, by darts, and the loops round which it does not close, by slits.
    void open(const SeamedMesh& chart)
    {
        std::vector<std::vector<Index>> ends;  // fans
        for (const std::vector<Index>& loop : boundary_halfedges(chart)) {
            if (closes_round(chart, loop.front())) continue;
            ends.emplace_back();
            for (const Index h : loop) ends.back().push_back(origin(chart.fans, h));
        }
        const std::size_t loops = ends.size();
        for (const Index h : tips_of(chart)) {
            ends.push_back({origin(chart.fans, h)});
            charts_.tips.insert(origin(chart.corners, h));
        }
        if (ends.size() < 2) return;
        const EdgeGraph graph(chart, 1.0);
        std::vector<char> is_reached(ends.size(), 0);
        is_reached[0] = 1;
        std::vector<Index> reached = ends[0];
        for (std::size_t count = 1; count < ends.size(); ++count) {
            const PathTree tree = shortest_paths(graph, reached);
            std::size_t next = 0;
            Index nearest = -1;
            for (std::size_t k = 0; k < ends.size(); ++k)
                for (const Index v : ends[k])
                    if (!is_reached[k] && (nearest < 0 || tree.distance[v] < tree.distance[nearest])) {
                        nearest = v;
                        next = k;
                    }
            is_reached[next] = 1;
            reached.insert(reached.end(), ends[next].begin(), ends[next].end());
            for (Index v = nearest; tree.parent[v] != v; v = tree.parent[v]) {
                if (tree.halfedge[v] == no_twin) return;  // no path
                reached.push_back(v);
                std::vector<Index>& kind = next < loops ? charts_.slits : charts_.darts;
                kind.push_back(in_net(chart, tree.halfedge[v]));
                net_.cut(kind.back());
            }
        }
    }

    const CutSurface& surface_;
    FlatCharts charts_;
    SeamedMesh& net_ = charts_.net;
};

}  // namespace

std::optional<FlatCharts> flat_charts(const CutSurface& surface)
{
    ChartLayer layer(surface);
    if (!layer.lay_charts()) return {};
    return layer.take();
}

}  // namespace koebe
