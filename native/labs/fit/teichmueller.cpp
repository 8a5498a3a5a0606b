#include "fit/teichmueller.h"

#include "bending/bend_between.h"
#include "circles/same_circles.h"
#include "conformal/rectangle_modulus.h"
#include "core/complex_places.h"
#include "core/counted.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "execution/detachable_run.h"
#include "fit/bounded_matches.h"
#include "fit/circle_template.h"
#include "fit/coarse_gaps.h"
#include "fit/dilatation_bounds.h"
#include "fit/domain_dilatation.h"
#include "fit/plane_beltrami.h"
#include "fit/template_start.h"
#include "linear/dense_spd.h"
#include "shape/conformal_module.h"
#include "shape/loop_matching.h"
#include "transfer/compact_domain.h"
#include "transfer/landmark_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace koebe {
namespace {

/// a's domain with its inner loops by their first vertices. Large powers of |mu| are nearly flat where faces bend less
/// than others: Newton's method amplifies rounding there, so that no sum may depend on the given order of the loops.
struct OrderedDomain : CompactDomain {
    std::vector<Index> given;  ///< a's own numbers of the loops
};

OrderedDomain ordered(MappedSurface a)
{
    std::vector<Index> given = numbers_below(a.loops.size());
    std::ranges::sort(given.begin() + 1, given.end(), {}, [&](Index k) { return a.loops[k].vertices; });
    a.loops = values_at(a.loops, given);
    return {compact(a), std::move(given)};
}

/// Landmarks in a's domain, and their places in b's.
struct Held {
    std::vector<SurfacePoint> points;
    VectorXcd places;

    VectorXcd of(const PlanarPoints& uv, const Triangles& triangles) const
    {
        VectorXcd now(places.size());
        for (Eigen::Index i = 0; i < now.size(); ++i) {
            const Eigen::RowVector2d at = points[static_cast<std::size_t>(i)].of(uv, triangles);
            now[i] = Complex(at[0], at[1]);
        }
        return now;
    }
};

Held held_points(const std::vector<HeldPoint>& landmarks)
{
    Held held{{}, VectorXcd(static_cast<Eigen::Index>(landmarks.size()))};
    for (const HeldPoint& landmark : landmarks) {
        held.places[static_cast<Eigen::Index>(held.points.size())] = landmark.place;
        held.points.push_back(landmark.point);
    }
    if (!held.places.allFinite()) throw InputError("the places of landmarks must be finite");
    return held;
}

void require_equally_many(const std::vector<Circle>& a, const std::vector<Circle>& b)
{
    if (a.size() != b.size())
        throw InputError("the domains have " + std::to_string(a.size()) + " and " + counted(b.size(), "loop") +
                         ": no map takes one to the other");
    require_circle_domain(a);
    require_circle_domain(b);
}

/// The domain's loop for each of b's. @param match b's loop for each of a's as they are given, or empty
std::vector<int> inverse_match(const OrderedDomain& a, const std::vector<Circle>& b, const std::vector<int>& match,
                               const Held& held, const ExecutionContext& context)
{
    std::vector<int> inverse(b.size(), 0);
    if (match.empty() && held.points.empty()) {
        const LoopMatch found = match_loops(a.circles, b, false, context);
        for (std::size_t k = 0; k < b.size(); ++k) inverse[found.order_b[k]] = found.order_a[k];
        return inverse;
    }
    if (match.empty())
        return align_by_landmarks(b, a.circles, held.of(a.surface.uv, a.surface.triangles), held.places, context).match;
    std::vector<int> all = numbers_below<int>(b.size());
    if (!std::is_permutation(all.begin(), all.end(), match.begin(), match.end()) || match[0] != 0)
        throw InputError("the match must name each of the loops of b once, the outer one first");
    for (std::size_t k = 0; k < b.size(); ++k) inverse[match[a.given[k]]] = static_cast<int>(k);
    return inverse;
}

/// Circles that are too small take thousands of steps to shrink to, as no face fits beside them.
/// @param number of the circles, for the refusal
void require_wide_circles(const std::vector<Circle>& circles, const std::vector<Index>& number, const char* whose)
{
    std::optional<std::size_t> first;
    for (std::size_t k = 0; k < circles.size(); ++k)
        if (!(circles[k].radius >= least_template_gap) && (!first || number[k] < number[*first])) first = k;
    if (first)
        throw InputError(std::string(whose) + " circle " + std::to_string(number[*first]) + " has the radius " +
                             formatted("%.3g", circles[*first].radius) + ": an extremal map needs 1e-6 at least",
                         ElementKind::loops, {number[*first]});
}

[[noreturn]] void refuse_teichmueller(double reached, std::vector<Index> blocked)
{
    throw SolverError("no one-to-one map of one domain to the other was found: faces turn over at " +
                          formatted("%.3g", 100.0 * reached) + " % of the way. The mesh is too coarse between holes",
                      blocked.empty() ? ElementKind::none : ElementKind::loops, std::move(blocked));
}

/// @param whose a or b @param circles in the order of the domain's loops
void require_fine_gaps(const std::vector<Circle>& circles, const OrderedDomain& domain, const PlanarPoints& uv,
                       const char* whose)
{
    if (const auto gap = coarse_gap(circles, domain.loops, uv)) {
        const Index first = domain.given[gap->first], second = domain.given[gap->second];
        throw SolverError("the mesh is too coarse for the gap between loops " + std::to_string(first) + " and " +
                              std::to_string(second) + " in the domain of " + whose +
                              ": the edges of their rims leave the circles by more than the gap is wide",
                          ElementKind::loops, {first, second});
    }
}

std::size_t newly_folded(const Triangles& triangles, const PlanarPoints& before, const PlanarPoints& after)
{
    const VectorXcd same = plane_beltrami(before, triangles, before), now = plane_beltrami(before, triangles, after);
    return static_cast<std::size_t>(((same.array().abs() < 1.0) && !(now.array().abs() < 1.0)).count());
}

/// The domain laid over b's circles, in the order of a's loops, with its landmarks near their places.
TemplateStart laid_over(const CompactDomain& domain, const std::vector<Circle>& goal, const Held& held,
                        PlanarPoints& undistorted, const ExecutionContext& context)
{
    const Triangles& triangles = domain.surface.triangles;
    std::vector<int> own = numbers_below<int>(goal.size());
    TemplateStart start = lay_over_template(domain.circles, goal, own, triangles, domain.surface.uv, context);
    Moebius symmetry;
    AlignedDomain laid =
        lay_by_landmarks(triangles, start.uv, goal, held.of(start.uv, triangles), held.places, symmetry);
    for (std::size_t k = 1; k < goal.size(); ++k) start.circles[k] = symmetry(start.circles[k]);
    start.uv = std::move(laid.uv);
    undistorted = std::move(laid.undistorted);
    return start;
}

/// Corners of a quadrilateral: four vertices of the only rim, in its order; or nothing.
std::optional<std::array<Index, 4>> four_corners(const CompactDomain& domain, const CutMesh& mesh)
{
    if (domain.loops.size() != 1 || mesh.vertex.size() != 4) return {};
    std::array<Index, 4> corners{};
    std::size_t found = 0;
    for (const Index v : domain.loops[0])
        if (std::ranges::find(mesh.vertex, v) != mesh.vertex.end()) corners[found++] = v;
    if (found < 4) return {};
    return corners;
}

/// K from a modulus that alone describes the domains: of a ring, or of a disk with four corners.
std::optional<double> dilatation_by_modulus(const CompactDomain& domain, const std::vector<Circle>& b,
                                            const CutMesh& mesh, const PlanarPoints& from, const PlanarPoints& to)
{
    double ratio = 1.0;
    if (b.size() == 2 && mesh.vertex.empty()) {
        ratio = conformal_separation(domain.circles[0], domain.circles[1]) / conformal_separation(b[0], b[1]);
    } else if (const auto corners = four_corners(domain, mesh)) {
        const auto modulus = [&](const PlanarPoints& uv) {
            std::array<Complex, 4> places{};
            for (std::size_t i = 0; i < 4; ++i) places[i] = complex_at(uv, (*corners)[i]);
            return rectangle_modulus(places);
        };
        ratio = modulus(from) / modulus(to);
    } else {
        return {};
    }
    return std::max(ratio, 1.0 / ratio);
}

/// b's circles in the order of a's loops. @param inverse a's loop for each of b's
std::vector<Circle> in_order_of(const std::vector<int>& inverse, const std::vector<Circle>& b)
{
    std::vector<Circle> result(b.size());
    for (std::size_t k = 0; k < b.size(); ++k) result[static_cast<std::size_t>(inverse[k])] = b[k];
    return result;
}

TeichmuellerMap extremal_map(const OrderedDomain& domain, const std::vector<Circle>& b, const std::vector<int>& inverse,
                             const Held& held, ExecutionContext& context)
{
    const Triangles& triangles = domain.surface.triangles;
    const std::vector<Circle> goal = in_order_of(inverse, b);
    TeichmuellerMap result;
    std::vector<Index> of_b(b.size());  // b's loop for each of the domain's
    for (std::size_t k = 0; k < b.size(); ++k) of_b[static_cast<std::size_t>(inverse[k])] = static_cast<Index>(k);
    result.match.assign(b.size(), 0);
    for (std::size_t k = 0; k < b.size(); ++k) result.match[domain.given[k]] = of_b[k];
    PlanarPoints undistorted;
    const TemplateStart start = laid_over(domain, goal, held, undistorted, context);
    PlanarPoints uv = start.uv;
    if (!same_circles(start.circles, goal)) {
        require_wide_circles(domain.circles, domain.given, "a's");
        require_wide_circles(goal, of_b, "b's");
        const BendingInput input{triangles,
                                 domain.loops,
                                 domain.off_circle,
                                 undistorted,
                                 start.uv,
                                 domain.areas,
                                 std::vector<TemplateRim>(b.size())};
        context.begin_stage("fit", 0.05, held.points.empty() ? 0.95 : 0.4);
        Extremal extremal{.powers = {2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0}, .free_rims = true};
        if (!held.points.empty()) extremal = {};
        BendingResult bent = bend_between(input, start.circles, goal, extremal, context);
        if (!bent.arrived) {
            for (Index& k : bent.blocked) k = domain.given[k];
            std::ranges::sort(bent.blocked);
            refuse_teichmueller(bent.reached, std::move(bent.blocked));
        }
        uv = std::move(bent.uv);
        result.straight = bent.straight;
        result.newton_steps = bent.newton_steps;
    }
    CutMesh mesh{triangles, {}, {}, {}};
    PlanarPoints from = undistorted;
    if (!held.points.empty()) {
        context.begin_stage("landmarks", 0.4, 0.95);
        LandmarkMap map =
            map_with_landmarks(domain.surface, goal, undistorted, uv, held.points, held.places, true, context);
        mesh = std::move(map.mesh);
        mesh.triangles = std::move(map.triangles);
        uv = std::move(map.uv);
        from = mesh.extended(undistorted, triangles);
    }
    context.begin_stage("finish", 0.95, 1.0);
    result.flipped = newly_folded(mesh.triangles, from, uv);
    if (result.flipped > 0) refuse_teichmueller(1.0, {});
    const VectorXcd mu = plane_beltrami(from, mesh.triangles, uv);
    result.mu = VectorXd::Zero(triangles.rows());
    for (Eigen::Index f = 0; f < mu.size(); ++f) {
        double& most = result.mu[mesh.face.empty() ? f : mesh.face[static_cast<std::size_t>(f)]];
        most = std::max(most, std::abs(mu[f]));
    }
    const double most = (mu.array().abs() < 1.0).select(mu.cwiseAbs(), 0.0).maxCoeff();
    result.largest = (1.0 + most) / (1.0 - most);
    // K: from moduli, from the circles alone, or with landmarks from this map.
    if (const auto exact = dilatation_by_modulus(domain, b, mesh, from, uv)) {
        result.lower = result.dilatation = *exact;
    } else {
        require_fine_gaps(domain.circles, domain, domain.surface.uv, "a");
        require_fine_gaps(goal, domain, uv, "b");
        DilatationBounds bounds;
        if (!mesh.vertex.empty()) {
            std::vector<Index> marks = mesh.vertex;
            sort_unique(marks);
            bounds = dilatation_bounds(mesh.triangles, from, start.circles, domain.loops, marks, mu);
            bounds.lower = std::max(bounds.lower, separation_bound(domain.circles, goal));
            bounds.upper = std::max(bounds.upper, bounds.lower);
        } else if (!same_circles(start.circles, goal)) {
            bounds = domain_dilatation(domain.circles, goal, context);
        }
        // This map is an upper bound too. It counts only where it is clearly better: its mesh is not the circles'.
        if (bounds.upper > 1.1 * result.largest) bounds.upper = std::max(result.largest, bounds.lower);
        result.lower = bounds.lower;
        result.dilatation = bounds.dilatation();
    }
    result.largest = std::max(result.largest, result.dilatation);
    result.uv = uv.topRows(domain.surface.uv.rows());
    context.advance(1.0);
    return result;
}

/// The least K of all matches. Maps are computed by rising lower bounds, until no bound is below the least K.
TeichmuellerMap least_map(const OrderedDomain& domain, const std::vector<Circle>& b, ExecutionContext& context)
{
    constexpr std::size_t most_maps = 100;
    std::optional<TeichmuellerMap> best;
    std::exception_ptr error;
    std::vector<std::vector<int>> refused;
    std::size_t tried = 0;
    context.begin_stage("fit", 0.0, 1.0);
    ExecutionContext inner({}, {}, [&context] { context.checkpoint(); });
    /// Calls a function. @return whether it was not refused
    const auto succeeds = [&error](auto&& call) {
        try {
            call();
            return true;
        } catch (const OutOfMemory&) {
            throw;
        } catch (const SolverError&) {
            if (!error) error = std::current_exception();
            return false;
        }
    };
    const auto attempt = [&](const std::vector<int>& inverse) {
        context.advance(static_cast<double>(tried) / most_maps);
        if (++tried > most_maps) refuse_long_search();
        const bool found = succeeds([&] {
            TeichmuellerMap map = extremal_map(domain, b, inverse, {}, inner);
            if (!best || map.dilatation < best->dilatation) best = std::move(map);
        });
        if (!found) refused.push_back(inverse);
    };
    const auto may_beat = [&](double dilatation, const std::vector<int>& inverse) {
        DilatationBounds bounds{.lower = 0.0, .upper = 0.0, .q = {}};
        succeeds([&] { bounds = domain_dilatation(domain.circles, in_order_of(inverse, b), inner); });
        return bounds.dilatation() < dilatation;
    };
    const std::vector<int> first = inverse_match(domain, b, {}, {}, context);
    attempt(first);
    const double limit = best ? best->dilatation : std::numeric_limits<double>::infinity();
    for (const auto& [bound, inverse] : bounded_matches(b, domain.circles, limit, context)) {
        if (best && bound >= best->dilatation) break;
        if (inverse != first) attempt(inverse);
    }
    if (!best) std::rethrow_exception(error);
    // K depends on the circles alone: without a map it still tells that a match is not the one with the least K.
    for (const std::vector<int>& inverse : refused) best->refused += may_beat(best->dilatation, inverse);
    context.advance(1.0);
    return *best;
}

}  // namespace

TeichmuellerMap teichmueller_map(const MappedSurface& a, const std::vector<Circle>& b,
                                 const TeichmuellerOptions& options, ExecutionContext& context)
{
    return run_detachable<TeichmuellerMap>(context, [a, b, options](ExecutionContext& own) {
        fix_product_blocks();
        require_own_circles(a.loops);
        if (options.least_match && !(options.match.empty() && options.landmarks.empty()))
            throw InputError("the search for the least match has neither a match nor landmarks");
        const OrderedDomain domain = ordered(a);
        require_equally_many(domain.circles, b);
        const Held held = held_points(options.landmarks);
        TeichmuellerMap map =
            options.least_match
                ? least_map(domain, b, own)
                : extremal_map(domain, b, inverse_match(domain, b, options.match, held, own), held, own);
        PlanarPoints uv = PlanarPoints::Zero(a.uv.rows(), 2);
        uv(domain.original, Eigen::all) = map.uv;
        map.uv = std::move(uv);
        return map;
    });
}

}  // namespace koebe
