#include "fit/fit_circles.h"

#include "bending/bend_between.h"
#include "circles/same_circles.h"
#include "core/counted.h"
#include "core/errors.h"
#include "execution/detachable_run.h"
#include "execution/thread_share.h"
#include "fit/plane_beltrami.h"
#include "fit/template_start.h"
#include "foldover/untangle.h"
#include "mesh/loop_with.h"
#include "pipeline/final_check.h"
#include "pipeline/map_input.h"
#include "pipeline/map_report.h"
#include "pipeline/map_warnings.h"
#include "pipeline/uniformize.h"
#include "planar/boundary_crossings.h"
#include "quality/map_clock.h"
#include "quality/take_verdict.h"
#include "surface/laplacian.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

/// The template in the order of the surface's loops.
struct Goal {
    std::vector<Circle> circles;    // the unit circle first
    std::vector<TemplateRim> rims;  // with vertices of the prepared surface
};

void require_as_many(const CircleTemplate& wanted, std::size_t loops)
{
    if (wanted.circles.size() + 1 != loops)
        throw InputError("the template has " + counted(wanted.circles.size(), "circle") + ", and the surface has " +
                         counted(loops - 1, "hole") + " besides its outer boundary");
    for (const int rank : wanted.loops)
        if (rank < 0 || rank >= static_cast<int>(loops))
            throw InputError("the template names the loop " + std::to_string(rank) + ", and the surface has " +
                                 counted(loops, "loop") + ", counted from 0",
                             ElementKind::loops, {rank});
}

/// Makes the loop that no circle names the outer loop.
void choose_outer_loop(const Surface& surface, const CircleTemplate& wanted, UniformizeOptions& options)
{
    if (wanted.loops.empty()) {
        if (!wanted.outer.pin) return;
        options.outer = OuterLoop::vertex;
        options.outer_vertex = wanted.outer.pin->vertex;
        return;
    }
    for (std::size_t rank = 0; rank < surface.loops.size(); ++rank)
        if (std::ranges::find(wanted.loops, static_cast<int>(rank)) == wanted.loops.end()) {
            options.outer = OuterLoop::vertex;
            options.outer_vertex = surface.loops[rank].front();
        }
}

std::vector<Circle> with_unit_circle(const std::vector<Circle>& holes)
{
    std::vector<Circle> circles{Circle{}};
    circles.insert(circles.end(), holes.begin(), holes.end());
    return circles;
}

/// For each circle of the template the place of its loop in the prepared surface; empty if loops are not given. A
/// pinned vertex names its loop, too.
std::vector<int> given_match(const MapInput& whole, const CircleTemplate& wanted)
{
    if (wanted.loops.empty()) return {};
    std::vector<int> match(wanted.circles.size() + 1, 0);
    for (std::size_t k = 0; k < whole.loops.size(); ++k) {
        const auto place = std::ranges::find(wanted.loops, rank_by_lowest_vertex(whole, whole.loops[k]));
        if (place != wanted.loops.end())
            match[static_cast<std::size_t>(place - wanted.loops.begin()) + 1] = static_cast<int>(k);
    }
    return match;
}

/// The rim with its vertex in the prepared surface's numbers.
TemplateRim rim_of(const MapInput& whole, const TemplateRim& given, std::size_t loop)
{
    TemplateRim rim = given;
    if (!rim.pin) return rim;
    const Index named = rim.pin->vertex;
    const auto on_loop = std::ranges::find(whole.loops[loop], named, [&](Index v) { return whole.original[v]; });
    if (on_loop == whole.loops[loop].end())
        throw InputError("the pinned vertex " + std::to_string(named) + " is not on the loop of its circle",
                         ElementKind::vertices, {named});
    rim.pin->vertex = *on_loop;
    return rim;
}

Goal goal_of(const MapInput& whole, const CircleTemplate& wanted, const std::vector<int>& match)
{
    const std::vector<Circle> circles = with_unit_circle(wanted.circles);
    Goal goal{std::vector<Circle>(circles.size()), std::vector<TemplateRim>(circles.size())};
    for (std::size_t k = 0; k < circles.size(); ++k) {
        const auto own = static_cast<std::size_t>(match[k]);
        goal.circles[own] = circles[k];
        if (k == 0)
            goal.rims[own] = rim_of(whole, wanted.outer, own);
        else if (!wanted.rims.empty())
            goal.rims[own] = rim_of(whole, wanted.rims[k - 1], own);
    }
    return goal;
}

/// The circles of the template that these loops of the surface go to.
std::vector<Index> template_circles(const std::vector<Index>& loops, const std::vector<int>& match)
{
    std::vector<Index> circles;
    for (std::size_t k = 1; k < match.size(); ++k)
        if (std::ranges::find(loops, static_cast<Index>(match[k])) != loops.end())
            circles.push_back(static_cast<Index>(k) - 1);
    return circles;
}

[[noreturn]] void refuse(const std::string& why, const std::vector<Index>& circles)
{
    std::string sentence = "no one-to-one map to the template was found: " + why;
    if (!circles.empty()) sentence += ", the first at circle " + std::to_string(circles.front());
    throw SolverError(sentence + ". The mesh is too coarse for this template, or too coarse between these holes: "
                                 "subdivide its faces there, or place the circles farther apart",
                      circles.empty() ? ElementKind::none : ElementKind::loops, circles);
}

BendingResult bend_to(const BendingInput& input, const std::vector<Circle>& from, const Goal& goal,
                      const std::vector<int>& match, bool extremal, ExecutionContext& context)
{
    Extremal least;
    if (extremal) least.powers = {2.0, 4.0, 8.0, 16.0};
    BendingResult result = bend_between(input, from, goal.circles, least, context);
    if (result.arrived) return result;
    refuse("faces turn over at " + formatted("%.3g", 100.0 * result.reached) + " % of the way",
           template_circles(result.blocked, match));
}

VectorXd surface_areas(const Vertices& vertices, const Triangles& triangles)
{
    const EdgeLengths lengths = edge_lengths(vertices, triangles);
    VectorXd areas(triangles.rows());
    for (Eigen::Index f = 0; f < areas.size(); ++f)
        areas[f] = triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
    return areas;
}

/// (F) |mu| of each face; 1 for faces that the map turns over, or that have no area.
VectorXd face_mu(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv)
{
    const FlatFaces faces(vertices, triangles);
    VectorXd mu(triangles.rows());
    for (Eigen::Index f = 0; f < mu.size(); ++f) {
        const FlatTriangle flat = faces(f);
        const Complex a(uv(triangles(f, 1), 0) - uv(triangles(f, 0), 0),
                        uv(triangles(f, 1), 1) - uv(triangles(f, 0), 1));
        const Complex b(uv(triangles(f, 2), 0) - uv(triangles(f, 0), 0),
                        uv(triangles(f, 2), 1) - uv(triangles(f, 0), 1));
        // f(z) = like z + unlike conj(z), up to a common factor.
        const Complex p(flat.p2x, flat.p2y);
        const Complex like = a * std::conj(p) - b * flat.p1x, unlike = b * flat.p1x - a * p;
        const double ratio = std::abs(unlike) / std::abs(like);
        mu[f] = ratio < 1.0 ? ratio : 1.0;
    }
    return mu;
}

FitBeltrami summed(const VectorXd& mu, const VectorXd& areas)
{
    FitBeltrami result;
    const double total = areas.sum();
    if (mu.size() == 0 || !(total > 0.0)) return result;
    result.mean = mu.dot(areas) / total;
    result.root_mean_square = std::sqrt(mu.cwiseAbs2().dot(areas) / total);
    for (Eigen::Index f = 0; f < mu.size(); ++f)
        if (mu[f] < 1.0) result.max = std::max(result.max, mu[f]);
    result.dilatation = (1.0 + result.max) / (1.0 - result.max);
    return result;
}

/// Takes the loops in the template's order, the unit circle first.
void reorder(MapInput& whole, CircleMap& map, const std::vector<int>& match)
{
    const std::vector<VertexLoop> loops = whole.loops;
    const CircleMap before = map;
    for (std::size_t k = 0; k < match.size(); ++k) {
        whole.loops[k] = loops[match[k]];
        map.circles[k] = before.circles[match[k]];
        map.roundness[k] = before.roundness[match[k]];
    }
}

double largest_miss(const MapInput& whole, const CircleMap& map)
{
    double largest = 0.0;
    for (std::size_t k = 0; k < whole.loops.size(); ++k)
        for (const Index v : whole.loops[k])
            if (!std::ranges::binary_search(map.off_circle, v))
                largest =
                    std::max(largest, std::abs(std::abs(Complex(map.uv(v, 0), map.uv(v, 1)) - map.circles[k].center) -
                                               map.circles[k].radius));
    return largest;
}

/// The loops whose polygons have lost half of their share of the circle's area: vertices have gathered on an arc.
std::vector<Index> gathered_rims(const MapInput& whole, const TemplateStart& start, const CircleMap& map)
{
    std::vector<Index> loops;
    const auto share = [](const VertexLoop& loop, const PlanarPoints& uv, const Circle& circle) {
        return std::abs(enclosed_area(loop, uv)) / (circle.radius * circle.radius);
    };
    for (std::size_t k = 0; k < whole.loops.size(); ++k)
        if (share(whole.loops[k], map.uv, map.circles[k]) < 0.5 * share(whole.loops[k], start.uv, start.circles[k]))
            loops.push_back(static_cast<Index>(k));
    return loops;
}

/// Turns back faces that are flipped only as stored.
/// @throws SolverError the map has a fault
void require_faultless(const MapInput& whole, const std::vector<int>& match, CircleMap& map, ExecutionContext& context)
{
    MapFaults faults = find_faults(whole.surface.triangles, whole.loops, map.uv, map.circles);
    if (!faults.flipped.empty()) {
        const UntangleReport untangled =
            untangle(whole.vertices, whole.surface, whole.loops, map.circles, map.off_circle, map.uv, context);
        if (untangled.freed.empty()) faults = find_faults(whole.surface.triangles, whole.loops, map.uv, map.circles);
    }
    if (!faults.any()) return;
    std::vector<Index> loops(faults.bad_circles.begin(), faults.bad_circles.end());
    for (const Index f : faults.flipped)
        for (const Index v : whole.surface.triangles.row(f))
            if (const int k = loop_with(whole.loops, v); k >= 0) loops.push_back(k);
    refuse(faults.flipped.empty() ? "rims cross"
                                  : counted(faults.flipped.size(), "face") + " would be flipped as stored",
           template_circles(loops, match));
}

class FitRun {
public:
    FitRun(const Vertices& vertices, const Triangles& triangles, const CircleTemplate& wanted, FitOptions options)
        : vertices_(vertices), triangles_(triangles), wanted_(wanted), options_(std::move(options))
    {
    }

    FitResult run(ExecutionContext& context)
    {
        require_feasible(wanted_);
        validate_arrays(vertices_, triangles_);
        const Surface surface = require_bordered_genus_zero(triangles_, static_cast<Index>(vertices_.rows()));
        require_as_many(wanted_, surface.loops.size());
        choose_outer_loop(surface, wanted_, options_.map);
        static_cast<UniformizeResult&>(result_) = conformal(context);
        clock_.take(result_.seconds);
        whole_ = prepare_input(vertices_, triangles_, options_.map);
        CircleMap map = conformal_map();
        const TemplateStart start =
            lay_over_template(map.circles, with_unit_circle(wanted_.circles), given_match(whole_, wanted_),
                              whole_.surface.triangles, map.uv, context);
        const Goal goal = goal_of(whole_, wanted_, start.match);
        const bool own = same_circles(start.circles, goal.circles);
        bend(start, goal, map, context);
        report(start, own, map, context);
        clock_.finish(result_, context);
        return std::move(result_);
    }

private:
    UniformizeResult conformal(ExecutionContext& context) const
    {
        ExecutionContext part([&](double fraction, const std::string& stage) { context.report(0.5 * fraction, stage); },
                              {});
        return uniformize_here(vertices_, triangles_, options_.map, part);
    }

    CircleMap conformal_map() const
    {
        CircleMap map;
        map.uv = result_.uv(whole_.original, Eigen::all);
        for (std::size_t k = 0; k < whole_.loops.size(); ++k) {
            const LoopReport& loop = result_.loops[k];
            map.circles.push_back(loop.circle);
            map.roundness.push_back(loop.roundness);
            for (const Index v : whole_.loops[k])
                if (std::ranges::binary_search(loop.off_circle, whole_.original[v])) map.off_circle.push_back(v);
        }
        std::ranges::sort(map.off_circle);
        return map;
    }

    void bend(const TemplateStart& start, const Goal& goal, CircleMap& map, ExecutionContext& context)
    {
        context.begin_stage("fit", 0.5, 0.98);
        areas_ = surface_areas(whole_.vertices, whole_.surface.triangles);
        const bool pinned = std::ranges::any_of(goal.rims, [](const TemplateRim& rim) { return rim.pin.has_value(); });
        undistorted_ = start.uv;
        if (goal.circles.size() > 1 || pinned) {
            const BendingInput input{
                whole_.surface.triangles, whole_.loops, map.off_circle, undistorted_, start.uv, areas_, goal.rims};
            BendingResult bent = bend_to(input, start.circles, goal, start.match, options_.extremal, context);
            map.uv = std::move(bent.uv);
            result_.straight = bent.straight;
            result_.bending_steps = bent.steps;
            result_.newton_steps = bent.newton_steps;
            if (!bent.settled) {
                result_.converged = false;
                result_.warnings.push_back(
                    {WarningKind::not_converged, "the fit ended before its |mu| was least; the map is one to one"});
            }
        }
        map.circles = goal.circles;
        require_faultless(whole_, start.match, map, context);
        if (const std::vector<Index> gathered = gathered_rims(whole_, start, map); !gathered.empty())
            refuse("rims gather on an arc of their circles", template_circles(gathered, start.match));
    }

    void report(const TemplateStart& start, bool own, CircleMap& map, ExecutionContext& context)
    {
        context.begin_stage("report", 0.98, 1.0);
        std::erase_if(result_.warnings, [](const Warning& warning) {
            using enum WarningKind;
            return std::ranges::count(std::vector{flipped, below_resolution, not_one_to_one, lost_area, off_circle},
                                      warning.kind) > 0;
        });
        result_.bending = summed(plane_beltrami(undistorted_, whole_.surface.triangles, map.uv).cwiseAbs(), areas_);
        reorder(whole_, map, start.match);
        result_.residual = largest_miss(whole_, map);
        ConformalDomain conformal{std::move(result_.uv), {}};
        for (const int k : start.match) conformal.loops.push_back(result_.loops[static_cast<std::size_t>(k)]);
        report_map(vertices_, triangles_, whole_, map, result_);
        if (!own) keep_conformal(std::move(conformal), result_);
        result_.names = wanted_.names;
        for (const VertexLoop& loop : whole_.loops) result_.ranks.push_back(rank_by_lowest_vertex(whole_, loop));
        const VectorXd mu = face_mu(whole_.vertices, whole_.surface.triangles, map.uv);
        result_.of_faces = summed(mu, areas_);
        result_.mu = VectorXd::Ones(triangles_.rows());
        for (Eigen::Index f = 0; f < mu.size(); ++f) result_.mu[whole_.original_faces[f]] = mu[f];
        for (Warning& warning : flip_warnings(whole_, map.uv, {}, {}, result_.distortion))
            result_.warnings.push_back(std::move(warning));
        take_verdict({.most_lost = options_.map.most_lost, .done = true}, result_);
    }

    const Vertices& vertices_;
    const Triangles& triangles_;
    const CircleTemplate& wanted_;
    FitOptions options_;
    FitResult result_;
    MapInput whole_;
    PlanarPoints undistorted_;
    VectorXd areas_;
    MapClock clock_;
};

}  // namespace

FitResult fit_circles(const Vertices& vertices, const Triangles& triangles, const CircleTemplate& wanted,
                      const FitOptions& options, ExecutionContext& context)
{
    return run_detachable<FitResult>(context, [vertices, triangles, wanted, options](ExecutionContext& own) {
        const ThreadShare threads(options.map.threads);
        return FitRun(vertices, triangles, wanted, options).run(own);
    });
}

}  // namespace koebe
