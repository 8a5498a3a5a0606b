#include "pipeline/map_from_loops.h"

#include "balance/area_balance.h"
#include "balance/flux_balance.h"
#include "circles/circle_fit.h"
#include "circles/circle_projection.h"
#include "circles/crowded_circles.h"
#include "ears/least_arcs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr Eigen::Index balance_sample = 20000;  // number of faces used to balance

/// The automorphism that makes two loops concentric; the identity otherwise.
Moebius normal_position(const std::vector<Circle>& circles)
{
    return circles.size() == 2 ? center_circle(circles[1]) : Moebius{};
}

/// Whether a loop's image is too small or too far from round for its circle to mean anything. Rounding leaves such
/// images at the end of a limb, and a loop with too few faces around it has one.
bool is_lost(const Circle& circle, const VectorXcd& image)
{
    constexpr double least_radius = 1e-18, least_share = 4.0 * std::numeric_limits<double>::epsilon();
    constexpr double no_circle = 0.5;  // of the radius
    return !(circle.radius > std::max(least_radius, least_share * std::abs(circle.center))) ||
           !(deviation_from(circle, image) < no_circle);
}

/// Puts the images on their circles: (m, 2), loop after loop. Notes their roundness.
MatrixXd points_on_circles(const MapInput& input, const EarCut& cut, const std::vector<VectorXcd>& images,
                           CircleMap& map)
{
    std::size_t boundary_count = 0;
    for (const VectorXcd& image : images) boundary_count += image.size();
    MatrixXd boundary(boundary_count, 2);
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < images.size(); ++k) {
        map.roundness.push_back(roundness(images[k], map.circles[k]));
        const VectorXcd projected =
            k == 0 ? project_onto_circle(map.circles[k], images[k], 1,
                                         least_arcs(input.surface, input.loops[0], cut.ears, cut.vertices))
                   : project_onto_circle(map.circles[k], images[k], -1);
        boundary.middleRows(row, projected.size()) << projected.real(), projected.imag();
        row += projected.size();
    }
    return boundary;
}

/// Computes the interior, and moves small circles to where it wants them. @return whether the map exists
bool extend(const MapSolver& solver, MatrixXd& boundary, AnnulusPosition annulus, CircleMap& map)
{
    map.uv = balance_flux(solver.boundary, solver.laplacian, solver.input.loops, map.circles, boundary, annulus);
    return map.uv.allFinite() && circles_apart(map.circles);
}

}  // namespace

std::optional<CircleMap> map_from_loops(const MapSolver& solver, const EarCut& cut, const KoebeOutcome& outcome)
{
    CircleMap map;
    map.circles.emplace_back();
    for (std::size_t k = 1; k < outcome.loops.size(); ++k) {
        map.circles.push_back(fit_circle_least_squares(outcome.loops[k]));
        if (is_lost(map.circles[k], outcome.loops[k])) map.lost.push_back(static_cast<Index>(k));
    }
    const Moebius moebius = normal_position(map.circles);
    if (!std::isfinite(std::abs(moebius.a))) return {};
    for (std::size_t k = 1; k < map.circles.size(); ++k) map.circles[k] = moebius(map.circles[k]);
    map.shrunk = shrink_crowded(map.circles);
    if (!circles_apart(map.circles)) return {};
    std::vector<VectorXcd> images;
    for (const VectorXcd& image : outcome.loops) images.push_back(moebius(image));
    MatrixXd boundary = points_on_circles(solver.input, cut, images, map);
    if (!extend(solver, boundary, AnnulusPosition::concentric, map)) return {};
    return map;
}

std::optional<CircleMap> moved_by(const MapSolver& solver, const CircleMap& map, const Moebius& automorphism)
{
    CircleMap moved = map;
    for (std::size_t k = 1; k < moved.circles.size(); ++k) moved.circles[k] = automorphism(moved.circles[k]);
    std::vector<Index> rows;
    for (const VertexLoop& loop : solver.input.loops) rows.insert(rows.end(), loop.begin(), loop.end());
    MatrixXd boundary = map.uv(rows, Eigen::all);
    const VectorXcd points = automorphism(boundary.col(0) + Complex(0.0, 1.0) * boundary.col(1));
    boundary << points.real(), points.imag();
    if (!extend(solver, boundary, AnnulusPosition::free, moved)) return {};
    return moved;
}

std::optional<CircleMap> with_area_balanced(const MapSolver& solver, const CircleMap& map)
{
    const MapInput& input = solver.input;
    double distortion = 0.0;
    const Moebius balance = least_area_distortion(
        face_scales(input.vertices, input.surface.triangles, map.uv, balance_sample, input.importance), distortion);
    return moved_by(solver, map, balance);
}

}  // namespace koebe
