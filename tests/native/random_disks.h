// Triangulated disks that are hard to draw: stacked, wildly flipped, limbs.
#pragma once

#include "core/types.h"

#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace koebe::test {

using FaceList = std::vector<std::array<Index, 3>>;

inline Triangles as_triangles(const FaceList& faces)
{
    Triangles triangles(faces.size(), 3);
    for (std::size_t f = 0; f < faces.size(); ++f) triangles.row(f) << faces[f][0], faces[f][1], faces[f][2];
    return triangles;
}

/// An Apollonian network: count times, a vertex is put into one of the last `choice` faces (0: of all).
inline FaceList stacked_disk(int count, std::size_t choice, std::mt19937& random)
{
    FaceList faces{{0, 1, 2}};
    for (Index v = 3; v < count + 3; ++v) {
        const std::size_t among = choice == 0 ? faces.size() : std::min(choice, faces.size());
        const std::size_t place = faces.size() - 1 - random() % among;
        const auto [a, b, c] = faces[place];
        faces[place] = {a, b, v};
        faces.push_back({b, c, v});
        faces.push_back({c, a, v});
    }
    return faces;
}

/// Rings of m vertices, each inside the last, and a vertex in the middle: a limb that hangs on its first ring.
inline FaceList limb(Index rings, Index m)
{
    FaceList faces;
    for (Index j = 0; j + 1 < rings; ++j)
        for (Index i = 0; i < m; ++i) {
            const Index a = j * m + i, b = j * m + (i + 1) % m;
            faces.push_back({a, b, b + m});
            faces.push_back({a, b + m, a + m});
        }
    for (Index i = 0; i < m; ++i) faces.push_back({(rings - 1) * m + i, (rings - 1) * m + (i + 1) % m, rings * m});
    return faces;
}

/// Flips random edges, as long as no edge comes twice.
inline FaceList flipped_at_random(FaceList faces, int times, std::mt19937& random)
{
    std::map<std::pair<Index, Index>, std::size_t> face_of;
    const auto enter = [&](std::size_t f) {
        for (int k = 0; k < 3; ++k) face_of[{faces[f][k], faces[f][(k + 1) % 3]}] = f;
    };
    for (std::size_t f = 0; f < faces.size(); ++f) enter(f);
    for (int i = 0; i < times; ++i) {
        const std::size_t f = random() % faces.size();
        const int k = static_cast<int>(random() % 3);
        const Index a = faces[f][k], b = faces[f][(k + 1) % 3], c = faces[f][(k + 2) % 3];
        const auto other = face_of.find({b, a});
        if (other == face_of.end()) continue;
        const std::size_t g = other->second;
        Index d = faces[g][0];
        for (const Index v : faces[g])
            if (v != a && v != b) d = v;
        if (c == d || face_of.contains({c, d}) || face_of.contains({d, c})) continue;
        face_of.erase({a, b});
        face_of.erase({b, a});
        faces[f] = {c, a, d};
        faces[g] = {d, b, c};
        enter(f);
        enter(g);
    }
    return faces;
}

}  // namespace koebe::test
