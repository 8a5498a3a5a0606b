#include "ears/ears.h"

#include "core/connectivity.h"
#include "core/sort_unique.h"
#include "surface/laplacian.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr int no_loop = -1, several_loops = -2;

/// A part of the surface between the chords. The parts form a tree, as a chord of one loop separates.
struct Block {
    std::vector<Index> faces;
    std::vector<Index> chords;  // half-edges of this part on a chord
    int loop = no_loop;         // the loop on the boundary edges of this part and all parts peeled off it
    double area = 0.0;
    int open_chords = 0;  // chords to parts not yet peeled off
    bool peeled = false;
};

int joined(int a, int b)
{
    if (a == no_loop) return b;
    return b == no_loop || a == b ? a : several_loops;
}

class EarCutter {
public:
    EarCutter(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops)
        : surface_(surface),
          loops_(loops),
          loop_of_(surface.vertex_count, no_loop),
          place_(surface.vertex_count, 0),
          part_of_(surface.triangles.rows(), -1)
    {
        for (std::size_t k = 0; k < loops.size(); ++k)
            for (std::size_t i = 0; i < loops[k].size(); ++i) {
                loop_of_[loops[k][i]] = static_cast<int>(k);
                place_[loops[k][i]] = static_cast<Index>(i);
            }
        for (Index h = 0; h < static_cast<Index>(surface.twin.size()) && !any_chord_; ++h) any_chord_ = is_chord(h);
        if (!any_chord_) return;
        split(edge_lengths(vertices, surface.triangles));
        peel();
    }

    std::vector<Ear> ears() const
    {
        std::vector<Ear> result;
        if (!any_chord_) return result;
        for (std::size_t p = 0; p < parts_.size(); ++p)
            if (!parts_[p].peeled)
                for (const Index h : parts_[p].chords)
                    if (parts_[part_of_[face_of(surface_.twin[h])]].peeled) result.push_back(ear_behind(h));
        return result;
    }

private:
    bool is_chord(Index h) const
    {
        if (surface_.twin[h] == no_twin) return false;
        const int loop = loop_of_[origin(surface_.triangles, h)];
        return loop != no_loop && loop == loop_of_[target(surface_.triangles, h)];
    }

    void split(const EdgeLengths& lengths)
    {
        // Flood from each face that has no part yet, up to chords.
        for (Index seed = 0; seed < static_cast<Index>(part_of_.size()); ++seed) {
            if (part_of_[seed] >= 0) continue;
            const Index id = static_cast<Index>(parts_.size());
            Block part;
            part.faces.push_back(seed);
            part_of_[seed] = id;
            for (std::size_t head = 0; head < part.faces.size(); ++head) {
                const Index f = part.faces[head];
                part.area += triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
                for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                    if (surface_.twin[h] == no_twin) {
                        part.loop = joined(part.loop, loop_of_[origin(surface_.triangles, h)]);
                    } else if (is_chord(h)) {
                        part.chords.push_back(h);
                    } else if (const Index g = face_of(surface_.twin[h]); part_of_[g] < 0) {
                        part_of_[g] = id;
                        part.faces.push_back(g);
                    }
                }
            }
            part.open_chords = static_cast<int>(part.chords.size());
            parts_.push_back(std::move(part));
        }
    }

    /// Takes off leaves of the tree, as long as only the chord's own loop runs along them.
    void peel()
    {
        std::size_t kept = 0;
        if (loops_.size() == 1)
            for (std::size_t p = 1; p < parts_.size(); ++p)
                if (parts_[p].area > parts_[kept].area) kept = p;
        std::vector<std::size_t> leaves;
        for (std::size_t p = 0; p < parts_.size(); ++p)
            if (parts_[p].open_chords == 1) leaves.push_back(p);
        for (std::size_t head = 0; head < leaves.size(); ++head) {
            Block& leaf = parts_[leaves[head]];
            if (leaf.open_chords != 1 || (loops_.size() == 1 && leaves[head] == kept)) continue;
            for (const Index h : leaf.chords) {
                Block& next = parts_[part_of_[face_of(surface_.twin[h])]];
                if (next.peeled) continue;
                if (joined(leaf.loop, loop_of_[origin(surface_.triangles, h)]) == several_loops) break;
                leaf.peeled = true;
                next.loop = joined(next.loop, leaf.loop);
                if (--next.open_chords == 1) leaves.push_back(static_cast<std::size_t>(&next - parts_.data()));
                break;
            }
        }
    }

    /// @param hinge a half-edge of the core, so that the core's loop runs along it
    Ear ear_behind(Index hinge) const
    {
        Ear ear;
        ear.first = origin(surface_.triangles, hinge);
        ear.last = target(surface_.triangles, hinge);
        ear.loop = loop_of_[ear.first];
        const VertexLoop& loop = loops_[ear.loop];
        for (std::size_t i = place_[ear.first] + 1; loop[i % loop.size()] != ear.last; ++i)
            ear.rim.push_back(loop[i % loop.size()]);

        // All blocks behind the hinge, over the chords between them.
        std::vector<Index> reached{part_of_[face_of(surface_.twin[hinge])]};
        std::vector<Index> from{surface_.twin[hinge]};
        for (std::size_t head = 0; head < reached.size(); ++head) {
            const Block& part = parts_[reached[head]];
            const Index entered_by = from[head];
            ear.faces.insert(ear.faces.end(), part.faces.begin(), part.faces.end());
            for (const Index h : part.chords)
                if (h != entered_by) {
                    reached.push_back(part_of_[face_of(surface_.twin[h])]);
                    from.push_back(surface_.twin[h]);
                }
        }
        std::sort(ear.faces.begin(), ear.faces.end());
        for (const Index f : ear.faces)
            for (int k = 0; k < 3; ++k)
                if (const Index v = surface_.triangles(f, k); loop_of_[v] == no_loop) ear.interior.push_back(v);
        sort_unique(ear.interior);
        return ear;
    }

    const Surface& surface_;
    const std::vector<VertexLoop>& loops_;
    std::vector<int> loop_of_;
    std::vector<Index> place_;    // place of each vertex in its loop
    std::vector<Index> part_of_;  // per face
    std::vector<Block> parts_;
    bool any_chord_ = false;
};

}  // namespace

EarCut cut_ears(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops)
{
    EarCut cut;
    cut.ears = EarCutter(vertices, surface, loops).ears();
    if (cut.ears.empty()) return cut;

    std::vector<char> cut_face(surface.triangles.rows(), 0);
    std::vector<Index> rank(surface.vertex_count, 0);
    for (const Ear& ear : cut.ears) {
        for (const Index f : ear.faces) cut_face[f] = 1;
        for (const Index v : ear.rim) rank[v] = -1;
        for (const Index v : ear.interior) rank[v] = -1;
    }
    for (Index v = 0; v < surface.vertex_count; ++v)
        if (rank[v] == 0) {
            rank[v] = static_cast<Index>(cut.vertices.size());
            cut.vertices.push_back(v);
        }
    for (const VertexLoop& loop : loops) {
        cut.loops.emplace_back();
        for (const Index v : loop)
            if (rank[v] >= 0) cut.loops.back().push_back(rank[v]);
    }
    // An ear is a disk that one edge joins to the rest. Without it the surface stays manifold, oriented and of the same
    // genus.
    std::vector<Index> face_rank(surface.triangles.rows(), -1);
    Index faces = 0;
    for (std::size_t f = 0; f < cut_face.size(); ++f)
        if (!cut_face[f]) face_rank[f] = faces++;
    Surface& core = cut.core;
    core.triangles.resize(faces, 3);
    core.twin.assign(3 * static_cast<std::size_t>(faces), no_twin);
    core.vertex_count = static_cast<Index>(cut.vertices.size());
    core.loops = cut.loops;
    core.euler_characteristic = surface.euler_characteristic;
    core.genus = surface.genus;
    for (Index h = 0; h < static_cast<Index>(surface.triangles.size()); ++h) {
        const Index f = face_rank[face_of(h)];
        if (f < 0) continue;
        core.triangles(f, h % 3) = rank[origin(surface.triangles, h)];
        const Index twin = surface.twin[h];
        if (twin != no_twin && face_rank[face_of(twin)] >= 0)
            core.twin[3 * f + h % 3] = 3 * face_rank[face_of(twin)] + twin % 3;
    }
    return cut;
}

}  // namespace koebe
