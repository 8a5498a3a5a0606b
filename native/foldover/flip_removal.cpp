#include "foldover/flip_removal.h"

#include "conformal/circle_fit.h"
#include "conformal/distortion.h"
#include "conformal/stored_uv.h"
#include "foldover/flap_map.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr double on_circle = 1e-6;  // disk units

/// Flipped faces as a reader of the result finds them, who takes areas from the first corner of the input's faces.
void report_flips(const NamedSurface& whole, const PlanarPoints& uv, Distortion& distortion)
{
    distortion.flipped.clear();
    distortion.below_resolution.clear();
    for (Eigen::Index f = 0; f < whole.surface.triangles.rows(); ++f) {
        const StoredFace face(whole.surface.triangles, uv, f, whole.first_corners[f]);
        if (!face.flipped()) continue;
        distortion.flipped.push_back(whole.original_faces[f]);
        if (face.below_resolution()) distortion.below_resolution.push_back(whole.original_faces[f]);
    }
    std::sort(distortion.flipped.begin(), distortion.flipped.end());
    std::sort(distortion.below_resolution.begin(), distortion.below_resolution.end());
}

}  // namespace

UntangledMap hang_back(const NamedSurface& whole, const FlapCut& cut, PlanarPoints core_uv, ExecutionContext& context)
{
    if (cut.flaps.empty()) return {std::move(core_uv), {}, {}};
    UntangledMap map;
    map.uv = PlanarPoints::Zero(whole.vertices.rows(), 2);
    map.uv(cut.vertices, Eigen::all) = core_uv;
    map.off_circle = hang_flaps(whole.vertices, whole.surface.triangles, cut.flaps, whole.loops, map.uv, context);
    std::sort(map.off_circle.begin(), map.off_circle.end());
    return map;
}

UntangledMap remove_flips(const NamedSurface& whole, const FlapCut& cut, PlanarPoints core_uv,
                          const std::vector<Circle>& circles, ExecutionContext& context)
{
    UntangledMap map = hang_back(whole, cut, std::move(core_uv), context);
    context.advance(0.3);
    map.report = untangle(whole.vertices, whole.surface, whole.loops, circles, map.off_circle, map.uv, context);
    context.advance(0.7);
    map.off_circle.insert(map.off_circle.end(), map.report.freed.begin(), map.report.freed.end());
    std::sort(map.off_circle.begin(), map.off_circle.end());
    return map;
}

std::vector<Circle> reported_circles(const std::vector<LoopReport>& reports)
{
    std::vector<Circle> circles;
    for (const LoopReport& report : reports) circles.push_back(report.circle);
    return circles;
}

void report_map(const NamedSurface& whole, const UntangledMap& map, UniformizeResult& result)
{
    for (std::size_t k = 0; k < whole.loops.size(); ++k) {
        LoopReport& report = result.loops[k];
        report.vertices.clear();
        report.off_circle.clear();
        VectorXcd points(static_cast<Eigen::Index>(whole.loops[k].size()));
        Eigen::Index count = 0;
        for (const Index v : whole.loops[k]) {
            const Complex point(map.uv(v, 0), map.uv(v, 1));
            report.vertices.push_back(whole.original[v]);
            if (std::binary_search(map.off_circle.begin(), map.off_circle.end(), v) ||
                !(std::abs(std::abs(point - report.circle.center) - report.circle.radius) <= on_circle))
                report.off_circle.push_back(whole.original[v]);
            else
                points[count++] = point;
        }
        std::rotate(report.vertices.begin(), std::min_element(report.vertices.begin(), report.vertices.end()),
                    report.vertices.end());
        std::sort(report.off_circle.begin(), report.off_circle.end());
        report.roundness_projected = count > 0 ? roundness(points.head(count), report.circle) : 0.0;
    }
    result.distortion = measure_distortion(whole.vertices, whole.surface.triangles, map.uv);
    report_flips(whole, map.uv, result.distortion);
    result.uv = PlanarPoints::Zero(result.vertex_count, 2);
    result.uv(whole.original, Eigen::all) = map.uv;
}

}  // namespace koebe
