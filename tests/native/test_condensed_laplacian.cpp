#include "circle_domain.h"
#include "linear/condensed_laplacian.h"
#include "linear/filled_laplacian.h"
#include "surface/laplacian.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

struct CondensedSample {
    explicit CondensedSample(Index face_count = 3000)
        : domain(make_circle_domain(five_circles(), face_count)),
          plane(lift(domain.points, Lift::plane)),
          laplacian(cotan_laplacian(domain.triangles, half_cotangents(edge_lengths(plane, domain.triangles)),
                                    static_cast<Index>(plane.rows())))
    {
        for (const VertexLoop& loop : domain.loops) boundary.insert(boundary.end(), loop.begin(), loop.end());
    }
    CircleDomain domain;
    Vertices plane;
    SparseMatrix laplacian;
    std::vector<Index> boundary;
};

}  // namespace

TEST(CondensedLaplacian, sigma_is_the_schur_complement)
{
    const CondensedSample sample(600);
    CondensedLaplacian condensed(sample.laplacian, sample.boundary);
    std::vector<char> on_boundary(sample.plane.rows(), 0);
    for (const Index v : sample.boundary) on_boundary[v] = 1;
    std::vector<Index> inside;
    for (Index v = 0; v < sample.plane.rows(); ++v)
        if (!on_boundary[v]) inside.push_back(v);
    const MatrixXd k = sample.laplacian;
    const MatrixXd schur = k(sample.boundary, sample.boundary) -
                           k(sample.boundary, inside) * k(inside, inside).llt().solve(k(inside, sample.boundary));
    EXPECT_LT((condensed.sigma() - schur).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(CondensedLaplacian, extension_of_linear_boundary_values_is_linear)
{
    const CondensedSample sample;
    CondensedLaplacian condensed(sample.laplacian, sample.boundary);
    const MatrixXd linear = sample.plane.leftCols<2>();
    const MatrixXd values = linear(sample.boundary, Eigen::all);
    EXPECT_LT((condensed.extend(values) - linear).cwiseAbs().maxCoeff(), 1e-11);
    // The flux of a linear function through its nodes: u' Sigma u is its energy over the domain.
    const MatrixXd energy = values.transpose() * condensed.sigma() * values;
    const MatrixXd expected = linear.transpose() * (sample.laplacian * linear);
    EXPECT_LT((energy - expected).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(CondensedLaplacian, what_a_source_gives_arrives_at_the_boundary)
{
    const CondensedSample sample;
    CondensedLaplacian condensed(sample.laplacian, sample.boundary);
    VectorXd load = VectorXd::Random(sample.plane.rows());
    for (const Index v : sample.boundary) load[v] = 0.0;
    const InteriorSolution solution = condensed.solve_interior(load);
    const VectorXd residual = sample.laplacian * solution.values - load;
    VectorXd inside = residual;
    for (const Index v : sample.boundary) inside[v] = 0.0;
    EXPECT_LT(inside.cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_NEAR(solution.boundary_flux.sum(), load.sum(), 1e-9);
    for (std::size_t i = 0; i < sample.boundary.size(); ++i)
        ASSERT_NEAR(solution.boundary_flux[i], -residual[sample.boundary[i]], 1e-10);
}

TEST(FilledLaplacian, has_the_disks_and_without_them_what_every_other_has)
{
    const CondensedSample sample;
    CondensedLaplacian with_sigma(sample.laplacian, sample.boundary);
    FilledLaplacian filled(sample.laplacian, sample.domain.loops);
    EXPECT_EQ(filled.boundary_size(), with_sigma.boundary_size());
    const MatrixXd values = MatrixXd::Random(filled.boundary_size(), 2);
    const VectorXd load = VectorXd::Random(sample.plane.rows());
    for (const double scale : {1.0, 30.0}) {
        SparseMatrix with_disks = sample.laplacian;
        std::vector<LoopDisk> disks;
        for (std::size_t k = 1; k < sample.domain.loops.size(); ++k) {
            const VertexLoop& loop = sample.domain.loops[k];
            const VectorXd x = VectorXd::Random(static_cast<Eigen::Index>(loop.size()));
            disks.push_back({scale * x * x.transpose(), {}});
            for (std::size_t i = 0; i < loop.size(); ++i)
                for (std::size_t j = 0; j < loop.size(); ++j)
                    with_disks.coeffRef(loop[i], loop[j]) += disks.back().stiffness(i, j);
        }
        VectorXd grounded = load;
        for (const Index v : sample.domain.loops[0]) grounded[v] = 0.0;
        VectorXd residual = with_disks * filled.fill(disks).solve(grounded) - load;
        for (const Index v : sample.domain.loops[0]) residual[v] = 0.0;
        EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-10);

        EXPECT_LT((filled.extend(values) - with_sigma.extend(values)).cwiseAbs().maxCoeff(), 1e-12);
        const InteriorSolution one = filled.solve_interior(load), other = with_sigma.solve_interior(load);
        EXPECT_LT((one.values - other.values).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT((one.boundary_flux - other.boundary_flux).cwiseAbs().maxCoeff(), 1e-11);
    }
}

TEST(FilledLaplacian, an_interior_that_is_not_positive_definite_gives_no_number)
{
    // The loops are 0, 1 and 7; 2 to 6 are inside, 2 beside all loops. 7, with one neighbour, is eliminated before 2.
    std::vector<Eigen::Triplet<double, Index>> entries;
    const auto edge = [&](Index v, Index w) {
        entries.emplace_back(v, w, -1.0);
        entries.emplace_back(w, v, -1.0);
        entries.emplace_back(v, v, 1.0);
        entries.emplace_back(w, w, 1.0);
    };
    for (const Index loop : {0, 1, 7}) edge(2, loop);
    for (Index v = 2; v < 7; ++v)
        for (Index w = v + 1; w < 7; ++w) edge(v, w);
    for (const double added : {0.0, -20.0}) {
        entries.emplace_back(2, 2, added);
        SparseMatrix laplacian(8, 8);
        laplacian.setFromTriplets(entries.begin(), entries.end());
        FilledLaplacian filled(laplacian, {{0}, {1}, {7}});
        const VectorXd values = filled.extend(VectorXd::Ones(3));
        EXPECT_EQ(values.allFinite(), added == 0.0);
    }
}

TEST(CondensedLaplacianOrder, an_interior_in_two_parts_keeps_the_boundary_last)
{
    // Two rows of cells side by side, all vertices of the shared column on the boundary: K_II falls apart.
    const Index n = 9;
    std::vector<Index> corners;
    Vertices vertices(n * 5, 3);
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < 5; ++j) vertices.row(i * 5 + j) << i, j, 0.0;
    for (Index i = 0; i + 1 < n; ++i)
        for (Index j = 0; j + 1 < 5; ++j) {
            const Index a = i * 5 + j, b = a + 5, c = b + 1, d = a + 1;
            corners.insert(corners.end(), {a, b, c, a, c, d});
        }
    const Triangles triangles = Eigen::Map<Triangles>(corners.data(), corners.size() / 3, 3);
    const SparseMatrix laplacian =
        cotan_laplacian(triangles, half_cotangents(edge_lengths(vertices, triangles)), n * 5);
    std::vector<Index> boundary;
    for (Index v = 0; v < n * 5; ++v)
        if (v / 5 == 0 || v / 5 == n - 1 || v / 5 == n / 2 || v % 5 == 0 || v % 5 == 4) boundary.push_back(v);
    CondensedLaplacian condensed(laplacian, boundary);
    const MatrixXd linear = vertices.leftCols<2>();
    EXPECT_LT((condensed.extend(linear(boundary, Eigen::all)) - linear).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((condensed.sigma() * VectorXd::Ones(boundary.size())).cwiseAbs().maxCoeff(), 1e-12);
}
