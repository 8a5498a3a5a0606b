#include "certified/polygonal_circles.h"

#include "certified/capacities.h"
#include "certified/circle_bounds.h"
#include "certified/circle_capacities.h"
#include "core/errors.h"
#include "execution/detachable_run.h"
#include "linear/dense_spd.h"
#include "mesh/loop_with.h"
#include "mesh/topology.h"
#include "shape/conformal_module.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double wanted_width = 3e-4;  // of an enclosure, of the largest capacity: the circles then change by 1e-4
constexpr double wanted_error = 1e-6;  // of harmonic measures of circles: far below the widths
constexpr double settled = 1e-4;       // change of the module, a length in the disk: what is left goes with its square
constexpr int most_steps = 30;
constexpr double ring_capacity = 2.0 * std::numbers::pi;  // of a ring, times the log of the ratio of its radii

/// Capacities of circles whose numbers are the loops' numbers.
class Capacities {
public:
    Capacities(const Surface& surface, const std::vector<LoopReport>& loops)
        : of_loops_(loop_condensers(static_cast<int>(loops.size()))), of_circles_(of_loops_)
    {
        std::vector<int> circle_of(loops.size());
        for (std::size_t k = 0; k < loops.size(); ++k)
            circle_of[loop_with(surface.loops, loops[k].vertices.front())] = static_cast<int>(k);
        for (Condenser& condenser : of_circles_)
            for (std::vector<int>* numbers : {&condenser.at_zero, &condenser.at_one})
                for (int& loop : *numbers) loop = circle_of[loop];
    }

    const std::vector<Condenser>& of_loops() const { return of_loops_; }

    VectorXd of_module(const VectorXd& module, ExecutionContext& context) const
    {
        if (module.size() == 1) return VectorXd::Constant(1, -ring_capacity / std::log(module[0]));
        return CircleCapacities(module, wanted_error, context).values(of_circles_);
    }

    /// The modules with these capacities, and with others nearby. @param near where to begin
    std::pair<VectorXd, VectorXd> modules_with(const VectorXd& wanted, const VectorXd& others, const VectorXd& near,
                                               ExecutionContext& context) const
    {
        if (near.size() == 1)
            return {VectorXd::Constant(1, std::exp(-ring_capacity / wanted[0])),
                    VectorXd::Constant(1, std::exp(-ring_capacity / others[0]))};
        VectorXd module = near;
        for (int step = 0; step < most_steps; ++step) {
            // With n loops the capacities are more than the module's 3n - 6 numbers: least squares of relative errors.
            const CircleCapacities now(module, wanted_error, context);
            const VectorXd gap = (wanted - now.values(of_circles_)).cwiseQuotient(wanted);
            const MatrixXd slopes = wanted.cwiseInverse().asDiagonal() * now.gradients(of_circles_);
            const auto factored = slopes.colPivHouseholderQr();
            const VectorXd change = factored.solve(gap);
            module = moved_module(module, change);
            require_circle_domain(circles_of_module(module));
            if (change.cwiseAbs().maxCoeff() < settled)
                return {module, module + factored.solve((others - wanted).cwiseQuotient(wanted))};
        }
        throw SolverError("the circles of the polyhedron were not found: the steps towards them do not settle");
    }

private:
    std::vector<Condenser> of_loops_, of_circles_;
};

}  // namespace

const char* to_string(RimKind rims) noexcept
{
    constexpr std::array words{"smooth", "polygonal", "extrapolated"};
    return words[static_cast<std::size_t>(rims)];
}

PolygonalCircles polygonal_circles(const Vertices& vertices, const Triangles& triangles,
                                   const std::vector<LoopReport>& loops, int threads, ExecutionContext& context)
{
    require_own_circles(loops);
    std::vector<Circle> circles;
    for (const LoopReport& loop : loops) circles.push_back(loop.circle);
    const VectorXd near = conformal_module(circles);
    if (loops.size() == 1) return {circles, circles};
    if (loops.size() > most_polygonal_loops)
        throw InputError("with polygonal rims a surface may have " + std::to_string(most_polygonal_loops) +
                             " loops at most, and this one has " + std::to_string(loops.size()) +
                             ": take smooth rims (numbers of the further loops listed)",
                         ElementKind::loops, [&] {
                             std::vector<Index> further;
                             for (std::size_t k = most_polygonal_loops; k < loops.size(); ++k)
                                 further.push_back(static_cast<Index>(k));
                             return further;
                         }());

    // Capacities of the polyhedron between its loops, enclosed.
    const Capacities capacities(require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows())), loops);
    const VectorXd expected = run_detachable<VectorXd>(
        context, [capacities, near](ExecutionContext& own) { return capacities.of_module(near, own); });
    CapacityOptions options{.width = wanted_width * expected.maxCoeff()};
    options.threads = threads;
    const CapacityReport report = certified_capacities(vertices, triangles, capacities.of_loops(), options, context);

    // The circles with these capacities.
    VectorXd middle(expected.size()), upper(expected.size());
    for (Eigen::Index c = 0; c < expected.size(); ++c) {
        const Interval& value = report.capacities[static_cast<std::size_t>(c)].value;
        middle[c] = 0.5 * (value.lower + value.upper);
        upper[c] = value.upper;
    }
    return run_detachable<PolygonalCircles>(context, [=](ExecutionContext& own) {
        fix_product_blocks();
        const auto [found, of_upper] = capacities.modules_with(middle, upper, near, own);
        return PolygonalCircles{circles_of_module(found), circles_of_module(of_upper)};
    });
}

std::vector<Circle> extrapolated_circles(const std::vector<Circle>& given, const std::vector<Circle>& refined)
{
    const VectorXd coarse = conformal_module(given);
    if (coarse.size() == 0) return given;
    std::vector<Circle> circles = circles_of_module((4.0 * conformal_module(refined) - coarse) / 3.0);
    try {
        require_circle_domain(circles);
    } catch (const InputError&) {
        throw SolverError("the mesh is too coarse to extrapolate from: circles would meet");
    }
    return circles;
}

VectorXd polygonal_changes(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                           const std::vector<LoopReport>& loops)
{
    // The turn of the rim at each vertex: pi minus the angles of its faces.
    VectorXd turn = VectorXd::Constant(vertices.rows(), std::numbers::pi);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index at = triangles(f, k);
            const Eigen::RowVector3d a = vertices.row(triangles(f, (k + 1) % 3)) - vertices.row(at);
            const Eigen::RowVector3d b = vertices.row(triangles(f, (k + 2) % 3)) - vertices.row(at);
            turn[at] -= std::atan2(a.cross(b).norm(), a.dot(b));
        }

    // Each circle moves towards its centre by the mean distance of its arcs from their chords.
    VectorXd change(static_cast<Eigen::Index>(loops.size()));
    for (std::size_t k = 0; k < loops.size(); ++k) {
        const VertexLoop& loop = loops[k].vertices;
        double moved = 0.0, length = 0.0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index a = loop[i], b = loop[(i + 1) % loop.size()];
            const double chord = (uv.row(b) - uv.row(a)).norm();
            moved += chord * chord * 0.5 * (turn[a] + turn[b]) / 12.0;
            length += chord;
        }
        change[static_cast<Eigen::Index>(k)] = (k == 0 ? -1.0 : 1.0) * moved / length / loops[k].circle.radius;
    }
    // Holes turn the other way round: their turns are negative, and so are their changes. The disk's rim grows back.
    const double rim = change[0];
    change[0] = 0.0;
    for (Eigen::Index k = 1; k < change.size(); ++k) change[k] -= rim;
    return change;
}

}  // namespace koebe
