#include "lift/sphere_sheets.h"

#include "core/connectivity.h"
#include "mesh/connected_pieces.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace {

using namespace koebe;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Numbered = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>>;

/// Random points of the sphere without a cap round the south pole, and faces between them.
std::pair<Vertices, Triangles> open_sphere(unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-2.5, 2.5);
    CGAL::Delaunay_triangulation_2<Kernel, Numbered> delaunay;
    Vertices points(1000, 3);
    for (Index v = 0; v < 1000; ++v) {
        const Complex w(place(random), place(random));
        points.row(v) = on_sphere(w).transpose();
        delaunay.insert(Kernel::Point_2(w.real(), w.imag()))->info() = v;
    }
    Triangles triangles(static_cast<Eigen::Index>(delaunay.number_of_faces()), 3);
    Eigen::Index f = 0;
    for (const auto& face : delaunay.finite_face_handles()) {
        for (int k = 0; k < 3; ++k) triangles(f, k) = face->vertex(k)->info();
        ++f;
    }
    return {points, triangles};
}

TEST(SphereSheets, EachHalfIsOnePiece)
{
    int small_parts = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto [points, triangles] = open_sphere(seed);
        const SphereSheets sheets = sphere_sheets(points, triangles, points, {});
        const std::vector<Index> twin = pair_halfedges(triangles, static_cast<Index>(points.rows()));
        std::vector<int> south, low;
        for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
            south.push_back(sheets.in_south(f) ? 1 : 0);
            low.push_back(points(triangles.row(f).transpose(), 2).sum() < 0.0 ? 1 : 0);
        }
        Index halves = 0, sides = 0;
        connected_pieces(twin, south, halves);
        connected_pieces(twin, low, sides);
        EXPECT_EQ(halves, 2) << "seed " << seed;
        small_parts += sides > halves ? 1 : 0;
    }
    EXPECT_GT(small_parts, 10) << "the middles alone leave small pieces";
}

}  // namespace
