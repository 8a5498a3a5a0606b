#include "pipeline/problem.h"

#include "circles/boundary_angles.h"
#include "circles/point_alignment.h"
#include "core/memory_limit.h"
#include "iteration/koebe_mesh.h"

#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

/// A polygon without inner vertices goes round the circle whole: of equal halves none is the flap.
FlapCut flaps_of(const Domain& whole)
{
    return is_polygon(whole) ? FlapCut{} : cut_flaps(whole.vertices, whole.surface, whole.loops);
}

VectorXd shape_of(const Problem& problem)
{
    return AngleForecast::shape_of(problem.domain().vertices, problem.domain().surface.triangles);
}

}  // namespace

Problem prepare_problem(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
{
    require_memory_for_faces(triangles.rows());
    Problem problem;
    problem.vertex_count = static_cast<Index>(vertices.rows());
    problem.whole = prepare_domain(vertices, triangles, options);
    if (options.engine == Engine::mesh)
        require_possible(options.mesh, static_cast<int>(problem.whole.loops.size()), options.method);
    problem.cut = flaps_of(problem.whole);
    if (!problem.cut.flaps.empty()) problem.core = core_domain(problem.whole, problem.cut);
    return problem;
}

bool chooses_outer_loop(const UniformizeOptions& options, const Domain& domain)
{
    return options.balance == Balance::area && options.outer == OuterLoop::automatic && domain.point < 0 &&
           domain.loops.size() > 1;
}

void move_problem(Problem& problem, const Vertices& vertices)
{
    move_domain(problem.whole, vertices);
    const std::vector<Index> kept = std::move(problem.cut.vertices);
    problem.cut = flaps_of(problem.whole);
    if (problem.cut.vertices != kept) {
        problem.assembled = {};
        problem.outcome = {};
        problem.forecast = {};
    }
    problem.core.reset();
    if (!problem.cut.flaps.empty()) problem.core = core_domain(problem.whole, problem.cut);
    if (problem.outcome.converged && !problem.outcome.angles.empty())
        problem.outcome.angles = problem.forecast.angles_for(shape_of(problem));
}

void remember_angles(Problem& problem)
{
    if (problem.outcome.converged && !problem.outcome.angles.empty())
        problem.forecast.add(shape_of(problem), problem.outcome.angles);
}

VectorXcd places_of_loops(const Problem& problem)
{
    const Domain& domain = problem.domain();
    const std::vector<VectorXcd>& images = problem.outcome.loops;
    VectorXcd result =
        VectorXcd::Constant(problem.vertex_count, Complex(std::numeric_limits<double>::quiet_NaN(), 0.0));
    for (std::size_t k = 0; k < images.size(); ++k)
        for (Eigen::Index b = 0; b < images[k].size(); ++b) result[domain.original[domain.loops[k][b]]] = images[k][b];
    return result;
}

void lay_over_first(Problem& problem)
{
    if (problem.first_places.size() == 0) return;
    const Domain& domain = problem.domain();
    std::vector<VectorXcd>& images = problem.outcome.loops;
    std::vector<Complex> points, targets;
    std::vector<double> weights;
    for (std::size_t k = 0; k < images.size(); ++k) {
        const VectorXd share = vertex_weights(domain.edges[k]) * domain.edges[k].sum();
        for (Eigen::Index b = 0; b < images[k].size(); ++b) {
            const Complex target = problem.first_places[domain.original[domain.loops[k][b]]];
            if (std::isnan(target.real())) continue;
            points.push_back(images[k][b]);
            targets.push_back(target);
            weights.push_back(share[b]);
        }
    }
    if (points.empty()) return;
    const auto size = static_cast<Eigen::Index>(points.size());
    const Moebius map = nearest_automorphism(Eigen::Map<const VectorXcd>(points.data(), size),
                                             Eigen::Map<const VectorXcd>(targets.data(), size),
                                             Eigen::Map<const VectorXd>(weights.data(), size));
    for (VectorXcd& image : images) image = map(image);
}

}  // namespace koebe
