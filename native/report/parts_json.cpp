#include "report/parts_json.h"

#include "report/json.h"

namespace koebe {

nlohmann::ordered_json to_json(const PartsResult& result)
{
    using Json = nlohmann::ordered_json;
    Json parts = Json::array();
    for (const PartReport& part : result.parts)
        parts.push_back({{"kind", to_string(part.kind)},
                         {"faces", part.faces},
                         {"angle_error_deg", part.angle_error_deg},
                         {"loops", part.loops},
                         {"off_round", part.off_round}});
    return {{"version", KOEBE_VERSION},
            {"input", ""},
            {"parts", std::move(parts)},
            {"cut_length", result.cut_length},
            {"slit_length", result.slit_length},
            {"handles_cut", result.handles_cut},
            {"density_ratio_5_95", result.density_ratio_5_95},
            {"even_area", result.even_area},
            {"flipped", result.flipped.size()},
            {"below_resolution", result.below_resolution.size()},
            {"angle_error_deg",
             {{"mean", result.angle_error_deg.mean},
              {"sd", result.angle_error_deg.sd},
              {"max", result.angle_error_deg.max}}},
            {"seconds", result.seconds},
            {"maps", result.maps},
            {"warnings", to_json(result.warnings)}};
}

}  // namespace koebe
