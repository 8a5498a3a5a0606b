#include "planar_domain/slit_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int first_count = 16, last_count = 512;  // powers of a circle
constexpr int samples_for_power = 4;               // two real unknowns for each
constexpr Eigen::Index most_numbers = 40000000;    // of a matrix: 320 MB
constexpr double vanishing = 1e-18;                // of a power, on another circle
constexpr double small_tail = 1e-15;               // of the coefficients, in the largest one
constexpr double solved = 1e-16;                   // gradient of the squares, in the first one
constexpr int most_steps = 400;                    // of conjugate gradients

Complex on_circle(const Circle& circle, double angle) { return circle.center + std::polar(circle.radius, angle); }

/// A matrix of dense blocks: a circle's high powers vanish far from it.
struct Block {
    Eigen::Index row, column;
    MatrixXd values;
};

struct BlockMatrix {
    Eigen::Index rows = 0, columns = 0;
    std::vector<Block> blocks = {};

    VectorXd operator*(const VectorXd& x) const
    {
        VectorXd y = VectorXd::Zero(rows);
        for (const Block& block : blocks)
            y.segment(block.row, block.values.rows()).noalias() +=
                block.values * x.segment(block.column, block.values.cols());
        return y;
    }
    VectorXd transposed(const VectorXd& y) const
    {
        VectorXd x = VectorXd::Zero(columns);
        for (const Block& block : blocks)
            x.segment(block.column, block.values.cols()).noalias() +=
                block.values.transpose() * y.segment(block.row, block.values.rows());
        return x;
    }
};

/// The least squares solution by conjugate gradients: columns are nearly orthogonal, as powers on a circle are.
VectorXd least_squares(const BlockMatrix& equations, const VectorXd& wanted)
{
    VectorXd found = VectorXd::Zero(equations.columns), left = wanted;
    VectorXd gradient = equations.transposed(left), direction = gradient;
    const double first = gradient.norm();
    double square = gradient.squaredNorm();
    for (int k = 0; k < most_steps && std::sqrt(square) > solved * first; ++k) {
        const VectorXd image = equations * direction;
        const double step = square / image.squaredNorm();
        found += step * direction;
        left -= step * image;
        gradient = equations.transposed(left);
        const double next = gradient.squaredNorm();
        direction = gradient + (next / square) * direction;
        square = next;
    }
    return found;
}

}  // namespace

SlitMap::SlitMap(std::vector<Circle> circles, SlitKind kind, const Pole& pole)
    : circles_(std::move(circles)), kind_(kind), pole_(pole), powers_(circles_.size(), first_count)
{
    solve();
    if (kind_ != SlitKind::parallel) constant_ -= std::log((*this)(1.0));
    for (std::size_t k = 0; k < circles_.size(); ++k) {
        if (is_closed(k)) {
            const Complex place = std::abs((*this)(on_circle(circles_[k], 0.0)));
            slits_.push_back({place, place});
        } else {
            const double sign = factor(k) == Complex(1.0) ? 1.0 : -1.0;
            slits_.push_back({(*this)(on_circle(circles_[k], extreme(k, -sign))),
                              (*this)(on_circle(circles_[k], extreme(k, sign)))});
        }
    }
}

/// The part of factor * (g + known) that is constant is the real one.
Complex SlitMap::factor(std::size_t circle) const
{
    if (kind_ == SlitKind::parallel) return Complex(0.0, -1.0) / pole_.direction;
    return kind_ == SlitKind::circular || is_closed(circle) ? Complex(1.0) : Complex(0.0, -1.0);
}

/// @param own the circle that z is on: the logarithm is continuous there, but for circle 1 and those round it
Complex SlitMap::known(Complex z, std::optional<std::size_t> own) const
{
    if (kind_ == SlitKind::parallel) return pole_.residue / (z - pole_.place);
    const Complex from = z - circles_[1].center;
    if (!own || is_closed(*own)) return std::log(from);
    const Complex middle = circles_[*own].center - circles_[1].center;
    return std::log(middle) + std::log(from / middle);
}

Complex SlitMap::known_derivative(Complex z) const
{
    if (kind_ == SlitKind::parallel) return -pole_.residue / ((z - pole_.place) * (z - pole_.place));
    return 1.0 / (z - circles_[1].center);
}

Complex SlitMap::series(Complex z) const
{
    Complex sum = constant_;
    for (std::size_t k = 0; k < circles_.size(); ++k) {
        const Complex step = ratio(z, k);
        Complex own = 0.0;
        for (Eigen::Index j = coefficients_[k].size(); j-- > 0;) own = (own + coefficients_[k][j]) * step;
        sum += own;
    }
    return sum;
}

Complex SlitMap::series_derivative(Complex z) const
{
    Complex sum = 0.0;
    for (std::size_t k = 0; k < circles_.size(); ++k) {
        const Complex step = ratio(z, k);
        Complex own = 0.0;
        for (Eigen::Index j = coefficients_[k].size(); j-- > 0;)
            own = own * step + static_cast<double>(j + 1) * coefficients_[k][j];
        sum += k == 0 ? own : -own * step * step / circles_[k].radius;
    }
    return sum;
}

void SlitMap::move(Complex by)
{
    constant_ += by;
    for (Slit& slit : slits_) slit = {slit.begin + by, slit.end + by};
}

Complex SlitMap::operator()(Complex z) const
{
    if (kind_ == SlitKind::parallel) return known(z, {}) + series(z);
    return (z - circles_[1].center) * std::exp(series(z));
}

Complex SlitMap::ratio(Complex z, std::size_t circle) const
{
    return circle == 0 ? z : circles_[circle].radius / (z - circles_[circle].center);
}

/// How many powers of a circle do not vanish on another one.
int SlitMap::powers_seen(std::size_t circle, std::size_t from) const
{
    if (circle == from) return powers_[circle];
    const Circle& other = circles_[from];
    const double away = std::abs(other.center - circles_[circle].center);
    const double most = circle == 0 ? away + other.radius
                        : from == 0 ? circles_[circle].radius / (1.0 - std::abs(circles_[circle].center))
                                    : circles_[circle].radius / (away - other.radius);
    return static_cast<int>(std::min<double>(powers_[circle], std::ceil(std::log(vanishing) / std::log(most))));
}

Eigen::Index SlitMap::numbers() const
{
    Eigen::Index sum = 0;
    for (std::size_t own = 0; own < circles_.size(); ++own)
        for (std::size_t k = 0; k < circles_.size(); ++k)
            sum += Eigen::Index{2} * samples_for_power * powers_[own] * powers_seen(k, own);
    return sum;
}

double SlitMap::solve_once()
{
    BlockMatrix equations{.columns = static_cast<Eigen::Index>(circles_.size())};
    std::vector<Eigen::Index> columns;  // of each circle's first power
    for (const int count : powers_) {
        columns.push_back(equations.columns);
        equations.columns += 2 * count;
        equations.rows += samples_for_power * count;
    }
    VectorXd wanted(equations.rows);
    Eigen::Index row = 0;
    for (std::size_t own = 0; own < circles_.size(); ++own) {
        const int samples = samples_for_power * powers_[own];
        const double weight = 1.0 / std::sqrt(samples);
        VectorXcd z(samples);
        for (int i = 0; i < samples; ++i) {
            z[i] = on_circle(circles_[own], 2.0 * pi * i / samples);
            wanted[row + i] = -weight * (factor(own) * known(z[i], own)).real();
        }
        equations.blocks.push_back({row, static_cast<Eigen::Index>(own), MatrixXd::Constant(samples, 1, -weight)});
        for (std::size_t k = 0; k < circles_.size(); ++k) {
            MatrixXd values(samples, 2 * powers_seen(k, own));
            for (int i = 0; i < samples; ++i) {
                const Complex step = ratio(z[i], k);
                Complex power = weight * factor(own) * step;
                for (Eigen::Index j = 0; j < values.cols(); j += 2, power *= step) {
                    values(i, j) = power.real();
                    values(i, j + 1) = -power.imag();
                }
            }
            equations.blocks.push_back({row, columns[k], std::move(values)});
        }
        row += samples;
    }
    const VectorXd found = least_squares(equations, wanted);
    coefficients_.clear();
    auto at = static_cast<Eigen::Index>(circles_.size());
    for (const int count : powers_) {
        VectorXcd own(count);
        for (int j = 0; j < count; ++j, at += 2) own[j] = {found[at], found[at + 1]};
        coefficients_.push_back(std::move(own));
    }
    double most = 0.0;
    for (std::size_t own = 0; own < circles_.size(); ++own)
        for (int i = 0; i < samples_for_power * powers_[own]; ++i) {
            const Complex z = on_circle(circles_[own], 2.0 * pi * (i + 0.5) / (samples_for_power * powers_[own]));
            const double value = (factor(own) * (known(z, own) + series(z))).real();
            most = std::max(most, std::abs(value - found[static_cast<Eigen::Index>(own)]));
        }
    return most;
}

/// Doubles the powers of the circles whose last coefficients have not died out.
bool SlitMap::needs_more_powers()
{
    double largest = 0.0;
    for (const VectorXcd& own : coefficients_) largest = std::max(largest, own.cwiseAbs().maxCoeff());
    std::vector<int> more = powers_;
    for (std::size_t k = 0; k < powers_.size(); ++k)
        if (coefficients_[k].tail(powers_[k] / 4).cwiseAbs().maxCoeff() > small_tail * largest)
            more[k] = std::min(2 * powers_[k], last_count);
    if (more == powers_) return false;
    std::swap(powers_, more);
    if (numbers() <= most_numbers) return true;
    std::swap(powers_, more);
    return false;
}

void SlitMap::solve()
{
    do residual_ = solve_once();
    while (needs_more_powers());
}

/// The part that is not prescribed: a place along the slit.
double SlitMap::along(std::size_t circle, double angle) const
{
    const Complex z = on_circle(circles_[circle], angle);
    return (factor(circle) * (known(z, circle) + series(z))).imag();
}

double SlitMap::along_derivative(std::size_t circle, double angle) const
{
    const Complex radius = std::polar(circles_[circle].radius, angle), z = circles_[circle].center + radius;
    return (factor(circle) * (known_derivative(z) + series_derivative(z)) * Complex(0.0, 1.0) * radius).imag();
}

/// The angle at which a circle's image is farthest along its slit, or nearest. @param sign +1 or -1
double SlitMap::extreme(std::size_t circle, double sign) const
{
    const int samples = 2 * samples_for_power * powers_[circle];
    const double spacing = 2.0 * pi / samples;
    double best = 0.0;
    for (int i = 1; i < samples; ++i)
        if (sign * along(circle, i * spacing) > sign * along(circle, best)) best = i * spacing;
    // The derivative is zero between the neighbours.
    double low = best - spacing, high = best + spacing;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (sign * along_derivative(circle, middle) > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace koebe
