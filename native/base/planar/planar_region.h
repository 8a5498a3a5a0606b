// CGAL's constrained Delaunay triangulation of a planar region. For the .cpp files of this folder only.
#pragma once

#include "core/types.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <vector>

namespace koebe::detail {

/// What refinement knows of a face.
struct FaceNote {
    char state = 0;       ///< not 0 inside the region
    double wanted = 0.0;  ///< edge length at its centroid,
    double there = 0.0;   ///< and at its circumcentre
};

/// Vertices hold their index. Predicates are exact.
class PlanarRegion {
public:
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
    using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceNote, Kernel,
                                                               CGAL::Constrained_triangulation_face_base_2<Kernel>>;
    using Cdt =
        CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                                   CGAL::No_constraint_intersection_tag>;

    /// @param polygons the boundary; vertices are numbered in their order
    /// @param interior further vertices, numbered after them
    /// @throws InputError polygons cross, touch, or have coinciding points (elements: points)
    PlanarRegion(const std::vector<VectorXcd>& polygons, const std::vector<Complex>& interior);

    Cdt& cdt() { return cdt_; }
    const Cdt& cdt() const { return cdt_; }
    bool inside(Cdt::Face_handle face) const { return !cdt_.is_infinite(face) && face->info().state != 0; }

private:
    void constrain(const std::vector<VectorXcd>& polygons, const std::vector<Cdt::Vertex_handle>& handles);
    /// Goes from the infinite face inwards; each constrained edge changes sides.
    void mark_inside();

    Cdt cdt_;
};

/// Orders points in rows of cells, to and fro, so that the walk from each to the next is short. CGAL's own order
/// (spatial_sort) differs between C++ libraries. Four points on a circle may be joined in two ways, so the mesh would
/// depend on the library.
std::vector<std::size_t> to_and_fro(const std::vector<Complex>& points);

inline Complex to_complex(const PlanarRegion::Cdt::Point& p) { return {p.x(), p.y()}; }
inline PlanarRegion::Cdt::Point to_point(Complex z) { return {z.real(), z.imag()}; }

}  // namespace koebe::detail
