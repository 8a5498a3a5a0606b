#include "certified/circle_capacities.h"

#include "certified/circle_bounds.h"
#include "certified/interval_functions.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace koebe {
namespace {

constexpr Eigen::Index fewest_terms = 12;
constexpr Eigen::Index most_unknowns = 800;
constexpr double most_stretch = 8.0;
constexpr int tried_stretches = 32;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double unit_roundoff = 0x1p-53;

/// Of the two sides of a condenser that holds all circles, the one without the unit circle.
const std::vector<int>& inner_side(const Condenser& condenser)
{
    return std::ranges::find(condenser.at_one, 0) == condenser.at_one.end() ? condenser.at_one : condenser.at_zero;
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

/// Values of the functions on the inner circles, at equal angles: doubles to solve with, intervals to prove with.
struct CircleCapacities::Samples {
    Samples(const CircleCapacities& of) : matrix(of.first_sample_of(of.inner() + 1), of.size())
    {
        for (int b = 1; b <= of.inner(); ++b)
            for (Eigen::Index j = 0; j < of.samples_of(b); ++j) {
                const Plane<Interval> turn = unit_root(j, of.samples_of(b));
                turns.push_back({0.5 * (turn.re.lower + turn.re.upper), 0.5 * (turn.im.lower + turn.im.upper)});
                circle_of.push_back(b);
                const std::vector<double> row = values(of, b, turns.back());
                matrix.row(static_cast<Eigen::Index>(turns.size()) - 1) =
                    Eigen::Map<const Eigen::RowVectorXd>(row.data(), of.size());
            }
    }

    /// (samples, numbers of the module) the derivatives of a potential, coefficients fixed.
    MatrixXd derivatives(const CircleCapacities& of, const VectorXd& coefficients) const
    {
        MatrixXd all(matrix.rows(), of.module_.size());
        for (Eigen::Index i = 0; i < all.rows(); ++i) {
            const std::vector<double> row = slopes(of, circle_of[i], turns[i], coefficients);
            all.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), all.cols());
        }
        return all;
    }

    /// Of all functions, at one place of circle b.
    template <class Real>
    static std::vector<Real> values(const CircleCapacities& of, int b, const Plane<Real>& turn)
    {
        std::vector<Real> row(of.size());
        const Plane<Real> z = place<Real>(of, b, turn);
        for (int k = 1; k <= of.inner(); ++k) {
            const Real radius = of.circles_[k].radius;
            const Plane<Real> c = plane<Real>(of.circles_[k].center);
            const Plane<Real> mirrored = plane<Real>(1.0) - conjugate(c) * z;
            const Plane<Real> w = k == b ? conjugate(turn) : inverse_of(z - c) * radius;
            const Plane<Real> v = z * inverse_of(mirrored) * radius;
            row[of.log_of(k)] = Real(0.5) * (logarithm(k == b ? squared(radius) : squared_length(z - c)) -
                                             logarithm(squared_length(mirrored)));
            Plane<Real> w_power = w, v_power = v;
            for (Eigen::Index s = 0; s < of.terms_[k - 1]; ++s, w_power = w_power * w, v_power = v_power * v) {
                row[of.pole_of(k) + 2 * s] = w_power.re - v_power.re;
                row[of.pole_of(k) + 2 * s + 1] = Real(0.0) - w_power.im - v_power.im;
            }
        }
        return row;
    }

    /// Of one potential at one place of circle b, in each number of the module.
    template <class Real>
    static std::vector<Real> slopes(const CircleCapacities& of, int b, const Plane<Real>& turn,
                                    const VectorXd& coefficients)
    {
        std::vector<Real> all(of.module_.size());
        const Plane<Real> z = place<Real>(of, b, turn);
        for (int k = 1; k <= of.inner(); ++k) {
            const Real radius = of.circles_[k].radius;
            const Plane<Real> c = plane<Real>(of.circles_[k].center);
            const Plane<Real> inverse = k == b ? Plane<Real>{} : inverse_of(z - c);  // w_b is the same at each place
            const Plane<Real> mirror_inverse = inverse_of(plane<Real>(1.0) - conjugate(c) * z);
            const Plane<Real> w = inverse * radius, v = z * mirror_inverse * radius;
            Plane<Real> of_w, of_v, w_power = plane<Real>(1.0), v_power = w_power;  // derivatives of the powers' sums
            for (Eigen::Index s = 0; s < of.terms_[k - 1]; ++s, w_power = w_power * w, v_power = v_power * v) {
                const Eigen::Index i = of.pole_of(k) + 2 * s;
                const Plane<Real> pole{coefficients[i], coefficients[i + 1]};
                of_w = of_w + w_power * pole * Real(static_cast<double>(s + 1));
                of_v = of_v + v_power * conjugate(pole) * Real(static_cast<double>(s + 1));
            }
            for (Eigen::Index l = 0; l < of.module_.size(); ++l) {
                const CircleStep step = step_of(l);
                if (step.circle != b && step.circle != k) continue;
                const Plane<Real> dz =
                    step.circle == b ? plane<Real>(step.center) + turn * Real(step.radius) : Plane<Real>{};
                const Plane<Real> dc = step.circle == k ? plane<Real>(step.center) : Plane<Real>{};
                const Plane<Real> dr = plane<Real>(step.circle == k ? step.radius : 0.0);
                const Plane<Real> of_distance = (dz - dc) * inverse;
                const Plane<Real> of_mirrored = (conjugate(dc) * z + conjugate(c) * dz) * mirror_inverse;
                const Plane<Real> dw = (dr - of_distance * radius) * inverse;
                const Plane<Real> dv = (dr * z + (dz + z * of_mirrored) * radius) * mirror_inverse;
                const Real of_log = k == b ? dr.re / radius : of_distance.re;
                all[l] =
                    all[l] + Real(coefficients[of.log_of(k)]) * (of_log + of_mirrored.re) + (of_w * dw - of_v * dv).re;
            }
        }
        return all;
    }

    std::vector<int> circle_of;
    std::vector<Plane<double>> turns;
    MatrixXd matrix;

private:
    template <class Real>
    static Plane<Real> plane(const Complex& z)
    {
        return {z.real(), z.imag()};
    }

    template <class Real>
    static Plane<Real> place(const CircleCapacities& of, int b, const Plane<Real>& turn)
    {
        return plane<Real>(of.circles_[b].center) + turn * Real(of.circles_[b].radius);
    }
};

/// The numbers of a potential: how large they are for all modules near by, and how fast they change.
struct CircleCapacities::Coefficients {
    Coefficients(const CircleCapacities& of, int i, const VectorXd& reach, const VectorXd& speed)
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
        poles.resize(of.inner());
        for (int k = 1; k <= of.inner(); ++k)
            for (Eigen::Index s = 0; s < of.terms_[k - 1]; ++s) poles[k - 1].push_back(bound(of.pole_of(k) + 2 * s, 2));
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
    terms_.assign(inner(), fewest_terms);
    do {
        context.checkpoint();
        solve();
    } while (add_terms(wanted_error));
    context.checkpoint();
    prove();
}

/// Twice as many terms square the series' error, until rounding is what is left. Circles near others, and large ones
/// beside small ones, need most. @return whether the errors ask for more and there is room
bool CircleCapacities::add_terms(double wanted_error)
{
    const VectorXd worst = errors_.rowwise().maxCoeff();
    const std::vector<Eigen::Index> before = terms_;
    for (const bool all : {true, false}) {
        for (int b = 0; b < inner(); ++b)
            if (!(worst[b] < (all ? wanted_error : worst.maxCoeff()))) terms_[b] *= 2;
        if (size() <= most_unknowns) return terms_ != before;
        terms_ = before;
    }
    return false;
}

void CircleCapacities::solve()
{
    const Samples samples(*this);
    MatrixXd wanted = MatrixXd::Zero(samples.matrix.rows(), inner());
    for (int i = 0; i < inner(); ++i) wanted.col(i).segment(first_sample_of(i + 1), samples_of(i + 1)).setOnes();
    const Eigen::HouseholderQR<MatrixXd> factored(samples.matrix);
    coefficients_ = factored.solve(wanted);
    const MatrixXd missed = samples.matrix * coefficients_ - wanted;
    errors_.resize(inner(), inner());
    for (int b = 1; b <= inner(); ++b)
        errors_.row(b - 1) = missed.middleRows(first_sample_of(b), samples_of(b)).colwise().norm();
    derivatives_.assign(module_.size(), MatrixXd(size(), inner()));
    for (int i = 0; i < inner(); ++i) {
        const MatrixXd found = factored.solve(-samples.derivatives(*this, coefficients_.col(i)));
        for (Eigen::Index l = 0; l < module_.size(); ++l) derivatives_[l].col(i) = found.col(l);
    }
}

/// The largest absolute value of a trigonometric polynomial through samples is at most the sum of its Fourier
/// coefficients, by Cauchy and Schwarz at most sqrt(samples) times their root mean square, which the samples have too
/// (Parseval).
void CircleCapacities::prove()
{
    errors_.setZero(inner(), inner());
    errors_of_derivatives_.assign(module_.size(), MatrixXd::Zero(inner(), inner()));
    const auto sum = [](const std::vector<Interval>& row, const auto& coefficients) {
        Interval sum;
        for (std::size_t i = 0; i < row.size(); ++i)
            sum = sum + Interval(coefficients[static_cast<Eigen::Index>(i)]) * row[i];
        return sum;
    };
    for (int b = 1; b <= inner(); ++b) {
        // Squares of what is missed at each sample: of the potentials' values, and of their derivatives by the module.
        for (Eigen::Index j = 0; j < samples_of(b); ++j) {
            const Plane<Interval> turn = unit_root(j, samples_of(b));
            const std::vector<Interval> row = Samples::values(*this, b, turn);
            for (int i = 0; i < inner(); ++i) {
                const Interval missed = sum(row, coefficients_.col(i)) - Interval(i + 1 == b ? 1.0 : 0.0);
                errors_(b - 1, i) += squared(missed.magnitude());
                const std::vector<Interval> slopes = Samples::slopes(*this, b, turn, coefficients_.col(i));
                for (Eigen::Index l = 0; l < module_.size(); ++l)
                    errors_of_derivatives_[l](b - 1, i) +=
                        squared((slopes[l] + sum(row, derivatives_[l].col(i))).magnitude());
            }
        }
        // The roots of the sums, rounded up.
        errors_.row(b - 1) = errors_.row(b - 1).cwiseSqrt() * rounded_up;
        for (MatrixXd& errors : errors_of_derivatives_) errors.row(b - 1) = errors.row(b - 1).cwiseSqrt() * rounded_up;
        add_what_samples_miss(b);
    }
}

void CircleCapacities::add_what_samples_miss(int b)
{
    const VectorXd zero = VectorXd::Zero(module_.size());
    const auto on_circle = [&](double stretch, const VectorXd& speed) {
        return bounds_on(circles_, {static_cast<std::size_t>(b), stretch}, CircleMotion(zero), CircleMotion(speed));
    };

    // Fourier coefficient m is at most the bound in the annulus times stretch^-|m|, and samples show it in another's
    // place.
    const double samples = static_cast<double>(samples_of(b));
    const auto tail = [&](double stretch) {
        const double power = std::pow(stretch, -0.5 * samples);
        return 4.0 * rounded_up * std::max(power, std::numeric_limits<double>::min()) / (1.0 - 1.0 / stretch);
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
        errors_(b - 1, i) += least;
        for (Eigen::Index l = 0; l < module_.size(); ++l) {
            const VectorXd step = VectorXd::Unit(module_.size(), l);
            const Coefficients moving(*this, i, zero, step);
            errors_of_derivatives_[l](b - 1, i) += tail(stretch) * moving.sum(on_circle(stretch, step)).first;
        }
    }
}

VectorXd CircleCapacities::potential_errors(const VectorXd& reach) const
{
    const CircleMotion motion(reach);
    if (!stay_apart(circles_, motion)) return VectorXd::Constant(inner(), infinite);
    VectorXd worst = VectorXd::Zero(inner());
    std::vector<Coefficients> coefficients;
    for (int i = 0; i < inner(); ++i) coefficients.emplace_back(*this, i, reach, reach);
    for (int b = 1; b <= inner(); ++b) {
        VectorXd second = VectorXd::Zero(inner());
        const double step = 2.0 * std::numbers::pi / static_cast<double>(samples_of(b));
        for (Eigen::Index j = 0; j < samples_of(b); ++j) {
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
