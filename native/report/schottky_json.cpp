#include "report/schottky_json.h"

#include "report/json.h"

namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

Json pair_of(Complex z) { return {z.real(), z.imag()}; }

Json circle_entry(const Circle& circle) { return {{"center", pair_of(circle.center)}, {"radius", circle.radius}}; }

Json handle_json(const SchottkyHandle& handle)
{
    const LinearFractional& map = handle.generator;
    return {{"generator", {{pair_of(map.a), pair_of(map.b)}, {pair_of(map.c), pair_of(map.d)}}},
            {"multiplier", pair_of(map.multiplier())},
            {"circles", {circle_entry(handle.circles[0]), circle_entry(handle.circles[1])}},
            {"outer", handle.outer},
            {"misfit", handle.misfit},
            {"cut", handle.cut}};
}

Json hole_json(const SchottkyHole& hole)
{
    Json json{{"vertices", hole.vertices}};
    json.update(circle_entry(hole.circle));
    json["roundness"] = hole.roundness.paper;
    json["roundness_least_squares"] = hole.roundness.least_squares;
    json["off_circle"] = hole.off_circle;
    return json;
}

}  // namespace

Json to_json(const SchottkyResult& result)
{
    Json handles = Json::array(), holes = Json::array();
    for (const SchottkyHandle& handle : result.handles) handles.push_back(handle_json(handle));
    for (const SchottkyHole& hole : result.holes) holes.push_back(hole_json(hole));
    return report_json(result, {{"converged", result.converged},
                                {"sweeps", result.sweeps},
                                {"changes", result.changes},
                                {"by_circles", result.by_circles},
                                {"handles", std::move(handles)},
                                {"loops", std::move(holes)},
                                {"turned", result.turned}});
}

}  // namespace koebe
