#include "report/sphere_json.h"

#include "report/json.h"

namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

Json cap_json(const SphereLoop& loop)
{
    return {{"vertices", loop.vertices},
            {"center", {loop.cap.center[0], loop.cap.center[1], loop.cap.center[2]}},
            {"radius", loop.cap.radius},
            {"roundness", loop.roundness.paper},
            {"roundness_least_squares", loop.roundness.least_squares},
            {"off_circle", loop.off_circle}};
}

}  // namespace

Json to_json(const SphereResult& result)
{
    Json loops = Json::array();
    for (const SphereLoop& loop : result.loops) loops.push_back(cap_json(loop));
    return report_json(result, {{"converged", result.converged},
                                {"sweeps", result.sweeps},
                                {"changes", result.changes},
                                {"mean_point", result.mean_point},
                                {"loops", std::move(loops)},
                                {"turned", result.turned},
                                {"on_sphere",
                                 {{"flipped", result.flipped_on_sphere.size()},
                                  {"below_resolution", result.below_sphere_resolution.size()}}},
                                {"layout",
                                 {{"kind", to_string(result.layout.kind)},
                                  {"crossing", result.layout.crossing},
                                  {"torn", result.layout.torn},
                                  {"flipped", result.layout.flipped},
                                  {"below_resolution", result.layout.below_resolution}}}});
}

}  // namespace koebe
