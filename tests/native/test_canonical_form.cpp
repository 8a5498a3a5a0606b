#include "canonical/canonical_form.h"
#include "canonical/canonical_mesh.h"
#include "circle_domain.h"
#include "pipeline/uniformize.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

struct UnevenMesh {
    Vertices vertices;
    Triangles triangles;
};

UnevenMesh uneven_mesh()
{
    const CircleDomain domain = make_circle_domain(five_circles(), 600);
    return {lift(domain.points, Lift::enneper), domain.triangles};
}

CanonicalForm form_of(const UnevenMesh& mesh)
{
    return canonical_form(analyze_surface(mesh.triangles, static_cast<Index>(mesh.vertices.rows())), mesh.vertices);
}

/// Vertices, faces and the corners of faces in another order. @param name the new vertex of each
UnevenMesh renumbered(const UnevenMesh& mesh, unsigned seed, std::vector<Index>& name)
{
    std::mt19937 random(seed);
    name.resize(mesh.vertices.rows());
    std::iota(name.begin(), name.end(), 0);
    std::shuffle(name.begin(), name.end(), random);
    std::vector<Index> faces(mesh.triangles.rows());
    std::iota(faces.begin(), faces.end(), 0);
    std::shuffle(faces.begin(), faces.end(), random);
    UnevenMesh result = mesh;
    for (std::size_t v = 0; v < name.size(); ++v) result.vertices.row(name[v]) = mesh.vertices.row(v);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
            result.triangles(f, k) = name[mesh.triangles(faces[f], (k + static_cast<int>(f)) % 3)];
    return result;
}

UnevenMesh moved(const UnevenMesh& mesh, double scale)
{
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.234, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
    return {scale * ((mesh.vertices * turn).rowwise() + Eigen::RowVector3d(0.2, 3.0, -1.0)), mesh.triangles};
}

}  // namespace

TEST(CanonicalForm, is_the_same_surface)
{
    const UnevenMesh mesh = uneven_mesh();
    const CanonicalForm form = form_of(mesh);
    ASSERT_EQ(form.surface.triangles.rows(), mesh.triangles.rows());
    for (Eigen::Index f = 0; f < form.surface.triangles.rows(); ++f) {
        const auto original = mesh.triangles.row(form.original_faces[f]);
        const int corner = static_cast<int>(
            std::find(original.begin(), original.end(), form.original_vertices[form.surface.triangles(f, 0)]) -
            original.begin());
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(form.original_vertices[form.surface.triangles(f, k)], original[(corner + k) % 3]);
    }
    const Surface again = analyze_surface(form.surface.triangles, form.surface.vertex_count);
    EXPECT_EQ(form.surface.twin, again.twin);
    EXPECT_EQ(form.surface.loops, again.loops);
    const double scale =
        (form.vertices.row(0) - form.vertices.row(1)).norm() /
        (mesh.vertices.row(form.original_vertices[0]) - mesh.vertices.row(form.original_vertices[1])).norm();
    for (Eigen::Index v = 1; v < form.vertices.rows(); ++v)
        EXPECT_NEAR(
            (form.vertices.row(0) - form.vertices.row(v)).norm(),
            scale *
                (mesh.vertices.row(form.original_vertices[0]) - mesh.vertices.row(form.original_vertices[v])).norm(),
            1e-9);
}

TEST(CanonicalForm, does_not_depend_on_numbers)
{
    const UnevenMesh mesh = uneven_mesh();
    const CanonicalForm expected = form_of(mesh);
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::vector<Index> name;
        const CanonicalForm form = form_of(renumbered(mesh, seed, name));
        EXPECT_EQ(form.surface.triangles, expected.surface.triangles);
        EXPECT_EQ(form.vertices, expected.vertices);
        for (std::size_t v = 0; v < form.original_vertices.size(); ++v)
            EXPECT_EQ(form.original_vertices[v], name[expected.original_vertices[v]]);
    }
}

TEST(CanonicalForm, does_not_depend_on_place_and_size)
{
    const UnevenMesh mesh = uneven_mesh();
    const CanonicalForm expected = form_of(mesh);
    for (const double scale : {1.0, 0.3, 1e8, 1e-8, 1e-150, 1e150}) {
        const CanonicalForm form = form_of(moved(mesh, scale));
        EXPECT_EQ(form.surface.triangles, expected.surface.triangles);
        EXPECT_LT((form.vertices - expected.vertices).cwiseAbs().maxCoeff(), 0x1p-33);
    }
}

TEST(CanonicalForm, the_edges_of_a_regular_rim_are_told_apart_by_what_lies_inside)
{
    // A round annulus with one vertex moved: all rim edges are as long.
    const CircleDomain domain = make_round_annulus(0.4, 24, 5);
    UnevenMesh mesh{lift(domain.points, Lift::plane), domain.triangles};
    mesh.vertices.row(60) *= 1.03;
    const CanonicalForm expected = form_of(mesh);
    for (const unsigned seed : {4u, 5u, 6u}) {
        std::vector<Index> name;
        EXPECT_EQ(form_of(renumbered(mesh, seed, name)).surface.triangles, expected.surface.triangles);
    }
}

TEST(CanonicalMesh, takes_any_mesh_there_and_back_whatever_its_numbers_and_place)
{
    // Two components, one with every third face turned over; a face twice, and one that names a vertex twice.
    const UnevenMesh one = uneven_mesh();
    UnevenMesh both{Vertices(2 * one.vertices.rows(), 3), Triangles(2 * one.triangles.rows() + 2, 3)};
    both.vertices << one.vertices, (0.1 * one.vertices).rowwise() + Eigen::RowVector3d(5.0, 1.0, 0.0);
    both.triangles << one.triangles, one.triangles.array() + static_cast<Index>(one.vertices.rows()),
        one.triangles.row(7), one.triangles.row(8);
    both.triangles(both.triangles.rows() - 1, 2) = both.triangles(both.triangles.rows() - 1, 0);
    for (Eigen::Index f = 0; f < one.triangles.rows(); f += 3) std::swap(both.triangles(f, 1), both.triangles(f, 2));
    const CanonicalMesh expected = canonical_mesh(both.vertices, both.triangles);
    for (Eigen::Index f = 0; f < both.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(expected.original_vertices[expected.triangles(f, (expected.first_corners[f] + k) % 3)],
                      both.triangles(expected.original_faces[f], k));
    for (const unsigned seed : {1u, 2u}) {
        std::vector<Index> name;
        const UnevenMesh other = moved(renumbered(both, seed, name), 1e5);
        const CanonicalMesh mesh = canonical_mesh(other.vertices, other.triangles);
        EXPECT_EQ(mesh.triangles, expected.triangles);
        EXPECT_LT((mesh.vertices - expected.vertices).cwiseAbs().maxCoeff(), 1e-9);
    }
    EXPECT_EQ(canonical_mesh(both.vertices, Triangles::Constant(1, 3, 99999)).triangles(0, 0), 99999);
}

TEST(CanonicalForm, one_point_is_no_surface)
{
    UnevenMesh mesh = uneven_mesh();
    mesh.vertices.setConstant(2.5);
    EXPECT_THROW(form_of(mesh), InputError);
}

TEST(Uniformize, renumbering_turning_and_scaling_change_nothing)
{
    const UnevenMesh mesh = uneven_mesh();
    ExecutionContext context;
    const UniformizeResult expected = uniformize(mesh.vertices, mesh.triangles, {}, context);
    std::vector<Index> name;
    const UnevenMesh other = moved(renumbered(mesh, 7, name), 0.3);
    const UniformizeResult result = uniformize(other.vertices, other.triangles, {}, context);
    EXPECT_LT((result.uv(name, Eigen::all) - expected.uv).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_EQ(*std::min_element(result.loops[0].vertices.begin(), result.loops[0].vertices.end()),
              result.loops[0].vertices.front());
}
