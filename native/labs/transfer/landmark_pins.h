// Makes landmarks held vertices, and refuses landmarks that exclude each other.
#pragma once

#include "circles/circle.h"
#include "pipeline/result.h"
#include "transfer/cut_mesh.h"

#include <string>
#include <vector>

namespace koebe {

/// A vertex that moves from one place of the plane to another.
struct Pin {
    Index vertex = 0;
    Index landmark = 0;  ///< its number
    int loop = -1;       ///< the loop whose rim it lies on, or -1
    Complex begin, end;
};

/// @param mesh cut at the landmarks @param loops of the mesh before the cut @param circles of these loops
/// @param start (V + added, 2) @param places (n) wanted places of the landmarks
/// @return one pin for each vertex
/// @throws InputError landmarks at one point with two places, or at two points with one place; on a rim's edge between
/// vertices; on a rim with a place off its circle, or off a rim with a place on it (landmarks listed)
std::vector<Pin> landmark_pins(const CutMesh& mesh, const Triangles& triangles, const std::vector<LoopReport>& loops,
                               const std::vector<Circle>& circles, const PlanarPoints& start, const VectorXcd& places);

/// Returns "landmark 3", "landmarks 1, 2": the first five.
std::string landmark_numbers(const std::vector<Index>& landmarks);

}  // namespace koebe
