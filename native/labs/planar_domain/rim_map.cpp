#include "planar_domain/rim_map.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr double largest_coefficient = 1e2;  // with larger ones, rounding costs more than it has to
constexpr double damping = 1e-14;
constexpr double start_offset = 0.05;  // from a corner, of its size
constexpr double near_ring = 0.01;     // of the rim's size: so near, the samples' polygon does not decide
constexpr double near_corner = 1e-4;   // of the distance to the map's center: offsets below follow the derivative

/// Places of which functions are summed at once.
using Lanes = Eigen::Array<double, 64, 1>;

/// Adds coefficient / (z - pole) at places z = (x, y).
template <typename Places>
void add_pole(Complex coefficient, Complex pole, const Places& x, const Places& y, Places& real, Places& imaginary)
{
    const Places dx = x - pole.real(), dy = y - pole.imag(), inverse = (dx * dx + dy * dy).inverse();
    real += (coefficient.real() * dx + coefficient.imag() * dy) * inverse;
    imaginary += (coefficient.imag() * dx - coefficient.real() * dy) * inverse;
}

/// 1 / z, without the checks of the language's division, which cost more than all else.
Complex reciprocal(Complex z) { return std::conj(z) / std::norm(z); }

Complex corner_coordinate(const RimCorner& corner, Complex from_vertex)
{
    return std::sqrt(from_vertex / (from_vertex - (corner.cut_end - corner.vertex)));
}

}  // namespace

RimMap::RimMap(const RimLayout& layout, int powers, bool is_round)
    : is_outer_(layout.is_outer),
      is_round_(is_round),
      center_(layout.center),
      corners_(layout.corners),
      poles_(layout.poles),
      powers_(powers)
{
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
    for (const RimSample& sample : layout.samples) {
        low = std::min(low, std::abs(sample.place - center_));
        high = std::max(high, std::abs(sample.place - center_));
    }
    scale_ = is_outer_ ? high : low;
    solve(layout.samples);
    if (is_outer_) {
        radius_ = 1.0;
    } else {
        // The derivative at infinity becomes 1: there w = 1, and all other functions vanish.
        Complex there = 0.0;
        Eigen::Index k = 0;
        for (const RimCorner& corner : corners_)
            for (const double pole : corner.poles) there -= coefficients_[k++] * pole / (1.0 - pole);
        radius_ = std::exp(-constant_.real() - there.real());
        constant_ = -there;
    }
    if (is_round) return;
    // Next to a corner the map is too bent to start from.
    for (const RimSample& sample : layout.samples) {
        ring_.points.push_back(sample.place);
        const RimCorner* corner =
            sample.corner < 0 || corners_.empty() ? nullptr : &corners_[static_cast<std::size_t>(sample.corner)];
        if (!corner || std::abs(sample.offset) > start_offset * std::abs(corner->cut_end - corner->vertex))
            known_.emplace_back(sample.place, on_own_rim(sample));
    }
    if (is_outer_) known_.emplace_back(center_, 0.0);
}

Eigen::Index RimMap::functions() const
{
    std::size_t count = poles_.size() + static_cast<std::size_t>(powers_);
    for (const RimCorner& corner : corners_) count += corner.poles.size();
    return static_cast<Eigen::Index>(count);
}

void RimMap::fill_row(Complex z, const RimSample* own, Complex* row) const
{
    for (std::size_t c = 0; c < corners_.size(); ++c) {
        const bool near = own && own->corner == static_cast<int>(c);
        const Complex w = corner_coordinate(corners_[c], near ? own->offset : z - corners_[c].vertex);
        for (const double pole : corners_[c].poles) *row++ = -pole * reciprocal(w - pole);
    }
    for (const Complex pole : poles_) *row++ = scale_ * reciprocal(z - pole);
    const Complex ratio = is_outer_ ? (z - center_) / scale_ : scale_ / (z - center_);
    Complex power = ratio;
    for (int j = 0; j < powers_; ++j, power *= ratio) *row++ = power;
}

void RimMap::solve(const std::vector<RimSample>& samples)
{
    const Eigen::Index count = functions(), rows = static_cast<Eigen::Index>(samples.size());
    Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(rows, count);
    VectorXd wanted(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const RimSample& sample = samples[static_cast<std::size_t>(i)];
        fill_row(sample.place, &sample, values.row(i).data());
        wanted[i] = -std::log(std::abs(sample.place - center_));
    }
    // Re sum (a + i b) f = sum a Re f - b Im f, each function scaled to the size 1
    const VectorXd sizes = values.cwiseAbs().colwise().maxCoeff();
    MatrixXd equations(rows, 2 * count + 1);
    equations.col(0).setOnes();
    for (Eigen::Index j = 0; j < count; ++j) {
        equations.col(1 + j) = values.col(j).real() / sizes[j];
        equations.col(1 + count + j) = -values.col(j).imag() / sizes[j];
    }
    const Eigen::HouseholderQR<MatrixXd> factored(equations);
    VectorXd found = factored.solve(wanted);
    if (!(found.cwiseAbs().maxCoeff() < largest_coefficient)) {
        // The functions are dependent in rounding: of all solutions, one that is not large.
        const Eigen::Index n = equations.cols();
        MatrixXd damped = MatrixXd::Zero(2 * n, n);
        damped.topRows(n) = factored.matrixQR().topRows(n).triangularView<Eigen::Upper>();
        damped.bottomRows(n).diagonal().setConstant(damping * std::sqrt(static_cast<double>(rows)));
        VectorXd side = VectorXd::Zero(2 * n);
        side.head(n) = (factored.householderQ().adjoint() * wanted).head(n);
        found = Eigen::HouseholderQR<MatrixXd>(damped).solve(side);
    }
    residual_ = (equations * found - wanted).cwiseAbs().maxCoeff();
    constant_ = found[0];
    coefficients_.resize(count);
    for (Eigen::Index j = 0; j < count; ++j) coefficients_[j] = Complex(found[1 + j], found[1 + count + j]) / sizes[j];
}

template <typename Places>
void RimMap::add_functions(const Complex* z, const RimSample* own, Places& real, Places& imaginary) const
{
    const Places x = Eigen::Map<const Eigen::Array<Complex, Places::RowsAtCompileTime, 1>>(z).real();
    const Places y = Eigen::Map<const Eigen::Array<Complex, Places::RowsAtCompileTime, 1>>(z).imag();
    Places u, v;
    const Complex* coefficient = coefficients_.data();
    // Poles that cluster at corners, in the corner's coordinate. At a corner's own samples it comes from the offset,
    // without cancellation.
    for (std::size_t c = 0; c < corners_.size(); ++c) {
        const bool near = own && own->corner == static_cast<int>(c);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            const Complex w = corner_coordinate(corners_[c], near ? own->offset : z[i] - corners_[c].vertex);
            u[i] = w.real();
            v[i] = w.imag();
        }
        for (const double pole : corners_[c].poles) add_pole(-pole * *coefficient++, pole, u, v, real, imaginary);
    }
    // Other poles.
    for (const Complex pole : poles_) add_pole(scale_ * *coefficient++, pole, x, y, real, imaginary);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const Complex ratio = is_outer_ ? (z[i] - center_) / scale_ : scale_ * reciprocal(z[i] - center_);
        u[i] = ratio.real();
        v[i] = ratio.imag();
    }
    // A polynomial in z outside, in 1 / z at a hole, by Horner's rule.
    Places a = Places::Zero(), b = Places::Zero();
    for (int j = powers_; j-- > 0;) {
        const Places sum = a + coefficient[j].real();
        b += coefficient[j].imag();
        a = sum * u - b * v;
        b = sum * v + b * u;
    }
    real += a;
    imaginary += b;
}

Complex RimMap::exponent(Complex z, const RimSample* own) const
{
    using One = Eigen::Array<double, 1, 1>;
    One real(constant_.real()), imaginary(constant_.imag());
    add_functions(&z, own, real, imaginary);
    return {real[0], imaginary[0]};
}

void RimMap::move(std::vector<RimSample>& samples) const
{
    constexpr std::size_t lanes = Lanes::SizeAtCompileTime;
    for (std::size_t begin = 0; begin < samples.size(); begin += lanes) {
        std::array<Complex, lanes> z;
        for (std::size_t i = 0; i < lanes; ++i) z[i] = samples[std::min(begin + i, samples.size() - 1)].place;
        Lanes real = Lanes::Constant(constant_.real()), imaginary = Lanes::Constant(constant_.imag());
        add_functions(z.data(), nullptr, real, imaginary);
        for (std::size_t i = 0; i < lanes && begin + i < samples.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(i);
            samples[begin + i].place =
                (z[i] - center_) * std::exp(Complex(real[k], imaginary[k])) + (is_outer_ ? Complex(0.0) : center_);
        }
    }
}

Complex RimMap::exponent_derivative(Complex z) const
{
    Complex sum = 0.0;
    Eigen::Index k = 0;
    for (const RimCorner& corner : corners_) {
        const Complex d = z - corner.vertex, e = z - corner.cut_end;
        const Complex w = std::sqrt(d / e);
        // w^2 = d / e, so 2 w w' = (e - d) / e^2
        const Complex slope = (e - d) / (2.0 * w * e * e);
        for (const double pole : corner.poles) sum += coefficients_[k++] * pole * slope / ((w - pole) * (w - pole));
    }
    for (const Complex pole : poles_) sum -= coefficients_[k++] * scale_ / ((z - pole) * (z - pole));
    const Complex ratio = is_outer_ ? (z - center_) / scale_ : scale_ / (z - center_);
    Complex power = ratio;
    for (int j = 1; j <= powers_; ++j, power *= ratio)
        sum += coefficients_[k++] * (is_outer_ ? 1.0 : -1.0) * static_cast<double>(j) * power / (z - center_);
    return sum;
}

Complex RimMap::operator()(Complex z) const
{
    const Complex image = (z - center_) * std::exp(exponent(z, nullptr));
    return is_outer_ ? image : center_ + image;
}

Complex RimMap::on_own_rim(const RimSample& sample) const
{
    const Complex image = (sample.place - center_) * std::exp(exponent(sample.place, &sample));
    return is_outer_ ? image : center_ + image;
}

Complex RimMap::derivative(Complex z) const
{
    return std::exp(exponent(z, nullptr)) * (1.0 + (z - center_) * exponent_derivative(z));
}

std::vector<RimSample> RimMap::operator()(const std::vector<RimSample>& samples,
                                          const std::vector<RimCorner>& corners) const
{
    std::vector<Complex> images;
    for (const RimCorner& corner : corners) images.push_back((*this)(corner.vertex));
    std::vector<RimSample> moved = samples;
    move(moved);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].corner < 0) continue;
        const auto corner = static_cast<std::size_t>(samples[i].corner);
        const Complex vertex = corners[corner].vertex, offset = samples[i].offset;
        moved[i].offset = std::abs(offset) < near_corner * std::abs(vertex - center_)
                              ? offset * derivative(vertex + 0.5 * offset)
                              : moved[i].place - images[corner];
    }
    return moved;
}

RimLayout RimMap::operator()(const RimLayout& other) const
{
    RimLayout image{other.is_outer, (*this)(other.center), {}, {}, {}};
    for (const RimCorner& corner : other.corners)
        image.corners.push_back({(*this)(corner.vertex), (*this)(corner.cut_end), corner.poles});
    for (const Complex pole : other.poles) image.poles.push_back((*this)(pole));
    image.samples = (*this)(other.samples, other.corners);
    return image;
}

Complex RimMap::inverse(Complex w) const
{
    if (is_round_) return followed(w, (*this)(w), w);
    // From known pairs, the nearest image first. Next to a corner many are near, so that further ones are tried too.
    std::vector<std::pair<double, Complex>> starts;
    for (const auto& [place, image] : known_) starts.emplace_back(std::abs(image - w), place);
    std::ranges::sort(starts, {}, [](const auto& start) { return start.first; });
    for (std::size_t i = 0; i < starts.size(); i = 2 * i + 1) {
        const Complex z = followed(starts[i].second, (*this)(starts[i].second), w);
        // Beyond the rim the formula takes values again.
        const bool on_side = (ring_.winding(z) != 0) == is_outer_ || ring_.distance(z) < near_ring * scale_;
        if (std::isfinite(std::abs(z)) && on_side) return z;
    }
    return followed(known_.back().first, known_.back().second, w);
}

Complex RimMap::followed(Complex z, Complex from, Complex w) const
{
    // The way of images keeps to the map's side of the circle: straight from the middle, else a logarithmic spiral.
    const Complex middle = is_outer_ ? Complex(0.0) : center_;
    const bool straight = std::abs(from - middle) < 0.01 * radius_ || std::abs(w - middle) < 0.01 * radius_;
    const Complex turn = straight ? Complex(0.0) : std::log((w - middle) / (from - middle));
    const auto way = [&](double t) {
        return straight ? from + t * (w - from) : middle + (from - middle) * std::exp(t * turn);
    };
    constexpr int most_steps = 100, most_newton = 8;
    double done = 0.0, step = 1.0;
    for (int i = 0; i < most_steps && done < 1.0; ++i) {
        const double next = std::min(1.0, done + step);
        const Complex target = way(next);
        Complex tried = z;
        double first = 0.0, last = 0.0;
        bool settled = false;
        for (int k = 0; k < most_newton && !settled; ++k) {
            const Complex change = ((*this)(tried)-target) / derivative(tried);
            const double now = std::abs(change);
            tried -= change;
            if (!std::isfinite(now) || (k > 0 && now > 0.25 * last && now > 1e-11))
                break;  // another branch may be near
            if (k == 0) first = now;
            last = now;
            settled = now <= 1e-12 * (1.0 + std::abs(tried)) || (k > 0 && now <= 1e-7 * first);
        }
        if (settled) {
            z = tried;
            done = next;
            step *= 2.0;
        } else {
            step *= 0.5;
        }
    }
    return done >= 1.0 ? z : Complex(std::numeric_limits<double>::quiet_NaN(), 0.0);
}

}  // namespace koebe
