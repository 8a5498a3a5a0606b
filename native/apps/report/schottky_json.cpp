#include "report/schottky_json.h"

#include "report/json.h"

namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

Json pair_of(Complex z) { return {z.real(), z.imag()}; }

Json handle_json(const SchottkyHandle& handle)
{
    const LinearFractional& map = handle.generator;
    return {{"generator", {{pair_of(map.a), pair_of(map.b)}, {pair_of(map.c), pair_of(map.d)}}},
            {"multiplier", pair_of(map.multiplier())},
            {"circles", {to_json(handle.circles[0]), to_json(handle.circles[1])}},
            {"outer", handle.outer},
            {"misfit", handle.misfit},
            {"cut", handle.cut}};
}

Json hole_json(const SchottkyHole& hole) { return loop_json(hole, to_json(hole.circle)); }

}  // namespace

Json to_json(const SchottkyResult& result)
{
    return report_json(result, {{"by_circles", result.by_circles},
                                {"handles", array_json(result.handles, handle_json)},
                                {"loops", array_json(result.holes, hole_json)},
                                {"turned", result.turned}});
}

}  // namespace koebe
