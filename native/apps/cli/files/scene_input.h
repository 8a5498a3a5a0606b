// The meshes of a GLB file as inputs of a map.
#pragma once

#include "cli/files/mesh_input.h"
#include "core/errors.h"
#include "io/gltf_meshes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace koebe::cli {

struct SceneInput {
    MeshFile file;
    std::string sha256;
    std::vector<GltfMesh> meshes;
    std::vector<MeshInput> inputs;  ///< of each mesh; without the file
    double seconds = 0.0;           ///< time to read and triangulate
};

/// @throws FileError, InputError, Cancelled
SceneInput read_scene_input(const std::filesystem::path& path, const CancelToken& token, const ReadOptions& options);

/// Calls compute(), and puts the mesh's name before an error's message, if the file has several.
template <typename Compute>
auto with_mesh_name(const SceneInput& scene, std::size_t mesh, Compute&& compute)
{
    if (scene.meshes.size() == 1) return compute();
    const auto named = [&](const KoebeError& error) { return mesh_name(scene.meshes[mesh]) + ": " + error.what(); };
    try {
        return compute();
    } catch (const TopologyError& error) {
        throw TopologyError(error.kind(), named(error), error.elements());
    } catch (const InputError& error) {
        throw InputError(named(error), error.elements_of(), error.elements());
    } catch (const OutOfMemory& error) {
        throw OutOfMemory(named(error), error.elements_of(), error.elements());
    } catch (const SolverError& error) {
        throw SolverError(named(error), error.elements_of(), error.elements());
    }
}

}  // namespace koebe::cli
