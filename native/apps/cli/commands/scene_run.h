// Maps each mesh of a GLB file, and writes the file with their UVs.
#pragma once

#include "cli/commands/map_kind.h"
#include "cli/files/scene_input.h"
#include "cli/process/interrupt.h"
#include "cli/process/progress_line.h"
#include "execution/stopwatch.h"
#include "exit_code.h"
#include "io/gltf_writer.h"

#include <string>
#include <vector>

namespace koebe::cli {

/// A mesh of the file after its map.
// NOLINTNEXTLINE(bugprone-exception-escape): JSON is moved without exceptions, by functions that could throw some
struct MappedMesh {
    nlohmann::ordered_json report;
    std::string first_words, picture;
    std::vector<GltfPoint> uvs;  ///< of the corners of its faces
    Distortion distortion;
    std::vector<Warning> warnings;
    bool converged = false;
};

/// Makes a report true for a GLB file. The file stores v from the top down, which rounds otherwise: faces that lose
/// their area by it are added. Vertices at the place of another one are in no face, and there is no warning of them.
/// @param uvs (C, 2) of the corners of the faces @param stored these in the file
void report_as_in_file(const MeshInput& input, const PlanarPoints& uvs, const std::vector<GltfPoint>& stored,
                       MapReport& report);

/// The context of one mesh of several: its progress is a share of the whole.
ExecutionContext share_of(ProgressLine& line, const CancelToken& token, const SceneInput& scene, std::size_t mesh);

/// Checks, before anything is read, the files that only one mesh can have. @throws KoebeError
void require_one_mesh_for_picture(const MapRequest& request, const SceneInput& scene);

/// Writes all files or none, and prints the result line.
/// @return an ExitCode
int finish_scene(const MapRequest& request, const SceneInput& scene, std::vector<MappedMesh>& mapped,
                 const Stopwatch& run, const CancelToken& token);

/// Reads, computes, writes all files or none, and prints the result line.
/// @return an ExitCode
template <typename Result>
int run_scene_of(const MapRequest& request, const MapKind<Result>& kind)
{
    const Stopwatch run;
    const CancelToken token = cancel_on_signal();
    const ReadOptions options = begin_run(request, kind);
    const SceneInput scene = read_scene_input(request.input, token, options);
    require_one_mesh_for_picture(request, scene);
    std::vector<MappedMesh> mapped;
    {
        // Map each mesh. Its UVs are rounded to the file's 32 bits before they are judged.
        ProgressLine progress(request.quiet);
        for (std::size_t m = 0; m < scene.inputs.size(); ++m) {
            const MeshInput& input = scene.inputs[m];
            ExecutionContext context = share_of(progress, token, scene, m);
            Result result = with_mesh_name(scene, m, [&] { return kind.compute(input, context); });
            const PlanarPoints uvs = kind.corner_uvs(input, result);
            MappedMesh& mesh = mapped.emplace_back();
            mesh.uvs = gltf_points(uvs);
            report_as_in_file(input, uvs, mesh.uvs, result);
            mesh.report = to_json(result);
            mesh.first_words = kind.first_words(result);
            if (!request.svg.empty()) mesh.picture = kind.draw(input, result);
            mesh.distortion = result.distortion;
            mesh.warnings = result.warnings;
            mesh.converged = result.converged;
        }
    }
    return finish_scene(request, scene, mapped, run, token);
}

}  // namespace koebe::cli
