// Times parts against one map of the same surface, turn by turn in one process, and prints a line for each.
//
//   parts_bench RUNS MESH...
//
// MESH is a file; TIMES:FILE for each of its faces cut in four so many times; islands:COUNT for so many
// small plates, whose one map is that with cuts.
// Seconds are of the clock and, in brackets, of the processor, the least of the runs.
#include "core/errors.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"
#include "opened/cut_uniformize.h"
#include "parts/parts.h"
#include "pipeline/uniformize.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <map>
#include <string>
#include <utility>

using namespace koebe;

namespace {

struct Mesh {
    Vertices vertices;
    Triangles triangles;
};

struct Seconds {
    double clock = std::numeric_limits<double>::infinity(), processor = clock;
};

template <typename Call>
void time_call(Seconds& best, const Call& call)
{
    const auto clock = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    call();
    best.clock = std::min(best.clock, std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count());
    best.processor = std::min(best.processor, static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
}

/// Every face in four, new vertices in the middle of its edges.
Mesh subdivided(const Mesh& mesh)
{
    std::map<std::pair<Index, Index>, Index> middles;
    std::vector<Eigen::RowVector3d> added;
    const auto middle = [&](Index a, Index b) {
        const auto [place, fresh] =
            middles.try_emplace(std::minmax(a, b), static_cast<Index>(mesh.vertices.rows() + added.size()));
        if (fresh) added.push_back(0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b)));
        return place->second;
    };
    Mesh finer{mesh.vertices, Triangles(4 * mesh.triangles.rows(), 3)};
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const Index a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
        const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.triangles.middleRows<4>(4 * f) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    }
    finer.vertices.conservativeResize(mesh.vertices.rows() + static_cast<Eigen::Index>(added.size()), Eigen::NoChange);
    for (std::size_t i = 0; i < added.size(); ++i)
        finer.vertices.row(mesh.vertices.rows() + static_cast<Eigen::Index>(i)) = added[i];
    return finer;
}

/// A grid of side x side squares over [0, 1]^2.
Mesh plate(Index side, double (*height)(double, double))
{
    Mesh mesh{Vertices((side + 1) * (side + 1), 3), Triangles(2 * side * side, 3)};
    for (Index i = 0; i <= side; ++i)
        for (Index j = 0; j <= side; ++j) {
            const double x = static_cast<double>(i) / side, y = static_cast<double>(j) / side;
            mesh.vertices.row(i * (side + 1) + j) << x, y, height(x, y);
        }
    for (Index i = 0; i < side; ++i)
        for (Index j = 0; j < side; ++j) {
            const Index a = i * (side + 1) + j, b = a + side + 1;
            mesh.triangles.middleRows<2>(2 * (i * side + j)) << a, b, b + 1, a, b + 1, a + 1;
        }
    return mesh;
}

Mesh islands(Index count)
{
    const Mesh one = plate(4, [](double x, double y) { return 0.3 * std::sin(3.0 * x) * std::cos(2.0 * y); });
    Mesh mesh{Vertices(count * one.vertices.rows(), 3), Triangles(count * one.triangles.rows(), 3)};
    for (Index i = 0; i < count; ++i) {
        const auto first = static_cast<Index>(i * one.vertices.rows());
        mesh.vertices.middleRows(first, one.vertices.rows()) =
            one.vertices.rowwise() + Eigen::RowVector3d(1.5 * (i % 100), 1.5 * static_cast<double>(i / 100), 0.0);
        mesh.triangles.middleRows(i * one.triangles.rows(), one.triangles.rows()) = one.triangles.array() + first;
    }
    return mesh;
}

Mesh read(const std::string& name)
{
    const auto colon = name.find(':');
    const std::string kind = name.substr(0, colon), rest = colon == std::string::npos ? name : name.substr(colon + 1);
    if (kind == "islands") return islands(static_cast<Index>(std::stol(rest)));
    PolygonMesh file = read_mesh(rest);
    Mesh mesh{{}, triangulate(file).triangles};
    mesh.vertices = std::move(file.vertices);
    for (int i = colon == std::string::npos ? 0 : std::stoi(kind); i > 0; --i) mesh = subdivided(mesh);
    return mesh;
}

void compare(const std::string& name, int runs)
{
    const Mesh mesh = read(name);
    Seconds one, parts;
    double angle = 0.0;
    PartsResult result;
    const bool many = name.starts_with("islands:");
    for (int run = 0; run < runs; ++run) {
        time_call(one, [&] {
            try {
                angle = many ? uniformize_with_cuts(mesh.vertices, mesh.triangles).distortion.angle_error_deg.mean
                             : uniformize(mesh.vertices, mesh.triangles).distortion.angle_error_deg.mean;
            } catch (const TopologyError&) {
                angle = uniformize_with_cuts(mesh.vertices, mesh.triangles).distortion.angle_error_deg.mean;
            }
        });
        time_call(parts, [&] {
            ExecutionContext context;
            result = parts_of(mesh.vertices, mesh.triangles, {}, context);
        });
    }
    std::printf("%-24s %7ld faces, %2zu parts, cuts %.2f + %.2f, density %.2f, even %.1f %%, flipped %zu, lost %zu, "
                "angle %.2f -> %.2f, maps %.1f; map %.2f (%.2f) s, parts %.2f (%.2f) s, ratio %.1f (%.1f)\n",
                name.substr(name.find_last_of('/') + 1).c_str(), static_cast<long>(mesh.triangles.rows()),
                result.parts.size(), result.cut_length - result.slit_length, result.slit_length,
                result.density_ratio_5_95, 100.0 * result.even_area, result.distortion.flipped.size(),
                result.distortion.below_resolution.size(), angle, result.distortion.angle_error_deg.mean, result.maps,
                one.clock, one.processor, parts.clock, parts.processor, parts.clock / one.clock,
                parts.processor / one.processor);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc < 3) {
        std::fputs("usage: parts_bench RUNS MESH...\n", stderr);
        return 2;
    }
    try {
        for (int i = 2; i < argc; ++i) compare(argv[i], std::stoi(argv[1]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
    return 0;
}
