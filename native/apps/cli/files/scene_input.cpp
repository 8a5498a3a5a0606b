#include "cli/files/scene_input.h"

#include "execution/detachable_run.h"
#include "execution/stopwatch.h"
#include "execution/thread_share.h"

namespace koebe::cli {
namespace {

SceneInput read_scene(const std::filesystem::path& path, const ReadOptions& options)
{
    const Stopwatch reading;
    const ProfiledStage stage("read");
    const ThreadShare threads(options.threads);
    SceneInput scene;
    scene.file = read_hashed(path, options, scene.sha256);
    scene.meshes = read_gltf_meshes(scene.file.bytes);
    std::vector<PlanarPoints> uvs;
    if (options.uv_set) uvs = read_gltf_uvs(scene.file.bytes, *options.uv_set);
    std::vector<std::vector<Index>> marks;
    if (options.cut_at != CutAt::nothing) marks = read_gltf_marks(scene.file.bytes, options.cut_at);
    for (GltfMesh& mesh : scene.meshes)
        with_mesh_name(scene, scene.inputs.size(), [&] {
            MeshInput input;
            input.polygons = std::move(mesh.polygons);
            if (options.uv_set) input.uvs = std::move(uvs[scene.inputs.size()]);
            if (!marks.empty()) input.marks = std::move(marks[scene.inputs.size()]);
            triangulate_input(input, options);
            scene.inputs.push_back(std::move(input));
        });
    scene.seconds = reading.elapsed();
    return scene;
}

}  // namespace

SceneInput read_scene_input(const std::filesystem::path& path, const CancelToken& token, const ReadOptions& options)
{
    ExecutionContext context({}, token);
    return run_detachable<SceneInput>(context,
                                      [path, options](ExecutionContext&) { return read_scene(path, options); });
}

}  // namespace koebe::cli
