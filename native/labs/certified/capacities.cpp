#include "certified/capacities.h"

#include "certified/bisected_surface.h"
#include "certified/capacity_bounds.h"
#include "certified/condenser.h"
#include "certified/interval_functions.h"
#include "certified/module_enclosure.h"
#include "certified/quadratic_functions.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "execution/detachable_run.h"
#include "execution/memory_limit.h"
#include "execution/thread_share.h"
#include "linear/dense_spd.h"
#include "quality/shared_warnings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr Eigen::Index at_once = 8;            // condensers
constexpr double share_to_cut = 0.6;           // of the gap (Doerfler 1996)
constexpr double least_progress = 0.02;        // of the width; below it rounding is all that is left
constexpr double width_for_circles = 0.01;     // of the wanted width; capacities are refined to it, to find the circles
constexpr double progress_for_circles = 0.25;  // of this width, before a further attempt
constexpr double growth_reserve = 2.0;         // cut faces become four, and their neighbours are cut too

/// Which loops are held, ascending: condensers that hold the same loops share their factors.
std::vector<int> held_loops(const Condenser& condenser)
{
    std::vector<int> held = condenser.at_zero;
    held.insert(held.end(), condenser.at_one.begin(), condenser.at_one.end());
    std::ranges::sort(held);
    return held;
}

void require_condenser(const Condenser& condenser, int loop_count)
{
    const std::vector<int> held = held_loops(condenser);
    if (condenser.at_zero.empty() || condenser.at_one.empty())
        throw InputError("a condenser needs a loop at 0 and a loop at 1");
    if (held.front() < 0 || held.back() >= loop_count)
        throw InputError("a condenser names a loop that is not there: the surface has " + std::to_string(loop_count),
                         ElementKind::loops, {held.front() < 0 ? held.front() : held.back()});
    if (const auto twice = std::ranges::adjacent_find(held); twice != held.end())
        throw InputError("a condenser names a loop twice", ElementKind::loops, {*twice});
}

/// What is known about all numbers so far.
class Enclosures {
public:
    Enclosures(const std::vector<Condenser>& condensers, int loop_count) : ring_(loop_count == 2)
    {
        for (const Condenser& condenser : condensers)
            report_.capacities.push_back({condenser, {0.0, std::numeric_limits<double>::infinity()}});
    }

    void narrow(std::size_t c, const Interval& bounds)
    {
        Interval& known = report_.capacities[c].value;
        if (!(std::isfinite(bounds.lower) && std::isfinite(bounds.upper)))
            throw SolverError("rounding leaves no bound of a capacity: faces are too thin");
        known = {std::max(known.lower, bounds.lower), std::min(known.upper, bounds.upper)};
        if (known.lower > known.upper) throw SolverError("bounds of a capacity contradict each other");
    }

    void end_level(Index faces)
    {
        ++report_.levels;
        report_.faces = faces;
        report_.width = 0.0;
        for (const Capacity& capacity : report_.capacities) add_width(capacity.value);
        if (!ring_ || report_.capacities.empty()) return;
        report_.modulus = Interval(1.0) / report_.capacities[0].value;
        report_.module = {exponential_between(-(enclosed_two_pi * *report_.modulus))};
        report_.order = {0, 1};
        add_width(*report_.modulus);
        add_width(report_.module[0]);
    }

    void take_module(std::vector<Interval> module)
    {
        report_.module = std::move(module);
        for (const Interval& number : report_.module) add_width(number);
    }

    CapacityReport& report() { return report_; }

private:
    void add_width(const Interval& value) { report_.width = std::max(report_.width, value.width()); }

    bool ring_;
    CapacityReport report_;
};

/// The triangles with the largest gaps, which make up a share of the whole gap.
std::vector<char> largest_gaps(const VectorXd& gap)
{
    std::vector<Index> order = numbers_below(gap.size());
    std::ranges::stable_sort(order, std::greater<>(), [&](Index f) { return gap[f]; });
    std::vector<char> marked(order.size(), 0);
    double sum = 0.0;
    for (std::size_t i = 0; i < order.size() && sum <= share_to_cut * gap.sum(); ++i) {
        marked[order[i]] = 1;
        sum += gap[order[i]];
    }
    return marked;
}

/// Encloses all capacities on one triangulation. @return (F) each triangle's part of the gap
VectorXd enclose_all(const BisectedSurface& surface, const std::vector<Condenser>& condensers, Enclosures& enclosures,
                     ExecutionContext& context)
{
    std::map<std::vector<int>, std::vector<std::size_t>> alike;
    for (std::size_t c = 0; c < condensers.size(); ++c) alike[held_loops(condensers[c])].push_back(c);
    const EdgeLengths weights = half_cotangents(surface.lengths());
    const QuadraticFunctions functions(surface);
    const SparseMatrix energy = functions.energy_matrix(weights);
    VectorXd gap = VectorXd::Zero(surface.face_count());
    for (const auto& [held, numbers] : alike) {
        context.checkpoint();
        const CapacityBounds level(surface, functions, weights, energy, held);
        for (std::size_t begin = 0; begin < numbers.size(); begin += at_once) {
            context.checkpoint();
            std::vector<Condenser> some;
            for (std::size_t i = begin; i < std::min(begin + at_once, numbers.size()); ++i)
                some.push_back(condensers[numbers[i]]);
            const std::vector<Interval> bounds = level.enclose(some, gap);
            for (std::size_t i = 0; i < some.size(); ++i) enclosures.narrow(numbers[begin + i], bounds[i]);
        }
    }
    return gap;
}

/// Bytes for two factors; quadratic functions have as many coefficients as linear ones on four times the faces.
double memory_for(double faces) { return 2.0 * memory_for_faces(static_cast<std::ptrdiff_t>(4.0 * faces)); }

bool has_room(double faces, const CapacityOptions& options)
{
    return faces <= options.max_faces && memory_for(faces) <= available_memory();
}

/// The module from the capacities between all loops.
class ModuleOfCapacities {
public:
    ModuleOfCapacities(const Vertices& vertices, const Surface& surface, int threads)
        : vertices_(vertices), surface_(surface), threads_(threads)
    {
    }

    bool may_narrow() const { return near_.may_narrow; }

    /// Leaves in the report the module, or why it is not enclosed.
    void enclose(Enclosures& enclosures, ExecutionContext& context)
    {
        CapacityReport& report = enclosures.report();
        if (!report.no_module.empty() && report.width > progress_for_circles * tried_) return;
        tried_ = report.width;
        report.no_module.clear();
        try {
            if (static_cast<int>(surface_.loops.size()) > most_enclosed_loops)
                throw SolverError("there are proved bounds for up to four loops: with more, several domains may have "
                                  "capacities between the bounds");
            ExecutionContext quiet({}, {}, [&] { context.checkpoint(); });  // it is a stage of no known length
            if (near_.order.empty()) near_ = near_module(vertices_, surface_, threads_, quiet);
            enclosures.take_module(enclose_module(near_, report.capacities, quiet));
            report.order = near_.wanted_order;
        } catch (const Cancelled&) {
            throw;
        } catch (const KoebeError& error) {
            report.no_module = error.what();
        }
    }

private:
    const Vertices& vertices_;
    const Surface& surface_;
    int threads_;
    double tried_ = 0.0;  // the widest enclosure of a capacity
    NearModule near_;
};

CapacityReport capacities_here(const Vertices& vertices, const Triangles& triangles,
                               const std::vector<Condenser>& condensers, const CapacityOptions& options,
                               ExecutionContext& context)
{
    fix_product_blocks();
    const ThreadShare threads(options.threads);
    validate_arrays(vertices, triangles);
    const Surface input = require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows()));
    const int loop_count = static_cast<int>(input.loops.size());
    const std::vector<Condenser> chosen = condensers.empty() ? loop_condensers(loop_count) : condensers;
    for (const Condenser& condenser : chosen) require_condenser(condenser, loop_count);
    require_memory(memory_for(static_cast<double>(triangles.rows())), "the bounds on a mesh of so many faces");
    BisectedSurface surface(vertices, input);
    Enclosures enclosures(chosen, loop_count);
    CapacityReport& report = enclosures.report();
    warn_reoriented(input.reoriented, report.warnings);
    ModuleOfCapacities module(vertices, input, options.threads);
    const double wanted = options.width.value_or(std::numeric_limits<double>::infinity());
    double of_capacities = 0.0;  // the widest enclosure of a capacity
    while (true) {
        // The time goes with the faces, and their number with 1 / width.
        const double reached = report.levels > 0 ? std::clamp(wanted / report.width, 0.0, 1.0) : 0.0;
        context.begin_stage("enclose", reached, reached);
        const VectorXd gap = enclose_all(surface, chosen, enclosures, context);
        enclosures.end_level(surface.face_count());
        const double before = std::exchange(of_capacities, report.width);
        const bool has_module = condensers.empty() && loop_count > 2;
        if (has_module && report.width <= wanted) module.enclose(enclosures, context);
        report.converged = report.width <= wanted;
        const bool may_find_circles = !report.no_module.empty() && loop_count <= most_enclosed_loops &&
                                      module.may_narrow() && options.width &&
                                      of_capacities > width_for_circles * wanted;
        const bool stuck = report.levels > 1 && of_capacities > (1.0 - least_progress) * before;
        const std::vector<char> marked = largest_gaps(gap);
        const double cut = static_cast<double>(std::ranges::count(marked, 1));
        if ((report.converged && !may_find_circles) || stuck ||
            !has_room(surface.face_count() + growth_reserve * 3.0 * cut, options)) {
            // Bounds that are too wide for the caller may do for the circles.
            if (has_module && report.module.empty() && report.no_module.empty()) module.enclose(enclosures, context);
            return std::move(report);
        }
        surface.refine(marked);
    }
}

}  // namespace

std::vector<Condenser> loop_condensers(int loop_count)
{
    std::vector<Condenser> condensers;
    const auto add = [&](const std::vector<int>& high) {
        Condenser condenser{{}, high};
        for (int k = 0; k < loop_count; ++k)
            if (std::ranges::find(high, k) == high.end()) condenser.at_zero.push_back(k);
        const auto is_exchanged = [&](const Condenser& other) { return other.at_one == condenser.at_zero; };
        if (!condenser.at_zero.empty() && std::ranges::none_of(condensers, is_exchanged))
            condensers.push_back(condenser);
    };
    for (int j = 0; j < loop_count; ++j) add({j});
    for (int j = 0; j < loop_count; ++j)
        for (int k = j + 1; k < loop_count; ++k) add({j, k});
    return condensers;
}

CapacityReport certified_capacities(const Vertices& vertices, const Triangles& triangles,
                                    const std::vector<Condenser>& condensers, const CapacityOptions& options,
                                    ExecutionContext& context)
{
    return run_detachable<CapacityReport>(context, [=](ExecutionContext& own) {
        CapacityReport report = capacities_here(vertices, triangles, condensers, options, own);
        own.report(1.0, "enclose");
        return report;
    });
}

}  // namespace koebe
