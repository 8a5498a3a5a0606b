// Conformal maps of circle domains to slit domains.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <optional>
#include <vector>

namespace koebe {

enum class SlitKind {
    none,
    parallel,  ///< the plane without parallel segments
    circular,  ///< a ring round 0 without arcs round 0
    radial     ///< a ring round 0 without segments that point to 0
};

/// What a rim becomes: a slit between two ends, or, if the ends are equal, a circle round 0 through them.
struct Slit {
    Complex begin, end;
};

/// A circle domain's map to a slit domain.
///
///     parallel:  f(z) = residue / (z - pole) + g(z), with the imaginary part of f / direction constant on each circle
///     circular:  f(z) = (z - c) exp(g(z)), with |f| constant on each circle
///     radial:    the same, with |f| constant on the first two circles, and arg f on each of the others
///
/// c is the centre of the circle 1. g is a sum of Laurent series, one for each circle, found by least squares. By the
/// maximum principle the error of the part that is prescribed is largest on the circles.
class SlitMap {
public:
    struct Pole {
        Complex place, residue, direction;  ///< |direction| = 1: of the slits
    };

    /// @param circles the unit circle, then those inside it, two at least but for parallel slits
    SlitMap(std::vector<Circle> circles, SlitKind kind, const Pole& pole);

    Complex operator()(Complex z) const;
    /// Of each circle, in their order.
    const std::vector<Slit>& slits() const { return slits_; }
    /// How far the prescribed part is from a constant on a circle at most, between the samples.
    double residual() const { return residual_; }
    /// Moves the whole slit domain, of parallel slits.
    void move(Complex by);

private:
    Complex factor(std::size_t circle) const;
    Complex known(Complex z, std::optional<std::size_t> own) const;
    Complex known_derivative(Complex z) const;
    Complex series(Complex z) const;
    Complex series_derivative(Complex z) const;
    Complex ratio(Complex z, std::size_t circle) const;
    int powers_seen(std::size_t circle, std::size_t from) const;
    Eigen::Index numbers() const;
    void solve();
    double solve_once();
    bool needs_more_powers();
    double along(std::size_t circle, double angle) const;
    double along_derivative(std::size_t circle, double angle) const;
    double extreme(std::size_t circle, double sign) const;
    bool is_closed(std::size_t circle) const { return kind_ != SlitKind::parallel && circle < 2; }

    std::vector<Circle> circles_;
    SlitKind kind_;
    Pole pole_;
    std::vector<int> powers_;              // of each circle
    std::vector<VectorXcd> coefficients_;  // of each circle
    Complex constant_ = 0.0;
    double residual_ = 0.0;
    std::vector<Slit> slits_;
};

}  // namespace koebe
