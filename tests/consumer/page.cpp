// The program of docs/cpp.md.
#include <koebe/koebe.h>

#include <cmath>
#include <cstdio>
#include <string>

int main()
{
    // A flat ring of 12 quadrilaterals, each cut into two triangles: radii 1 and 2.
    koebe::Vertices vertices(24, 3);
    koebe::Triangles triangles(24, 3);
    for (int k = 0; k < 12; ++k) {
        const double turn = 2.0 * std::acos(-1.0) * k / 12.0;
        vertices.row(k) << 2.0 * std::cos(turn), 2.0 * std::sin(turn), 0.0;
        vertices.row(12 + k) << std::cos(turn), std::sin(turn), 0.0;
        const int next = (k + 1) % 12;
        triangles.row(2 * k) << k, next, next + 12;
        triangles.row(2 * k + 1) << k, next + 12, k + 12;
    }

    koebe::UniformizeOptions options;
    options.threads = 1;
    koebe::CancelToken cancel;  // cancel.cancel() from any thread ends the call
    const auto show = [](double share, const std::string& stage) {
        std::fprintf(stderr, "%3.0f %% %s\n", 100.0 * share, stage.c_str());
    };
    koebe::ExecutionContext context(show, cancel);
    try {
        const koebe::UniformizeResult map = koebe::uniformize(vertices, triangles, options, context);
        for (const auto& loop : map.loops) std::printf("radius %.3f\n", loop.circle.radius);
        std::printf("%.2f degrees, %zu flipped\n", map.distortion.angle_error_deg.mean, map.distortion.flipped.size());
        return map.converged ? 0 : 1;
    } catch (const koebe::TopologyError& error) {  // closed, handles, ...: error.elements() are at fault
        std::fprintf(stderr, "%s\n", error.what());
    } catch (const koebe::Cancelled&) {
    }
    return 1;
}
