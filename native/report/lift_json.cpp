#include "report/lift_json.h"

#include "report/json.h"

namespace koebe {

nlohmann::ordered_json to_json(const LiftResult& result)
{
    const LeftOut& left = result.left_out;
    nlohmann::ordered_json report{
        {"version", KOEBE_VERSION},
        {"input", ""},
        {"shape", to_string(result.shape)},
        {"pattern", result.pattern},
        {"size", result.size},
        {"bridge", result.bridge},
        {"bend", result.bend},
        {"outlines", result.outlines},
        {"left_out", {{"at_border", left.at_border}, {"too_fine", left.too_fine}, {"crossing", left.crossing}}},
        {"loops", {{"before", result.loops_before}, {"after", result.loops_after}}},
        {"euler", {{"before", result.euler_before}, {"after", result.euler_after}}},
        {"vertices", result.vertices.rows()},
        {"faces", result.triangles.rows()},
        {"closed", result.uv.rows() == 0},
        {"converged", result.converged}};
    report.update(to_json(result.distortion));
    report["seconds"] = to_json(result.seconds);
    report["peak_memory_mb"] = result.peak_memory_mb;
    report["warnings"] = to_json(result.warnings);
    return report;
}

}  // namespace koebe
