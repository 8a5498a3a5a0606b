#include "report/sphere_json.h"

#include "report/json.h"

namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

Json cap_json(const SphereLoop& loop)
{
    const Cap& cap = loop.cap;
    return loop_json(loop, {{"center", {cap.center[0], cap.center[1], cap.center[2]}}, {"radius", cap.radius}});
}

}  // namespace

Json to_json(const SphereResult& result)
{
    return report_json(result, {{"mean_point", result.mean_point},
                                {"loops", array_json(result.loops, cap_json)},
                                {"turned", result.turned},
                                {"on_sphere",
                                 {{"flipped", result.flipped_on_sphere.size()},
                                  {"below_resolution", result.below_sphere_resolution.size()}}},
                                {"layout",
                                 {{"kind", to_string(result.layout.kind)},
                                  {"crossing", result.layout.crossing},
                                  {"moved", result.layout.moved},
                                  {"torn", result.layout.torn},
                                  {"flipped", result.layout.flipped},
                                  {"below_resolution", result.layout.below_resolution}}}});
}

}  // namespace koebe
