// Koebe's iteration on the rims of a planar domain.
#pragma once

#include "circles/circle.h"
#include "core/types.h"
#include "execution/execution.h"
#include "planar_domain/planar_rim.h"
#include "planar_domain/rim_layout.h"
#include "planar_domain/rim_map.h"

#include <vector>

namespace koebe {

/// Koebe's iteration at one resolution.
class KoebeIteration {
public:
    /// @throws InputError as rim_layout (the rim listed)
    KoebeIteration(const OrderedRims& domain, const RimResolution& resolution);

    /// The entries of the largest system.
    std::size_t most_work() const;
    /// @param enough for each rim the residual that its own map has to be below
    /// @return false: a map is not, and the run ended at it
    bool run(int max_sweeps, const std::vector<double>& enough, ExecutionContext& context);
    /// Distances of the rims' images from circles, the outer one of radius 1.
    std::vector<double> residuals() const;
    std::vector<Circle> circles() const;
    Circle outer() const;

    std::vector<RimMap> maps;
    std::vector<double> first_residuals;  ///< of the rims' own maps
    int sweeps = 0;
    Eigen::Index unknowns = 0;

private:
    /// One rim becomes a circle. @return how far it was from one, in its radius
    double turn(std::size_t k);
    int powers() const { return resolution_.circle_points / 4; }
    /// A singularity of a map that is farther than this from its circle is resolved by powers.
    double reach(const Circle& circle) const;
    bool is_near(const Circle& circle, const RimLayout& other) const;

    RimResolution resolution_;
    std::vector<RimLayout> layouts_, checks_;
};

}  // namespace koebe
