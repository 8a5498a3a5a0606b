#include "report/lift_json.h"

#include "report/json.h"

namespace koebe {

nlohmann::ordered_json to_json(const LiftResult& result)
{
    const LeftOut& left = result.left_out;
    return report_json(result,
                       {{"shape", to_string(result.shape)},
                        {"pattern", result.pattern},
                        {"size", result.size},
                        {"bridge", result.bridge},
                        {"bend", result.bend},
                        {"outlines", result.outlines},
                        {"islands", result.islands},
                        {"crossings", result.crossings},
                        {"thin_bridges", result.thin_bridges},
                        {"thinnest_bridge", result.thinnest_bridge ? nlohmann::ordered_json(*result.thinnest_bridge)
                                                                   : nlohmann::ordered_json(nullptr)},
                        {"left_out",
                         {{"at_border", left.at_border},
                          {"too_fine", left.too_fine},
                          {"crossing", left.crossing},
                          {"open", left.open}}},
                        {"loops", {{"before", result.loops_before}, {"after", result.loops_after}}},
                        {"euler", {{"before", result.euler_before}, {"after", result.euler_after}}},
                        {"closed", result.uv.rows() == 0},
                        {"converged", result.converged}});
}

}  // namespace koebe
