#include "parts/carried_paths.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "cut/seamed_mesh.h"
#include "mesh/nearest_first.h"
#include "parts/tension.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double far_off = 4.0;         // price of an edge as far from a coarse edge as that is long, beside its length
constexpr double longest_detour = 3.0;  // length of a path over the length of its chain

/// The paths of one fine part.
class PathFinder {
public:
    PathFinder(const FlatPart& fine, const CutCoarsePart& cut, const std::vector<Index>& vertex)
        : fine_(fine), coarse_(cut.uncut()), cut_(cut), vertex_(vertex)
    {
        prepare();
    }

    /// The chains of edges along which the coarse part was cut, from one fork, tip or place of the boundary to the
    /// next.
    std::vector<Path> chains() const
    {
        const Triangles& triangles = coarse_.surface.triangles;
        std::vector<std::vector<Index>> leaving(static_cast<std::size_t>(coarse_.surface.vertex_count));
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
            if (coarse_.surface.twin[h] != no_twin && cut_.is_open(h)) leaving[origin(triangles, h)].push_back(h);
        const std::vector<char> outside = boundary_mask(coarse_.surface);
        std::vector<Path> all;
        const auto is_node = [&](Index v) { return outside[v] != 0 || leaving[v].size() != 2; };
        std::vector<char> seen(coarse_.surface.twin.size(), 0);
        for (Index v = 0; v < coarse_.surface.vertex_count; ++v) {
            if (!is_node(v)) continue;
            for (Index h : leaving[v]) {
                if (seen[h]) continue;
                Path chain{h};
                for (Index end = target(triangles, h); !is_node(end); end = target(triangles, h)) {
                    h = leaving[end][leaving[end][0] == coarse_.surface.twin[h] ? 1 : 0];
                    chain.push_back(h);
                }
                for (const Index own : chain) seen[own] = seen[coarse_.surface.twin[own]] = 1;
                all.push_back(std::move(chain));
            }
        }
        return all;
    }

    /// The vertices of a chain, by the whole, or their images; from the lower end.
    std::vector<Index> name_of(const Path& chain, bool image) const
    {
        const std::vector<Index>& names = image ? coarse_.image : coarse_.original;
        const Triangles& triangles = coarse_.surface.triangles;
        std::vector<Index> name{names[origin(triangles, chain.front())]};
        for (const Index h : chain) name.push_back(names[target(triangles, h)]);
        if (name.front() > name.back()) std::ranges::reverse(name);
        return name;
    }

    /// A short path near a chain, through its vertices.
    std::optional<Path> path_along(const Path& chain)
    {
        const Triangles& triangles = coarse_.surface.triangles;
        Path path;
        std::vector<Index> own{vertex_[origin(triangles, chain.front())]};  // vertices of this path
        for (const Index h : chain) own.push_back(vertex_[target(triangles, h)]);
        std::vector<char> taken = taken_;
        for (const Index v : own) taken[v] = 1;
        for (std::size_t i = 0; i + 1 < own.size(); ++i) {
            std::optional<Path> step = path_between(own[i], own[i + 1], taken, false);
            if (!step && (i == 0 || i + 2 == own.size())) step = path_between(own[i], own[i + 1], taken, true);
            if (!step) return {};
            for (const Index h : *step) taken[target(fine_.surface.triangles, h)] = 1;
            path.insert(path.end(), step->begin(), step->end());
        }
        return path;
    }

    /// The shortest path near the straight line between two vertices. @param taken (V) 1: the path may not touch it
    /// @param anywhere ends on the boundary may be elsewhere on the same loop
    std::optional<Path> path_between(Index from, Index to, const std::vector<char>& taken, bool anywhere) const
    {
        const Triangles& triangles = fine_.surface.triangles;
        const Complex start = complex_at(fine_.points, from), along = complex_at(fine_.points, to) - start;
        NearestFirst nearest(fine_.surface.vertex_count);
        std::unordered_map<Index, Index> last;
        nearest.reach(from, 0.0);
        if (anywhere && loop_of_[from] >= 0 && loop_of_[from] != loop_of_[to])
            for (const Index v : fine_.surface.loops[loop_of_[from]])
                if (!on_path_[v]) nearest.reach(v, 0.0);
        const auto is_end = [&](Index v) {
            return v == to || (anywhere && loop_of_[to] >= 0 && loop_of_[v] == loop_of_[to] &&
                               loop_of_[to] != loop_of_[from] && !on_path_[v]);
        };
        Index end = nearest.take();
        for (Index v = end; v >= 0 && !is_end(v); v = end = nearest.take())
            for (std::size_t i = begin_[v]; i < begin_[v + 1]; ++i) {
                const Index h = leaving_[i], w = target(triangles, h);
                if (taken[w] && !is_end(w)) continue;
                const Complex off = (0.5 * (complex_at(fine_.points, v) + complex_at(fine_.points, w)) - start) / along;
                const double beyond = off.real() - std::clamp(off.real(), 0.0, 1.0);
                const double price = 1.0 + far_off * (off.imag() * off.imag() + beyond * beyond);
                if (nearest.reach(w, nearest.distance()[v] + mesh_.length[h] * price)) last[w] = h;
            }
        if (end < 0) return {};
        Path path;
        for (Index v = end; last.contains(v); v = origin(triangles, last[v])) path.push_back(last[v]);
        std::ranges::reverse(path);
        return path;
    }

    /// The path through these vertices of the whole, if it is free. @param names in either direction
    std::optional<Path> path_through(const Path& chain, std::vector<Index> names)
    {
        if (names.back() == coarse_.original[origin(coarse_.surface.triangles, chain.front())] ||
            names.front() == coarse_.original[target(coarse_.surface.triangles, chain.back())])
            std::ranges::reverse(names);
        const auto number = [&](Index name) {
            const auto found = number_.find(name);
            return found == number_.end() ? -1 : found->second;
        };
        Path path;
        for (std::size_t i = 0; i + 1 < names.size(); ++i) {
            const Index a = number(names[i]), b = number(names[i + 1]);
            if (a < 0 || b < 0 || (i > 0 && taken_[a])) return {};
            const auto begin = leaving_.begin() + static_cast<std::ptrdiff_t>(begin_[a]);
            const auto end = leaving_.begin() + static_cast<std::ptrdiff_t>(begin_[a + 1]);
            const auto found =
                std::find_if(begin, end, [&](Index h) { return target(fine_.surface.triangles, h) == b; });
            if (found == end) return {};
            path.push_back(*found);
        }
        return path;
    }

    std::vector<Index> images_on(const Path& path) const
    {
        std::vector<Index> names{fine_.image[origin(fine_.surface.triangles, path.front())]};
        for (const Index h : path) names.push_back(fine_.image[target(fine_.surface.triangles, h)]);
        return names;
    }

    bool is_roundabout(const Path& chain, const Path& path) const
    {
        return path_length(fine_, path) > longest_detour * path_length(coarse_, chain);
    }

    CarriedPath taken(const Path& chain, Path path)
    {
        for (const Index h : path)
            for (const Index v : {origin(fine_.surface.triangles, h), target(fine_.surface.triangles, h)})
                taken_[v] = on_path_[v] = 1;
        return {chain, std::move(path)};
    }

private:
    void prepare()
    {
        mesh_ = seamed(fine_, fine_.shown);
        taken_ = boundary_mask(fine_.surface);
        on_path_.assign(taken_.size(), 0);
        loop_of_.assign(taken_.size(), -1);
        for (std::size_t k = 0; k < fine_.surface.loops.size(); ++k)
            for (const Index v : fine_.surface.loops[k]) loop_of_[v] = static_cast<int>(k);
        const auto count = static_cast<std::size_t>(fine_.surface.vertex_count);
        begin_.assign(count + 1, 0);
        const auto may_cut = [&](Index h) { return mesh_.twin[h] != no_twin && !mesh_.whole[h]; };
        for (Index h = 0; h < mesh_.halfedge_count(); ++h)
            if (may_cut(h)) ++begin_[origin(fine_.surface.triangles, h) + 1];
        for (std::size_t v = 0; v < count; ++v) begin_[v + 1] += begin_[v];
        leaving_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), std::prev(begin_.end()));
        for (Index h = 0; h < mesh_.halfedge_count(); ++h)
            if (may_cut(h)) leaving_[next[origin(fine_.surface.triangles, h)]++] = h;
        for (std::size_t v = 0; v < count; ++v) {
            const auto [at, is_new] = number_.emplace(fine_.original[v], static_cast<Index>(v));
            if (!is_new) at->second = -1;  // two sides of a slit
        }
    }

    const FlatPart &fine_, &coarse_;
    const CutCoarsePart& cut_;
    const std::vector<Index>& vertex_;  // (V) of the coarse part: the fine vertex
    SeamedMesh mesh_;
    std::vector<char> taken_, on_path_;  // (V) of the fine part: on the boundary or on a path
    std::vector<int> loop_of_;           // (V) -1 inside
    std::vector<std::size_t> begin_;
    std::vector<Index> leaving_;               // half-edges that may be cut, by the vertex that they leave
    std::unordered_map<Index, Index> number_;  // of the fine vertex, by the vertex of the whole
};

}  // namespace

double halfedge_length(const FlatPart& part, Index h)
{
    const Triangles& triangles = part.surface.triangles;
    return (part.vertices.row(origin(triangles, h)) - part.vertices.row(target(triangles, h))).norm();
}

double path_length(const FlatPart& part, const Path& path)
{
    double sum = 0.0;
    for (const Index h : path) sum += halfedge_length(part, h);
    return sum;
}

CutCoarsePart::CutCoarsePart(const FlatPart& uncut) : uncut_(&uncut), first_(uncut.faces.size())
{
    for (std::size_t f = 0; f < uncut.faces.size(); ++f) face_.emplace(uncut.faces[f], static_cast<Index>(f));
}

void CutCoarsePart::add(const FlatPart& piece)
{
    for (std::size_t f = 0; f < piece.faces.size(); ++f)
        first_[face_.at(piece.faces[f])] = {pieces_.size(), 3 * static_cast<Index>(f)};
    pieces_.push_back(&piece);
}

CutCoarsePart::Place CutCoarsePart::place_of(Index halfedge) const
{
    const Place& first = first_[face_of(halfedge)];
    return {first.piece, first.halfedge + halfedge % 3};
}

bool CutCoarsePart::is_open(Index halfedge) const
{
    const Place place = place_of(halfedge);
    return pieces_[place.piece]->surface.twin[place.halfedge] == no_twin;
}

Index CutCoarsePart::face_of_whole(Index face) const
{
    const auto found = face_.find(face);
    return found == face_.end() ? -1 : found->second;
}

std::vector<std::vector<CarriedPath>> carried_paths(const std::vector<FlatPart>& fine,
                                                    const std::vector<CutCoarsePart>& coarse,
                                                    const std::vector<std::vector<Index>>& vertex,
                                                    const ExecutionContext& context)
{
    std::map<std::vector<Index>, std::vector<Index>> images;  // the image of each path, by the image of its chain
    std::vector<std::vector<CarriedPath>> all(fine.size());
    for (std::size_t k = 0; k < fine.size(); ++k) {
        PathFinder finder(fine[k], coarse[k], vertex[k]);
        for (const Path& chain : finder.chains()) {
            context.checkpoint();
            std::optional<Path> path;
            if (const auto found = images.find(finder.name_of(chain, false)); found != images.end())
                path = finder.path_through(chain, found->second);
            if (!path) path = finder.path_along(chain);
            if (!path || finder.is_roundabout(chain, *path)) continue;
            if (!fine[k].image.empty()) images[finder.name_of(chain, true)] = finder.images_on(*path);
            all[k].push_back(finder.taken(chain, std::move(*path)));
        }
    }
    return all;
}

}  // namespace koebe
