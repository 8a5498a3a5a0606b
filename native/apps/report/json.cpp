#include "report/json.h"

#include "core/enum_words.h"

#include <array>
namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

Json step_json(const KoebeStep& step)
{
    return {{"step", step.step},
            {"pair", {step.pair.first, step.pair.second}},
            {"change", step.change},
            {"mean_roundness", step.mean_roundness.all.paper},
            {"mean_roundness_holes", step.mean_roundness.holes.paper}};
}

/// Without off_circle.
Json mapped_json(const MappedLoop& loop, const Json& circle)
{
    Json json{{"vertices", loop.vertices}};
    json.update(circle);
    json.update(to_json(loop.roundness));
    return json;
}

Json disk_loop_json(const LoopReport& loop)
{
    Json json = mapped_json(loop, to_json(loop.circle));
    json.update({{"roundness_projected", loop.roundness_projected},
                 {"off_circle", loop.off_circle},
                 {"own_circle", !loop.shrunk}});
    return json;
}

/// The circle of a loop by which shapes are compared.
Json conformal_json(const LoopReport& loop)
{
    Json json = to_json(loop.circle);
    json.update({{"off_circle", loop.off_circle}, {"own_circle", !loop.shrunk}});
    return json;
}

Json mean_roundness_json(const std::vector<LoopReport>& loops)
{
    std::vector<Roundness> each;
    for (const LoopReport& loop : loops) each.push_back(loop.roundness);
    const MeanRoundness mean = mean_roundness(each);
    return {{"all", mean.all.paper},
            {"holes", mean.holes.paper},
            {"least_squares", {{"all", mean.all.least_squares}, {"holes", mean.holes.least_squares}}}};
}

Json area_json(const AreaDistortion& area)
{
    return {{"log_sd", area.log_sd}, {"log_min", area.log_min}, {"log_max", area.log_max}};
}

Json angle_json(const AngleError& error) { return {{"mean", error.mean}, {"sd", error.sd}, {"max", error.max}}; }

Json warning_json(const Warning& warning)
{
    return {{"kind", to_string(warning.kind)}, {"elements", warning.elements}, {"text", warning.text()}};
}

}  // namespace

const char* to_string(Method method) noexcept { return word_of(method, std::array{"gk", "ck", "against-outer"}); }

const char* to_string(Engine engine) noexcept { return word_of(engine, std::array{"condensed", "mesh"}); }

Json to_json(const Distortion& distortion)
{
    return {{"angle_error_deg", angle_json(distortion.angle_error_deg)},
            {"angle_error_stored_deg", angle_json(distortion.angle_error_stored_deg)},
            {"lost_area", distortion.lost_area},
            {"beltrami", {{"mean", distortion.beltrami.mean}, {"max", distortion.beltrami.max}}},
            {"area_distortion", area_json(distortion.area)},
            {"conformal_energy", distortion.conformal_energy},
            {"flipped", distortion.flipped.size()},
            {"below_resolution", distortion.below_resolution.size()}};
}

Json to_json(const StageSeconds& seconds)
{
    return {{"read", seconds.read},     {"topology", seconds.topology}, {"metric", seconds.metric},
            {"factor", seconds.factor}, {"iterate", seconds.iterate},   {"finish", seconds.finish},
            {"write", seconds.write},   {"total", seconds.total}};
}

Json to_json(const std::vector<Warning>& warnings) { return array_json(warnings, warning_json); }

Json report_json(const MapReport& map, const Json& own)
{
    Json report{{"version", KOEBE_VERSION}, {"input", ""}, {"vertices", map.vertex_count}, {"faces", map.face_count}};
    report.update(own);
    report["converged"] = map.converged;
    if (map.even) report.update({{"even", *map.even}, {"overlaps", map.overlaps}});
    report.update(to_json(map.distortion));
    std::size_t concave = 0;
    for (const Warning& warning : map.warnings)
        if (warning.kind == WarningKind::concave_polygons) concave += warning.elements.size();
    report["concave_polygons"] = concave;
    report.update({{"seconds", to_json(map.seconds)},
                   {"peak_memory_mb", map.peak_memory_mb},
                   {"warnings", to_json(map.warnings)}});
    return report;
}

Json report_json(const SweptMapReport& map, const Json& own)
{
    Json all{{"converged", map.converged}, {"sweeps", map.sweeps}, {"changes", map.changes}};
    all.update(own);
    return report_json(static_cast<const MapReport&>(map), all);
}

Json to_json(const Circle& circle)
{
    return {{"center", {circle.center.real(), circle.center.imag()}}, {"radius", circle.radius}};
}

Json to_json(const Roundness& roundness)
{
    return {{"roundness", roundness.paper}, {"roundness_least_squares", roundness.least_squares}};
}

Json loop_json(const MappedLoop& loop, const Json& circle)
{
    Json json = mapped_json(loop, circle);
    json["off_circle"] = loop.off_circle;
    return json;
}

Json to_json(const UniformizeResult& result)
{
    Json own{
        {"method", to_string(result.method)}, {"engine", to_string(result.engine)}, {"outer_loop", result.outer_loop}};
    if (result.center >= 0) own["center"] = result.center;
    if (result.point >= 0) own["point"] = result.point;
    own.update({{"converged", result.converged},
                {"sweeps", result.sweeps},
                {"steps", result.steps},
                {"history", array_json(result.history, step_json)},
                {"loops", array_json(result.loops, disk_loop_json)},
                {"mean_roundness", mean_roundness_json(result.loops)}});
    for (std::size_t k = 0; result.conformal && k < result.loops.size(); ++k)
        own["loops"][k]["conformal"] = conformal_json(result.conformal->loops[k]);
    Json report = report_json(result, own);
    if (result.unbalanced_area) report["area_distortion"]["before_balance"] = area_json(*result.unbalanced_area);
    if (result.unpolished_angle_error_deg)
        report["angle_error_deg"]["before_polish"] = result.unpolished_angle_error_deg->mean;
    return report;
}

std::string json_text(const Json& report) { return report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace koebe
