#include "shape/module_error.h"

#include "mesh/loop_with.h"
#include "pipeline/uniformize.h"
#include "shape/conformal_module.h"
#include "surface/smooth_refinement.h"

#include <cmath>

namespace koebe {

std::vector<Circle> refined_circles(const Vertices& vertices, const Triangles& triangles,
                                    const std::vector<LoopReport>& loops, UniformizeOptions options,
                                    ExecutionContext& context)
{
    const RefinedSurface refined = refine_smoothly(vertices, triangles);
    options.outer = OuterLoop::vertex;
    options.outer_vertex = loops[0].vertices.front();
    options.polish = options.mesh.record_steps = false;  // these do not change circles
    const UniformizeResult result = uniformize(refined.vertices, refined.triangles, options, context);
    require_own_circles(result.loops);
    std::vector<Circle> circles;
    for (const LoopReport& loop : loops) {
        const int same = loop_with(result.loops, loop.vertices.front(), &LoopReport::vertices);
        circles.push_back(result.loops.at(same).circle);
    }
    return circles;
}

VectorXd module_error(const VectorXd& module, const VectorXd& refined)
{
    VectorXd change = (refined - module).cwiseAbs();
    if (change.size() == 0) return change;
    const double typical = change.norm() / std::sqrt(static_cast<double>(change.size()));
    return 2.0 * change + VectorXd::Constant(change.size(), typical);
}

}  // namespace koebe
