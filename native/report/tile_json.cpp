#include "report/tile_json.h"

#include "report/json.h"

namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

Json loop_json(const TileLoop& loop)
{
    Json json{{"vertices", loop.vertices}, {"rim", loop.rim}};
    if (loop.has_circle) {
        json["center"] = {loop.circle.center.real(), loop.circle.center.imag()};
        json["radius"] = loop.circle.radius;
        json["roundness"] = loop.roundness.paper;
        json["roundness_least_squares"] = loop.roundness.least_squares;
    }
    if (loop.is_slit) json["slit"] = loop.slit;
    json["off_circle"] = loop.off_circle;
    return json;
}

}  // namespace

Json to_json(const TileResult& result)
{
    Json loops = Json::array();
    for (const TileLoop& loop : result.loops) loops.push_back(loop_json(loop));
    return report_json(result, {{"converged", result.converged},
                                {"sweeps", result.sweeps},
                                {"changes", result.changes},
                                {"periods", result.periods},
                                {"modulus", {result.modulus.real(), result.modulus.imag()}},
                                {"loops", std::move(loops)},
                                {"turned", result.turned},
                                {"cut_length", result.cut_length}});
}

}  // namespace koebe
