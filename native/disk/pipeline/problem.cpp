#include "pipeline/problem.h"

#include "circles/boundary_angles.h"
#include "circles/point_alignment.h"
#include "execution/memory_limit.h"
#include "iteration/koebe_mesh.h"
#include "pipeline/normalization.h"

#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

/// A polygon without inner vertices stays whole on the circle: of two equal halves neither is an ear.
EarCut ears_of(const MapInput& whole)
{
    return is_polygon(whole) ? EarCut{} : cut_ears(whole.vertices, whole.surface, whole.loops);
}

VectorXd shape_of(const Problem& problem)
{
    return AngleForecast::shape_of(problem.input().vertices, problem.input().surface.triangles);
}

/// Whether the inner loops are still sorted by falling length.
bool goes_by_length(const MapInput& input)
{
    for (std::size_t k = 2; k < input.edges.size(); ++k)
        if (input.edges[k].sum() > (1.0 + same_length) * input.edges[k - 1].sum()) return false;
    return true;
}

/// Moves the map by an automorphism. The interior is made harmonic again only where faces would turn over.
void move_as_one(const Problem& problem, CircleMap& map, Moebius automorphism)
{
    const MapInput& input = problem.input();
    if (map.circles.size() == 2) automorphism = center_circle(automorphism(map.circles[1])) * automorphism;
    CircleMap moved = map;
    move_points(input, automorphism, moved);
    const Triangles& triangles = input.surface.triangles;
    const std::size_t flipped = flipped_faces(triangles, moved.uv).size();
    if (flipped > 0 && flipped > flipped_faces(triangles, map.uv).size())
        if (std::optional<CircleMap> harmonic = moved_by(problem.solver(), map, automorphism))
            moved = *std::move(harmonic);
    map = std::move(moved);
}

}  // namespace

Problem prepare_problem(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
{
    require_memory_for_faces(triangles.rows());
    Problem problem;
    problem.vertex_count = static_cast<Index>(vertices.rows());
    problem.whole = prepare_input(vertices, triangles, options);
    if (options.engine == Engine::mesh)
        require_possible(options.mesh, static_cast<int>(problem.whole.loops.size()), options.method);
    problem.cut = ears_of(problem.whole);
    if (!problem.cut.ears.empty()) problem.core = core_input(problem.whole, problem.cut);
    return problem;
}

bool chooses_outer_loop(const UniformizeOptions& options, const MapInput& input)
{
    return options.balance == Balance::area && options.outer == OuterLoop::automatic && input.point < 0 &&
           input.loops.size() > 1;
}

bool move_problem(Problem& problem, const Vertices& vertices)
{
    MapInput& whole = problem.whole;
    const Vertices before = whole.vertices;
    move_input(whole, vertices);
    if (!problem.assembled.boundary) return whole.vertices == before;
    if (!goes_by_length(whole)) return false;
    const std::vector<Index> kept = std::move(problem.cut.vertices);
    problem.cut = ears_of(whole);
    if (problem.cut.vertices != kept) return false;
    problem.core.reset();
    if (!problem.cut.ears.empty()) problem.core = core_input(whole, problem.cut);
    if (!problem.assembled.move_metric(problem.input())) return false;
    if (problem.outcome.converged && !problem.outcome.angles.empty())
        problem.outcome.angles = problem.forecast.angles_for(shape_of(problem));
    return true;
}

void remember_angles(Problem& problem)
{
    if (problem.outcome.converged && !problem.outcome.angles.empty())
        problem.forecast.add(shape_of(problem), problem.outcome.angles);
}

VectorXcd places_of_loops(const Problem& problem)
{
    const MapInput& input = problem.input();
    const std::vector<VectorXcd>& images = problem.outcome.loops;
    VectorXcd result =
        VectorXcd::Constant(problem.vertex_count, Complex(std::numeric_limits<double>::quiet_NaN(), 0.0));
    for (std::size_t k = 0; k < images.size(); ++k)
        for (Eigen::Index b = 0; b < images[k].size(); ++b) result[input.original[input.loops[k][b]]] = images[k][b];
    return result;
}

void align_with_first(Problem& problem, CircleMap& map)
{
    const MapInput& input = problem.input();
    // The rim's vertices that the first map has too, with the lengths that they stand for.
    std::vector<Complex> points, targets;
    std::vector<double> weights;
    for (std::size_t k = 0; k < input.loops.size() && problem.first_places.size() > 0; ++k) {
        const VectorXd share = vertex_weights(input.edges[k]) * input.edges[k].sum();
        for (Eigen::Index b = 0; b < share.size(); ++b) {
            const Index v = input.loops[k][b];
            const Complex target = problem.first_places[input.original[v]];
            if (std::isnan(target.real())) continue;
            points.emplace_back(map.uv(v, 0), map.uv(v, 1));
            targets.push_back(target);
            weights.push_back(share[b]);
        }
    }
    // The automorphism of the disk that brings them nearest.
    if (!points.empty()) {
        const auto size = static_cast<Eigen::Index>(points.size());
        move_as_one(problem, map,
                    nearest_automorphism(Eigen::Map<const VectorXcd>(points.data(), size),
                                         Eigen::Map<const VectorXcd>(targets.data(), size),
                                         Eigen::Map<const VectorXd>(weights.data(), size)));
    }
    for (std::size_t k = 0; k < input.loops.size(); ++k)
        problem.outcome.loops[k] = map.uv(input.loops[k], 0) + Complex(0.0, 1.0) * map.uv(input.loops[k], 1);
}

}  // namespace koebe
