#include "circle_domain.h"
#include "core/errors.h"
#include "mesh/halfedge_mesh.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

/// Runs something that must throw a TopologyError of the kind, and print nothing.
template <class Action>
std::vector<Index> elements_of(TopologyKind kind, Action action)
{
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    std::vector<Index> elements;
    bool thrown = false;
    try {
        action();
    } catch (const TopologyError& error) {
        thrown = true;
        EXPECT_EQ(error.kind(), kind) << error.what();
        elements = error.elements();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_TRUE(thrown);
    return elements;
}

Triangles faces(std::initializer_list<std::initializer_list<Index>> rows)
{
    Triangles triangles(static_cast<Eigen::Index>(rows.size()), 3);
    Eigen::Index f = 0;
    for (const auto& row : rows) std::copy(row.begin(), row.end(), triangles.row(f++).begin());
    return triangles;
}

}  // namespace

TEST(HalfedgeMesh, arrays_come_back_as_they_were)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Vertices vertices = lift(domain.points, Lift::enneper);
    const MeshArrays back = to_arrays(to_halfedge_mesh(vertices, domain.triangles));
    EXPECT_EQ(back.vertices, vertices);
    EXPECT_EQ(back.triangles, domain.triangles);
}

TEST(HalfedgeMesh, vertices_of_no_face_and_64_bits_are_kept)
{
    Vertices vertices(4, 3);
    vertices << 0.1, 0.2, 0.3, 1e300, 0, 0, 0, 1e-300, 0, 1.0 / 3.0, 0, 0;
    const MeshArrays back = to_arrays(to_halfedge_mesh(vertices, faces({{0, 3, 2}})));
    EXPECT_EQ(back.vertices, vertices);
    EXPECT_EQ(back.triangles, faces({{0, 3, 2}}));
}

TEST(HalfedgeMesh, a_third_face_on_an_edge_is_refused_without_a_word)
{
    const auto elements = elements_of(TopologyKind::nonmanifold_edge, [] {
        to_halfedge_mesh(Vertices::Random(5, 3), faces({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    });
    EXPECT_EQ(elements, (std::vector<Index>{0, 1}));
}

TEST(HalfedgeMesh, a_face_on_a_closed_vertex_is_refused_without_a_word)
{
    // Vertex 0 is surrounded by three faces; a fourth has no place.
    const auto elements = elements_of(TopologyKind::nonmanifold_vertex, [] {
        to_halfedge_mesh(Vertices::Random(6, 3), faces({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}}));
    });
    EXPECT_EQ(elements, (std::vector<Index>{0}));
}

TEST(HalfedgeMesh, faces_that_name_no_vertex_or_one_twice_are_refused)
{
    EXPECT_THROW(to_halfedge_mesh(Vertices::Random(3, 3), faces({{0, 1, 3}})), InputError);
    EXPECT_THROW(to_halfedge_mesh(Vertices::Random(3, 3), faces({{0, -1, 2}})), InputError);
    EXPECT_THROW(to_halfedge_mesh(Vertices::Random(3, 3), faces({{0, 1, 1}})), InputError);
}
