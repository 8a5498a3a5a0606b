// Meshes that are no bordered surfaces of genus 0: closed, with handles, one-sided, broken at random.
#pragma once

#include "core/types.h"

#include <cstdint>
#include <random>
#include <string>

namespace koebe::test {

struct NamedMesh {
    std::string name;
    Vertices vertices;
    Triangles triangles;
};

/// The surface of a plate of cubes with so many square holes through it: closed, of that genus.
NamedMesh plate_with_holes(int holes, int refined = 1);
/// A torus of m x n cells; its tube is as thick as told, the ring's radius being 1.
NamedMesh coarse_torus(Index m, Index n, double thick);
NamedMesh coarse_sphere(Index rings, Index sectors);
NamedMesh moebius_band(Index cells, Index width);
/// Closed and one-sided, m x n cells; it passes through itself in space, but not in its numbers.
NamedMesh klein_bottle(Index m, Index n);
/// Cubes kept at random; their common surface, which has edges of four faces and vertices where corners touch.
NamedMesh random_cubes(int side, double share, std::mt19937& random);
/// Faces of any three vertices.
NamedMesh random_soup(Index vertices, Index faces, std::mt19937& random);
/// Faces taken out, doubled, turned, collapsed; vertices glued to others.
NamedMesh damaged(NamedMesh mesh, std::mt19937& random);
/// Two meshes in one, their faces in turn.
NamedMesh together(const NamedMesh& a, const NamedMesh& b);
/// One of all those above.
NamedMesh random_mesh(std::uint32_t seed);

}  // namespace koebe::test
