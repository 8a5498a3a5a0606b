#include "certified/circle_capacities.h"

#include "certified/circle_bounds.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace koebe {
namespace {

constexpr int fewest_terms = 12;
constexpr Eigen::Index most_unknowns = 800;
constexpr Eigen::Index samples_per_term = 6;
constexpr double most_stretch = 8.0;
constexpr int tried_stretches = 32;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double unit_roundoff = 0x1p-53;

/// Of the two sides of a condenser that holds all circles, the one without the unit circle.
const std::vector<int>& inner_side(const Condenser& condenser)
{
    return std::ranges::find(condenser.high, 0) == condenser.high.end() ? condenser.high : condenser.low;
}

/// Below it the functions on circle b are analytic in the angle (CirclePart::stretch): no other centre is in the
/// annulus, and no mirror image of a centre.
double largest_stretch(const std::vector<Circle>& circles, int b)
{
    double most = most_stretch;
    for (std::size_t k = 1; k < circles.size(); ++k) {
        const Complex c = circles[k].center;
        if (k != static_cast<std::size_t>(b))
            most = std::min(most, std::abs(circles[b].center - c) / circles[b].radius);
        const double mirror = std::abs(1.0 - std::conj(c) * circles[b].center);
        if (mirror < most * std::abs(c) * circles[b].radius) most = mirror / (std::abs(c) * circles[b].radius);
    }
    return most;
}

}  // namespace

/// Values of the functions on the inner circles, at equal angles.
struct CircleCapacities::Samples {
    Samples(const CircleCapacities& of) : count(of.samples_), matrix(count * of.inner(), of.size())
    {
        for (int b = 1; b <= of.inner(); ++b)
            for (Eigen::Index j = 0; j < count; ++j) {
                const Complex turn = std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(j) / count);
                turns.push_back(turn);
                points.push_back(of.circles_[b].center + of.circles_[b].radius * turn);
                fill(of, b, static_cast<Eigen::Index>(points.size()) - 1);
            }
    }

    /// The derivative of each sample of a potential, coefficients fixed, in a number of the module.
    MatrixXd derivatives(const CircleCapacities& of, const VectorXd& coefficients) const
    {
        MatrixXd all = MatrixXd::Zero(matrix.rows(), of.module_.size());
        for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
            const int b = static_cast<int>(row / count) + 1;
            const Complex z = points[row];
            for (int k = 1; k <= of.inner(); ++k) {
                const Circle& circle = of.circles_[k];
                const double a = coefficients[of.log_of(k)];
                const Complex inverse = k == b ? 0.0 : 1.0 / (z - circle.center);  // w_b is the same at each place
                const Complex mirror_inverse = 1.0 / (1.0 - std::conj(circle.center) * z);
                const Complex w = circle.radius * inverse, v = circle.radius * z * mirror_inverse;
                Complex of_w = 0.0, of_v = 0.0, w_power = 1.0, v_power = 1.0;  // derivatives of the powers' sums
                for (int s = 0; s < of.terms_; ++s, w_power *= w, v_power *= v) {
                    const Eigen::Index i = of.pole_of(k) + 2 * static_cast<Eigen::Index>(s);
                    const Complex pole(coefficients[i], coefficients[i + 1]);
                    of_w += (s + 1.0) * pole * w_power;
                    of_v += (s + 1.0) * std::conj(pole) * v_power;
                }
                for (Eigen::Index l = 0; l < of.module_.size(); ++l) {
                    const CircleStep step = step_of(l);
                    if (step.circle != b && step.circle != k) continue;
                    const Complex dz = step.circle == b ? step.center + step.radius * turns[row] : 0.0;
                    const Complex dc = step.circle == k ? step.center : 0.0;
                    const double dr = step.circle == k ? step.radius : 0.0;
                    const Complex of_distance = (dz - dc) * inverse;
                    const Complex of_mirrored = -(std::conj(dc) * z + std::conj(circle.center) * dz) * mirror_inverse;
                    const Complex dw = (dr - circle.radius * of_distance) * inverse;
                    const Complex dv = (dr * z + circle.radius * (dz - z * of_mirrored)) * mirror_inverse;
                    const double of_log = k == b ? dr / circle.radius : of_distance.real();
                    all(row, l) += a * (of_log - of_mirrored.real()) + (of_w * dw - of_v * dv).real();
                }
            }
        }
        return all;
    }

    /// (circles, columns) a bound of the largest absolute value of trigonometric polynomials with fewer than `count`
    /// terms: by Cauchy and Schwarz the sum of its Fourier coefficients is at most sqrt(count) times their root mean
    /// square, which the samples have too (Parseval).
    MatrixXd largest(const MatrixXd& values) const
    {
        MatrixXd most(values.rows() / count, values.cols());
        for (Eigen::Index b = 0; b < most.rows(); ++b)
            most.row(b) = values.middleRows(b * count, count).colwise().norm() * rounded_up;
        return most;
    }

    Eigen::Index count;
    std::vector<Complex> turns, points;
    MatrixXd matrix;

private:
    void fill(const CircleCapacities& of, int b, Eigen::Index row)
    {
        const Complex z = points[row];
        for (int k = 1; k <= of.inner(); ++k) {
            const Circle& circle = of.circles_[k];
            const Complex apart = k == b ? circle.radius * turns[row] : z - circle.center;
            const Complex mirror_apart = 1.0 - std::conj(circle.center) * z;
            const Complex w = k == b ? std::conj(turns[row]) : circle.radius / apart;
            const Complex v = circle.radius * z / mirror_apart;
            matrix(row, of.log_of(k)) =
                std::log(k == b ? circle.radius : std::abs(apart)) - std::log(std::abs(mirror_apart));
            Complex w_power = w, v_power = v;
            for (int s = 0; s < of.terms_; ++s, w_power *= w, v_power *= v) {
                const Eigen::Index i = of.pole_of(k) + 2 * static_cast<Eigen::Index>(s);
                matrix(row, i) = w_power.real() - v_power.real();
                matrix(row, i + 1) = -w_power.imag() - v_power.imag();
            }
        }
    }
};

/// The numbers of a potential: how large they are for all modules near by, and how fast they change.
struct CircleCapacities::Coefficients {
    Coefficients(const CircleCapacities& of, int i, const VectorXd& reach, const VectorXd& speed)
        : poles(of.inner(), std::vector<BoundedFunction>(of.terms_))
    {
        const auto bound = [&](Eigen::Index first, Eigen::Index count) {
            BoundedFunction result{of.coefficients_.col(i).segment(first, count).norm()};
            for (Eigen::Index l = 0; l < reach.size(); ++l) {
                const double slope = of.derivatives_[l].col(i).segment(first, count).norm();
                result.value += slope * reach[l];
                result.first += slope * speed[l];
            }
            return result;
        };
        for (int k = 1; k <= of.inner(); ++k) logarithms.push_back(bound(of.log_of(k), 1));
        for (int k = 1; k <= of.inner(); ++k)
            for (int s = 0; s < of.terms_; ++s) poles[k - 1][s] = bound(of.pole_of(k) + 2 * s, 2);
    }

    /// Of the potential on a circle.
    BoundedFunction sum(const OnCircle& on) const
    {
        if (on.ratio.empty()) return {infinite, infinite, infinite};
        BoundedFunction sum;
        for (std::size_t k = 0; k < poles.size(); ++k) {
            sum = sum + logarithms[k] * on.logarithm[k];
            BoundedFunction power = on.ratio[k], mirrored = on.mirrored[k];
            for (const BoundedFunction& pole : poles[k]) {
                sum = sum + pole * (power + mirrored);
                power = power * on.ratio[k];
                mirrored = mirrored * on.mirrored[k];
            }
        }
        return {sum.value * rounded_up, sum.first * rounded_up, sum.second * rounded_up};
    }

    std::vector<BoundedFunction> logarithms;          // of the inner circles
    std::vector<std::vector<BoundedFunction>> poles;  // of the inner circles
};

CircleCapacities::CircleCapacities(VectorXd module, double wanted_error, ExecutionContext& context)
    : module_(std::move(module)), circles_(circles_of_module(module_))
{
    // Twice as many terms square the series' error, until rounding is what is left.
    for (terms_ = fewest_terms; terms_ == fewest_terms || size() <= most_unknowns; terms_ *= 2) {
        context.checkpoint();
        solve();
        if (errors_.maxCoeff() < wanted_error) return;
    }
    terms_ = static_cast<int>(samples_ / samples_per_term);  // of the last solution
}

void CircleCapacities::solve()
{
    samples_ = samples_per_term * terms_;
    const Samples samples(*this);
    MatrixXd wanted = MatrixXd::Zero(samples.matrix.rows(), inner());
    for (int i = 0; i < inner(); ++i) wanted.col(i).segment(i * samples_, samples_).setOnes();
    const Eigen::HouseholderQR<MatrixXd> factored(samples.matrix);
    coefficients_ = factored.solve(wanted);
    errors_ = samples.largest(samples.matrix * coefficients_ - wanted);
    derivatives_.assign(module_.size(), MatrixXd(size(), inner()));
    errors_of_derivatives_.assign(module_.size(), MatrixXd(inner(), inner()));
    for (int i = 0; i < inner(); ++i) {
        const MatrixXd slopes = samples.derivatives(*this, coefficients_.col(i));
        const MatrixXd found = factored.solve(-slopes);
        const MatrixXd errors = samples.largest(samples.matrix * found + slopes);
        for (Eigen::Index l = 0; l < module_.size(); ++l) {
            derivatives_[l].col(i) = found.col(l);
            errors_of_derivatives_[l].col(i) = errors.col(l);
        }
    }
    for (int b = 1; b <= inner(); ++b) add_what_samples_miss(b);
}

void CircleCapacities::add_what_samples_miss(int b)
{
    const VectorXd zero = VectorXd::Zero(module_.size());
    const auto on_circle = [&](double stretch, const VectorXd& speed) {
        return bounds_on(circles_, {static_cast<std::size_t>(b), stretch}, CircleMotion(zero), CircleMotion(speed));
    };

    // Fourier coefficient m is at most the bound in the annulus times stretch^-|m|, and samples show it in another's
    // place.
    const double samples = static_cast<double>(samples_);
    const auto tail = [&](double stretch) {
        const double power = std::pow(stretch, -0.5 * samples);
        return 4.0 * rounded_up * std::max(power, std::numeric_limits<double>::min()) / (1.0 - 1.0 / stretch);
    };

    // A sample is wrong by so much of what its terms are at most; a polynomial of samples by sqrt(samples) times as
    // much, as in largest(). Two logarithms near 0 are not known relative to their own size, but to 1.
    const double rounding = std::sqrt(samples) * unit_roundoff * (static_cast<double>(size()) + 64.0 * terms_ + 64.0) *
                            (1.0 + 1.0 / on_circle(1.0, zero).nearest);
    const auto sizes = [&](const VectorXd& speed) {
        OnCircle on = on_circle(1.0, speed);
        for (BoundedFunction& logarithm : on.logarithm) logarithm.value += 2.0;
        return on;
    };

    const double most = largest_stretch(circles_, b);
    for (int i = 0; i < inner(); ++i) {
        // Any stretch is right. A larger one lowers the tail, and raises the bound.
        const Coefficients still(*this, i, zero, zero);
        double stretch = 1.0, least = infinite;
        for (int k = 1; k < tried_stretches; ++k) {
            const double other = std::pow(most, static_cast<double>(k) / tried_stretches);
            const double missed = tail(other) * still.sum(on_circle(other, zero)).value;
            if (!(missed < least)) continue;
            stretch = other;
            least = missed;
        }
        errors_(b - 1, i) += least + rounding * still.sum(sizes(zero)).value;
        for (Eigen::Index l = 0; l < module_.size(); ++l) {
            const VectorXd step = VectorXd::Unit(module_.size(), l);
            const Coefficients moving(*this, i, zero, step);
            errors_of_derivatives_[l](b - 1, i) +=
                tail(stretch) * moving.sum(on_circle(stretch, step)).first + rounding * moving.sum(sizes(step)).first;
        }
    }
}

VectorXd CircleCapacities::potential_errors(const VectorXd& reach) const
{
    const CircleMotion motion(reach);
    if (!stay_apart(circles_, motion)) return VectorXd::Constant(inner(), infinite);
    const double step = 2.0 * std::numbers::pi / static_cast<double>(samples_);
    VectorXd worst = VectorXd::Zero(inner());
    std::vector<Coefficients> coefficients;
    for (int i = 0; i < inner(); ++i) coefficients.emplace_back(*this, i, reach, reach);
    for (int b = 1; b <= inner(); ++b) {
        VectorXd second = VectorXd::Zero(inner());
        for (Eigen::Index j = 0; j < samples_; ++j) {
            const Complex point = circles_[b].center + std::polar(circles_[b].radius, step * static_cast<double>(j));
            const OnCircle on =
                bounds_on(circles_, {static_cast<std::size_t>(b), 1.0, point, 0.51 * step}, motion, motion);
            for (int i = 0; i < inner(); ++i) second[i] = std::max(second[i], coefficients[i].sum(on).second);
        }
        for (int i = 0; i < inner(); ++i) {
            double error = errors_(b - 1, i) + 0.5 * second[i];
            for (Eigen::Index l = 0; l < reach.size(); ++l) error += errors_of_derivatives_[l](b - 1, i) * reach[l];
            worst[i] = std::isfinite(error) ? std::max(worst[i], error * rounded_up) : infinite;
        }
    }
    return worst;
}

VectorXd CircleCapacities::values(const std::vector<Condenser>& condensers) const
{
    return sums_of_fluxes(condensers, coefficients_);
}

MatrixXd CircleCapacities::gradients(const std::vector<Condenser>& condensers) const
{
    MatrixXd all(static_cast<Eigen::Index>(condensers.size()), module_.size());
    for (Eigen::Index l = 0; l < module_.size(); ++l) all.col(l) = sums_of_fluxes(condensers, derivatives_[l]);
    return all;
}

VectorXd CircleCapacities::sums_of_fluxes(const std::vector<Condenser>& condensers, const MatrixXd& coefficients) const
{
    VectorXd sums = VectorXd::Zero(static_cast<Eigen::Index>(condensers.size()));
    for (std::size_t c = 0; c < condensers.size(); ++c)
        for (const int i : inner_side(condensers[c]))
            for (const int j : inner_side(condensers[c]))
                sums[static_cast<Eigen::Index>(c)] -= 2.0 * std::numbers::pi * coefficients(log_of(j), i - 1);
    return sums;
}

VectorXd CircleCapacities::errors(const std::vector<Condenser>& condensers, const VectorXd& reach) const
{
    const VectorXd of_potential = potential_errors(reach);
    VectorXd largest(inner()), flux = VectorXd::Zero(inner());  // C_jj at most; the fluxes' absolute sum
    for (int j = 0; j < inner(); ++j) {
        double capacity = 0.0;
        for (int i = 0; i < inner(); ++i) {
            double size = std::abs(coefficients_(j, i));
            for (Eigen::Index l = 0; l < reach.size(); ++l) size += std::abs(derivatives_[l](j, i)) * reach[l];
            flux[j] += 2.0 * std::numbers::pi * size;
            if (i == j) capacity = 2.0 * std::numbers::pi * size;
        }
        largest[j] = of_potential[j] < 0.25 ? capacity * rounded_up / (1.0 - 2.0 * of_potential[j]) : infinite;
    }
    VectorXd errors = VectorXd::Zero(static_cast<Eigen::Index>(condensers.size()));
    for (std::size_t c = 0; c < condensers.size(); ++c)
        for (const int j : inner_side(condensers[c])) {
            double of_potentials = 0.0;
            for (const int i : inner_side(condensers[c])) of_potentials += of_potential[i - 1];
            errors[static_cast<Eigen::Index>(c)] +=
                rounded_up * (2.0 * of_potentials * largest[j - 1] + 16.0 * inner() * unit_roundoff * flux[j - 1]);
        }
    return errors;
}

}  // namespace koebe
