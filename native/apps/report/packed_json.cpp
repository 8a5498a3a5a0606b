#include "report/packed_json.h"

#include "report/json.h"

namespace koebe {

nlohmann::ordered_json to_json(const PackedLayer& result)
{
    using Json = nlohmann::ordered_json;
    Json islands = Json::array();
    for (const LayerIsland& island : result.islands)
        islands.push_back({{"faces", island.faces}, {"overlaps", island.overlaps}, {"locked", island.locked}});
    return report_json(result, {{"islands", std::move(islands)},
                                {"overlaps", result.overlaps},
                                {"tiles", result.tiles},
                                {"margin", result.margin},
                                {"scale", result.scale},
                                {"coverage", result.coverage}});
}

}  // namespace koebe
