#include "certified/module_enclosure.h"

#include "certified/circle_bounds.h"
#include "certified/circle_capacities.h"
#include "certified/interval_functions.h"
#include "core/errors.h"
#include "mesh/loop_with.h"
#include "pipeline/uniformize.h"
#include "shape/conformal_module.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace koebe {
namespace {

constexpr int newton_steps = 20;
constexpr double newton_share = 0.02, error_share = 1e-3;  // of the widest bounds of a capacity
constexpr double least_error = 1e-9;  // of harmonic measures; more terms than it needs add rounding
constexpr int tried_boxes = 40;
constexpr double box_growth = 1.5;
constexpr double sum_rounded_up = 1.0 + 0x1p-50;
constexpr double narrower = 0.9;  // a box that gains less is the last

using Box = std::vector<Interval>;

/// Condensers of circles from those of loops.
std::vector<Condenser> renumbered(std::vector<Condenser> condensers, const std::vector<int>& order)
{
    std::vector<int> circle_of(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) circle_of[order[k]] = static_cast<int>(k);
    for (Condenser& condenser : condensers)
        for (std::vector<int>* loops : {&condenser.at_zero, &condenser.at_one})
            for (int& loop : *loops) loop = circle_of[loop];
    return condensers;
}

/// The numbers of a box, farthest from 0.
VectorXd largest_in(const Box& box)
{
    VectorXd largest(static_cast<Eigen::Index>(box.size()));
    for (std::size_t l = 0; l < box.size(); ++l) largest[static_cast<Eigen::Index>(l)] = box[l].magnitude();
    return largest;
}

VectorXd middle_of(const Box& box)
{
    VectorXd middle(static_cast<Eigen::Index>(box.size()));
    for (std::size_t l = 0; l < box.size(); ++l)
        middle[static_cast<Eigen::Index>(l)] = 0.5 * (box[l].lower + box[l].upper);
    return middle;
}

/// The order in which the nearest other circle is farthest away, in radii.
std::vector<int> roomiest_order(const std::vector<Circle>& circles)
{
    const int count = static_cast<int>(circles.size());
    double most = -1.0;
    std::vector<int> best;
    for (int outer = 0; outer < count; ++outer)
        for (int middle = 0; middle < count; ++middle) {
            if (middle == outer) continue;
            // Which circle is the unit circle, and which lies in the middle; the others do not matter.
            std::vector<int> order{outer, middle};
            for (int k = 0; k < count; ++k)
                if (k != outer && k != middle) order.push_back(k);
            const std::vector<Circle> placed = normalized_circles(circles, order);
            // The smallest gap, in radii of the inner circle.
            double room = std::numeric_limits<double>::infinity();
            for (int i = 1; i < count; ++i)
                for (int j = 0; j < count; ++j) {
                    const double apart = std::abs(placed[i].center - placed[j].center);
                    const double gap =
                        j == 0 ? 1.0 - apart - placed[i].radius : apart - placed[i].radius - placed[j].radius;
                    if (j != i) room = std::min(room, gap / placed[i].radius);
                }
            if (room > most) {
                most = room;
                best = order;
            }
        }
    return best;
}

struct EnclosedCircle {
    Plane<Interval> center;
    Interval radius;
};

/// Under z -> (a z + b) / (c z + d), which takes the domain to bounded places.
EnclosedCircle image_of_circle(const EnclosedCircle& circle, const Plane<Interval>& a, const Plane<Interval>& b,
                               const Plane<Interval>& c, const Plane<Interval>& d)
{
    const Plane<Interval> below_line = c * circle.center + d;
    const Interval size = squared_length(below_line) - squared_length(c) * squared(circle.radius);
    const Interval inverse = size.upper < 0.0 ? -inverse_of(-size) : inverse_of(size);
    const Plane<Interval> center =
        (a * circle.center + b) * conjugate(below_line) - a * conjugate(c) * squared(circle.radius);
    const Interval stretch = square_root(squared_length(a * d - b * c));
    return {center * inverse, circle.radius * stretch * (size.upper < 0.0 ? -inverse : inverse)};
}

/// The module of circles in another order. @param order as in conformal_module
Box reordered(const Box& module, const std::vector<int>& order)
{
    const Plane<Interval> zero, one{1.0, 0.0};
    std::vector<EnclosedCircle> circles(order.size(), {zero, Interval(0.0)});
    circles[0].radius = 1.0;
    for (std::size_t l = 0; l < module.size(); ++l) {
        const CircleStep step = step_of(static_cast<Eigen::Index>(l));
        EnclosedCircle& circle = circles[step.circle];
        if (step.radius != 0.0) circle.radius = module[l];
        if (step.center.real() != 0.0) circle.center.re = module[l];
        if (step.center.imag() != 0.0) circle.center.im = module[l];
    }

    // The outer circle to the unit circle.
    const EnclosedCircle outer = circles[order[0]];
    std::vector<EnclosedCircle> placed{{zero, Interval(1.0)}};
    for (std::size_t k = 1; k < order.size(); ++k) {
        const EnclosedCircle& circle = circles[order[k]];
        placed.push_back(order[0] == 0 ? circle
                                       : image_of_circle(circle, zero, {outer.radius, 0.0}, one, zero - outer.center));
    }

    // The middle one to 0: its hyperbolic centre p goes there.
    const Interval square = squared_length(placed[1].center);
    const Interval sum = Interval(1.0) + square - squared(placed[1].radius);
    const Interval root = square_root(squared(sum) - Interval(4.0) * square);
    const Plane<Interval> p = placed[1].center * (Interval(2.0) * inverse_of(sum + root));
    for (std::size_t k = 1; k < placed.size(); ++k)
        placed[k] = image_of_circle(placed[k], one, zero - p, zero - conjugate(p), one);

    // The third onto the positive y axis.
    const Interval height = square_root(squared_length(placed[2].center));
    const Plane<Interval> turn = Plane<Interval>{0.0, 1.0} * conjugate(placed[2].center) * inverse_of(height);
    Box box{placed[1].radius, height, placed[2].radius};
    for (std::size_t k = 3; k < placed.size(); ++k) {
        const Plane<Interval> center = placed[k].center * turn;
        box.insert(box.end(), {center.re, center.im, placed[k].radius});
    }
    return box;
}

/// The linear function near one module, solved for the module.
class LinearStep {
public:
    LinearStep(const CircleCapacities& circles, const std::vector<Condenser>& condensers)
        : circles_(circles),
          condensers_(condensers),
          values_(circles.values(condensers)),
          gradients_(circles.gradients(condensers)),
          inverse_(gradients_.partialPivLu().inverse())
    {
        if (!inverse_.allFinite()) throw SolverError("the capacities do not determine the circles, to first order");
    }

    /// Holds M (C - C(m_c)) for these capacities, up to what errors() tells.
    Box change(const Box& known) const
    {
        Box sums(known.size());
        for (Eigen::Index l = 0; l < inverse_.rows(); ++l)
            for (Eigen::Index c = 0; c < inverse_.cols(); ++c)
                sums[l] = sums[l] + Interval(inverse_(l, c)) * (known[c] - Interval(values_[c]));
        return sums;
    }

    /// How far m - m_c is from M (C(m) - values), at most, for all modules m in a box. @param reach half of its sides
    VectorXd errors(const VectorXd& reach) const
    {
        const VectorXd of_capacities = circles_.errors(condensers_, reach);
        VectorXd errors(inverse_.rows());
        for (Eigen::Index l = 0; l < inverse_.rows(); ++l) {
            Interval sum;
            for (Eigen::Index c = 0; c < inverse_.cols(); ++c)
                sum = sum + Interval(std::abs(inverse_(l, c))) * Interval(of_capacities[c]);
            for (Eigen::Index m = 0; m < inverse_.rows(); ++m) {
                Interval entry(l == m ? -1.0 : 0.0);
                for (Eigen::Index c = 0; c < inverse_.cols(); ++c)
                    entry = entry + Interval(inverse_(l, c)) * Interval(gradients_(c, m));
                sum = sum + Interval(entry.magnitude()) * Interval(reach[m]);
            }
            errors[l] = std::isfinite(sum.upper) ? sum.upper : std::numeric_limits<double>::infinity();
        }
        return errors;
    }

private:
    const CircleCapacities& circles_;
    const std::vector<Condenser>& condensers_;
    VectorXd values_;
    MatrixXd gradients_, inverse_;
};

/// Newton's method, until what is left is far below the widths of the capacities.
void approach(VectorXd& module, const std::vector<Condenser>& condensers, const Box& known, double width,
              ExecutionContext& context)
{
    for (int i = 0; i < newton_steps; ++i) {
        const CircleCapacities circles(module, width, context);
        const VectorXd change = middle_of(LinearStep(circles, condensers).change(known));
        module = moved_module(module, change);
        require_circle_domain(circles_of_module(module));
        if (change.cwiseAbs().maxCoeff() < width) return;
    }
}

/// Half of the sides of a box that the step takes into itself, if one is found. @param change largest, in each number
std::optional<VectorXd> closed_box(const LinearStep& step, const VectorXd& change)
{
    VectorXd reach = box_growth * (change + step.errors(VectorXd::Zero(change.size())));
    for (int i = 0; i < tried_boxes; ++i) {
        const VectorXd needed = change + step.errors(reach);
        if (!needed.allFinite()) break;
        if ((needed.array() * sum_rounded_up < reach.array()).all()) return reach;
        reach = reach.cwiseMax(box_growth * needed);
    }
    return std::nullopt;
}

}  // namespace

NearModule near_module(const Vertices& vertices, const Surface& surface, int threads, ExecutionContext& context)
{
    UniformizeOptions options;
    options.threads = threads;
    const UniformizeResult result = uniformize_here(vertices, surface.triangles, options, context);
    NearModule near;
    std::vector<Circle> circles;
    for (const LoopReport& loop : result.loops) {
        near.wanted_order.push_back(loop_with(surface.loops, loop.vertices.front()));
        circles.push_back(loop.circle);
    }
    require_circle_domain(circles);
    const std::vector<int> order = roomiest_order(circles);
    near.numbers = conformal_module(circles, order);
    for (const int circle : order) near.order.push_back(near.wanted_order[circle]);
    return near;
}

std::vector<Interval> enclose_module(NearModule& near, const std::vector<Capacity>& capacities,
                                     ExecutionContext& context)
{
    std::vector<Condenser> of_loops;
    Box known;
    for (const Capacity& capacity : capacities) {  // the last one of four loops follows from the others
        if (static_cast<Eigen::Index>(known.size()) == near.numbers.size()) break;
        of_loops.push_back(capacity.condenser);
        known.push_back(capacity.value);
    }
    const std::vector<Condenser> condensers = renumbered(std::move(of_loops), near.order);
    const double widest = std::ranges::max_element(known, {}, &Interval::width)->width();
    approach(near.numbers, condensers, known, newton_share * widest, context);

    const CircleCapacities circles(near.numbers, std::max(error_share * widest, least_error), context);
    const LinearStep step(circles, condensers);
    const Box change = step.change(known);
    const std::optional<VectorXd> closed = closed_box(step, largest_in(change));
    if (!closed) {
        // Exact capacities leave the errors of the circles' own capacities.
        const CircleCapacities finest(near.numbers, least_error, context);
        near.may_narrow = closed_box(LinearStep(finest, condensers), VectorXd::Zero(change.size())).has_value();
        throw SolverError(near.may_narrow
                              ? "the bounds of the capacities are too wide for it: a smaller width may help"
                              : "the capacities of circles so near to each other, or so near to their mirror image, "
                                "are not known well enough: a smaller width does not help");
    }
    VectorXd reach = *closed;
    while (true) {
        const VectorXd errors = step.errors(reach);
        Box box;
        VectorXd now(reach.size());
        for (Eigen::Index l = 0; l < reach.size(); ++l) {
            const Interval offset = change[l] + Interval(-errors[l], errors[l]);
            box.push_back(Interval(near.numbers[l]) + offset);
            now[l] = std::min(reach[l], offset.magnitude());
        }
        if (!(now.maxCoeff() < narrower * reach.maxCoeff())) {
            std::vector<int> order;
            for (const int loop : near.wanted_order)
                order.push_back(static_cast<int>(std::ranges::find(near.order, loop) - near.order.begin()));
            box = reordered(box, order);
            for (const Interval& number : box)
                if (!std::isfinite(number.width())) throw SolverError("the box of the circles is too wide");
            return box;
        }
        reach = now;
    }
}

}  // namespace koebe
