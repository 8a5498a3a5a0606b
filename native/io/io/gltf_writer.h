// Writes UVs into a GLB file and keeps everything else.
#pragma once

#include "core/warning.h"
#include "io/gltf_meshes.h"

#include <string>
#include <string_view>
#include <vector>

namespace koebe {

/// A point of the UV square as a GLB file stores it: 32-bit floats, v from the top down (glTF 2.0, section 3.8.2).
struct GltfPoint {
    float u, v;

    friend bool operator==(const GltfPoint& a, const GltfPoint& b) { return a.u == b.u && a.v == b.v; }
    friend bool operator<(const GltfPoint& a, const GltfPoint& b) { return a.u < b.u || (a.u == b.u && a.v < b.v); }
};

/// @param uv (N, 2) u and v in [0, 1], v from the bottom up
std::vector<GltfPoint> gltf_points(const PlanarPoints& uv);

struct GlbWithUvs {
    std::string bytes;
    std::vector<Warning> warnings;  ///< about contents that the new UVs replace: kinds replaced_uvs, not_kept
};

/// The GLB file with these UVs as TEXCOORD_`set` of its meshes.
///
/// Materials, skins, morph targets, animations and all other contents stay, bit for bit, but for what belonged to the
/// old UVs of the set: tangents, which programs then compute by MikkTSpace (glTF 2.0, section 3.7.2.1), and
/// KHR_texture_transform of materials that only these meshes have. Data that only replaced accessors used leave the
/// file (io/glb_editor.h). Where a vertex has several UVs, the primitive gets copies of the vertex, with all of its
/// attributes and morph targets, behind its vertices; strips and fans become lists then.
/// @param meshes of read_gltf_meshes @param uvs for each of them: (C) of the corners of its faces
/// @throws InputError the file would have more than 4 GiB, or too many vertices; a primitive lacks a set below this one
GlbWithUvs glb_with_corner_uvs(std::string_view glb, const std::vector<GltfMesh>& meshes,
                               const std::vector<std::vector<GltfPoint>>& uvs, int set = 0);

}  // namespace koebe
