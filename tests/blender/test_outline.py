"""The outlines that the UV Editor shows in Object Mode: the edges without a neighbour in the UVs, and no others."""

import collections

import bpy
import numpy as np
import pytest
import scenes

LAYER = "Koebe"


def lonely_edges(obj):
    """Edges and sides (as pairs of UVs) that no other face has in the same place: by dictionaries, one by one."""
    mesh, uv = obj.data, obj.data.uv_layers[LAYER].data
    sides = collections.defaultdict(list)
    for face in mesh.polygons:
        loops = list(face.loop_indices)
        for here, there in zip(loops, loops[1:] + loops[:1], strict=True):
            ends = sorted((mesh.loops[i].vertex_index, tuple(uv[i].uv)) for i in (here, there))
            sides[mesh.loops[here].edge_index].append(tuple(ends))
    found = []
    for edge, ones in sides.items():
        found += [(edge, one) for one in ones if ones.count(one) == 1]
    return sorted(found)


@pytest.mark.parametrize("how", ["disk", "tube", "parts"])
def test_they_are_the_edges_without_a_neighbour_in_the_uvs(addon, how):
    if how == "parts":
        bpy.ops.mesh.primitive_torus_add(major_segments=24, minor_segments=12)
        bpy.ops.uv.koebe_parts(checker=False)
    elif how == "tube":
        bpy.ops.mesh.primitive_cylinder_add(end_fill_type="NOTHING")
        bpy.ops.uv.koebe_uniformize(tube="unroll", checker=False)
    else:
        scenes.add_panel()
        bpy.ops.uv.koebe_uniformize(checker=False)
    obj = bpy.context.object
    vertex, edge, following, uv = addon("blender.mesh_reading").read_layout(obj, LAYER)
    ends = addon("layers.uv_outline").outline(vertex, edge, following, uv)
    found = sorted(
        (max(edge[pair], key=lambda e: (set(obj.data.edges[e].vertices) == set(vertex[pair].tolist()))).item(),
         tuple(sorted((int(vertex[i]), tuple(uv[i].tolist())) for i in pair)))
        for pair in ends
    )  # fmt: skip
    assert found == lonely_edges(obj) and len(found) > 3


def test_a_layer_without_faces_has_none(addon):
    empty = np.zeros(0, np.int32)
    assert addon("layers.uv_outline").outline(empty, empty, empty, np.zeros((0, 2), np.float32)).shape == (0, 2)
