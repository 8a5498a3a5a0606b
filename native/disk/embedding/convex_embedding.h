// A one-to-one map of any surface of genus 0 with boundary: convex combinations (Tutte 1963), safe in floating point.
#pragma once

#include "execution/execution.h"
#include "mesh/topology.h"

#include <optional>
#include <vector>

namespace koebe {

/// The surface with every inner hole filled by a fan of triangles round a new vertex: a disk.
struct FilledDisk {
    Triangles triangles;     ///< the surface's faces first
    Index surface_vertices;  ///< the fans' centres follow these, one for each inner loop
    Index vertex_count;
};

/// @param loops the outer loop first; it stays open
FilledDisk fill_with_fans(const Surface& surface, const std::vector<VertexLoop>& loops);

/// Puts the outer loop on the unit circle, and every other vertex at the mean of its neighbours. In exact arithmetic
/// every triangle keeps its orientation (Floater 2003, theorem 6: the boundary is strictly convex). But faces deep
/// inside, as in stacked triangles or at the end of a limb, become exponentially small, and can fall below the
/// precision of numbers.
///
/// So if faces are turned over or too small, inner vertices around them are taken out (disk_complex.h) until all other
/// faces are right. Then the vertices are put back one after another, as in the proof of Fary's theorem (Fary 1948) and
/// in progressive embedding (Shen, Jiang, Zorin and Panozzo 2019). Each vertex goes into the kernel of the polygon of
/// its neighbours, where every face gets an area in proportion to the number of faces it stands for (star_centre.h);
/// the neighbours then follow. Schnyder (1990) draws any triangulation on a grid of its size in this way. Faces are
/// then about equally large.
/// @param rim (n) points of the outer loop on the unit circle, in order, all different
/// @return (filled.vertex_count, 2)
PlanarPoints convex_embedding(const FilledDisk& filled, const VertexLoop& outer, const VectorXcd& rim,
                              const ExecutionContext& context);

/// A drawing of the disk, and the vertices that are not where they were.
struct MendedDrawing {
    PlanarPoints points;          ///< (filled.vertex_count, 2)
    std::vector<Index> replaced;  ///< ascending
};

/// Makes a drawing right that is wrong in few places: takes out inner vertices around wrong faces, ring after ring,
/// until all faces are right, and puts them back as convex_embedding does. All other vertices stay.
/// @param points (filled.vertex_count, 2), the outer loop on the unit circle
/// @param wrong (filled.triangles) 1 for faces that are to become right
/// @return nothing if faces stay wrong
std::optional<MendedDrawing> mend_drawing(const FilledDisk& filled, const VertexLoop& outer, PlanarPoints points,
                                          std::vector<char> wrong, const ExecutionContext& context);

}  // namespace koebe
