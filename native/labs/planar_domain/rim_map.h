// The conformal map of one side of a closed curve to one side of a circle.
#pragma once

#include "core/types.h"
#include "planar_domain/rim_layout.h"

#include <vector>

namespace koebe {

/// Riemann's map of one rim: its inside goes to the unit disk, its center to 0; or its outside goes to the outside of a
/// circle round its center, with z -> z + O(1) at infinity.
///
///     f(z) = (z - center) exp(g(z)),   Re g = -log |z - center| on the rim, up to a constant,
///
/// where g is a sum of simple poles off the domain, in z and in the corners' coordinates (RimCorner), and of powers of
/// z - center. Its coefficients are found by least squares on the samples. g is analytic on the whole side, so by the
/// maximum principle its real part is nowhere farther from the exact one than on the rim.
class RimMap {
public:
    /// @param powers how many powers of z - center (inside), or of its inverse (outside)
    /// @param is_round the rim is near a circle round its center, so that the map is near the identity
    RimMap(const RimLayout& layout, int powers, bool is_round);

    Complex operator()(Complex z) const;
    Complex derivative(Complex z) const;
    /// The images of samples; their offsets stay exact.
    std::vector<RimSample> operator()(const std::vector<RimSample>& samples,
                                      const std::vector<RimCorner>& corners_of_samples) const;
    /// The image of a rim's layout with its poles. The rim is not this map's own.
    RimLayout operator()(const RimLayout& other) const;

    /// The image of a sample of the map's own rim.
    Complex on_own_rim(const RimSample& sample) const;

    bool is_outer() const { return is_outer_; }
    Complex center() const { return center_; }
    double radius() const { return radius_; }      ///< of the image of the rim
    double residual() const { return residual_; }  ///< the greatest |Re g + log |z - center|| on the samples
    Eigen::Index unknowns() const { return coefficients_.size() + 1; }
    /// A preimage in the closed side, by Newton's method along a path from known pairs. Not finite: none is found.
    Complex inverse(Complex w) const;

private:
    /// The preimage of w by Newton's method along the segment of images from a known one. Not finite: it fails.
    Complex followed(Complex place, Complex image, Complex w) const;
    void fill_row(Complex z, const RimSample* own, Complex* row) const;
    Complex exponent(Complex z, const RimSample* own) const;
    /// Adds g less its constant at as many places as there are entries.
    template <typename Places>
    void add_functions(const Complex* z, const RimSample* own, Places& real, Places& imaginary) const;
    /// The images of the samples' places.
    void move(std::vector<RimSample>& samples) const;
    Complex exponent_derivative(Complex z) const;
    void solve(const std::vector<RimSample>& samples);
    Eigen::Index functions() const;

    bool is_outer_, is_round_;
    Complex center_;
    std::vector<RimCorner> corners_;
    std::vector<Complex> poles_;
    int powers_;
    double scale_ = 1.0;  // of the powers: the rim's greatest or least distance from the center
    VectorXcd coefficients_;
    Complex constant_ = 0.0;
    double radius_ = 1.0, residual_ = 0.0;
    std::vector<std::pair<Complex, Complex>> known_;  // places and their images
    RimPolygon ring_;                                 // of the samples
};

}  // namespace koebe
