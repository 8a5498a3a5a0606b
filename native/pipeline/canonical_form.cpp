#include "pipeline/canonical_form.h"

#include "core/connectivity.h"
#include "core/length.h"
#include "core/prefetch.h"
#include "core/thread_share.h"
#include "pipeline/canonical_position.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace koebe {
namespace {

constexpr double hash_unit = 1e-3;  // of lengths in a hash, over the longest boundary edge
constexpr int hash_rounds = 24;     // edges that a neighbourhood reaches

std::uint64_t mixed(std::uint64_t x)
{
    // The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

class Canonicalizer {
public:
    Canonicalizer(const Surface& surface, const Vertices& vertices)
        : surface_(surface), positions_(scaled_position(surface, vertices))
    {
    }

    CanonicalForm run()
    {
        number_from(first_halfedge());
        Vertices numbered(form_.original_vertices.size(), 3);
        each_rows(numbered.rows(), [&](Eigen::Index first, Eigen::Index count) {
            for (Eigen::Index v = first; v < first + count; ++v)
                numbered.row(v) = positions_.row(form_.original_vertices[v]);
        });
        positions_ = {};
        CanonicalPosition position = turned_position(form_.surface.triangles, std::move(numbered));
        form_.vertices = std::move(position.vertices);
        form_.thinnest = position.thinnest;
        return std::move(form_);
    }

private:
    double length(Index h) const
    {
        return length_of(positions_.row(target(surface_.triangles, h)) - positions_.row(origin(surface_.triangles, h)));
    }

    Index first_halfedge() const
    {
        const std::vector<Index> rim = found_in_pieces(static_cast<Index>(surface_.twin.size()),
                                                       [&](Index h) { return surface_.twin[h] == no_twin; });
        double longest = -1.0;
        for (const Index h : rim) longest = std::max(longest, length(h));
        std::vector<Index> candidates;
        for (const Index h : rim)
            if (length(h) >= (1.0 - same_size) * longest) candidates.push_back(h);
        if (candidates.size() == 1) return candidates.front();
        const std::vector<Key> keys = keys_of(candidates, longest);
        return candidates[static_cast<std::size_t>(std::max_element(keys.begin(), keys.end()) - keys.begin())];
    }

    /// The half-edges of all faces that a walk of so many edges from the ends of others comes to.
    std::vector<Index> halfedges_around(const std::vector<Index>& starts, int edges) const
    {
        const std::vector<Index>& twin = surface_.twin;
        std::vector<bool> is_near(surface_.vertex_count, false), is_found(surface_.triangles.rows(), false);
        std::vector<Index> ring, next, result;  // a ring: of each of its vertices a half-edge from there
        const auto add = [&](Index h) {
            const Index v = origin(surface_.triangles, h);
            if (!is_near[v]) next.push_back(h);
            is_near[v] = true;
        };
        const auto find = [&](Index f) {
            if (is_found[f]) return;
            is_found[f] = true;
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                result.push_back(h);
                add(h);
            }
        };
        for (const Index h : starts) {
            add(h);
            add(next_halfedge(h));
        }
        for (int step = 0; step <= edges && !next.empty(); ++step) {
            ring.swap(next);
            next.clear();
            for (const Index first : ring) {
                Index h = first;
                for (; h != no_twin; h = twin[previous_halfedge(h)]) {
                    find(face_of(h));
                    if (twin[previous_halfedge(h)] == first) break;
                }
                if (h != no_twin) continue;  // all round
                for (h = twin[first]; h != no_twin; h = twin[next_halfedge(h)]) find(face_of(h));
            }
        }
        return result;
    }

    using Key = std::pair<std::uint64_t, std::uint64_t>;

    /// Numbers for the two ends of each candidate that tell their neighbourhoods from others, until all candidates are
    /// told apart.
    std::vector<Key> keys_of(const std::vector<Index>& candidates, double unit) const
    {
        const Triangles& triangles = surface_.triangles;
        const std::vector<Index> around = halfedges_around(candidates, hash_rounds);
        struct Edge {
            Index from, to;  // numbers of the vertices here
            bool on_rim;
            std::uint64_t length;
        };
        std::vector<Index> number(surface_.vertex_count, -1);
        Index count = 0;
        for (const Index h : around)
            if (Index& own = number[origin(triangles, h)]; own < 0) own = count++;
        std::vector<Edge> edges;
        edges.reserve(around.size());
        for (const Index h : around) {
            const bool on_rim = surface_.twin[h] == no_twin;
            const double units = unit > 0.0 ? length(h) / (hash_unit * unit) : 0.0;
            edges.push_back(
                {number[origin(triangles, h)], number[target(triangles, h)], on_rim,
                 mixed(units < 0x1p62 ? static_cast<std::uint64_t>(std::llround(units)) : 0u) + (on_rim ? 1u : 0u)});
        }
        std::vector<std::uint64_t> hash(static_cast<std::size_t>(count), 1), next;
        for (int round = 0; round < hash_rounds; ++round) {
            next = hash;
            for (const Edge& e : edges) {
                next[e.from] += mixed(hash[e.to] ^ mixed(e.length));
                if (e.on_rim) next[e.to] += mixed(hash[e.from] ^ mixed(e.length + 1));
            }
            for (std::uint64_t& number_of_vertex : next) number_of_vertex = mixed(number_of_vertex);
            hash.swap(next);
            std::vector<std::uint64_t> keys;
            for (const Index h : candidates)
                keys.push_back(mixed(hash[number[origin(triangles, h)]]) + hash[number[target(triangles, h)]]);
            std::sort(keys.begin(), keys.end());
            if (std::adjacent_find(keys.begin(), keys.end()) == keys.end()) break;
        }
        std::vector<Key> result;
        for (const Index h : candidates)
            result.emplace_back(hash[number[origin(triangles, h)]], hash[number[target(triangles, h)]]);
        return result;
    }

    /// The half-edges that a walk over the faces, breadth first, enters them by. Appends the vertices as it meets them:
    /// those of the edge that it enters by are known, but for the first face.
    std::vector<Index> walk_from(Index start)
    {
        const Triangles& triangles = surface_.triangles;
        std::vector<Index> entered;
        entered.reserve(surface_.triangles.rows());
        form_.original_vertices.reserve(surface_.vertex_count);
        std::vector<bool> is_met(surface_.triangles.rows(), false), is_numbered(surface_.vertex_count, false);
        const auto meet = [&](Index h) {
            if (is_numbered[origin(triangles, h)]) return;
            is_numbered[origin(triangles, h)] = true;
            form_.original_vertices.push_back(origin(triangles, h));
        };
        const auto cross = [&](Index h) {
            const Index twin = surface_.twin[h];
            if (twin == no_twin || is_met[face_of(twin)]) return;
            is_met[face_of(twin)] = true;
            entered.push_back(twin);
        };
        is_met[face_of(start)] = true;
        entered.push_back(start);
        for (std::size_t head = 0; head < entered.size(); ++head) {
            if (head + steps_ahead < entered.size()) {
                const Index ahead = entered[head + steps_ahead];
                prefetch(&surface_.twin[ahead]);
                prefetch(&triangles.data()[ahead]);
            }
            const Index second = next_halfedge(entered[head]), third = next_halfedge(second);
            if (head == 0) {
                meet(start);
                cross(start);
                meet(second);
            }
            cross(second);
            meet(third);
            cross(third);
        }
        return entered;
    }

    /// Breadth first over the faces, each from the corner it is entered by.
    void number_from(Index start)
    {
        const Index face_count = static_cast<Index>(surface_.triangles.rows());
        Surface& surface = form_.surface;
        const std::vector<Index> entered = walk_from(start);
        rank_.assign(surface_.vertex_count, -1);
        each_rows(static_cast<Eigen::Index>(form_.original_vertices.size()), [&](Eigen::Index first, Eigen::Index n) {
            for (Eigen::Index v = first; v < first + n; ++v) rank_[form_.original_vertices[v]] = static_cast<Index>(v);
        });
        form_.original_faces.resize(face_count);
        form_.first_corners.resize(face_count);
        std::vector<Index> first_halfedge(face_count);  // of each face, in the new numbers
        each_rows(face_count, [&](Eigen::Index first, Eigen::Index n) {
            for (Eigen::Index f = first; f < first + n; ++f) {
                const Index h = entered[f];
                form_.original_faces[f] = face_of(h);
                form_.first_corners[f] = static_cast<char>((3 - h % 3) % 3);
                first_halfedge[face_of(h)] = static_cast<Index>(3 * f) + (3 - h % 3) % 3;
            }
        });
        surface.triangles.resize(face_count, 3);
        surface.twin.resize(3 * static_cast<std::size_t>(face_count));
        each_rows(face_count, [&](Eigen::Index first, Eigen::Index n) {
            for (Eigen::Index f = first; f < first + n; ++f) {
                Index h = entered[f];
                for (int k = 0; k < 3; ++k, h = next_halfedge(h)) {
                    surface.triangles(f, k) = rank_[origin(surface_.triangles, h)];
                    const Index twin = surface_.twin[h];
                    Index& other = surface.twin[3 * f + k];
                    other = twin == no_twin ? no_twin : first_halfedge[face_of(twin)];
                    for (Index step = twin % 3; step > 0; --step) other = next_halfedge(other);
                }
            }
        });
        surface.vertex_count = static_cast<Index>(form_.original_vertices.size());
        surface.euler_characteristic = surface_.euler_characteristic;
        surface.genus = surface_.genus;
        surface.reoriented = surface_.reoriented;
        surface.unused = surface_.unused;
        for (VertexLoop loop : surface_.loops) {
            for (Index& v : loop) v = rank_[v];
            std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
            surface.loops.push_back(std::move(loop));
        }
        std::sort(surface.loops.begin(), surface.loops.end());
    }

    const Surface& surface_;
    Vertices positions_;
    std::vector<Index> rank_;
    CanonicalForm form_;
};

}  // namespace

CanonicalForm canonical_form(const Surface& surface, const Vertices& vertices)
{
    return Canonicalizer(surface, vertices).run();
}

}  // namespace koebe
