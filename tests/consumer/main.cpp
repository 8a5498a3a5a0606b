// Maps a round annulus, known in advance: its inner radius is that of the map. Ends with 0 if all is right.
#include <koebe/koebe.h>

#include "examples.h"

#if __has_include("core/types.h")
#error "the package's headers must not stand in the include path by their rooms"
#endif
#if defined(OPENMESHDLLEXPORT) || defined(NLOHMANN_JSON_VERSION_MAJOR)
#error "koebe.h must not bring OpenMesh or JSON along"
#endif

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

// What the library maps to, each declared by koebe.h.
static_assert(sizeof(koebe::CutUniformizeResult) > 0 && sizeof(koebe::PartsResult) > 0);
static_assert(sizeof(koebe::TileResult) > 0 && sizeof(koebe::SphereResult) > 0 && sizeof(koebe::SchottkyResult) > 0);
static_assert(sizeof(koebe::OpenedSurface) > 0 && sizeof(koebe::SurfaceSolver) > 0);
static_assert(sizeof(koebe::Correspondence) > 0 && sizeof(koebe::SurfacePoint) > 0);

int main()
{
    constexpr int sectors = 60, rings = 24;
    constexpr double inner = 0.3;
    koebe::Vertices vertices(sectors * (rings + 1), 3);
    koebe::Triangles triangles(2 * sectors * rings, 3);
    int face = 0;
    for (int r = 0; r <= rings; ++r)
        for (int s = 0; s < sectors; ++s) {
            const double radius = std::pow(inner, 1.0 - static_cast<double>(r) / rings);
            const double angle = 2.0 * std::numbers::pi * s / sectors;
            vertices.row(r * sectors + s) << radius * std::cos(angle), radius * std::sin(angle), 0.0;
            if (r == rings) continue;
            const int a = r * sectors + s, b = r * sectors + (s + 1) % sectors;
            triangles.row(face++) << a, b + sectors, b;
            triangles.row(face++) << a, a + sectors, b + sectors;
        }

    const koebe::UniformizeResult map = koebe::uniformize(vertices, triangles);
    std::printf("inner radius %.6f, %zu flipped\n", map.loops.at(1).circle.radius, map.distortion.flipped.size());
    if (!map.converged || !map.distortion.flipped.empty()) return 1;
    if (std::abs(map.loops.at(1).circle.radius - inner) > 2e-3) return 2;

    one_surface(vertices, triangles);
    steps(vertices, triangles);
    shapes();
    handles();

    int stages = 0;
    koebe::ExecutionContext context([&](double, const std::string&) { ++stages; }, koebe::CancelToken());
    koebe::UniformizeOptions options;
    options.method = koebe::Method::ck;
    koebe::uniformize(vertices, triangles, options, context);
    if (stages == 0) return 3;

    triangles(0, 0) = -1;
    try {
        koebe::uniformize(vertices, triangles);
    } catch (const koebe::InputError& error) {
        return error.elements_of() == koebe::ElementKind::faces && error.elements() == std::vector<koebe::Index>{0} ? 0
                                                                                                                    : 4;
    }
    return 5;
}
