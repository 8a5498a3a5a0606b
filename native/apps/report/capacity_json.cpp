#include "report/capacity_json.h"

#include "certified/polygonal_circles.h"
#include "core/warning.h"
#include "report/json.h"
#include "shape/conformal_module.h"

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
        capacities.push_back({{"low", capacity.condenser.at_zero},
                              {"high", capacity.condenser.at_one},
                              {"lower", capacity.value.lower},
                              {"upper", capacity.value.upper}});
    nlohmann::ordered_json json{{"version", KOEBE_VERSION},      {"input", ""},
                                {"converged", report.converged}, {"rims", to_string(RimKind::polygonal)},
                                {"width", report.width},         {"faces", report.faces},
                                {"levels", report.levels},       {"capacities", capacities}};
    if (report.modulus) json["modulus"] = enclosure_json(*report.modulus);
    if (!report.module.empty()) {
        const std::vector<std::string> names = module_names(report.order.size());
        for (std::size_t i = 0; i < names.size(); ++i) json[names[i]] = enclosure_json(report.module[i]);
        json["loops"] = report.order;
    }
    std::vector<Warning> warnings = report.warnings;
    if (!report.no_module.empty())
        warnings.push_back({WarningKind::not_enclosed, "the circles have no proved bounds: " + report.no_module});
    json["warnings"] = to_json(warnings);
    return json;
}

}  // namespace koebe
