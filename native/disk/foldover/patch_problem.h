// Poses a part of a map as a foldover-free problem.
#pragma once

#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "foldover/tangled_map.h"

#include <algorithm>
#include <vector>

namespace koebe {

struct PatchProblem {
    FoldoverProblem problem;
    std::vector<Index> vertices;  ///< of the surface, ascending: the first rows of problem.points

    /// Row of a vertex in problem.points; -1 outside the patch.
    Index row(Index vertex) const
    {
        const auto found = std::lower_bound(vertices.begin(), vertices.end(), vertex);
        return found == vertices.end() || *found != vertex ? -1 : static_cast<Index>(found - vertices.begin());
    }
    bool moves(std::size_t row) const { return problem.mobility[row] != FoldoverProblem::Mobility::held; }
};

/// Takes some faces of the surface with wanted shapes. Vertices on the edge of the patch are held, vertices on circles
/// slide. Every determinant has a floor: the part that a face can lose by rounding to 32 bits. For a face that is
/// upright as stored the floor is at most half of its present determinant. Otherwise thin faces far from the flips
/// would keep the minimizer busy.
/// @param faces of the surface, ascending
PatchProblem patch_problem(const TangledMap& map, const std::vector<Index>& faces, PatchShape shape,
                           PatchBoundary boundary);

}  // namespace koebe
