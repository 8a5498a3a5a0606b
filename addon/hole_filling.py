# SPDX-License-Identifier: GPL-3.0-or-later
"""Fills holes of a mesh with real faces: finds the boundary loops, adds the patches, continues the UVs."""

import dataclasses

import numpy as np

from . import patch

HOLES, SELECTED, ALL = "holes", "selected", "all"
SAME_UV = 1e-5  # UV units: corners of a vertex nearer than this are one point of the map


class FillError(Exception):
    """The mesh has nothing to fill, or a boundary that is no closed loop."""


@dataclasses.dataclass
class Filling:
    """What fills one hole: the hole's corners, the new vertices (k, 3), faces, and the UVs of each layer."""

    corners: list
    vertices: np.ndarray
    disk: patch.Disk
    uvs: dict


def boundary_loops(mesh):
    """Boundary loops of a bmesh: lists of the corners at which the boundary edges begin, in the faces' direction."""
    ahead = [edge.link_loops[0] for edge in mesh.edges if edge.is_boundary and not edge.hide]
    open_corners, loops = set(ahead), []
    for first in ahead:
        if first not in open_corners:
            continue
        loop, corner = [], first
        while corner in open_corners:
            open_corners.remove(corner)
            loop.append(corner)
            corner = _next_on_boundary(corner)
        if corner is not first:
            raise FillError("a boundary is no closed loop: faces are turned against each other or too many meet")
        loops.append(loop)
    return loops


def _next_on_boundary(corner):
    """The corner whose edge follows on the boundary, found by walking round the vertex."""
    vertex = corner.link_loop_next.vert
    corner = corner.link_loop_next
    while not corner.edge.is_boundary:
        corner = corner.link_loop_radial_next
        if corner.vert is vertex or len(corner.edge.link_loops) != 2:
            return None
        corner = corner.link_loop_next
    return corner


def chosen_loops(mesh, which):
    """The loops to fill. HOLES: all but the longest of each connected part; SELECTED: whose edges all are selected."""
    loops = boundary_loops(mesh)
    if which == SELECTED:
        loops = [loop for loop in loops if all(corner.edge.select for corner in loop)]
    elif which == HOLES:
        part, longest = _parts(loops), {}
        length = [sum(corner.edge.calc_length() for corner in loop) for loop in loops]
        for index in range(len(loops)):
            best = longest.setdefault(part[index], index)
            if length[index] > length[best]:
                longest[part[index]] = index
        loops = [loop for index, loop in enumerate(loops) if longest[part[index]] != index]
    if not loops:
        raise FillError(
            "no boundary loop is selected" if which == SELECTED else "there is no hole: no boundary but the outer one"
        )
    return loops


def _parts(loops):
    """For each loop the number of the connected part of the mesh that it is on."""
    seen, numbers = {}, []
    for number, loop in enumerate(loops):
        first = loop[0].face
        stack = [] if first in seen else [first]
        while stack:
            face = stack.pop()
            if face in seen:
                continue
            seen[face] = number
            stack += [other for edge in face.edges for other in edge.link_faces if other not in seen]
        numbers.append(seen[first])
    return numbers


def filling(mesh, loop):
    """The patch for one loop; changes nothing."""
    corners = loop[::-1]  # seen from the patch the boundary runs the other way
    vertices = [corner.link_loop_next.vert for corner in corners]
    positions = np.array([vertex.co for vertex in vertices], dtype=np.float64)
    if not np.ptp(positions, axis=0).max() > 0.0:  # NaN too
        raise FillError("a hole has no extent: merge its doubled vertices")
    disk = patch.triangulated_disk(patch.rim_by_length(positions))
    inner = patch.faired(disk, positions, *_surroundings(vertices))
    uvs = {layer.name: _continued_uv(layer, corners, disk) for layer in mesh.loops.layers.uv.values()}
    return Filling(corners, inner, disk, {name: uv for name, uv in uvs.items() if uv is not None})


def _surroundings(vertices):
    """Vertices (m, 3) of the faces that meet a hole, but for its own, and these faces as triangles (t, 3)."""
    rank = {vertex: i for i, vertex in enumerate(vertices)}
    triangles = []
    for face in dict.fromkeys(face for vertex in vertices for face in vertex.link_faces):
        corners = [rank.setdefault(vertex, len(rank)) for vertex in face.verts]
        triangles += [(corners[0], one, two) for one, two in zip(corners[1:], corners[2:])]
    others = [vertex.co for vertex in list(rank)[len(vertices) :]]
    return np.array(others, dtype=np.float64).reshape(-1, 3), np.array(sorted(triangles))


def _continued_uv(layer, corners, disk):
    """UVs (n, 2) of the disk's vertices, harmonic; None where a seam ends at the hole."""
    begin = np.array([corner.link_loop_next[layer].uv for corner in corners])
    end = np.array([corner[layer].uv for corner in corners])
    if np.abs(np.roll(end, 1, axis=0) - begin).max() > SAME_UV:
        return None
    return patch.harmonic(disk, begin)


def add_faces(mesh, fillings):
    """Add the patches to the bmesh; return the new faces. Material and shading are those beside them."""
    added = []
    for one in fillings:
        vertices = [corner.link_loop_next.vert for corner in one.corners]
        vertices += [mesh.verts.new(position) for position in one.vertices]
        model = one.corners[0].face
        material, smooth = model.material_index, model.smooth
        layers = [(mesh.loops.layers.uv[name], uv) for name, uv in one.uvs.items()]
        for triangle in one.disk.triangles.tolist():
            face = mesh.faces.new([vertices[v] for v in triangle])
            face.material_index, face.smooth = material, smooth
            for layer, uv in layers:
                for corner, v in zip(face.loops, triangle, strict=True):
                    corner[layer].uv = uv[v]
            added.append(face)
    return added
