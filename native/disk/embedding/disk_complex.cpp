#include "embedding/disk_complex.h"

#include <algorithm>

namespace koebe {

DiskComplex::DiskComplex(const Triangles& triangles, Index vertex_count, const std::vector<Index>& outer)
    : outer_(vertex_count, 0),
      around_(vertex_count),
      next_(vertex_count, -1),
      next_face_(vertex_count, -1),
      marked_(vertex_count, 0)
{
    for (const Index v : outer) outer_[v] = 1;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        faces_.push_back({triangles(f, 0), triangles(f, 1), triangles(f, 2)});
        weights_.push_back(1.0);
        alive_.push_back(0);
        add(static_cast<Index>(f));
    }
}

Triangles DiskComplex::triangles() const
{
    Triangles result(std::count(alive_.begin(), alive_.end(), 1), 3);
    Eigen::Index row = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f)
        if (alive_[f]) result.row(row++) << faces_[f][0], faces_[f][1], faces_[f][2];
    return result;
}

DiskComplex::Face DiskComplex::seen_from(Index vertex, Index f) const
{
    const Face& face = faces_[f];
    const int k = face[0] == vertex ? 0 : face[1] == vertex ? 1 : 2;
    return {face[k], face[(k + 1) % 3], face[(k + 2) % 3]};
}

void DiskComplex::link(Index vertex, std::vector<Index>& neighbours, std::vector<Index>& faces) const
{
    neighbours.clear();
    faces.clear();
    for (const Index f : around_[vertex]) {
        const Face face = seen_from(vertex, f);
        next_[face[1]] = face[2];
        next_face_[face[1]] = f;
    }
    const Index first = seen_from(vertex, around_[vertex].front())[1];
    Index v = first;
    do {
        neighbours.push_back(v);
        faces.push_back(next_face_[v]);
        v = next_[v];
    } while (v != first);
}

/// The neighbour to slide into, by its place in the link: of the possible ones the one with fewest faces. -1 without
/// any.
Index DiskComplex::heir(const std::vector<Index>& link, const std::vector<Index>& faces, bool chords,
                        const std::function<bool(const Face&, double)>& wrong)
{
    const std::size_t n = link.size();
    Index best = -1;
    std::size_t least = 0, fewest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Index u = link[i];
        std::size_t wrong_faces = 0;  // of those that take the place of the star
        for (std::size_t k = 1; wrong && k + 1 < n; ++k) {
            double weight = weights_[faces[(i + k) % n]];
            if (k == 1) weight += weights_[faces[i]];
            if (k + 2 == n) weight += weights_[faces[(i + n - 1) % n]];
            wrong_faces += wrong({u, link[(i + k) % n], link[(i + k + 1) % n]}, weight);
        }
        if (best >= 0 && std::pair(wrong_faces, around_[u].size()) >= std::pair(fewest, least)) continue;
        for (const Index f : around_[u])
            for (const Index w : faces_[f]) marked_[w] = 1;
        bool free = true;  // the link condition: u has no other neighbour in the link
        for (std::size_t k = 2; k + 1 < n && free; ++k) {
            const Index w = link[(i + k) % n];
            free = !marked_[w] && (chords || !outer_[u] || !outer_[w]);
        }
        for (const Index f : around_[u])
            for (const Index w : faces_[f]) marked_[w] = 0;
        if (!free) continue;
        best = static_cast<Index>(i);
        least = around_[u].size();
        fewest = wrong_faces;
    }
    return best;
}

bool DiskComplex::take_out(Index vertex, bool chords, const std::function<bool(const Face&, double)>& wrong)
{
    Removal removal{vertex, {}, face_count()};
    std::vector<Index> neighbours;
    link(vertex, neighbours, removal.old_faces);
    const Index i = heir(neighbours, removal.old_faces, chords, wrong);
    if (i < 0) return false;
    const std::size_t n = neighbours.size();
    std::rotate(neighbours.begin(), neighbours.begin() + i, neighbours.end());
    std::rotate(removal.old_faces.begin(), removal.old_faces.begin() + i, removal.old_faces.end());
    for (const Index f : removal.old_faces) drop(f);
    for (std::size_t k = 1; k + 1 < n; ++k) {
        faces_.push_back({neighbours[0], neighbours[k], neighbours[k + 1]});
        double weight = weights_[removal.old_faces[k]];
        if (k == 1) weight += weights_[removal.old_faces[0]];
        if (k + 2 == n) weight += weights_[removal.old_faces[n - 1]];
        weights_.push_back(weight);
        alive_.push_back(0);
        add(face_count() - 1);
    }
    removals_.push_back(std::move(removal));
    return true;
}

Index DiskComplex::put_back()
{
    const Removal removal = std::move(removals_.back());
    removals_.pop_back();
    for (Index f = face_count() - 1; f >= removal.first_new; --f) drop(f);
    faces_.resize(removal.first_new);
    weights_.resize(removal.first_new);
    alive_.resize(removal.first_new);
    for (const Index f : removal.old_faces) add(f);
    return removal.vertex;
}

void DiskComplex::add(Index f)
{
    alive_[f] = 1;
    for (const Index v : faces_[f]) around_[v].push_back(f);
}

void DiskComplex::drop(Index f)
{
    alive_[f] = 0;
    for (const Index v : faces_[f]) {
        auto& list = around_[v];
        list.erase(std::find(list.begin(), list.end(), f));
    }
}

}  // namespace koebe
