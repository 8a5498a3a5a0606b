// What the reproduction of the paper needs beside the koebe command (bench/reproduce.py):
//
//   koebe_rates surface HOLES FACES OUT.obj      a smooth surface with round holes, on no shared scan
//   koebe_rates steps DOMAIN FACES ENGINE METHOD the error of the circles after each step, as JSON
//
// DOMAIN is apart, middle or close: how far the circles are from each other. The domain is lifted to Enneper's surface
// and uniformized until nothing moves; "error" is the largest relative error of an inversive distance, which no Moebius
// map changes, against the circles after the same step of the last sweep (the limits of the steps of a sweep differ by
// the discretization), "exact_error" against the domain's own.
#include "circle_domain.h"
#include "cli/fast_kernels.h"
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

nlohmann::ordered_json steps(const std::string& name, Index faces, const std::string& engine, const std::string& method)
{
    const test::CircleDomain domain = test::make_circle_domain(circles_of(name), faces);
    UniformizeOptions options;
    options.engine = engine == "mesh" ? Engine::mesh : Engine::condensed;
    options.method = method == "ck" ? Method::ck : Method::gk;
    options.tolerance = 1e-14;
    options.max_sweeps = options.engine == Engine::mesh ? 18 : 30;
    ExecutionContext context;
    const UniformizeResult result =
        uniformize(test::lift(domain.points, test::Lift::enneper), domain.triangles, options, context);
    const std::vector<Circle> exact = in_order(domain, result);
    const std::size_t per_sweep = static_cast<std::size_t>(result.steps / result.sweeps);
    nlohmann::ordered_json report{{"domain", name},
                                  {"faces", domain.triangles.rows()},
                                  {"holes", domain.circles.size() - 1},
                                  {"engine", engine},
                                  {"method", method},
                                  {"steps_per_sweep", per_sweep},
                                  {"steps", nlohmann::json::array()}};
    for (std::size_t k = 0; k < result.history.size(); ++k) {
        const KoebeStep& step = result.history[k];
        const KoebeStep& last = result.history[result.history.size() - per_sweep + k % per_sweep];
        report["steps"].push_back({{"step", step.step},
                                   {"pair", {step.pair.first, step.pair.second}},
                                   {"error", test::inversive_distance_error(step.circles, last.circles)},
                                   {"exact_error", test::inversive_distance_error(step.circles, exact)},
                                   {"mean_roundness", step.mean_roundness.all.paper}});
    }
    return report;
}

}  // namespace

int main(int argc, char** argv)
{
    cli::restart_with_fast_kernels(argv);
    const std::vector<std::string> words(argv + 1, argv + argc);
    try {
        if (words.size() == 4 && words[0] == "surface")
            write_surface(std::stoi(words[1]), static_cast<Index>(std::stol(words[2])), words[3]);
        else if (words.size() == 5 && words[0] == "steps")
            std::cout << steps(words[1], static_cast<Index>(std::stol(words[2])), words[3], words[4]).dump() << '\n';
        else
            throw std::invalid_argument("usage: koebe_rates surface HOLES FACES OUT.obj | "
                                        "steps apart|middle|close FACES condensed|mesh gk|ck");
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
    return 0;
}
