#include "fit/teichmueller.h"

#include "core/counted.h"
#include "core/errors.h"
#include "execution/detachable_run.h"
#include "fit/bend_between.h"
#include "fit/circle_template.h"
#include "fit/dilatation_bounds.h"
#include "fit/plane_beltrami.h"
#include "fit/template_start.h"
#include "linear/dense_spd.h"
#include "shape/conformal_module.h"
#include "shape/loop_matching.h"
#include "surface/laplacian.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace koebe {
namespace {

/// A surface without the vertices that no face uses.
struct CompactDomain {
    std::vector<Index> original;  // vertex of the surface for each vertex
    Triangles triangles;
    std::vector<VertexLoop> loops;
    std::vector<Index> off_circle;
    std::vector<Circle> circles;
    PlanarPoints uv;
    VectorXd areas;  // on the surface
};

CompactDomain compact(const MappedSurface& surface)
{
    CompactDomain domain;
    std::vector<Index> place(static_cast<std::size_t>(surface.uv.rows()), -1);
    for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) place[surface.triangles.data()[i]] = 0;
    for (std::size_t v = 0; v < place.size(); ++v)
        if (place[v] == 0) {
            place[v] = static_cast<Index>(domain.original.size());
            domain.original.push_back(static_cast<Index>(v));
        }
    domain.triangles = surface.triangles.unaryExpr([&](Index v) { return place[v]; });
    for (const LoopReport& loop : surface.loops) {
        domain.circles.push_back(loop.circle);
        domain.loops.emplace_back();
        for (const Index v : loop.vertices) domain.loops.back().push_back(place[v]);
        for (const Index v : loop.off_circle) domain.off_circle.push_back(place[v]);
    }
    std::ranges::sort(domain.off_circle);
    domain.uv = surface.uv(domain.original, Eigen::all);
    const EdgeLengths lengths = edge_lengths(surface.vertices, surface.triangles);
    domain.areas.resize(lengths.rows());
    for (Eigen::Index f = 0; f < lengths.rows(); ++f)
        domain.areas[f] = triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
    return domain;
}

/// a's loop for each of b's.
std::vector<int> inverse_match(const std::vector<Circle>& a, const std::vector<Circle>& b,
                               const std::vector<int>& match, const ExecutionContext& context)
{
    if (a.size() != b.size())
        throw InputError("the domains have " + std::to_string(a.size()) + " and " + counted(b.size(), "loop") +
                         ": no map takes one to the other");
    require_circle_domain(a);
    require_circle_domain(b);
    std::vector<int> inverse(b.size(), 0);
    if (match.empty()) {
        const LoopMatch found = match_loops(a, b, false, context);
        for (std::size_t k = 0; k < b.size(); ++k) inverse[found.order_b[k]] = found.order_a[k];
        return inverse;
    }
    std::vector<int> all(b.size());
    std::iota(all.begin(), all.end(), 0);
    if (!std::is_permutation(all.begin(), all.end(), match.begin(), match.end()) || match[0] != 0)
        throw InputError("the match must name each of the loops of b once, the outer one first");
    for (std::size_t k = 0; k < b.size(); ++k) inverse[match[k]] = static_cast<int>(k);
    return inverse;
}

/// Whether the circles already lie at their places.
bool has_arrived(const std::vector<Circle>& circles, const std::vector<Circle>& goal)
{
    constexpr double near_enough = 1e-9;  // disk units
    for (std::size_t k = 0; k < goal.size(); ++k)
        if (std::abs(circles[k].center - goal[k].center) + std::abs(circles[k].radius - goal[k].radius) > near_enough)
            return false;
    return true;
}

/// Circles that are too small take thousands of steps to shrink to, as no face fits beside them.
void require_wide_circles(const std::vector<Circle>& circles, const char* whose)
{
    for (std::size_t k = 0; k < circles.size(); ++k)
        if (!(circles[k].radius >= least_template_gap))
            throw InputError(std::string(whose) + " circle " + std::to_string(k) + " has the radius " +
                                 formatted("%.3g", circles[k].radius) + ": an extremal map needs 1e-6 at least",
                             ElementKind::loops, {static_cast<Index>(k)});
}

[[noreturn]] void refuse_teichmueller(double reached, std::vector<Index> blocked)
{
    throw SolverError("no one-to-one map of one domain to the other was found: faces turn over at " +
                          formatted("%.3g", 100.0 * reached) + " % of the way. The mesh is too coarse between holes",
                      blocked.empty() ? ElementKind::none : ElementKind::loops, std::move(blocked));
}

std::size_t newly_folded(const Triangles& triangles, const PlanarPoints& before, const PlanarPoints& after)
{
    const VectorXcd same = plane_beltrami(before, triangles, before), now = plane_beltrami(before, triangles, after);
    return static_cast<std::size_t>(((same.array().abs() < 1.0) && !(now.array().abs() < 1.0)).count());
}

TeichmuellerMap extremal_map(const MappedSurface& a, const std::vector<Circle>& b, const std::vector<int>& match,
                             ExecutionContext& context)
{
    require_own_circles(a.loops);
    context.begin_stage("align", 0.0, 0.05);
    const CompactDomain domain = compact(a);
    const std::vector<int> inverse = inverse_match(domain.circles, b, match, context);
    const TemplateStart start = lay_over_template(domain.circles, b, inverse, domain.triangles, domain.uv, context);
    std::vector<Circle> goal(b.size());
    TeichmuellerMap result;
    result.match.assign(b.size(), 0);
    for (std::size_t k = 0; k < b.size(); ++k) {
        goal[static_cast<std::size_t>(inverse[k])] = b[k];
        result.match[static_cast<std::size_t>(inverse[k])] = static_cast<int>(k);
    }
    PlanarPoints uv = start.uv;
    if (!has_arrived(start.circles, goal)) {
        require_wide_circles(domain.circles, "a's");
        require_wide_circles(b, "b's");
        const BendingInput input{domain.triangles,
                                 domain.loops,
                                 domain.off_circle,
                                 start.uv,
                                 start.uv,
                                 domain.areas,
                                 std::vector<TemplateRim>(b.size())};
        const Extremal extremal{.powers = {2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0}, .free_rims = true};
        context.begin_stage("fit", 0.05, 0.95);
        BendingResult bent = bend_between(input, start.circles, goal, extremal, context);
        if (!bent.arrived) refuse_teichmueller(bent.reached, std::move(bent.blocked));
        uv = std::move(bent.uv);
        result.straight = bent.straight;
        result.newton_steps = bent.newton_steps;
    }
    context.begin_stage("finish", 0.95, 1.0);
    result.flipped = newly_folded(domain.triangles, start.uv, uv);
    if (result.flipped > 0) refuse_teichmueller(1.0, {});
    const VectorXcd mu = plane_beltrami(start.uv, domain.triangles, uv);
    result.mu = mu.cwiseAbs();
    const double most = (result.mu.array() < 1.0).select(result.mu, 0.0).maxCoeff();
    result.largest = (1.0 + most) / (1.0 - most);
    const DilatationBounds bounds = dilatation_bounds(domain.triangles, start.uv, domain.loops, mu);
    result.lower = std::min(bounds.lower, result.largest);
    result.dilatation = std::clamp(std::sqrt(bounds.lower * bounds.upper), result.lower, result.largest);
    if (b.size() == 2) {
        const double ratio =
            conformal_separation(domain.circles[0], domain.circles[1]) / conformal_separation(b[0], b[1]);
        result.lower = result.dilatation = std::max(ratio, 1.0 / ratio);
        result.largest = std::max(result.largest, result.dilatation);
    }
    result.uv = PlanarPoints::Zero(a.uv.rows(), 2);
    result.uv(domain.original, Eigen::all) = uv;
    context.advance(1.0);
    return result;
}

/// cosh of the hyperbolic distance, minus 1.
double half_plane_gap(Complex a, Complex b) { return std::norm(a - b) / (2.0 * a.imag() * b.imag()); }

/// In the fundamental domain of the modular group.
Complex reduced_modulus(Complex tau)
{
    for (int i = 0; i < 10000; ++i) {
        tau -= std::round(tau.real());
        if (std::norm(tau) >= 1.0) return tau;
        tau = -1.0 / tau;
    }
    throw InputError("the modulus of the torus is too near the real axis");
}

}  // namespace

TeichmuellerMap teichmueller_map(const MappedSurface& a, const std::vector<Circle>& b, const std::vector<int>& match,
                                 ExecutionContext& context)
{
    return run_detachable<TeichmuellerMap>(context, [a, b, match](ExecutionContext& own) {
        fix_product_blocks();
        return extremal_map(a, b, match, own);
    });
}

double torus_dilatation(Complex a, Complex b)
{
    for (const Complex tau : {a, b})
        if (!std::isfinite(tau.real()) || !std::isfinite(tau.imag()) || !(tau.imag() > 0.0))
            throw InputError("the modulus of a torus is a number above the real axis");
    Complex z = reduced_modulus(a), w = reduced_modulus(b);
    if (z.imag() < w.imag()) std::swap(z, w);
    double least = half_plane_gap(z, w);
    if (!(least < 1e100)) throw InputError("the moduli of the tori are too far apart");
    // An image of w at a distance d has at least the height of z over exp(d): finitely many (c, d).
    const double reach = w.imag() / z.imag() * (1.0 + least + std::sqrt(least * (least + 2.0)));
    const auto most_c = static_cast<long>(std::sqrt(reach) / w.imag());
    for (long c = 0; c <= most_c; ++c) {
        const double wide = std::sqrt(std::max(reach - std::pow(static_cast<double>(c) * w.imag(), 2), 0.0));
        const double middle = -static_cast<double>(c) * w.real();
        for (auto d = static_cast<long>(std::floor(middle - wide)); d <= static_cast<long>(std::ceil(middle + wide));
             ++d) {
            if (std::gcd(c, d) != 1) continue;
            // The first row (p, q) with p d - q c = 1, up to a shift.
            long p = d, q = 0;
            if (c != 0) {
                const long size = c;
                for (p = 0; p < size && ((p * d - 1) % size + size) % size != 0;) ++p;
                q = (p * d - 1) / c;
            }
            const Complex image = (static_cast<double>(p) * w + static_cast<double>(q)) /
                                  (static_cast<double>(c) * w + static_cast<double>(d));
            least = std::min(least, half_plane_gap(z, image + std::round((z - image).real())));
        }
    }
    return 1.0 + least + std::sqrt(least * (least + 2.0));
}

}  // namespace koebe
