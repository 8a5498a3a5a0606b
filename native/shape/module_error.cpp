#include "shape/module_error.h"

#include "pipeline/uniformize.h"
#include "shape/conformal_module.h"
#include "surface/smooth_refinement.h"

#include <algorithm>
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
        const auto same = std::ranges::find_if(result.loops, [&](const LoopReport& other) {
            return std::ranges::find(other.vertices, loop.vertices.front()) != other.vertices.end();
        });
        circles.push_back(same->circle);
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
