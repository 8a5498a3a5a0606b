#include "circle_domain.h"
#include "surface/one_form.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

struct FormSample {
    CircleDomain domain = make_circle_domain(five_circles(), 1500);
    Index vertex_count = static_cast<Index>(domain.points.size());
    EdgeLengths weights = half_cotangents(edge_lengths(lift(domain.points, Lift::plane), domain.triangles));
    VectorXd f = domain.points.real().array().sin() + 0.3 * domain.points.imag().array().square();
    VectorXd g = domain.points.imag().array().exp() - domain.points.real().array();

    double area() const
    {
        double sum = 0.0;
        for (Eigen::Index t = 0; t < domain.triangles.rows(); ++t) {
            const Complex a = domain.points[domain.triangles(t, 0)];
            sum += 0.5 * std::imag(std::conj(domain.points[domain.triangles(t, 1)] - a) *
                                   (domain.points[domain.triangles(t, 2)] - a));
        }
        return sum;
    }
};

}  // namespace

TEST(OneForm, derivatives_are_closed)
{
    const FormSample sample;
    EXPECT_LT(circulation(exterior_derivative(sample.domain.triangles, sample.f)).cwiseAbs().maxCoeff(), 1e-15);
    const VectorXd corners = VectorXd::Random(sample.domain.triangles.size());
    EXPECT_LT(circulation(exterior_derivative_of_corners(corners)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(OneForm, a_function_by_corners_has_the_derivative_of_the_function_by_vertices)
{
    const FormSample sample;
    VectorXd corners(sample.domain.triangles.size());
    for (Eigen::Index c = 0; c < corners.size(); ++c) corners[c] = sample.f[sample.domain.triangles.data()[c]];
    EXPECT_EQ(exterior_derivative_of_corners(corners), exterior_derivative(sample.domain.triangles, sample.f));
}

TEST(OneForm, the_divergence_of_a_gradient_is_minus_the_laplacian)
{
    const FormSample sample;
    const OneForm df = exterior_derivative(sample.domain.triangles, sample.f);
    const SparseMatrix k = cotan_laplacian(sample.domain.triangles, sample.weights, sample.vertex_count);
    const VectorXd divergence_of_df = divergence(sample.domain.triangles, sample.weights, df, sample.vertex_count);
    EXPECT_LT((divergence_of_df + k * sample.f).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_NEAR(divergence_of_df.sum(), 0.0, 1e-13);
    EXPECT_NEAR(squared_norm(sample.weights, df), sample.f.dot(k * sample.f), 1e-12);
}

TEST(OneForm, dx_wedge_dy_is_the_area_and_the_wedge_is_antisymmetric)
{
    const FormSample sample;
    const OneForm dx = exterior_derivative(sample.domain.triangles, sample.domain.points.real());
    const OneForm dy = exterior_derivative(sample.domain.triangles, sample.domain.points.imag());
    EXPECT_NEAR(wedge_integral(dx, dy), sample.area(), 1e-13);
    EXPECT_NEAR(wedge_integral(dy, dx), -sample.area(), 1e-13);
    EXPECT_NEAR(wedge_integral(dx, dx), 0.0, 1e-15);
    // The plane's Dirichlet energy: |dx|^2 = area.
    EXPECT_NEAR(squared_norm(sample.weights, dx), sample.area(), 1e-13);
}

TEST(OneForm, the_wedge_of_exact_forms_depends_on_boundary_values_only)
{
    // Stokes: integral df ^ dg = integral over the boundary of f dg.
    const FormSample sample;
    const auto wedge = [&](const VectorXd& f) {
        return wedge_integral(exterior_derivative(sample.domain.triangles, f),
                              exterior_derivative(sample.domain.triangles, sample.g));
    };
    double boundary = 0.0;
    VectorXd changed = sample.f + VectorXd::Random(sample.f.size());
    for (const VertexLoop& loop : sample.domain.loops)
        for (std::size_t b = 0; b < loop.size(); ++b) {
            const Index v = loop[b], w = loop[(b + 1) % loop.size()];
            boundary += 0.5 * (sample.f[v] + sample.f[w]) * (sample.g[w] - sample.g[v]);
            changed[v] = sample.f[v];
        }
    EXPECT_NEAR(wedge(sample.f), boundary, 1e-13);
    EXPECT_NEAR(wedge(changed), boundary, 1e-12);
}
