// Landmarks as vertices that are held: what excludes each other is told.
#pragma once

#include "circles/circle.h"
#include "pipeline/result.h"
#include "transfer/cut_mesh.h"

#include <string>
#include <vector>

namespace koebe {

/// A vertex that goes from one place of the plane to another.
struct Pin {
    Index vertex = 0;
    Index landmark = 0;  ///< its number
    int loop = -1;       ///< on whose rim it lies
    Complex begin, end;
};

/// @param mesh cut at the landmarks @param loops of the mesh before the cut @param circles theirs
/// @param start (V + added, 2) @param places (n) where the landmarks shall lie
/// @return one for each vertex
/// @throws InputError landmarks at one point that have two places, or two points with one place; on a rim's edge
///         between vertices; on a rim with a place beside its circle, or the other way round (landmarks listed)
std::vector<Pin> landmark_pins(const CutMesh& mesh, const Triangles& triangles, const std::vector<LoopReport>& loops,
                               const std::vector<Circle>& circles, const PlanarPoints& start, const VectorXcd& places);

/// "landmark 3", "landmarks 1, 2": the first five.
std::string landmark_numbers(const std::vector<Index>& landmarks);

}  // namespace koebe
