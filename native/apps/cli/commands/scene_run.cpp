#include "cli/commands/scene_run.h"

#include "cli/commands/map_kind.h"
#include "cli/process/result_line.h"
#include "cli/process/standard_streams.h"
#include "core/counted.h"
#include "core/sort_unique.h"
#include "files/atomic_file.h"
#include "quality/stored_uv.h"
#include "report/json.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

namespace koebe::cli {
namespace {

using Json = nlohmann::ordered_json;

/// v of a GLB file goes down: with u and v exchanged the face has its orientation again, and no further rounding.
StoredFace face_in_file(const GltfPoint* corners)
{
    const auto point = [&](int k) { return StoredPoint{corners[k].v, corners[k].u}; };
    return {point(0), point(1), point(2)};
}

StoredFace face_as_judged(const PlanarPoints& uvs, Index corner)
{
    const auto point = [&](Index k) {
        return StoredPoint{as_stored(uvs(corner + k, 0)), as_stored(uvs(corner + k, 1))};
    };
    return {point(0), point(1), point(2)};
}

double area_of(const PolygonMesh& mesh, Index face)
{
    const auto corners = mesh.face(face);
    const auto at = [&](int k) { return Eigen::Vector3d(mesh.vertices.row(corners[k])); };
    return 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
}

/// The report of the only mesh, or of all.
Json scene_report(const SceneInput& scene, const std::vector<MappedMesh>& mapped, double written, double total)
{
    if (mapped.size() == 1) {
        Json report = mapped.front().report;
        report["seconds"].update({{"read", scene.seconds}, {"write", written}, {"total", total}});
        return report;
    }
    Json meshes = Json::array();
    for (std::size_t m = 0; m < mapped.size(); ++m) {
        Json report{{"mesh", scene.meshes[m].place}, {"name", scene.meshes[m].name}};
        report.update(mapped[m].report);
        for (const char* of_file : {"version", "input"}) report.erase(of_file);
        meshes.push_back(std::move(report));
    }
    const auto all = [](const MappedMesh& mesh) { return mesh.converged; };
    return {{"version", KOEBE_VERSION},
            {"input", ""},
            {"meshes", std::move(meshes)},
            {"converged", std::ranges::all_of(mapped, all)},
            {"seconds", {{"read", scene.seconds}, {"write", written}, {"total", total}}}};
}

/// The warnings of all meshes, with their names where there are several.
std::vector<Warning> scene_warnings(const SceneInput& scene, const std::vector<MappedMesh>& mapped)
{
    std::vector<Warning> warnings;
    for (std::size_t m = 0; m < mapped.size(); ++m)
        add_losses(mapped.size() == 1 ? "" : mesh_name(scene.meshes[m]) + ": ", mapped[m].warnings, warnings);
    return warnings;
}

std::string scene_line(const MapRequest& request, const std::vector<MappedMesh>& mapped,
                       const std::vector<Warning>& warnings, double total, bool converged)
{
    std::string words = mapped.front().first_words;
    Distortion distortion = mapped.front().distortion;
    if (mapped.size() > 1) {
        words = std::to_string(mapped.size()) + " meshes";
        for (std::size_t m = 1; m < mapped.size(); ++m) {
            const Distortion& other = mapped[m].distortion;
            distortion.angle_error_deg.mean = std::max(distortion.angle_error_deg.mean, other.angle_error_deg.mean);
            for (const auto faces : {&Distortion::flipped, &Distortion::below_resolution})
                (distortion.*faces).insert((distortion.*faces).end(), (other.*faces).begin(), (other.*faces).end());
        }
    }
    return map_line(request, words, distortion, total, converged, warnings);
}

}  // namespace

void report_as_in_file(const MeshInput& input, const PlanarPoints& uvs, const std::vector<GltfPoint>& stored,
                       MapReport& report)
{
    std::erase_if(report.warnings, [](const Warning& warning) { return warning.kind == WarningKind::unused_vertices; });
    double whole = 0.0, lost = 0.0;
    for (Index f = 0; f < input.polygons.face_count(); ++f) {
        const double area = area_of(input.polygons, f);
        whole += area;
        const StoredFace judged = face_as_judged(uvs, 3 * f), in_file = face_in_file(stored.data() + 3 * f);
        if (judged.area() * in_file.area() > 0.0 || judged.area() == 0.0) continue;
        lost += area;
        report.distortion.flipped.push_back(f);
        if (in_file.below_resolution()) report.distortion.below_resolution.push_back(f);
    }
    if (lost == 0.0) return;
    sort_unique(report.distortion.flipped);
    sort_unique(report.distortion.below_resolution);
    report.distortion.lost_area = std::min(1.0, report.distortion.lost_area + lost / whole);
}

ExecutionContext share_of(ProgressLine& line, const CancelToken& token, const SceneInput& scene, std::size_t mesh)
{
    const ProgressCallback whole = line.callback();
    if (!whole) return {{}, token};
    const double count = static_cast<double>(scene.meshes.size());
    return {[whole, mesh, count](double fraction, const std::string& stage) {
                whole((static_cast<double>(mesh) + fraction) / count, stage);
            },
            token};
}

void require_one_mesh_for_picture(const MapRequest& request, const SceneInput& scene)
{
    if (!request.svg.empty() && scene.meshes.size() > 1)
        throw InputError("--svg draws one mesh, and the GLB file has " + std::to_string(scene.meshes.size()));
}

int finish_scene(const MapRequest& request, const SceneInput& scene, std::vector<MappedMesh>& mapped,
                 const Stopwatch& run, const CancelToken& token)
{
    const Stopwatch writing;
    const ProfiledStage stage("write");
    std::vector<std::vector<GltfPoint>> uvs;
    for (MappedMesh& mesh : mapped) uvs.push_back(std::move(mesh.uvs));
    std::vector<Warning> warnings = scene_warnings(scene, mapped);
    GlbWithUvs made = glb_with_corner_uvs(scene.file.bytes, scene.meshes, uvs, request.of_files.uv_channel);
    std::ranges::move(made.warnings, std::back_inserter(warnings));
    // All files are written before one of them is renamed.
    std::vector<AtomicFile> files;
    files.emplace_back(request.output).write(made.bytes);
    if (!request.svg.empty()) files.emplace_back(request.svg).write(mapped.front().picture);
    const double written = writing.elapsed(), total = run.elapsed();
    if (!request.json.empty()) {
        Json report = scene_report(scene, mapped, written, total);
        report["input"] = std::filesystem::path(request.input).filename().string();
        if (!scene.sha256.empty()) report["input_sha256"] = scene.sha256;
        report["warnings"] = to_json(warnings);
        report.update(request.entries);
        files.emplace_back(request.json).write(json_text(report));
    }
    ExecutionContext({}, token).checkpoint();
    for (AtomicFile& file : files) file.commit();
    const bool converged = std::ranges::all_of(mapped, [](const MappedMesh& mesh) { return mesh.converged; });
    if (!request.quiet) {
        print(scene_line(request, mapped, warnings, total, converged), "; the files are written");
        show_warnings(warnings);
    }
    return converged ? done : not_converged;
}

}  // namespace koebe::cli
