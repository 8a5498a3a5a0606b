#include "report/tile_json.h"

#include "report/json.h"

namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

Json tile_loop_json(const TileLoop& loop)
{
    Json json{{"vertices", loop.vertices}, {"rim", loop.rim}};
    if (loop.has_circle) {
        json.update(to_json(loop.circle));
        json.update(to_json(loop.roundness));
    }
    if (loop.is_slit) json["slit"] = loop.slit;
    json["off_circle"] = loop.off_circle;
    return json;
}

}  // namespace

Json to_json(const TileResult& result)
{
    return report_json(result, {{"periods", result.periods},
                                {"modulus", {result.modulus.real(), result.modulus.imag()}},
                                {"loops", array_json(result.loops, tile_loop_json)},
                                {"turned", result.turned},
                                {"cut_length", result.cut_length}});
}

}  // namespace koebe
