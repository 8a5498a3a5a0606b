#include "report/capacity_json.h"

namespace koebe {
namespace {

nlohmann::ordered_json enclosure_json(const Interval& value)
{
    return {{"lower", value.lower}, {"upper", value.upper}};
}

}  // namespace

nlohmann::ordered_json to_json(const CapacityReport& report)
{
    nlohmann::ordered_json capacities = nlohmann::ordered_json::array();
    for (const Capacity& capacity : report.capacities)
        capacities.push_back({{"low", capacity.condenser.low},
                              {"high", capacity.condenser.high},
                              {"lower", capacity.value.lower},
                              {"upper", capacity.value.upper}});
    nlohmann::ordered_json json{{"version", KOEBE_VERSION}, {"input", ""},           {"converged", report.converged},
                                {"width", report.width},    {"faces", report.faces}, {"levels", report.levels},
                                {"capacities", capacities}};
    if (report.modulus) json["modulus"] = enclosure_json(*report.modulus);
    if (report.inner_radius) json["r_1"] = enclosure_json(*report.inner_radius);
    return json;
}

}  // namespace koebe
