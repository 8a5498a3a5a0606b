// The report's JSON has the keys of the contract, and the picture what it is to show.
#include "report/edge_trails.h"
#include "report/json.h"
#include "report/svg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace koebe {
namespace {

UniformizeResult sample_result()
{
    UniformizeResult result;
    result.uv.resize(5, 2);
    result.uv << 1, 0, 0, 1, -1, 0, 0, -1, 0.25, 0.25;
    result.method = Method::ck;
    result.engine = Engine::mesh;
    result.vertex_count = 5;
    result.face_count = 4;
    result.loops.resize(2);
    result.loops[0].vertices = {0, 1, 2, 3};
    result.loops[1].circle = {{0.25, -0.5}, 0.125};
    result.loops[1].roundness.paper = 1e-3;
    result.loops[1].off_circle = {4};
    result.outer_loop = 1;
    result.converged = true;
    result.sweeps = 2;
    result.steps = 3;
    result.history = {{1, {0, 1}, 0.5, {{0.25, 0.2}, {0.5, 0.4}}, {}},
                      {2, {1, 0}, 0.125, {{0.0625, 0.05}, {0.125, 0.1}}, {}}};
    result.distortion.flipped = {1, 2};
    result.distortion.below_resolution = {2};
    result.distortion.lost_area = 0.25;
    result.distortion.conformal_energy = 1.0 / 3.0;
    result.seconds.total = 1.5;
    result.warnings = {{WarningKind::flipped, "2 faces flipped", {3, 5}}};
    return result;
}

std::vector<std::string> keys_of(const nlohmann::ordered_json& object)
{
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

using Keys = std::vector<std::string>;

TEST(Json, HasTheKeysOfTheContractInItsOrder)
{
    const auto report = to_json(sample_result());
    EXPECT_EQ(keys_of(report), (Keys{"version",
                                     "input",
                                     "vertices",
                                     "faces",
                                     "method",
                                     "engine",
                                     "outer_loop",
                                     "converged",
                                     "sweeps",
                                     "steps",
                                     "history",
                                     "loops",
                                     "mean_roundness",
                                     "angle_error_deg",
                                     "angle_error_stored_deg",
                                     "lost_area",
                                     "beltrami",
                                     "area_distortion",
                                     "conformal_energy",
                                     "flipped",
                                     "below_resolution",
                                     "concave_polygons",
                                     "seconds",
                                     "peak_memory_mb",
                                     "warnings"}));
    EXPECT_EQ(keys_of(report["history"][0]),
              (Keys{"step", "pair", "change", "mean_roundness", "mean_roundness_holes"}));
    EXPECT_EQ(keys_of(report["loops"][0]), (Keys{"vertices", "center", "radius", "roundness", "roundness_least_squares",
                                                 "roundness_projected", "off_circle", "own_circle"}));
    EXPECT_EQ(keys_of(report["angle_error_deg"]), (Keys{"mean", "sd", "max"}));
    EXPECT_EQ(keys_of(report["beltrami"]), (Keys{"mean", "max"}));
    EXPECT_EQ(keys_of(report["seconds"]),
              (Keys{"read", "topology", "metric", "factor", "iterate", "finish", "write", "total"}));
}

TEST(Json, SaysWhatTheResultHolds)
{
    const auto report = nlohmann::json::parse(to_json(sample_result()).dump());
    EXPECT_EQ(report["method"], "ck");
    EXPECT_EQ(report["engine"], "mesh");
    EXPECT_EQ(report["outer_loop"], 1);
    EXPECT_EQ(report["history"][1]["pair"], nlohmann::json({1, 0}));
    EXPECT_EQ(report["loops"][0]["vertices"], nlohmann::json({0, 1, 2, 3}));
    EXPECT_EQ(report["loops"][0]["off_circle"], nlohmann::json::array());
    EXPECT_EQ(report["loops"][1]["center"], nlohmann::json({0.25, -0.5}));
    EXPECT_EQ(report["flipped"], 2);
    EXPECT_EQ(report["below_resolution"], 1);
    EXPECT_EQ(report["lost_area"], 0.25);
    EXPECT_EQ(report["conformal_energy"].get<double>(), 1.0 / 3.0);  // to the last bit
    EXPECT_EQ(report["warnings"][0]["kind"], "flipped");
    EXPECT_EQ(report["warnings"][0]["elements"], nlohmann::json({3, 5}));
    EXPECT_EQ(report["warnings"][0]["text"], "2 faces flipped; the first face is 3");
}

TEST(Json, AnEmptyResultHasArraysAndWhatIsNotFiniteIsNull)
{
    UniformizeResult result;
    result.distortion.beltrami.max = std::numeric_limits<double>::quiet_NaN();
    const auto report = nlohmann::json::parse(to_json(result).dump());
    for (const char* key : {"history", "loops", "warnings"}) EXPECT_TRUE(report[key].is_array()) << key;
    EXPECT_TRUE(report["beltrami"]["max"].is_null());
}

TEST(EdgeTrails, CoverEveryEdgeOnce)
{
    std::mt19937 random(5);
    std::set<Edge> edges;
    for (int i = 0; i < 500; ++i) {
        const auto a = static_cast<Index>(random() % 60), b = static_cast<Index>(random() % 60);
        if (a != b) edges.insert({std::min(a, b), std::max(a, b)});
    }
    const auto trails = edge_trails({edges.begin(), edges.end()}, 60);
    std::multiset<Edge> covered;
    for (const auto& trail : trails) {
        ASSERT_GE(trail.size(), 2u);
        for (std::size_t i = 1; i < trail.size(); ++i)
            covered.insert({std::min(trail[i - 1], trail[i]), std::max(trail[i - 1], trail[i])});
    }
    EXPECT_TRUE(std::equal(covered.begin(), covered.end(), edges.begin(), edges.end()));
    EXPECT_LT(trails.size(), edges.size() / 4);
}

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

/// The outer square of sample_result as a fan around vertex 4.
PolygonMesh fan()
{
    PolygonMesh mesh;
    mesh.vertices = Vertices::Zero(5, 3);
    mesh.corners = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    mesh.face_begin = {0, 3, 6, 9, 12};
    return mesh;
}

TEST(Svg, ShowsDiskHolesWireframeAndStrayVertices)
{
    const std::string svg = to_svg(sample_result(), fan());
    EXPECT_EQ(count(svg, "<circle"), 4u);  // the disk filled, one hole, the disk's rim, the stray vertex
    EXPECT_NE(svg.find("cx=\"6200\" cy=\"7400\" r=\"600\""), std::string::npos) << svg;  // the imaginary axis goes up
    EXPECT_GT(count(svg, "<path"), 0u);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(Svg, LargeMeshesAndPointsThatAreNoneAreLeftOut)
{
    PolygonMesh large = fan();
    large.face_begin.resize(wireframe_face_limit + 1, 12);
    EXPECT_EQ(count(to_svg(sample_result(), large), "<path"), 0u);

    UniformizeResult broken = sample_result();
    broken.uv.row(4).setConstant(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(count(to_svg(broken, fan()), "nan"), 0u);
}

}  // namespace
}  // namespace koebe
