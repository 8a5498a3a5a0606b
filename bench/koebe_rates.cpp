// What the reproduction of the paper needs beside the koebe command (bench/reproduce.py):
//
//   koebe_rates surface HOLES FACES OUT.obj      a smooth surface with round holes, on no shared scan
//   koebe_rates steps DOMAIN FACES ENGINE METHOD the error of the circles after each step, as JSON
//   koebe_rates file MESH ENGINE METHOD          the same for a mesh file, whose own circles nobody knows
//
// DOMAIN is apart, middle or close: how far the circles are from each other. The domain is lifted to Enneper's surface
// and uniformized until nothing moves, a mesh file until circles move by less than 1e-9. "error" is the largest
// relative error of an inversive distance, which no Moebius map changes, against the circles after the same step of the
// last sweep (the limits of the steps of a sweep differ by the discretization), "exact_error" against the domain's own.
#include "circle_domain.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"
#include "pipeline/uniformize.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>

using namespace koebe;

namespace {

/// Seven holes, one in the middle of six; the gaps between neighbouring circles shrink from domain to domain.
std::vector<Circle> circles_of(const std::string& domain)
{
    const double radius = domain == "apart" ? 0.12 : domain == "middle" ? 0.21 : domain == "close" ? 0.28 : 0.0;
    if (radius == 0.0) throw std::invalid_argument("no domain " + domain);
    std::vector<Circle> circles{{{0.0, 0.0}, 1.0}, {{0.0, 0.0}, radius}};
    for (int k = 0; k < 6; ++k) circles.push_back({std::polar(0.63, (0.1 + k / 3.0) * std::numbers::pi), radius});
    return circles;
}

/// Equal holes on a sunflower's spiral.
std::vector<Circle> sunflower(int holes)
{
    std::vector<Circle> circles{{{0.0, 0.0}, 1.0}};
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (int k = 0; k < holes; ++k)
        circles.push_back({std::polar(0.85 * std::sqrt((k + 0.5) / holes), golden * k), 0.45 / std::sqrt(holes + 4.0)});
    return circles;
}

/// A planar conformal map with bumps, which are not.
void write_surface(int holes, Index faces, const std::string& path)
{
    const test::CircleDomain domain = test::make_circle_domain(sunflower(holes), faces);
    Vertices vertices = test::lift(domain.points, test::Lift::polynomial);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        vertices(v, 2) += 0.15 * std::sin(4.0 * vertices(v, 0)) * std::cos(3.0 * vertices(v, 1));
    std::ofstream file(path);
    file << std::setprecision(10);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        file << "v " << vertices(v, 0) << ' ' << vertices(v, 1) << ' ' << vertices(v, 2) << '\n';
    for (Eigen::Index f = 0; f < domain.triangles.rows(); ++f)
        file << "f " << domain.triangles(f, 0) + 1 << ' ' << domain.triangles(f, 1) + 1 << ' '
             << domain.triangles(f, 2) + 1 << '\n';
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

/// The domain's circles in the order of the iteration's loops.
std::vector<Circle> in_order(const test::CircleDomain& domain, const UniformizeResult& result)
{
    std::vector<Circle> circles;
    for (const LoopReport& report : result.loops)
        for (std::size_t k = 0; k < domain.loops.size(); ++k)
            if (std::find(report.vertices.begin(), report.vertices.end(), domain.loops[k].front()) !=
                report.vertices.end())
                circles.push_back(domain.circles[k]);
    return circles;
}

Method method_of(const std::string& name)
{
    if (name == "gk" || name == "at-once") return Method::gk;
    if (name == "ck") return Method::ck;
    if (name == "against-outer") return Method::against_outer;
    throw std::invalid_argument("no method " + name);
}

UniformizeOptions options_of(const std::string& engine, const std::string& method)
{
    UniformizeOptions options;
    options.engine = engine == "mesh" ? Engine::mesh : Engine::condensed;
    options.method = method_of(method);
    options.gauss_seidel = method != "at-once";
    return options;
}

/// @param exact the domain's circles in the order of the loops; empty if nobody knows them
nlohmann::ordered_json steps_json(const UniformizeResult& result, const std::vector<Circle>& exact)
{
    const std::size_t per_sweep = static_cast<std::size_t>(result.steps / result.sweeps);
    nlohmann::ordered_json report{{"vertices", result.vertex_count},
                                  {"faces", result.face_count},
                                  {"boundaries", result.loops.size()},
                                  {"converged", result.converged},
                                  {"steps_per_sweep", per_sweep},
                                  {"factor_seconds", result.seconds.factor},
                                  {"iterate_seconds", result.seconds.iterate},
                                  {"total_seconds", result.seconds.total},
                                  {"steps", nlohmann::json::array()}};
    for (std::size_t k = 0; k < result.history.size(); ++k) {
        const KoebeStep& step = result.history[k];
        const KoebeStep& last = result.history[result.history.size() - per_sweep + k % per_sweep];
        report["steps"].push_back({{"step", step.step},
                                   {"pair", {step.pair.first, step.pair.second}},
                                   {"error", test::inversive_distance_error(step.circles, last.circles)},
                                   {"mean_roundness", step.mean_roundness.all.paper}});
        if (!exact.empty()) report["steps"].back()["exact_error"] = test::inversive_distance_error(step.circles, exact);
    }
    return report;
}

nlohmann::ordered_json steps_on_domain(const std::string& name, Index faces, const std::string& engine,
                                       const std::string& method)
{
    const test::CircleDomain domain = test::make_circle_domain(circles_of(name), faces);
    UniformizeOptions options = options_of(engine, method);
    options.tolerance = 1e-14;
    options.max_sweeps = options.engine == Engine::mesh ? 18 : 30;
    ExecutionContext context;
    const UniformizeResult result =
        uniformize(test::lift(domain.points, test::Lift::enneper), domain.triangles, options, context);
    return steps_json(result, in_order(domain, result));
}

nlohmann::ordered_json steps_on_file(const std::string& path, const std::string& engine, const std::string& method)
{
    PolygonMesh file = read_mesh(path);
    UniformizeOptions options = options_of(engine, method);
    options.tolerance = 1e-9;
    ExecutionContext context;
    return steps_json(uniformize(file.vertices, triangulate(file).triangles, options, context), {});
}

}  // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> words(argv + 1, argv + argc);
    try {
        if (words.size() == 4 && words[0] == "surface")
            write_surface(std::stoi(words[1]), static_cast<Index>(std::stol(words[2])), words[3]);
        else if (words.size() == 5 && words[0] == "steps")
            std::cout << steps_on_domain(words[1], static_cast<Index>(std::stol(words[2])), words[3], words[4]) << '\n';
        else if (words.size() == 4 && words[0] == "file")
            std::cout << steps_on_file(words[1], words[2], words[3]) << '\n';
        else
            throw std::invalid_argument("usage: koebe_rates surface HOLES FACES OUT.obj | "
                                        "steps apart|middle|close FACES ENGINE METHOD | file MESH ENGINE METHOD; "
                                        "ENGINE condensed|mesh, METHOD gk|ck|against-outer|at-once");
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
    return 0;
}
