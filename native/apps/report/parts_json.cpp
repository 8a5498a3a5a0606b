#include "report/parts_json.h"

#include "report/json.h"

namespace koebe {

nlohmann::ordered_json to_json(const PartsResult& result)
{
    using Json = nlohmann::ordered_json;
    // Each island, then copies that lie on others, then figures of the whole layout.
    Json parts = Json::array();
    for (const PartReport& part : result.parts)
        parts.push_back({{"kind", to_string(part.kind)},
                         {"faces", part.faces},
                         {"angle_error_deg", part.angle_error_deg},
                         {"loops", part.loops},
                         {"off_round", part.off_round}});
    Json stacked = Json::array();
    for (const StackedPart& one : result.stacked)
        stacked.push_back({{"part", one.part}, {"onto", one.onto}, {"mirrored", one.mirrored}});
    return report_json(result, {{"parts", std::move(parts)},
                                {"stacked", std::move(stacked)},
                                {"tiles", result.tiles},
                                {"converged", result.converged},
                                {"cut_length", result.cut_length},
                                {"slit_length", result.slit_length},
                                {"darts", result.darts},
                                {"dart_length", result.dart_length},
                                {"handles_cut", result.handles_cut},
                                {"density_ratio_5_95", result.density_ratio_5_95},
                                {"density", result.density},
                                {"even_area", result.even_area},
                                {"margin", result.margin},
                                {"coverage", result.coverage},
                                {"regions", result.regions},
                                {"whole", result.whole},
                                {"aligned", result.aligned},
                                {"maps", result.maps}});
}

}  // namespace koebe
