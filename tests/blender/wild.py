"""Meshes of all shapes, whole and damaged, with what an artist may have on them, from one number."""

import json

import bmesh
import bpy
import numpy as np
import scenes


def panel(random):
    """A bent sheet of quadrilaterals."""
    return _sheet(int(random.integers(3, 9)), int(random.integers(3, 7)))


def _sheet(n, m):
    points = [(x, y, 0.3 * np.sin(x) + 0.1 * y * y / m) for y in range(m + 1) for x in range(n + 1)]
    return points, [
        [y * (n + 1) + x, y * (n + 1) + x + 1, (y + 1) * (n + 1) + x + 1, (y + 1) * (n + 1) + x]
        for y in range(m) for x in range(n)
    ]  # fmt: skip


def torus(random):
    return closed_grid(*random.integers((3, 3), (9, 7)).tolist())


def klein(random):
    return closed_grid(*random.integers((3, 3), (9, 7)).tolist(), klein=True)


def closed_grid(n, m, klein=False):
    """A torus, or Klein's bottle, as a figure of eight that is turned half round."""
    u, v = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(m) / m, indexing="ij")
    radius = 3 + np.cos(u / 2) * np.sin(v) - np.sin(u / 2) * np.sin(2 * v) if klein else 2 + np.cos(v)
    height = np.sin(u / 2) * np.sin(v) + np.cos(u / 2) * np.sin(2 * v) if klein else np.sin(v)
    points = np.stack([radius * np.cos(u), radius * np.sin(u), height], axis=2).reshape(-1, 3)

    def at(i, j):
        return (i % n) * m + (-j if klein and i == n else j) % m

    return points, [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(n) for j in range(m)]


def drum(random):
    """Closed, with two large polygons."""
    n = int(random.integers(3, 12))
    turn = 2 * np.pi * np.arange(n) / n
    points = [(np.cos(a), np.sin(a), z) for z in (0.0, 1.0) for a in turn]
    sides = [[j, (j + 1) % n, n + (j + 1) % n, n + j] for j in range(n)]
    return points, [*sides, list(range(n))[::-1], list(range(n, 2 * n))]


def keyhole(random):
    """One polygon around a hole, which goes in and out along the same edge's two ends, and quadrilaterals beside it."""
    square, inner = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(-0.4, -0.4, 0), (-0.4, 0.4, 0), (0.4, 0.4, 0)]
    gap = 0.0 if random.random() < 0.5 else 0.05
    points = [*square, (-1, -1 + gap, 0), *inner, (0.4, -0.4, 0), (-0.4, -0.4 + gap, 0), (2, -1, 0), (2, 1, 0)]
    return points, [[0, 1, 2, 3, 4, 9, 6, 7, 8, 5], [1, 10, 11, 2]]


def soup(random):
    """Faces between any points."""
    n, sizes = int(random.integers(5, 20)), random.integers(3, 5, random.integers(2, 25))
    return random.normal(size=(n, 3)), [random.choice(n, size, replace=False).tolist() for size in sizes]


def damaged(random, points, faces):
    """Up to five accidents: faces lost, doubled, turned, crowded at an edge, without area; vertices merged; a copy."""
    points, faces = np.array(points, dtype=float), [list(face) for face in faces]
    for _ in range(random.integers(0, 6)):
        accident, one = random.integers(7), int(random.integers(len(faces)))
        if accident == 0 and len(faces) > 3:
            faces.pop(one)
        elif accident == 1:
            faces.append(faces[one][1:] + faces[one][:1])
        elif accident == 2:
            faces[one] = faces[one][::-1]
        elif accident == 3:
            points = np.vstack([points, points.mean(axis=0) + random.normal(size=3)])
            faces.append([faces[one][0], faces[one][1], len(points) - 1])
        elif accident == 4:
            kept, gone = random.choice(len(points), 2, replace=False).tolist()
            merged = [[kept if v == gone else v for v in face] for face in faces]
            faces = [face for face in merged if len(set(face)) == len(face)] or faces
        elif accident == 5:
            points[faces[one]] = points[faces[one][0]]  # no area, nor have its neighbours much
        else:
            count = len(points)
            points = np.vstack([points, points + (5, 0, 0)])
            faces += [[v + count for v in face] for face in faces]
    return points, faces


def wild(random, name="Wild"):
    """An object with such a mesh, and things on it: loose vertices and edges, hidden faces, keys, modifiers, seams,
    pins, a mirrored or a flat scale, a parent."""
    shapes = (panel, torus, klein, drum, keyhole, soup)
    points, faces = damaged(random, *shapes[random.integers(len(shapes))](random))
    obj = scenes.add_object(name, points, faces)
    mesh = obj.data
    for dress in (_loose, _hidden, _keys, _modifiers, _scale, _marks, _parent, _flags):
        if random.random() < 0.35:
            dress(random, obj)
    mesh.update()
    return obj


def _loose(random, obj):
    """Vertices and edges without faces."""
    mesh, count = obj.data, len(obj.data.vertices)
    mesh.vertices.add(3)
    for vertex in range(count, count + 3):
        mesh.vertices[vertex].co = random.normal(size=3)
    first = len(mesh.edges)
    mesh.edges.add(2)
    for edge, ends in ((first, (count, count + 1)), (first + 1, (0, count))):
        mesh.edges[edge].vertices = ends


def _hidden(random, obj):
    """Faces hidden, as in Edit Mode: with the vertices and edges that no other face shows."""
    mesh = obj.data
    hidden = random.random(len(mesh.polygons)) < random.choice([0.2, 1.0])
    shown_vertices, shown_edges = np.zeros(len(mesh.vertices), bool), np.zeros(len(mesh.edges), bool)
    for face in mesh.polygons:
        if not hidden[face.index]:
            shown_vertices[list(face.vertices)] = True
            shown_edges[[mesh.loops[i].edge_index for i in face.loop_indices]] = True
    mesh.polygons.foreach_set("hide", hidden)
    mesh.vertices.foreach_set("hide", ~shown_vertices)
    mesh.edges.foreach_set("hide", ~shown_edges)


def _keys(random, obj):
    obj.shape_key_add(name="Basis")
    for point in obj.shape_key_add(name="Other").data:
        point.co.z += 0.3
    obj.active_shape_key_index = int(random.integers(2))


def _modifiers(random, obj):
    for kind in random.choice(["MIRROR", "SUBSURF", "SOLIDIFY", "ARRAY", "TRIANGULATE"], 2, replace=False):
        obj.modifiers.new(kind.title(), str(kind))


def _scale(random, obj):
    obj.scale = [(-1.0, 1.0, 1.0), (1.0, 1.0, 0.0), (0.0, 0.0, 0.0), (1e-6, 1e-6, 1e-6), (1e5, 1.0, -1.0)][
        random.integers(5)]  # fmt: skip


def _marks(random, obj):
    """Seams, sharp edges, smooth faces, another layer with pins, and perhaps the layer that is written."""
    mesh = obj.data
    mesh.edges.foreach_set("use_seam", random.random(len(mesh.edges)) < 0.2)
    mesh.edges.foreach_set("use_edge_sharp", random.random(len(mesh.edges)) < 0.2)
    mesh.polygons.foreach_set("use_smooth", random.random(len(mesh.polygons)) < 0.5)
    values = random.uniform(0, 1, 2 * len(mesh.loops)).astype(np.float32)
    name = "First"
    for layer in [str(random.choice(["Koebe", name])), name]:
        if layer not in mesh.uv_layers:
            mesh.uv_layers.new(name=layer).data.foreach_set("uv", values)
    edited = bmesh.new()  # through `data` Blender 4.5 spoils its memory with pins
    edited.from_mesh(mesh)
    layer = edited.loops.layers.uv[name]
    for face in edited.faces:
        for corner in face.loops:
            corner[layer].pin_uv = bool(random.random() < 0.3)
    edited.to_mesh(mesh)
    edited.free()


def _parent(random, obj):
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.collection.objects.link(parent)
    parent.rotation_euler, parent.scale = random.normal(size=3), (2.0, 1.0, -0.5)
    obj.parent = parent


def _flags(random, obj):
    """A vertex group, a material, a custom property."""
    group = obj.vertex_groups.new(name="Weight")
    for vertex in range(0, len(obj.data.vertices), 2):
        group.add([vertex], float(random.random()), "REPLACE")
    obj.data.materials.append(bpy.data.materials.new("Own"))
    obj.data["own"] = 7


def map_or_refuse(obj, job, assert_is_right):
    """Run a job on an object: each island is mapped right, or has a reason, and the mesh stays. Returns the islands
    that were mapped, and those that were not."""
    state = scenes.mesh_state(obj.data)
    job.compute()
    (outcome,) = job.outcomes
    for one in outcome.mapped:
        assert_is_right(outcome, one)
    for one in outcome.failed:
        assert "an unexpected error" not in str(one.error)
    if outcome.mapped:
        job.write()
        assert outcome.line() and json.dumps(job.entries(outcome))
    assert scenes.mesh_state(obj.data, but_layer="Koebe").items() >= {
        key: value for key, value in state.items() if key not in ("uv Koebe", "face material")
    }.items()
    return outcome.mapped, outcome.failed


def map_or_refuse_many(addon, seed, times, make, choices, assert_is_right):
    """As map_or_refuse, of so many objects that `make` adds, each with every one of its choices."""
    random, domains = np.random.default_rng(seed), addon("maps.domain_table")
    for _ in range(times):
        obj = make(random)
        bpy.context.view_layer.update()
        for choice in choices(random, domains):
            map_or_refuse(obj, scenes.domain_job(addon, obj, choice), assert_is_right)
        bpy.data.objects.remove(obj)


def add_wild(random, points, faces, noise, damage):
    """An object of these faces, with noise, and damaged in a share of the cases."""
    points = points + random.normal(0, random.choice([0, 0.02, noise]), points.shape)
    if random.random() < damage:
        points, faces = damaged(random, points, faces)
    return scenes.add_object("Wild", points, faces)
