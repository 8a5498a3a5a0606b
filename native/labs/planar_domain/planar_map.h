// Conformal maps of planar domains with smooth or polygonal rims to circle domains, to ten digits.
#pragma once

#include "circles/circle.h"
#include "circles/moebius.h"
#include "core/api.h"
#include "core/types.h"
#include "execution/execution.h"
#include "planar_domain/planar_rim.h"
#include "planar_domain/rim_map.h"
#include "planar_domain/slit_map.h"

#include <optional>
#include <vector>

namespace koebe {

struct PlanarOptions {
    double tolerance = 1e-10;  ///< of the circles, a length in the unit disk
    int max_sweeps = 100;      ///< of the Koebe iteration, at each resolution
    SlitKind slits = SlitKind::none;
    double slit_angle = 0.0;           ///< of parallel slits, degrees
    std::optional<Complex> pole = {};  ///< of the map to parallel slits: a place of the domain
};

/// A conformal map of a planar domain, and its inverse.
class PlanarMap {
public:
    PlanarMap() = default;
    PlanarMap(Complex middle, double size, std::vector<RimPolygon> rims, std::vector<RimMap> maps, Circle outer);

    /// The images of places of the closed domain. @throws InputError places off the domain (listed as points)
    KOEBE_API VectorXcd operator()(const VectorXcd& places) const;
    /// Preimages of places of the closed circle domain, inside the domain or on its rims.
    /// @throws InputError places off the circle domain; SolverError a place whose preimage is not found (listed)
    KOEBE_API VectorXcd inverse(const VectorXcd& images) const;

    /// The images of places of the closed domain in the slit domain, infinite at the pole.
    /// @throws InputError as above; the map was made without slits
    KOEBE_API VectorXcd slit_images(const VectorXcd& places) const;

    /// @param residual greatest distance of a rim's image from its circle
    void normalize(const Moebius& last, std::vector<Circle> circles, double residual);
    /// @throws InputError as planar_map, for slits
    void add_slits(const PlanarOptions& options);
    const std::vector<Circle>& circles() const { return circles_; }
    const std::optional<SlitMap>& slit_map() const { return slit_map_; }

private:
    Complex image(Complex place) const;
    Complex derivative(Complex place) const;
    Complex preimage(Complex image) const;

    Complex middle_ = 0.0;  // of the domain, which is moved to 0
    double size_ = 1.0;
    std::vector<RimPolygon> rims_;  // in the input's coordinates
    std::vector<RimMap> maps_;      // applied one after the other
    Circle outer_;                  // the outer rim after all of them
    Moebius last_;
    std::vector<Circle> circles_;
    double off_ = 0.0;  // disk units: images so far off the circle domain are refused
    std::optional<SlitMap> slit_map_;
};

struct PlanarResult {
    /// Of the rims in the order of `order`, in the module's position (shape/conformal_module.h): the unit circle first.
    std::vector<Circle> circles;
    std::vector<int> order;         ///< numbers of the rims as given: the outer one, then the holes
    VectorXd module;                ///< conformal_module of the circles
    VectorXd module_errors;         ///< of each of its numbers, as `error`
    double error = 0.0;             ///< of circles: how far the next coarser resolution's are, at least the residual
    std::vector<double> residuals;  ///< of each circle: the greatest distance of its rim's image, between the samples
    bool converged = false;         ///< whether `error` and `slit_error` are at most the tolerance
    SlitKind slit_kind = SlitKind::none;
    std::vector<Slit> slits;    ///< one for each circle, if slits are wanted
    double slit_error = 0.0;    ///< of the slits' ends, of the greatest distance of one from 0, as `error`
    int sweeps = 0;             ///< of the Koebe iteration at the finest resolution
    int levels = 0;             ///< resolutions
    Eigen::Index unknowns = 0;  ///< of the largest system, real
    PlanarMap map;
};

/// Maps a planar domain to a circle domain.
///
/// Koebe's iteration (paper, CK; Nasser 2015): one rim a step. The map of one side of the rim alone to a side of a
/// circle (RimMap) is applied to the whole domain, the outer rim first. When each rim had its turn, all are analytic
/// curves near circles, whatever corners they had, and Laurent series are enough. All steps are formulas, so the map
/// and its derivative are known everywhere.
///
/// The computation is repeated with more poles until the circles change by no more than the tolerance.
///
/// @param rims the outer one and the holes in any order
/// @throws InputError as ordered_rims, or a rim with too many corners; circular or radial slits without a hole,
/// parallel ones without a pole, a pole off the domain or on a rim; SolverError rims that are too near or too far apart
/// in size to be resolved (listed); Cancelled
KOEBE_API PlanarResult planar_map(const std::vector<PlanarRim>& rims, const PlanarOptions& options,
                                  ExecutionContext& context);

}  // namespace koebe
