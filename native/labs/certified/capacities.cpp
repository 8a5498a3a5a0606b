#include "certified/capacities.h"

#include "certified/bisected_surface.h"
#include "certified/condenser.h"
#include "certified/flux_tree.h"
#include "certified/interval_functions.h"
#include "certified/module_enclosure.h"
#include "certified/quadratic_functions.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "execution/detachable_run.h"
#include "execution/memory_limit.h"
#include "execution/thread_share.h"
#include "linear/dense_spd.h"
#include "linear/sparse_cholesky.h"
#include "quality/shared_warnings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace koebe {
namespace {

/// The bounds for condensers that hold the same loops: they share the factors.
class CapacityBounds {
public:
    /// @param weights, energy half cotangents and the energy of the functions @param held loops, ascending
    CapacityBounds(const BisectedSurface& surface, const QuadraticFunctions& functions, const EdgeLengths& weights,
                   const SparseMatrix& energy, std::vector<int> held);

    /// @param gap (F) each triangle's part of the gap is added to it
    std::vector<Interval> enclose(const std::vector<Condenser>& all, VectorXd& gap) const;

private:
    SparseMatrix make_collapse();
    bool is_held(int loop) const;
    MatrixXd loop_values(const std::vector<Condenser>& all) const;
    std::pair<Interval, Interval> energies(const VectorXd& u, const VectorXd& g, const OneForm& carried,
                                           VectorXd& gap) const;

    const BisectedSurface& surface_;
    const QuadraticFunctions& functions_;
    const EdgeLengths& weights_;
    const SparseMatrix& energy_;
    std::vector<int> held_;
    std::vector<char> fixed_;
    FluxTree tree_;
    SparseMatrix collapse_;
    DirichletSolver potential_;
    SparseCholesky conjugate_;
};

constexpr std::size_t summands = 1024;  // short sums round less

/// Loads sum to 0 over the vertices, so that a diagonal added at one changes nothing but the constant.
SparseMatrix pinned(SparseMatrix matrix)
{
    matrix.coeffRef(0, 0) *= 2.0;
    return matrix;
}

CapacityBounds::CapacityBounds(const BisectedSurface& surface, const QuadraticFunctions& functions,
                               const EdgeLengths& weights, const SparseMatrix& energy, std::vector<int> held)
    : surface_(surface),
      functions_(functions),
      weights_(weights),
      energy_(energy),
      held_(std::move(held)),
      fixed_(functions.size(), 0),
      tree_(surface),
      collapse_(make_collapse()),
      potential_(energy, fixed_),
      conjugate_(pinned(collapse_.transpose() * energy * collapse_))
{
}

std::vector<Interval> CapacityBounds::enclose(const std::vector<Condenser>& all, VectorXd& gap) const
{
    // Upper bound: the energy of a potential with these values on the loops (Dirichlet).
    const MatrixXd values = loop_values(all);
    MatrixXd u = potential_.solve(values);
    for (Index i = 0; i < functions_.size(); ++i)
        if (fixed_[i]) u.row(i) = values.row(i);
    // Lower bound: a flux without divergence that leaves each loop as the potential's does (Thomson).
    const MatrixXd source = energy_ * u;
    MatrixXd load(functions_.size(), u.cols());
    std::vector<OneForm> carried;
    std::vector<double> total;
    for (Eigen::Index c = 0; c < u.cols(); ++c) {
        VectorXd flux = VectorXd::Zero(surface_.loop_count());
        for (Index v = 0; v < surface_.vertex_count(); ++v)
            if (fixed_[v]) flux[surface_.loop_of()[v]] += source(v, c);
        flux = rounded_fluxes(std::move(flux), held_);
        total.push_back(0.0);
        for (const int k : all[c].at_one) total.back() += flux[k];
        carried.push_back(tree_.carry(flux));
        load.col(c) = functions_.load(weights_, carried.back());
    }
    // Its best part along stream functions, and both energies in intervals: capacity >= flux^2 / energy.
    const MatrixXd g = collapse_ * conjugate_.solve(collapse_.transpose() * load);
    std::vector<Interval> bounds;
    for (Eigen::Index c = 0; c < u.cols(); ++c) {
        const auto [upper, per_square] = energies(u.col(c), g.col(c), carried[c], gap);
        bounds.push_back({(squared(total[c]) / per_square).lower, upper.upper});
    }
    return bounds;
}

/// A function that is constant on each loop through which nothing flows, from one number for such a loop and the
/// coefficients elsewhere. Marks the coefficients on loops that are held.
SparseMatrix CapacityBounds::make_collapse()
{
    std::vector<Index> of_loop(surface_.loop_count(), -1);
    std::vector<Eigen::Triplet<double, Index>> entries;
    Index count = 0;
    std::vector<char> vanishes(functions_.size(), 0);
    for (Index h = 0; h < static_cast<Index>(surface_.twin().size()); ++h) {
        if (surface_.twin()[h] != no_twin) continue;
        const bool held = is_held(surface_.loop_of()[origin(surface_.triangles(), h)]);
        (held ? fixed_ : vanishes)[functions_.edge(h)] = 1;
    }
    for (Index i = 0; i < functions_.size(); ++i) {
        const int loop = i < surface_.vertex_count() ? surface_.loop_of()[i] : -1;
        if (vanishes[i]) continue;
        if (loop >= 0 && is_held(loop)) fixed_[i] = 1;
        const bool shared = loop >= 0 && !fixed_[i];
        if (!shared || of_loop[loop] < 0) ++count;
        if (shared && of_loop[loop] < 0) of_loop[loop] = count - 1;
        entries.emplace_back(i, shared ? of_loop[loop] : count - 1, 1.0);
    }
    SparseMatrix collapse(functions_.size(), count);
    collapse.setFromTriplets(entries.begin(), entries.end());
    return collapse;
}

bool CapacityBounds::is_held(int loop) const { return std::ranges::binary_search(held_, loop); }

MatrixXd CapacityBounds::loop_values(const std::vector<Condenser>& all) const
{
    MatrixXd values = MatrixXd::Zero(functions_.size(), static_cast<Eigen::Index>(all.size()));
    for (std::size_t c = 0; c < all.size(); ++c)
        for (Index v = 0; v < surface_.vertex_count(); ++v)
            if (std::ranges::find(all[c].at_one, surface_.loop_of()[v]) != all[c].at_one.end())
                values(v, static_cast<Eigen::Index>(c)) = 1.0;
    return values;
}

/// The energies of u and of the flux dg + carried.
std::pair<Interval, Interval> CapacityBounds::energies(const VectorXd& u, const VectorXd& g, const OneForm& carried,
                                                       VectorXd& gap) const
{
    const std::size_t count = static_cast<std::size_t>(surface_.face_count());
    std::vector<std::pair<Interval, Interval>> sums((count + summands - 1) / summands);
    in_pieces(count, summands, [&](std::size_t begin, std::size_t end) {
        std::pair<Interval, Interval> sum;
        for (Index f = static_cast<Index>(begin); f < static_cast<Index>(end); ++f)
            for (int m = 0; m < 3; ++m) {
                const auto [u1, u2] = functions_.covector(u, nullptr, f, m);
                const auto [g1, g2] = functions_.covector(g, &carried, f, m);
                const Interval of_u = surface_.energy(f, u1, u2), of_flux = surface_.energy(f, g1, g2);
                sum.first = sum.first + of_u;
                sum.second = sum.second + of_flux;
                // |grad u - flux|^2; the flux is dg + carried, turned by 90 degrees.
                gap[f] += std::max(of_u.upper + of_flux.upper - (u1.upper * g2.upper - u2.upper * g1.upper), 0.0);
            }
        sums[begin / summands] = sum;
    });
    std::pair<Interval, Interval> sum;
    for (const auto& [of_u, of_flux] : sums) sum = {sum.first + of_u, sum.second + of_flux};
    return {sum.first / 3.0, sum.second / 3.0};
}

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
