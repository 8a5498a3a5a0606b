#include "lift/overlay.h"

#include "core/connectivity.h"
#include "core/sort_unique.h"
#include "lift/outline_walk.h"
#include "planar/divided_polygon.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

namespace koebe {
namespace {

constexpr int rounds_one_by_one = 6;  // after which the neighbours of faulty outlines are left out too

enum class Fault { border, too_fine, crossing };

using Faults = std::vector<std::pair<Index, Fault>>;  // an outline, and why it cannot be drawn

std::uint64_t key_of(Index a, Index b)
{
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
}

/// For an edge the outline that it belongs to, and its number there.
using EdgesOfOutlines = std::unordered_map<std::uint64_t, std::pair<Index, std::size_t>>;

class Drawing {
public:
    Drawing(const FlatSheet& sheet, const std::vector<FlatSheet>& charts, const std::vector<DrawnOutline>& outlines,
            double& drawn)
        : sheet_(sheet), charts_(charts), outlines_(outlines), drawn_(drawn)
    {
    }

    /// @return outlines that cannot be drawn; if there is one, the result is of no use
    Faults run(Overlay& result)
    {
        walk_all();
        if (!faults_.empty()) return faults_;
        sort_edges();
        number_vertices(result);
        divide_faces(result);
        if (!faults_.empty()) return faults_;
        find_regions(result);
        return faults_;
    }

private:
    struct FacePart {
        std::vector<Index> inside;                 // nodes inside the face
        std::vector<std::array<Index, 2>> chords;  // nodes
        std::vector<Index> outlines;               // of the chords
        Index outline = -1;
    };

    void blame(Index outline, Fault fault) { faults_.emplace_back(outline, fault); }

    void walk_all()
    {
        std::unordered_map<Index, Index> owner;  // of vertices
        for (Index o = 0; o < static_cast<Index>(outlines_.size()); ++o) {
            const int chart = outlines_[o].chart;
            const std::size_t first = nodes_.size();
            OutlinePath path = walk_outline(chart < 0 ? sheet_ : charts_[chart], outlines_[o], nodes_);
            drawn_ += static_cast<double>(nodes_.size() - first);
            const Index face = outlines_[o].face;
            require_few_outlines(static_cast<double>(outlines_.size()), drawn_, "the size",
                                 face >= 0 && sheet_.on_surface(face) ? face : -1);
            if (chart >= 0) bring_home(charts_[chart], first);
            if (path.end != WalkEnd::closed) {
                blame(o, path.end == WalkEnd::border ? Fault::border : Fault::too_fine);
                paths_.emplace_back();
                continue;
            }
            for (const OutlineStep& step : path.steps)
                if (const Index v = nodes_[step.node].vertex; v >= 0 && owner.emplace(v, o).first->second != o)
                    blame(o, Fault::crossing);
            paths_.push_back(std::move(path.steps));
        }
    }

    /// Nodes in a chart of a sphere get their places in the sheet.
    void bring_home(const FlatSheet& chart, std::size_t first)
    {
        for (std::size_t n = first; n < nodes_.size(); ++n) {
            OutlineNode& node = nodes_[n];
            if (node.halfedge >= 0) {
                const Complex a = sheet_.uv[node.halfedge];
                node.uv = a + node.share * (sheet_.uv[next_halfedge(node.halfedge)] - a);
            } else if (node.vertex < 0) {
                node.uv = sheet_.uv_at(node.face, chart.weights_of(node.face, node.uv));
            }
        }
    }

    void sort_edges()
    {
        for (Index o = 0; o < static_cast<Index>(paths_.size()); ++o) {
            const std::vector<OutlineStep>& steps = paths_[o];
            for (std::size_t i = 0; i < steps.size(); ++i) {
                const OutlineNode& node = nodes_[steps[i].node];
                if (node.halfedge >= 0) {
                    on_edge_[node.halfedge].push_back(steps[i].node);
                    touch(face_of(node.halfedge), o);
                    touch(face_of(sheet_.twin[node.halfedge]), o);
                } else if (node.vertex < 0) {
                    touch(node.face, o).inside.push_back(steps[i].node);
                }
                const Index before = steps[(i + steps.size() - 1) % steps.size()].node;
                FacePart& crossed = touch(steps[i].face, o);
                crossed.chords.push_back({before, steps[i].node});
                crossed.outlines.push_back(o);
            }
        }
        for (auto& [halfedge, list] : on_edge_) std::ranges::sort(list, {}, [&](Index n) { return nodes_[n].share; });
    }

    FacePart& touch(Index face, Index outline)
    {
        FacePart& part = parts_[face];
        part.outline = std::max(part.outline, outline);
        return part;
    }

    void number_vertices(Overlay& result)
    {
        vertex_of_.assign(nodes_.size(), -1);
        Index count = static_cast<Index>(sheet_.vertices.rows());
        std::vector<Index> added;
        for (Index o = 0; o < static_cast<Index>(paths_.size()); ++o)
            for (const OutlineStep& step : paths_[o]) {
                const OutlineNode& node = nodes_[step.node];
                vertex_of_[step.node] = node.vertex >= 0 ? node.vertex : count++;
                if (node.vertex >= 0) continue;
                added.push_back(step.node);
                outline_of_.push_back(o);
            }
        result.vertices.resize(count, 3);
        result.normals.resize(count, 3);
        result.vertices.topRows(sheet_.vertices.rows()) = sheet_.vertices;
        result.normals.topRows(sheet_.vertices.rows()) = sheet_.normals;
        for (const Index n : added) lift(nodes_[n], vertex_of_[n], result);
        for (const auto& steps : paths_) {
            result.loops.emplace_back();
            for (const OutlineStep& step : steps) result.loops.back().push_back(vertex_of_[step.node]);
        }
    }

    void lift(const OutlineNode& node, Index vertex, Overlay& result) const
    {
        Eigen::RowVector3d weights = Eigen::RowVector3d::Zero();
        Index face = node.face;
        if (node.halfedge >= 0) {
            face = face_of(node.halfedge);
            weights[node.halfedge % 3] = 1.0 - node.share;
            weights[next_halfedge(node.halfedge) % 3] = node.share;
        } else {
            weights = sheet_.weights_of(face, node.uv);
        }
        result.vertices.row(vertex) = sheet_.position_at(face, weights);
        Eigen::RowVector3d normal = Eigen::RowVector3d::Zero();
        for (int k = 0; k < 3; ++k) normal += weights[k] * sheet_.normals.row(sheet_.triangles(face, k));
        const double length = normal.norm();
        result.normals.row(vertex) = length > 0.0 ? (normal / length).eval() : normal;
    }

    void divide_faces(Overlay& result)
    {
        std::vector<Index> corners;
        for (Index f = 0; f < static_cast<Index>(sheet_.triangles.rows()); ++f) {
            const auto part = parts_.find(f);
            if (part == parts_.end()) {
                for (int k = 0; k < 3; ++k) {
                    corners.push_back(sheet_.triangles(f, k));
                    result.uv.push_back(sheet_.corner(f, k));
                }
                result.face.push_back(f);
            } else {
                divide(f, part->second, corners, result);
            }
        }
        result.triangles =
            Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
    }

    void divide(Index f, const FacePart& part, std::vector<Index>& corners, Overlay& result)
    {
        std::vector<Complex> polygon, inside;
        std::vector<Index> vertices;
        std::unordered_map<Index, Index> place;  // of a vertex in the polygon and the points inside
        const auto add = [&](std::vector<Complex>& to, Complex z, Index vertex) {
            to.push_back(z);
            place.emplace(vertex, static_cast<Index>(vertices.size()));
            vertices.push_back(vertex);
        };
        for (int k = 0; k < 3; ++k) {
            add(polygon, sheet_.corner(f, k), sheet_.triangles(f, k));
            const Index h = 3 * f + k;
            const bool own = sheet_.twin[h] == no_twin || h < sheet_.twin[h];
            const auto list = on_edge_.find(own ? h : sheet_.twin[h]);
            if (list == on_edge_.end()) continue;
            std::vector<Index> in_order = list->second;
            if (!own) std::ranges::reverse(in_order);
            for (const Index n : in_order) add(polygon, node_place(sheet_, nodes_[n], f), vertex_of_[n]);
        }
        for (const Index n : part.inside) add(inside, nodes_[n].uv, vertex_of_[n]);
        std::vector<std::array<Index, 2>> segments;
        std::vector<Index> outlines;  // of the segments
        for (std::size_t i = 0; i < part.chords.size(); ++i) {
            const auto [a, b] = part.chords[i];
            const auto from = place.find(vertex_of_[a]), to = place.find(vertex_of_[b]);
            if (from == place.end() || to == place.end()) {
                blame(part.outlines[i], Fault::too_fine);
            } else {
                segments.push_back({from->second, to->second});
                outlines.push_back(part.outlines[i]);
            }
        }
        std::vector<std::size_t> faulty;
        const Triangles pieces = divided_polygon(polygon, inside, segments, &faulty);
        for (const std::size_t i : faulty) blame(outlines[i], Fault::crossing);
        if (pieces.rows() == 0 && faulty.empty()) blame(part.outline, Fault::crossing);
        polygon.insert(polygon.end(), inside.begin(), inside.end());
        for (Eigen::Index t = 0; t < pieces.rows(); ++t) {
            std::array<StoredPoint, 3> stored{};
            Index outline = -1;  // at a corner of the piece
            for (int k = 0; k < 3; ++k) {
                const Complex z = polygon[pieces(t, k)];
                stored[k] = {as_stored(z.real()), as_stored(z.imag())};
                if (const Index v = vertices[pieces(t, k)]; v >= sheet_.vertices.rows())
                    outline = std::max(outline, outline_of_[v - sheet_.vertices.rows()]);
                corners.push_back(vertices[pieces(t, k)]);
                result.uv.push_back(z);
            }
            if (sheet_.on_surface(f) && StoredFace(stored[0], stored[1], stored[2]).doubtful())
                blame(outline >= 0 ? outline : part.outline, Fault::too_fine);
            result.face.push_back(f);
        }
    }

    void find_regions(Overlay& result)
    {
        const std::vector<Index> twin = pair_halfedges(result.triangles, static_cast<Index>(result.vertices.rows()));
        EdgesOfOutlines outline_at;
        for (Index o = 0; o < static_cast<Index>(result.loops.size()); ++o)
            for (std::size_t i = 0; i < result.loops[o].size(); ++i)
                outline_at[key_of(result.loops[o][i], result.loops[o][(i + 1) % result.loops[o].size()])] = {o, i};
        result.region.assign(result.triangles.rows(), -1);
        std::vector<std::vector<Index>> begin(result.loops.size());
        std::vector<std::size_t> found(result.loops.size(), 0);
        for (Index h = 0; h < static_cast<Index>(twin.size()); ++h) {
            const Index a = origin(result.triangles, h);
            const auto at = outline_at.find(key_of(a, target(result.triangles, h)));
            if (at == outline_at.end()) continue;
            const auto [o, i] = at->second;
            if (result.loops[o][i] != a) continue;
            begin[o].push_back(h);
            ++found[o];
        }
        std::vector<Index> euler(begin.size(), 1);
        for (Index o = 0; o < static_cast<Index>(begin.size()); ++o) {
            if (found[o] != result.loops[o].size())
                blame(o, Fault::crossing);  // a chord runs through another outline's point
            else
                euler[o] = flood(o, begin[o], twin, outline_at, result);
        }
        check_nesting(begin, twin, std::move(euler), result);
    }

    /// Checks that each outline's faces are a disk, less what the outlines inside take out of it.
    void check_nesting(const std::vector<std::vector<Index>>& begin, const std::vector<Index>& twin,
                       std::vector<Index> euler, const Overlay& result)
    {
        for (Index o = 0; o < static_cast<Index>(begin.size()); ++o) {
            if (begin[o].empty()) continue;
            const auto outside = [&](Index h) { return twin[h] == no_twin ? -1 : result.region[face_of(twin[h])]; };
            const Index around = outside(begin[o].front());
            const bool in_outline = around >= 0 && !outlines_[around].hole;
            if (outlines_[o].hole != in_outline ||
                std::ranges::any_of(begin[o], [&](Index h) { return outside(h) != around; }))
                blame(o, Fault::crossing);
            if (around >= 0) ++euler[around];
        }
        for (Index o = 0; o < static_cast<Index>(euler.size()); ++o)
            if (euler[o] != 1) blame(o, Fault::border);
    }

    /// Numbers the faces inside an outline. @return their Euler characteristic
    Index flood(Index o, const std::vector<Index>& begin, const std::vector<Index>& twin,
                const EdgesOfOutlines& outline_at, Overlay& result)
    {
        std::vector<Index> front, faces;
        const auto visit = [&](Index f) {
            if (result.region[f] == o) return;
            if (result.region[f] >= 0) blame(o, Fault::crossing);
            result.region[f] = o;
            front.push_back(f);
            faces.push_back(f);
        };
        for (const Index h : begin) visit(face_of(h));
        std::set<Index> vertices;
        Index edges = 0;  // twice those between two faces, and those at the region's rim
        bool at_border = false;
        while (!front.empty()) {
            const Index f = front.back();
            front.pop_back();
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                vertices.insert(origin(result.triangles, h));
                const bool chord =
                    outline_at.contains(key_of(origin(result.triangles, h), target(result.triangles, h)));
                edges += chord ? 2 : 1;
                if (chord) continue;
                if (twin[h] == no_twin) {
                    at_border = true;
                    ++edges;
                } else {
                    visit(face_of(twin[h]));
                }
            }
            if (faces.size() > result.region.size()) break;
        }
        for (const Index h : begin)  // the other side must be outside
            if (twin[h] == no_twin || result.region[face_of(twin[h])] == o) at_border = true;
        if (at_border) blame(o, Fault::border);
        return static_cast<Index>(vertices.size()) - edges / 2 + static_cast<Index>(faces.size());
    }

    const FlatSheet& sheet_;
    const std::vector<FlatSheet>& charts_;
    const std::vector<DrawnOutline>& outlines_;
    double& drawn_;  // nodes, in all rounds
    std::vector<OutlineNode> nodes_;
    std::vector<std::vector<OutlineStep>> paths_;
    std::unordered_map<Index, std::vector<Index>> on_edge_;
    std::unordered_map<Index, FacePart> parts_;
    std::vector<Index> vertex_of_;
    std::vector<Index> outline_of_;  // of added vertices
    Faults faults_;
};

/// Takes out the groups of the faulty outlines. Each group counts once.
/// @param widely also the outlines that begin in the same faces
void leave_out(const Faults& faults, const FlatSheet& sheet, bool widely, std::vector<DrawnOutline>& outlines,
               LeftOut& left_out)
{
    std::unordered_map<Index, Fault> groups, faces;
    for (const auto& [outline, fault] : faults) {
        groups.emplace(outlines[outline].group, fault);
        faces.emplace(outlines[outline].face, fault);
    }
    if (widely)
        for (const DrawnOutline& o : outlines)
            if (const auto face = faces.find(o.face); face != faces.end()) groups.emplace(o.group, face->second);
    for (const auto& [group, fault] : groups)
        ++(fault == Fault::border     ? left_out.at_border
           : fault == Fault::too_fine ? left_out.too_fine
                                      : left_out.crossing);
    for (const DrawnOutline& o : outlines)
        if (groups.contains(o.group) && o.face >= 0 && sheet.on_surface(o.face)) left_out.faces.push_back(o.face);
    std::erase_if(outlines, [&](const DrawnOutline& o) { return groups.contains(o.group); });
}

}  // namespace

void LeftOut::add(const LeftOut& others)
{
    at_border += others.at_border;
    too_fine += others.too_fine;
    crossing += others.crossing;
    open += others.open;
    faces.insert(faces.end(), others.faces.begin(), others.faces.end());
}

Overlay draw_outlines(const FlatSheet& sheet, std::vector<DrawnOutline> outlines, const std::vector<FlatSheet>& charts,
                      double drawn)
{
    LeftOut left_out;
    for (int round = 1;; ++round) {
        Overlay result;
        const Faults faults = Drawing(sheet, charts, outlines, drawn).run(result);
        if (faults.empty()) {
            result.outlines = std::move(outlines);
            result.drawn = drawn;
            sort_unique(left_out.faces);
            result.left_out = std::move(left_out);
            return result;
        }
        leave_out(faults, sheet, round > rounds_one_by_one, outlines, left_out);
    }
}

}  // namespace koebe
