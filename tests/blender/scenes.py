"""Objects to test with, made from nothing, and ways to look at them that do not use the add-on."""

import bmesh
import bpy
import numpy as np
import pytest

CIRCLE_TOLERANCE = 1e-6  # UV units; 32-bit UVs near 1 are 6e-8 apart
# Blocks of faces that are cut out: from and to a part of the turn, from and to a part of the radius.
HOLES = ((0.03, 0.20, 0.35, 0.65), (0.30, 0.45, 0.30, 0.70), (0.62, 0.90, 0.45, 0.60))


def bend(x, y):
    """Height of the panel over its plane."""
    return 0.35 * np.sin(2.0 * x) + 0.2 * y * y


def panel_arrays(size=26, holes=HOLES, height=bend):
    """Vertices and faces of a bent round panel of radius 1 with holes: a fan, then rings of quads.

    No face has two boundary edges, so that every boundary can be drawn round.
    """
    rings, around = size // 2, 2 * size
    turn = 2.0 * np.pi * np.arange(around) / around
    radius = np.arange(1, rings + 1) / rings
    x = np.append(0.0, np.outer(radius, np.cos(turn)))
    y = np.append(0.0, np.outer(radius, np.sin(turn)))
    at = lambda i, j: 1 + i * around + j % around  # noqa: E731
    cut = {
        (i, j)
        for turn_from, turn_to, radius_from, radius_to in holes
        for i in range(int(radius_from * rings), int(radius_to * rings))
        for j in range(int(turn_from * around), int(turn_to * around))
    }
    faces = [[0, at(0, j), at(0, j + 1)] for j in range(around)]
    faces += [
        [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
        for i in range(rings - 1)
        for j in range(around)
        if (i, j) not in cut
    ]
    used, index = np.unique(np.concatenate(faces), return_inverse=True)
    ends = np.cumsum([len(face) for face in faces])[:-1]
    vertices = np.stack([x, y, height(x, y)], axis=1)[used]
    return vertices, [face.tolist() for face in np.split(index, ends)]


def add_object(name, vertices, faces):
    """A new mesh object in the scene."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, v)) for v in vertices], [], [[int(i) for i in f] for f in faces])
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    return obj


def add_panel(name="Panel", **options):
    """The panel as an object, selected and active."""
    obj = add_object(name, *panel_arrays(**options))
    select(obj)
    return obj


def add_cube(name="Cube", closed=True):
    """A cube: closed, or without its top."""
    vertices = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    faces = [(0, 2, 3, 1), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6), (4, 5, 7, 6)]
    return add_object(name, vertices, faces if closed else faces[:5])


def add_sheet(size=12, seams=()):
    """A bent sheet of quadrilaterals, selected. @param seams columns of vertices along which it is cut"""
    side = np.linspace(-1, 1, size + 1)
    x, y = np.meshgrid(side, side, indexing="ij")
    vertices = np.stack([x, y, 0.3 * np.sin(2 * x) * y], axis=-1).reshape(-1, 3)
    at = np.arange((size + 1) ** 2).reshape(size + 1, size + 1)
    faces = np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]], axis=-1).reshape(-1, 4)
    obj = add_object("Sheet", vertices.tolist(), faces.tolist())
    ends = np.array([edge.vertices[:] for edge in obj.data.edges])
    cut = np.zeros(len(ends), dtype=bool)
    for column in seams:
        cut |= (ends // (size + 1) == column).all(axis=1)
    obj.data.edges.foreach_set("use_seam", cut)
    select(obj)
    return obj


def select_seams(obj):
    """Enter Edit Mode with the seams selected, and no other edge."""
    select(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    mesh = bmesh.from_edit_mesh(obj.data)
    for element in (*mesh.faces, *mesh.verts, *mesh.edges):
        element.select_set(False)
    for edge in mesh.edges:
        edge.select_set(edge.seam)
    mesh.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)


def select(*objects):
    """Select these objects only; the first one is active."""
    bpy.context.view_layer.update()  # a new object cannot be selected before
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0]


def edit_all(mode="EDIT"):
    """Enter Edit Mode with everything selected, or another mode."""
    bpy.ops.object.mode_set(mode=mode)
    if mode == "EDIT":
        bpy.ops.mesh.select_all(action="SELECT")


def select_faces(obj, indices=None):
    """Enter Edit Mode in face mode with these faces selected (None: all)."""
    chosen = np.ones(len(obj.data.polygons), bool)
    if indices is not None:
        chosen[:] = False
        chosen[list(indices)] = True
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    obj.data.polygons.foreach_set("select", chosen)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)


def read(collection, name, dtype, width=1):
    """One property of all items of a collection."""
    values = np.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def with_polygons(obj, wanted=True):
    """The same object with some of its quadrilaterals joined to larger polygons, and some cut in two, inside: a face
    with all its vertices on a slit has no place. As it was if that is not wanted."""
    if not wanted:
        return obj
    edited = bmesh.new()
    edited.from_mesh(obj.data)
    edited.edges.ensure_lookup_table()
    chosen, met = [], {vert for vert in edited.verts if vert.is_boundary}
    for edge in edited.edges:
        around = {vert for face in edge.link_faces for vert in face.verts}
        if len(edge.link_faces) == 2 and not met & around:  # two polygons along two edges have one diagonal
            chosen.append(edge)
            met |= around
    bmesh.ops.dissolve_edges(edited, edges=chosen)
    inner = [face for face in edited.faces if not any(vert.is_boundary for vert in face.verts)]
    bmesh.ops.triangulate(edited, faces=inner[::7])
    edited.to_mesh(obj.data)
    edited.free()
    sizes = {len(face.vertices) for face in obj.data.polygons}
    assert {3, 4, 6} <= sizes
    return obj


def corner_uv(mesh, layer):
    """UVs (C, 2) of a layer."""
    return read(mesh.uv_layers[layer].data, "uv", np.float32, 2)


def vertex_uv(obj):
    """UVs (V, 2) of the vertices of a mesh without seams."""
    uv = np.empty((len(obj.data.vertices), 2))
    uv[read(obj.data.loops, "vertex_index", np.int32)] = corner_uv(obj.data, "Koebe")
    return uv


def pin(mesh, layer, corners):
    """Pin the UVs of the corners (C,) bool, and no others. Not in Edit Mode."""
    if not hasattr(mesh.uv_layers[layer], "pin"):  # before 3.5
        mesh.uv_layers[layer].data.foreach_set("pin_uv", corners)
        return
    mesh.uv_layers[layer].pin_ensure()
    mesh.uv_layers[layer].pin.foreach_set("value", corners)


def pins(mesh, layer):
    """Which corners (C,) of a layer are pinned. Not in Edit Mode."""
    if not hasattr(mesh.uv_layers[layer], "pin"):  # before 3.5
        return read(mesh.uv_layers[layer].data, "pin_uv", bool)
    found = mesh.attributes.get(f".pn.{layer}")
    return np.zeros(len(mesh.loops), bool) if found is None else read(found.data, "value", bool)


def corner_uv_in_square(obj):
    """UVs (C, 2) of the layer Koebe, which lie in the unit square."""
    uv = corner_uv(obj.data, "Koebe")
    assert np.isfinite(uv).all() and uv.min() >= 0.0 and uv.max() <= 1.0
    return uv


def triangles(mesh):
    """Vertices (T, 3) and corners (T, 3) of Blender's own triangulation."""
    mesh.calc_loop_triangles()
    return read(mesh.loop_triangles, "vertices", np.int32, 3), read(mesh.loop_triangles, "loops", np.int32, 3)


def mesh_state(mesh, but_layer=None):
    """Everything that the add-on must leave as it is, as bytes."""
    state = {
        "co": read(mesh.vertices, "co", np.float32, 3),
        "edges": read(mesh.edges, "vertices", np.int32, 2),
        "seam": read(mesh.edges, "use_seam", bool),
        "corner vertex": read(mesh.loops, "vertex_index", np.int32),
        "corner edge": read(mesh.loops, "edge_index", np.int32),
        "face start": read(mesh.polygons, "loop_start", np.int32),
        "face size": read(mesh.polygons, "loop_total", np.int32),
        "face material": read(mesh.polygons, "material_index", np.int32),
        "face smooth": read(mesh.polygons, "use_smooth", bool),
        "face select": read(mesh.polygons, "select", bool),
        "edge select": read(mesh.edges, "select", bool),
        "vertex select": read(mesh.vertices, "select", bool),
    }
    for layer in mesh.uv_layers:
        if layer.name != but_layer:
            state["uv " + layer.name] = corner_uv(mesh, layer.name)
    return {key: value.tobytes() for key, value in state.items()}


def last_run():
    """The report's entry of the last run, which is the only one of that run."""
    first, *others = bpy.context.window_manager.koebe_uv.islands
    assert all(entry.run < first.run for entry in others)
    return first


def written_faces(obj, layer="Koebe"):
    """Numbers of the faces with UVs that are not all the same."""
    uv = corner_uv(obj.data, layer)
    written = [np.ptp(uv[list(face.loop_indices)], axis=0).max() > 0.0 for face in obj.data.polygons]
    return np.flatnonzero(written).tolist()


def of_the_package(obj, function, **options):
    """What a map of the package makes of Blender's own triangles: the UVs of the corners, the result, and the polygon
    of each triangle."""
    vertices = read(obj.data.vertices, "co", np.float32, 3).astype(np.float64)
    corner_vertex, corners = triangles(obj.data)
    polygon = read(obj.data.loop_triangles, "polygon_index", np.int32)
    result = function(vertices, corner_vertex, polygon=polygon, **options)
    uv = np.zeros((len(obj.data.loops), 2), np.float32)
    uv[corners] = result.uv
    assert np.array_equal(uv[corners], result.uv), "a corner of a polygon has two places"
    return uv, result, polygon


def domain_job(addon, obj, choice):
    """The job of an operator that maps to a domain beside the disk."""
    return addon("jobs.job_of_domain").job_type(choice)([obj], addon("maps.options").Options(), choice)


def boundary_loops(mesh):
    """Vertices of each boundary loop, in order, found edge by edge."""
    uses = np.bincount(read(mesh.loops, "edge_index", np.int32), minlength=len(mesh.edges))
    ends = {}
    for a, b in read(mesh.edges, "vertices", np.int32, 2)[uses == 1]:
        ends.setdefault(int(a), []).append(int(b))
        ends.setdefault(int(b), []).append(int(a))
    loops = []
    while ends:
        loop = [next(iter(ends))]
        while loop[-1] in ends:
            following = [v for v in ends.pop(loop[-1]) if v in ends]
            if not following:
                break
            loop.append(following[0])
        loops.append(loop)
    return loops


def fit_circle(points):
    """Centre, radius and largest distance from the circle through `points` (least squares, Kåsa 1976)."""
    points = np.asarray(points, dtype=np.float64)
    system = np.column_stack([2.0 * points, np.ones(len(points))])
    x, y, rest = np.linalg.lstsq(system, (points**2).sum(axis=1), rcond=None)[0]
    radius = np.sqrt(rest + x * x + y * y)
    distance = np.hypot(points[:, 0] - x, points[:, 1] - y)
    return (x, y), radius, np.abs(distance - radius).max()


def signed_areas(mesh, layer):
    """Signed UV area of each triangle, in the mesh's own order, in 64 bits."""
    _, corners = triangles(mesh)
    a, b, c = np.moveaxis(corner_uv(mesh, layer).astype(np.float64)[corners], 1, 0)
    one, two = b - a, c - a
    return 0.5 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])


def polygon_areas(obj):
    """UV areas of the faces, twice over."""
    uv = corner_uv(obj.data, "Koebe").astype(float)
    return np.array([
        sum(uv[i][0] * uv[j][1] - uv[j][0] * uv[i][1] for i, j in zip(loops, [*loops[1:], loops[0]]))
        for loops in (list(face.loop_indices) for face in obj.data.polygons)
    ])  # fmt: skip


def loop_uv(mesh, layer, loop):
    """UVs of the vertices of a loop (each must have one UV only)."""
    vertex = read(mesh.loops, "vertex_index", np.int32)
    uv = corner_uv(mesh, layer)
    points = []
    for v in loop:
        values = np.unique(uv[vertex == v], axis=0)
        assert len(values) == 1, f"vertex {v} has {len(values)} UVs"
        points.append(values[0])
    return np.array(points)


def assert_circle_domain(obj, layer="Koebe", holes=3):
    """UVs in the square, every boundary loop on a circle, the outer one on the unit disk's, nothing flipped."""
    uv = corner_uv(obj.data, layer)
    assert uv.min() >= 0.0 and uv.max() <= 1.0
    loops = boundary_loops(obj.data)
    assert len(loops) == holes + 1
    circles = [fit_circle(loop_uv(obj.data, layer, loop)) for loop in loops]
    for _, _, off in circles:
        assert off < CIRCLE_TOLERANCE
    outer = max(circles, key=lambda circle: circle[1])
    assert outer[0] == pytest.approx((0.5, 0.5), abs=CIRCLE_TOLERANCE)
    assert outer[1] == pytest.approx(0.5, abs=CIRCLE_TOLERANCE)
    assert (signed_areas(obj.data, layer) > 0.0).all()


def checker_pattern(obj):
    """The matrix (2, 2) by which the checker's nodes take UVs to squares of side 1."""
    nodes = obj.material_slots[0].material.node_tree.nodes
    scale = nodes["Fine"].inputs["Scale"].default_value
    assert nodes["Coarse"].inputs["Scale"].default_value == pytest.approx(scale / 4)
    if "Across" not in nodes:
        return scale * np.eye(2)
    for name in ("Fine", "Coarse"):
        assert nodes[name].inputs["Vector"].links[0].from_node.type == "COMBXYZ"
    return scale * np.array([nodes[name].inputs[1].default_value[:2] for name in ("Across", "Up")])
