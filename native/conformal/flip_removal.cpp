#include "conformal/flip_removal.h"

#include "conformal/circle_fit.h"
#include "conformal/flap_map.h"

#include <algorithm>

namespace koebe {

PlanarPoints remove_flips(const NamedSurface& whole, const FlapCut& cut, PlanarPoints core_uv,
                          std::vector<LoopReport>& reports, UntangleReport& untangled, ExecutionContext& context)
{
    PlanarPoints uv = std::move(core_uv);
    std::vector<Index> off_circle;
    if (!cut.flaps.empty()) {
        PlanarPoints whole_uv = PlanarPoints::Zero(whole.vertices.rows(), 2);
        whole_uv(cut.vertices, Eigen::all) = uv;
        uv = std::move(whole_uv);
        off_circle = hang_flaps(whole.vertices, whole.surface.triangles, cut.flaps, whole.loops, uv, context);
    }
    context.advance(0.3);
    std::vector<Circle> circles;
    for (const LoopReport& report : reports) circles.push_back(report.circle);
    untangled = untangle(whole.vertices, whole.surface, whole.loops, circles, off_circle, uv, context);
    context.advance(0.7);

    off_circle.insert(off_circle.end(), untangled.freed.begin(), untangled.freed.end());
    std::sort(off_circle.begin(), off_circle.end());
    for (std::size_t k = 0; k < whole.loops.size(); ++k) {
        LoopReport& report = reports[k];
        report.vertices.clear();
        VectorXcd points(static_cast<Eigen::Index>(whole.loops[k].size()));
        Eigen::Index on_circle = 0;
        for (const Index v : whole.loops[k]) {
            report.vertices.push_back(whole.original[v]);
            if (std::binary_search(off_circle.begin(), off_circle.end(), v))
                report.off_circle.push_back(whole.original[v]);
            else
                points[on_circle++] = {uv(v, 0), uv(v, 1)};
        }
        report.roundness_projected = roundness(points.head(on_circle), report.circle);
    }
    return uv;
}

}  // namespace koebe
