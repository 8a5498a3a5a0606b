#include "circle_domain.h"
#include "core/errors.h"
#include "linear/sparse_cholesky.h"
#include "surface/laplacian.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

struct LaplacianSample : LiftedDomain {
    LaplacianSample() : LiftedDomain(2000, Lift::enneper) {}
    SparseMatrix laplacian(const Vertices& v) const
    {
        return cotan_laplacian(domain.triangles, half_cotangents(edge_lengths(v, domain.triangles)),
                               static_cast<Index>(v.rows()));
    }
};

}  // namespace

TEST(Laplacian, is_symmetric_semidefinite_and_kills_constants)
{
    const LaplacianSample sample;
    const SparseMatrix k = sample.laplacian(sample.vertices);
    EXPECT_LT((SparseMatrix(k.transpose()) - k).norm(), 1e-14 * k.norm());
    EXPECT_LT((k * VectorXd::Ones(k.cols())).cwiseAbs().maxCoeff(), 1e-12);
    for (int trial = 0; trial < 5; ++trial) {
        const VectorXd u = VectorXd::Random(k.cols());
        EXPECT_GT(u.dot(k * u), 0.0);
    }
}

TEST(Laplacian, a_plane_has_the_energy_of_its_linear_functions)
{
    // |grad (2x - y)|^2 = 5 and linear functions are exact: u' K u = 5 area.
    const LaplacianSample sample;
    const SparseMatrix k = sample.laplacian(lift(sample.domain.points, Lift::plane));
    const VectorXd u = 2.0 * sample.domain.points.real() - sample.domain.points.imag();
    double area = 0.0;
    for (Eigen::Index f = 0; f < sample.domain.triangles.rows(); ++f) {
        const Complex a = sample.domain.points[sample.domain.triangles(f, 0)];
        const Complex b = sample.domain.points[sample.domain.triangles(f, 1)] - a;
        const Complex c = sample.domain.points[sample.domain.triangles(f, 2)] - a;
        area += 0.5 * (std::conj(b) * c).imag();
    }
    EXPECT_NEAR(u.dot(k * u), 5.0 * area, 1e-11);
    EXPECT_NEAR(vertex_areas(sample.domain.triangles,
                             edge_lengths(lift(sample.domain.points, Lift::plane), sample.domain.triangles),
                             static_cast<Index>(u.size()))
                    .sum(),
                area, 1e-12);
}

TEST(Laplacian, does_not_depend_on_the_unit)
{
    const LaplacianSample sample;
    const SparseMatrix k = sample.laplacian(sample.vertices);
    for (const double scale : {1e-8, 1e8}) {
        const SparseMatrix scaled = sample.laplacian(scale * sample.vertices);
        EXPECT_LT((scaled - k).norm(), 1e-12 * k.norm()) << scale;
    }
}

TEST(Laplacian, weights_of_a_degenerate_face_are_finite)
{
    EdgeLengths lengths(2, 3);
    lengths << 1.0, 1.0, 2.0, 1.0, 1.0, 0.0;
    EXPECT_TRUE(half_cotangents(lengths).allFinite());
}

TEST(DirichletSolver, reproduces_linear_functions_of_a_plane)
{
    const LaplacianSample sample;
    const Vertices plane = lift(sample.domain.points, Lift::plane);
    std::vector<char> fixed(plane.rows(), 0);
    for (const VertexLoop& loop : sample.domain.loops)
        for (const Index v : loop) fixed[v] = 1;
    const DirichletSolver solver(sample.laplacian(plane), fixed);
    const MatrixXd solution = solver.solve(plane.leftCols<2>());
    EXPECT_LT((solution - plane.leftCols<2>()).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(Laplacian, places_filled_anew_give_that_of_other_positions)
{
    const LaplacianSample sample;
    SparseMatrix k = sample.laplacian(sample.vertices);
    const LaplacianPlaces places(sample.domain.triangles, k);
    for (const Lift kind : {Lift::sphere, Lift::polynomial}) {
        const Vertices there = lift(sample.domain.points, kind);
        places.fill(half_cotangents(edge_lengths(there, sample.domain.triangles)), k);
        const SparseMatrix expected = sample.laplacian(there);
        ASSERT_EQ(k.nonZeros(), expected.nonZeros());
        EXPECT_LT((k - expected).norm(), 1e-14 * expected.norm());
        EXPECT_EQ(SparseMatrix(k.transpose()).toDense(), k.toDense());
    }
}

TEST(SparseCholesky, refuses_an_indefinite_matrix)
{
    SparseMatrix matrix(2, 2);
    matrix.insert(0, 0) = 1.0;
    matrix.insert(1, 1) = -1.0;
    EXPECT_THROW(SparseCholesky{matrix}, SolverError);
}
