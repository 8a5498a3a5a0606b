#include "pipeline/surface_solver.h"

#include "core/errors.h"
#include "execution/detachable_run.h"
#include "mesh/topology.h"
#include "pipeline/problem.h"

#include <string>
#include <utility>

namespace koebe {

struct SurfaceSolver::Impl {
    std::shared_ptr<const Triangles> triangles;
    UniformizeOptions options;  ///< once the outer loop is known, they name it by a vertex
    Index vertex_count = 0;
    std::shared_ptr<Problem> kept;  ///< null while a map is made, and after an error
    VectorXcd first_places;         ///< of the first map (Problem)

    void keep(std::shared_ptr<Problem> problem)
    {
        kept = std::move(problem);
        options.outer = OuterLoop::vertex;
        options.outer_vertex = kept->whole.original[kept->whole.loops[0][0]];
    }
};

SurfaceSolver::SurfaceSolver(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options)
    : impl_(std::make_unique<Impl>())
{
    if (!options.vertex_names.empty() || !options.face_names.empty())
        throw InputError("SurfaceSolver takes no vertex_names and no face_names");
    if (options.engine != Engine::condensed) throw InputError("SurfaceSolver does not have the mesh engine");
    impl_->triangles = std::make_shared<const Triangles>(triangles);
    impl_->options = options;
    impl_->vertex_count = static_cast<Index>(vertices.rows());
    auto problem = std::make_shared<Problem>(prepare_problem(vertices, triangles, options));
    problem->assembled.moves = true;
    if (chooses_outer_loop(options, problem->whole))
        impl_->kept = std::move(problem);
    else
        impl_->keep(std::move(problem));
}

SurfaceSolver::~SurfaceSolver() = default;
SurfaceSolver::SurfaceSolver(SurfaceSolver&&) noexcept = default;
SurfaceSolver& SurfaceSolver::operator=(SurfaceSolver&&) noexcept = default;

Index SurfaceSolver::vertex_count() const { return impl_->vertex_count; }

UniformizeResult SurfaceSolver::uniformize(const Vertices& vertices, ExecutionContext& context)
{
    if (vertices.rows() != impl_->vertex_count)
        throw InputError("the surface has " + std::to_string(impl_->vertex_count) + " vertices, not " +
                         std::to_string(vertices.rows()));
    require_finite(vertices);
    // An abandoned run ends later, on a problem of its own.
    std::shared_ptr<Problem> problem = std::move(impl_->kept);
    const bool begun = problem != nullptr;
    if (!begun) problem = std::make_shared<Problem>();
    const auto compute = [problem, begun, vertices, triangles = impl_->triangles, options = impl_->options,
                          places = impl_->first_places](ExecutionContext& own) {
        const auto prepare = [&]() -> Problem& {
            if (!begun || !move_problem(*problem, vertices)) *problem = prepare_problem(vertices, *triangles, options);
            problem->assembled.moves = true;
            problem->first_places = places;
            return *problem;
        };
        return map_problem(vertices, *triangles, prepare, options, own);
    };
    UniformizeResult result = run_detachable<UniformizeResult>(context, compute);
    if (impl_->first_places.size() == 0 && result.converged) impl_->first_places = places_of_loops(*problem);
    remember_angles(*problem);
    impl_->keep(std::move(problem));
    return result;
}

UniformizeResult SurfaceSolver::uniformize(const Vertices& vertices)
{
    ExecutionContext context;
    return uniformize(vertices, context);
}

}  // namespace koebe
