// Times uniformize against one Laplacian solve of the same mesh, turn by turn in one process, and prints JSON.
//
//   koebe_bench MESH RUNS ENGINE METHOD
//
// MESH is a file; TIMES:FILE for each of its faces cut in four so many times; or LIFT:FACES for five known circles
// on a surface, LIFT one of polynomial, sphere, Enneper (tests/native/circle_domain.h): then "circle_error", the
// relative error of the inversive distances, is printed too.
//
// The unit of time is what any linear conformal map costs at least: assemble the cotan Laplacian, order it by AMD,
// factor it (supernodal) and solve for two columns. Built without OpenBLAS, it leaves that out.
#include "circle_domain.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"
#include "mesh/topology.h"
#include "pipeline/uniformize.h"
#include "report/json.h"
#include "surface/laplacian.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <string>
#include <utility>

#if defined(KOEBE_BENCH_REFERENCE)
#include <Eigen/CholmodSupport>

extern "C" void openblas_set_num_threads(int threads);
#endif

using namespace koebe;

namespace {

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

#if defined(KOEBE_BENCH_REFERENCE)
/// One assemble + AMD + supernodal factor of CHOLMOD's + two-column solve; the boundary is given, as in a harmonic map.
double time_laplacian(const Vertices& vertices, const Triangles& triangles, const std::vector<char>& fixed)
{
    openblas_set_num_threads(1);
    const auto start = std::chrono::steady_clock::now();
    SparseMatrix laplacian = cotan_laplacian(triangles, half_cotangents(edge_lengths(vertices, triangles)),
                                             static_cast<Index>(vertices.rows()));
    MatrixXd load = MatrixXd::Zero(vertices.rows(), 2);
    for (Index c = 0; c < static_cast<Index>(laplacian.cols()); ++c)
        for (SparseMatrix::InnerIterator it(laplacian, c); it; ++it) {
            if (fixed[it.row()] == 0 && fixed[c] == 0) continue;
            if (fixed[it.row()] == 0) load.row(it.row()) -= it.value() * vertices.row(c).head<2>();
            it.valueRef() = it.row() == c ? 1.0 : 0.0;
        }
    for (Index v = 0; v < static_cast<Index>(vertices.rows()); ++v)
        if (fixed[v] != 0) load.row(v) = vertices.row(v).head<2>();
    laplacian.prune(0.0);
    Eigen::CholmodSupernodalLLT<SparseMatrix> solver;
    solver.cholmod().nmethods = 1;
    solver.cholmod().method[0].ordering = CHOLMOD_AMD;
    solver.compute(laplacian);
    const MatrixXd solution = solver.solve(load);
    const double seconds = seconds_since(start);
    if (!solution.allFinite()) throw SolverError("the reference solve failed");
    return seconds;
}
#endif

struct Input {
    Vertices vertices;
    Triangles triangles;
    std::vector<Circle> known_circles;  // in the order of known_loops; empty for a file
    std::vector<VertexLoop> known_loops;
};

/// Every face in four, new vertices in the middle of its edges.
void subdivide(Vertices& vertices, Triangles& triangles)
{
    std::map<std::pair<Index, Index>, Index> middles;
    std::vector<Eigen::RowVector3d> added;
    const auto middle = [&](Index a, Index b) {
        const auto [place, fresh] =
            middles.try_emplace(std::minmax(a, b), static_cast<Index>(vertices.rows() + added.size()));
        if (fresh) added.push_back(0.5 * (vertices.row(a) + vertices.row(b)));
        return place->second;
    };
    Triangles finer(4 * triangles.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Index a = triangles(f, 0), b = triangles(f, 1), c = triangles(f, 2);
        const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.middleRows<4>(4 * f) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    }
    const Eigen::Index old = vertices.rows();
    vertices.conservativeResize(old + static_cast<Eigen::Index>(added.size()), Eigen::NoChange);
    for (std::size_t i = 0; i < added.size(); ++i) vertices.row(old + i) = added[i];
    triangles = std::move(finer);
}

Input read_input(const std::string& name)
{
    const auto colon = name.find(':');
    for (const test::Lift kind : test::curved_lifts) {
        if (name.substr(0, colon) != test::to_string(kind) || colon == std::string::npos) continue;
        const auto faces = static_cast<Index>(std::stol(name.substr(colon + 1)));
        const test::CircleDomain domain = test::make_circle_domain(test::five_circles(), faces);
        return {test::lift(domain.points, kind), domain.triangles, domain.circles, domain.loops};
    }
    PolygonMesh file = read_mesh(colon == std::string::npos ? name : name.substr(colon + 1));
    Triangles triangles = triangulate(file).triangles;
    for (int i = colon == std::string::npos ? 0 : std::stoi(name); i > 0; --i) subdivide(file.vertices, triangles);
    return {std::move(file.vertices), std::move(triangles), {}, {}};
}

double circle_error(const Input& input, const UniformizeResult& result)
{
    std::vector<Circle> found;
    for (const VertexLoop& loop : input.known_loops)
        for (const LoopReport& report : result.loops)
            if (std::find(report.vertices.begin(), report.vertices.end(), loop.front()) != report.vertices.end())
                found.push_back(report.circle);
    return test::inversive_distance_error(found, input.known_circles);
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 5) {
        std::cerr << "usage: koebe_bench MESH RUNS condensed|mesh gk|ck\n";
        return 2;
    }
    try {
        const Input input = read_input(argv[1]);
        const Surface surface = require_bordered_genus_zero(input.triangles, static_cast<Index>(input.vertices.rows()));
        [[maybe_unused]] const std::vector<char> fixed = boundary_mask(surface);
        UniformizeOptions options;
        options.engine = std::string(argv[3]) == "mesh" ? Engine::mesh : Engine::condensed;
        options.method = std::string(argv[4]) == "ck" ? Method::ck : Method::gk;

        nlohmann::ordered_json runs = nlohmann::json::array();
        for (int run = 0; run <= std::atoi(argv[2]); ++run) {
            nlohmann::ordered_json figures;
#if defined(KOEBE_BENCH_REFERENCE)
            figures["laplacian_seconds"] = time_laplacian(input.vertices, surface.triangles, fixed);
#endif
            ExecutionContext context;
            const auto start = std::chrono::steady_clock::now();
            const UniformizeResult result = uniformize(input.vertices, input.triangles, options, context);
            const double seconds = seconds_since(start);
            if (run == 0) continue;  // warms up
            auto report = to_json(result);
            for (auto& loop : report["loops"]) loop["vertices"] = loop["vertices"].size();
            figures["seconds"] = seconds;
            figures["report"] = report;
            if (!input.known_circles.empty()) figures["circle_error"] = circle_error(input, result);
            runs.push_back(figures);
        }
        std::cout << runs.dump() << '\n';
    } catch (const KoebeError& error) {
        std::cerr << error.name() << ": " << error.what() << '\n';
        return 3;
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
