#include "parts/unfolding.h"

#include "core/errors.h"
#include "cut/edge_graph.h"
#include "cut/seamed_mesh.h"
#include "parts/dart_rounds.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr double least_fold = std::numbers::pi / 6;  // angle between the faces of a crease
constexpr double flat_angle = 1e-3;       // radians by which the angles round a flat vertex may miss a full turn
constexpr double same_place = 1e-5;       // in roots of the whole's area
constexpr std::size_t most_tips = 64;     // inner vertices of charts that are not flat,
constexpr std::size_t most_charts = 300;  // and charts: other surfaces are smooth, or rough
constexpr double least_border = 0.12;     // of a chart's boundary: a shorter common border is not worth joining

using FacePlaces = std::array<Complex, 3>;

/// A plane motion that keeps orientation.
struct Motion {
    Complex turn, shift;
    Complex operator()(Complex z) const { return turn * z + shift; }
};

class Unfolding {
public:
    explicit Unfolding(const CutSurface& surface) : surface_(surface)
    {
        const auto faces = static_cast<Index>(surface.areas.size());
        net_.corners = surface.surface.triangles;
        net_.face.resize(faces);
        std::iota(net_.face.begin(), net_.face.end(), 0);
        net_.turned.assign(faces, 0);
        net_.twin = surface.surface.twin;
        net_.whole.assign(net_.twin.size(), 0);
        for (Index h = 0; h < halfedges(); ++h)
            net_.whole[h] = net_.twin[h] != no_twin && !surface.polygon.empty() &&
                            surface.polygon[face_of(h)] == surface.polygon[face_of(net_.twin[h])];
        net_.length.assign(surface.lengths.data(), surface.lengths.data() + surface.lengths.size());
        for (Index h = 0; h < halfedges(); ++h)
            net_.length[h] *= price_of_edge(surface.shown, origin(net_.corners, h), target(net_.corners, h));
    }

    /// @return whether all charts lie flat
    bool lay_charts(ExecutionContext& context)
    {
        for (Index h = 0; h < halfedges(); ++h)
            if (is_crease(h)) net_.cut(h);
        number_fans(net_);
        if (tips_of(net_).size() > most_tips) return false;
        std::vector<SeamedMesh> charts = connected_parts(net_);
        if (charts.size() > most_charts) return false;
        at_.resize(net_.twin.size());
        for (const SeamedMesh& chart : charts) {
            context.checkpoint();
            if (lay(chart)) continue;
            open(chart);
        }
        charts = connected_parts(net_);
        chart_.resize(net_.face.size());
        for (std::size_t k = 0; k < charts.size(); ++k) {
            if (!lay(charts[k])) return false;
            islands_.push_back(charts[k].face);
            for (const Index f : charts[k].face) chart_[f] = static_cast<Index>(k);
            auto part = part_of(charts[k].face);
            if (!part || !survives_storing(*part)) return false;
            parts_.push_back(std::move(*part));
        }
        island_.resize(charts.size());
        std::iota(island_.begin(), island_.end(), 0);
        return true;
    }

    void join_charts(ExecutionContext& context)
    {
        for (const Index h : borders()) {
            context.checkpoint();
            const Index a = island_of(h), b = island_of(twin(h));
            if (a == b) continue;
            islands_[a].size() < islands_[b].size() ? join(twin(h)) : join(h);
        }
    }

    double cut_length() const
    {
        double length = 0.0;
        for (Index h = 0; h < halfedges(); ++h)
            if (twin(h) > h && net_.twin[h] == no_twin) length += surface_.lengths[h];
        return length;
    }

    std::vector<FlatPart> parts()
    {
        for (const Index h : slit_)
            if (net_.twin[h] == no_twin) parts_[island_of(h)].slit += surface_.lengths[h];
        for (const Index h : dart_)
            if (net_.twin[h] == no_twin) parts_[island_of(h)].dart_length += surface_.lengths[h];
        std::vector<FlatPart> found;
        for (std::size_t k = 0; k < parts_.size(); ++k)
            if (!islands_[k].empty()) found.push_back(std::move(parts_[k]));
        return found;
    }

private:
    Index halfedges() const { return net_.halfedge_count(); }
    Index twin(Index h) const { return surface_.surface.twin[h]; }
    Index island_of(Index h) const { return island_[chart_[face_of(h)]]; }
    static Index in_net(const SeamedMesh& chart, Index h) { return 3 * chart.face[face_of(h)] + h % 3; }

    Eigen::RowVector3d place(Index h) const { return surface_.vertices.row(origin(net_.corners, h)); }
    Eigen::RowVector3d normal(Index f) const
    {
        return (place(3 * f + 1) - place(3 * f)).cross(place(3 * f + 2) - place(3 * f));
    }

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

    static bool same(Complex a, Complex b) { return std::abs(a - b) < same_place; }

    /// Lays a chart flat, face by face. @return whether it closes round all its holes
    bool lay(const SeamedMesh& chart)
    {
        std::vector<char> laid(chart.face.size(), 0);
        const auto put = [&](Index f, const FacePlaces& places) {
            laid[f] = 1;
            std::ranges::copy(places, at_.begin() + 3 * static_cast<std::ptrdiff_t>(chart.face[f]));
        };
        put(0, first_face(chart.face[0]));
        bool closes = true;
        std::vector<Index> queue{0};
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
                const Index t = chart.twin[h];
                if (t == no_twin) continue;
                const Complex a = at_[in_net(chart, next_halfedge(h))], b = at_[in_net(chart, h)];
                if (!laid[face_of(t)]) {
                    put(face_of(t), beside(in_net(chart, t), a, b));
                    queue.push_back(face_of(t));
                } else if (!same(at_[in_net(chart, t)], a) || !same(at_[in_net(chart, next_halfedge(t))], b)) {
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
            tips_.insert(origin(chart.corners, h));
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
                std::vector<Index>& kind = next < loops ? slit_ : dart_;
                kind.push_back(in_net(chart, tree.halfedge[v]));
                net_.cut(kind.back());
            }
        }
    }

    /// The motion that brings the face across a crease to the crease's place.
    Motion motion_to(Index h) const
    {
        const Index t = twin(h);
        const Complex from = at_[next_halfedge(t)] - at_[t], to = at_[h] - at_[next_halfedge(h)];
        const Complex turn = to / from / std::abs(to / from);
        return {turn, at_[next_halfedge(h)] - turn * at_[t]};
    }

    bool meets(Index h, const Motion& motion) const
    {
        const Index t = twin(h);
        return same(motion(at_[t]), at_[next_halfedge(h)]) && same(motion(at_[next_halfedge(t)]), at_[h]);
    }

    /// For each pair of charts the crease at which they are best joined, if their straight common border is long
    /// enough. The longest border first.
    std::vector<Index> borders() const
    {
        std::map<std::pair<Index, Index>, std::vector<Index>> common;
        std::vector<double> boundary(islands_.size(), 0.0);
        for (Index h = 0; h < halfedges(); ++h) {
            if (net_.twin[h] != no_twin) continue;
            const Index a = chart_[face_of(h)];
            boundary[a] += surface_.lengths[h];
            if (twin(h) == no_twin) continue;
            if (const Index b = chart_[face_of(twin(h))]; a < b) common[{a, b}].push_back(h);
        }
        std::vector<std::pair<double, Index>> found;
        for (const auto& [charts, halfedges] : common) {
            const Index longest =
                *std::ranges::max_element(halfedges, {}, [&](Index h) { return surface_.lengths[h]; });
            const Motion motion = motion_to(longest);
            double length = 0.0, price = 0.0;
            for (const Index h : halfedges)
                if (meets(h, motion)) {
                    length += surface_.lengths[h];
                    price += net_.length[h];
                }
            if (length >= least_border * std::min(boundary[charts.first], boundary[charts.second]))
                found.emplace_back(-price, longest);
        }
        std::ranges::sort(found);
        std::vector<Index> order;
        for (const auto& border : found) order.push_back(border.second);
        return order;
    }

    /// Joins two islands at this half-edge of the first one, unless they overlap.
    void join(Index crease)
    {
        const Index a = island_of(crease), b = island_of(twin(crease));
        const Motion motion = motion_to(crease);
        const std::vector<Complex> before = at_;
        std::vector<Index> joined;
        for (const Index f : islands_[b])
            for (Index t = 3 * f; t < 3 * f + 3; ++t) {
                const Index h = twin(t);
                if (h == no_twin || net_.twin[h] != no_twin || island_of(h) != a || !meets(h, motion)) continue;
                joined.push_back(h);
            }
        for (const Index h : joined) {
            net_.twin[h] = twin(h);
            net_.twin[twin(h)] = h;
        }
        for (const Index f : islands_[b])
            for (Index c = 3 * f; c < 3 * f + 3; ++c) at_[c] = motion(at_[c]);
        std::vector<Index> faces = islands_[a];
        faces.insert(faces.end(), islands_[b].begin(), islands_[b].end());
        std::ranges::sort(faces);
        auto part = part_of(faces);
        if (!part || !survives_storing(*part)) {
            at_ = before;
            for (const Index h : joined) net_.cut(h);
            return;
        }
        parts_[a] = std::move(*part);
        islands_[a] = std::move(faces);
        islands_[b].clear();
        std::ranges::replace(island_, b, a);
    }

    /// These faces as they lie. @return no value if they are no disk with holes, or overlap
    std::optional<FlatPart> part_of(const std::vector<Index>& faces) const
    {
        std::vector<Index> number(net_.face.size(), -1);
        for (std::size_t i = 0; i < faces.size(); ++i) number[faces[i]] = static_cast<Index>(i);
        SeamedMesh mesh;
        mesh.corners = net_.corners(faces, Eigen::all);
        for (const Index f : faces)
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const Index t = net_.twin[h];
                mesh.twin.push_back(t == no_twin ? no_twin : 3 * number[face_of(t)] + t % 3);
            }
        number_fans(mesh);
        FlatPart part;
        part.faces = faces;
        part.original.resize(mesh.fan_count);
        part.points.resize(mesh.fan_count, 2);
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            const Index v = origin(mesh.fans, h);
            const Complex z = at_[3 * faces[face_of(h)] + h % 3];
            part.original[v] = origin(mesh.corners, h);
            part.points.row(v) << z.real(), z.imag();
        }
        part.vertices = surface_.vertices(part.original, Eigen::all);
        try {
            part.surface = require_bordered_genus_zero(mesh.fans, mesh.fan_count);
        } catch (const TopologyError&) {  // two islands that close a ring meet in one vertex
            return {};
        }
        if (!lies_one_to_one(part, part.points)) return {};
        part.rims.assign(part.surface.loops.begin(), part.surface.loops.end());
        part.held.assign(mesh.fan_count, 0);
        for (const VertexLoop& loop : part.surface.loops) {
            part.loops.emplace_back();
            for (const Index v : loop) part.loops.back().push_back(part.original[v]);
        }
        for (Index v = 0; v < mesh.fan_count; ++v)
            if (tips_.contains(part.original[v]) && std::ranges::count(part.original, part.original[v]) == 1)
                part.tips.push_back(v);
        if (!surface_.polygon.empty())
            for (const Index f : faces) part.polygon.push_back(surface_.polygon[f]);
        return part;
    }

    const CutSurface& surface_;
    SeamedMesh net_;                           // twins only where faces are joined
    std::vector<Complex> at_;                  // (3F) places of the corners
    std::vector<Index> slit_, dart_;           // half-edges
    std::set<Index> tips_;                     // where darts end
    std::vector<Index> chart_;                 // (F)
    std::vector<Index> island_;                // (charts)
    std::vector<std::vector<Index>> islands_;  // their faces, ascending
    std::vector<FlatPart> parts_;              // (islands)
};

}  // namespace

std::optional<UnfoldedParts> unfolded(const CutSurface& surface, ExecutionContext& context)
{
    Unfolding unfolding(surface);
    if (!unfolding.lay_charts(context)) return {};
    unfolding.join_charts(context);
    return UnfoldedParts{unfolding.parts(), unfolding.cut_length()};
}

}  // namespace koebe
