#include "schottky/linear_fractional.h"

#include "core/errors.h"

#include <Eigen/SVD>

#include <cmath>

namespace koebe {
namespace {

constexpr int fit_rounds = 4;

/// z -> (z - center) / size of a set of points: fits are made in frames where both sets are near the unit circle.
struct Frame {
    Complex center;
    double size;

    explicit Frame(const VectorXcd& points)
        : center(points.mean()), size(std::sqrt((points.array() - center).abs2().mean()))
    {
        if (!(size > 0.0) || !std::isfinite(size)) throw SolverError("the two sides of a handle's cut do not fit");
    }
    VectorXcd operator()(const VectorXcd& points) const { return (points.array() - center) / size; }
};

Complex large_eigenvalue(const LinearFractional& map)
{
    const Complex half = 0.5 * (map.a + map.d), root = std::sqrt(half * half - 1.0);
    return std::abs(half + root) >= std::abs(half - root) ? half + root : half - root;
}

}  // namespace

LinearFractional linear_fractional(Complex a, Complex b, Complex c, Complex d)
{
    const Complex root = std::sqrt(a * d - b * c);
    if (!(std::abs(root) > 0.0) || !std::isfinite(std::abs(root)))
        throw SolverError("the two sides of a handle's cut do not fit");
    return {a / root, b / root, c / root, d / root};
}

VectorXcd LinearFractional::operator()(const VectorXcd& z) const
{
    VectorXcd result(z.size());
    for (Eigen::Index i = 0; i < z.size(); ++i) result[i] = (*this)(z[i]);
    return result;
}

/// The pole's mirror image in the circle goes to the new center.
Circle LinearFractional::operator()(const Circle& circle) const
{
    Complex center = (*this)(circle.center);
    if (std::abs(c) > 0.0) {
        const Complex to_pole = -d / c - circle.center;
        if (std::abs(to_pole) > 0.0)
            center = (*this)(circle.center + circle.radius * circle.radius / std::conj(to_pole));
        else
            center = a / c;
    }
    return {center, std::abs((*this)(circle.center + circle.radius) - center)};
}

LinearFractional LinearFractional::operator*(const LinearFractional& first) const
{
    return {a * first.a + b * first.c, a * first.b + b * first.d, c * first.a + d * first.c, c * first.b + d * first.d};
}

Circle LinearFractional::isometric_circle() const { return {-d / c, 1.0 / std::abs(c)}; }

/// The eigenvector of the larger eigenvalue, computed from the row that is farther from 0.
std::array<Complex, 2> LinearFractional::attracting() const
{
    const Complex value = large_eigenvalue(*this);
    const std::array<Complex, 2> first{b, value - a}, second{value - d, c};
    return std::norm(first[0]) + std::norm(first[1]) > std::norm(second[0]) + std::norm(second[1]) ? first : second;
}

Complex LinearFractional::multiplier() const
{
    const Complex large = large_eigenvalue(*this);
    return 1.0 / (large * large);
}

LinearFractional fitted_map(const VectorXcd& from, const VectorXcd& to)
{
    const Frame source(from), goal(to);
    const VectorXcd x = source(from), y = goal(to);
    VectorXd weights = VectorXd::Ones(x.size());
    LinearFractional map;
    for (int round = 0; round < fit_rounds; ++round) {
        Eigen::MatrixXcd rows(x.size(), 4);  // a x + b - y (c x + d), over |c x + d| of the round before
        rows << x, VectorXcd::Ones(x.size()), -(x.array() * y.array()).matrix(), -y;
        rows = weights.asDiagonal() * rows;
        const Eigen::JacobiSVD<Eigen::MatrixXcd, Eigen::HouseholderQRPreconditioner> svd(rows, Eigen::ComputeThinU |
                                                                                                   Eigen::ComputeThinV);
        const Eigen::VectorXcd v = svd.matrixV().col(3);
        if (!v.allFinite()) throw SolverError("the two sides of a handle's cut do not fit");
        map = linear_fractional(v[0], v[1], v[2], v[3]);
        for (Eigen::Index i = 0; i < x.size(); ++i) weights[i] = 1.0 / std::max(1e-6, std::abs(map.c * x[i] + map.d));
    }
    const LinearFractional in = linear_fractional(1.0, -source.center, 0.0, source.size);
    const LinearFractional out = linear_fractional(goal.size, goal.center, 0.0, 1.0);
    return out * map * in;
}

}  // namespace koebe
