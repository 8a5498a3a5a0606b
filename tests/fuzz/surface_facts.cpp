#include "surface_facts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace koebe::fuzz {
namespace {

class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parent_(count)
    {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    std::size_t root(std::size_t x)
    {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

private:
    std::vector<std::size_t> parent_;
};

Edge edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

struct Side {
    std::size_t face;
    bool rising;  ///< the face runs from the smaller vertex to the larger one
};

using Sides = std::map<Edge, std::vector<Side>>;

Sides sides_of(const Soup& soup)
{
    Sides sides;
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index a = soup.faces[f][k], b = soup.faces[f][(k + 1) % 3];
            sides[edge_of(a, b)].push_back({f, a < b});
        }
    return sides;
}

/// Whether the faces around every vertex hang together: joined by the edges at it, they are one part.
bool every_star_is_one(const Soup& soup, const Sides& sides)
{
    std::vector<std::vector<std::size_t>> star(soup.points.size());
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        for (const Index v : soup.faces[f]) star[v].push_back(f);
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> joined(soup.points.size());
    for (const auto& [edge, faces] : sides)
        if (faces.size() == 2)
            for (const Index v : {edge.first, edge.second}) joined[v].push_back({faces[0].face, faces[1].face});
    for (std::size_t v = 0; v < star.size(); ++v) {
        const auto place = [&](std::size_t face) {
            return static_cast<std::size_t>(std::ranges::find(star[v], face) - star[v].begin());
        };
        UnionFind parts(star[v].size());
        for (const auto& [f, g] : joined[v]) parts.join(place(f), place(g));
        for (std::size_t i = 1; i < star[v].size(); ++i)
            if (parts.root(i) != parts.root(0)) return false;
    }
    return true;
}

}  // namespace

bool arrays_are_a_mesh(const Soup& soup)
{
    const auto is_vertex = [&](Index v) { return v >= 0 && v < static_cast<Index>(soup.points.size()); };
    return !soup.faces.empty() && std::ranges::all_of(soup.points, [](const auto& p) {
        return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
    }) && std::ranges::all_of(soup.faces, [&](const auto& face) {
        return std::ranges::all_of(face, is_vertex) && face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
    });
}

std::optional<SurfaceFacts> surface_facts(const Soup& soup)
{
    if (!arrays_are_a_mesh(soup)) return std::nullopt;
    const Sides sides = sides_of(soup);
    const std::size_t face_count = soup.faces.size();
    UnionFind same(2 * face_count);  // face f as it is, and face f turned
    for (const auto& [edge, faces] : sides) {
        if (faces.size() > 2) return std::nullopt;
        if (faces.size() < 2) continue;
        const std::size_t f = faces[0].face, g = faces[1].face;
        const bool agree = faces[0].rising != faces[1].rising;
        same.join(f, agree ? g : g + face_count);
        same.join(f + face_count, agree ? g + face_count : g);
    }
    SurfaceFacts facts;
    facts.faces = soup.faces;
    for (std::size_t f = 0; f < face_count; ++f) {
        if (same.root(f) == same.root(f + face_count)) return std::nullopt;  // one side only
        if (same.root(f) == same.root(0)) continue;
        if (same.root(f) != same.root(face_count)) return std::nullopt;  // another component
        std::swap(facts.faces[f][0], facts.faces[f][1]);
        ++facts.reversed;
    }
    if (!every_star_is_one(soup, sides)) return std::nullopt;

    UnionFind rim(soup.points.size());
    for (const auto& [edge, faces] : sides)
        if (faces.size() == 1) {
            facts.boundary.push_back(edge);
            rim.join(static_cast<std::size_t>(edge.first), static_cast<std::size_t>(edge.second));
        }
    std::vector<char> used(soup.points.size(), 0), is_root(soup.points.size(), 0);
    for (const auto& face : soup.faces)
        for (const Index v : face) used[v] = 1;
    for (const Edge& edge : facts.boundary) is_root[rim.root(static_cast<std::size_t>(edge.first))] = 1;
    facts.loop_count = static_cast<std::size_t>(std::ranges::count(is_root, 1));
    const auto euler = std::ranges::count(used, 1) - static_cast<std::ptrdiff_t>(sides.size()) +
                       static_cast<std::ptrdiff_t>(face_count);
    if (facts.loop_count == 0 || euler != 2 - static_cast<std::ptrdiff_t>(facts.loop_count)) return std::nullopt;
    return facts;
}

}  // namespace koebe::fuzz
