#include "pipeline/placement.h"

#include "conformal/area_balance.h"
#include "conformal/circle_fit.h"
#include "conformal/circle_projection.h"
#include "conformal/distortion.h"
#include "conformal/flux_balance.h"
#include "conformal/moebius.h"
#include "foldover/flip_removal.h"
#include "foldover/rim_room.h"
#include "pipeline/loop_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t outer_candidates = 8;     // the longest loops, to choose the outer one from
constexpr Eigen::Index outer_sample = 2000;     // faces to judge the choice by
constexpr Eigen::Index balance_sample = 20000;  // faces to balance by

/// The automorphism that puts the map into normal position: two loops concentric, else nothing.
Moebius normal_position(const std::vector<Circle>& circles)
{
    return circles.size() == 2 ? center_circle(circles[1]) : Moebius{};
}

/// Makes circles smaller that meet another or leave the disk, as those of loops of a few vertices do where less than an
/// edge is between them: r_k <= d_kj r_k / (r_k + r_j) for all j leaves every pair apart.
/// @return the loops of the circles it changed
std::vector<Index> set_apart(std::vector<Circle>& circles)
{
    constexpr double share = 0.9;  // of the room between two centres
    const std::vector<Circle> before = circles;
    std::vector<Index> changed;
    for (std::size_t k = 1; k < circles.size(); ++k) {
        double room = 1.0 - std::abs(before[k].center);
        for (std::size_t j = 1; j < circles.size(); ++j)
            if (j != k)
                room = std::min(room, std::abs(before[k].center - before[j].center) * before[k].radius /
                                          (before[k].radius + before[j].radius));
        if (before[k].radius <= room) continue;
        circles[k].radius = share * room;
        changed.push_back(static_cast<Index>(k));
    }
    return changed;
}

/// Whether the image of a loop is so small, or so far from round, that its circle tells nothing of the surface: what
/// rounding leaves at the end of a limb, or the image of a loop without faces enough around it.
bool is_lost(const Circle& circle, const VectorXcd& image)
{
    constexpr double least_radius = 1e-18, least_share = 4.0 * std::numeric_limits<double>::epsilon();
    constexpr double no_circle = 0.5;  // roundness
    return !(circle.radius > std::max(least_radius, least_share * std::abs(circle.center))) ||
           !(roundness(image, circle) < no_circle);
}

/// The images of the loops in normal position, each put on its circle: (m, 2), loop after loop; empty if the circles
/// leave the disk or meet. Fills the loop reports.
MatrixXd place_on_circles(const Domain& domain, const FlapCut& cut, const KoebeOutcome& outcome,
                          UniformizeResult& result)
{
    std::vector<Circle> circles{Circle{}};
    for (std::size_t k = 1; k < outcome.loops.size(); ++k)
        circles.push_back(fit_circle_least_squares(outcome.loops[k]));
    std::vector<Index> lost;
    for (std::size_t k = 1; k < circles.size(); ++k)
        if (is_lost(circles[k], outcome.loops[k])) lost.push_back(static_cast<Index>(k));
    const Moebius moebius = normal_position(circles);
    if (!std::isfinite(std::abs(moebius.a))) return {};
    for (std::size_t k = 1; k < circles.size(); ++k) circles[k] = moebius(circles[k]);
    const std::vector<Index> changed = set_apart(circles);
    if (!changed.empty())
        result.warnings.push_back({WarningKind::shrunk_circles,
                                   "circles that met another made smaller, the mesh between them is too coarse: " +
                                       std::to_string(changed.size()),
                                   changed});
    if (!circles_apart(circles)) return {};
    if (!lost.empty())
        result.warnings.push_back({WarningKind::lost_circles,
                                   "circles of no meaning, the loop too deep inside for rounding or the mesh around it "
                                   "too coarse: " + std::to_string(lost.size()),
                                   lost});

    std::size_t boundary_count = 0;
    for (const VectorXcd& loop : outcome.loops) boundary_count += loop.size();
    MatrixXd boundary(boundary_count, 2);
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < outcome.loops.size(); ++k) {
        LoopReport report;
        report.circle = circles[k];
        report.shrunk = std::ranges::count(changed, static_cast<Index>(k)) > 0 ||
                        std::ranges::count(lost, static_cast<Index>(k)) > 0;
        const VectorXcd image = moebius(outcome.loops[k]);
        report.roundness = roundness(image, report.circle);
        const VectorXcd projected =
            k == 0 ? project_onto_circle(report.circle, image, 1,
                                         rim_room(domain.surface, domain.loops[0], cut.flaps, cut.vertices))
                   : project_onto_circle(report.circle, image, -1);
        report.roundness_projected = roundness(projected, report.circle);
        for (const Index v : domain.loops[k]) report.vertices.push_back(domain.original[v]);
        boundary.middleRows(row, projected.size()) << projected.real(), projected.imag();
        row += projected.size();
        result.loops.push_back(std::move(report));
    }
    return boundary;
}

}  // namespace

std::optional<PlanarPoints> finish_map(const CondensedLaplacian& condensed, const SparseMatrix& laplacian, const Domain& domain,
                        const FlapCut& cut, const KoebeOutcome& outcome, const UniformizeOptions& options,
                        UniformizeResult& result, int& outer)
{
    MatrixXd boundary = place_on_circles(domain, cut, outcome, result);
    if (boundary.rows() == 0) return {};
    std::vector<Circle> circles = reported_circles(result.loops);
    PlanarPoints uv = balance_flux(condensed, laplacian, domain.loops, circles, boundary, AnnulusPosition::concentric);
    if (!uv.allFinite() || !circles_apart(circles)) return {};
    if (options.balance == Balance::area) {
        if (options.outer == OuterLoop::automatic) {
            std::vector<int> longest(std::min(circles.size(), outer_candidates));
            std::iota(longest.begin(), longest.end(), 0);
            outer = balanced_outer_loop(face_scales(domain.vertices, domain.surface.triangles, uv, outer_sample),
                                        circles, longest);
        }
        result.unbalanced_area = measure_distortion(domain.vertices, domain.surface.triangles, uv).area;
        if (outer != 0) return uv;
        double distortion = 0.0;
        const Moebius balance = least_area_distortion(
            face_scales(domain.vertices, domain.surface.triangles, uv, balance_sample), distortion);
        const VectorXcd moved = balance(boundary.col(0) + Complex(0.0, 1.0) * boundary.col(1));
        boundary << moved.real(), moved.imag();
        for (std::size_t k = 1; k < circles.size(); ++k) circles[k] = balance(circles[k]);
        uv = balance_flux(condensed, laplacian, domain.loops, circles, boundary, AnnulusPosition::free);
    }
    if (!uv.allFinite() || !circles_apart(circles)) return {};
    for (std::size_t k = 0; k < circles.size(); ++k) result.loops[k].circle = circles[k];
    return uv;
}

}  // namespace koebe
