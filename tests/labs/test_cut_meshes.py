"""Meshes of other packages that were cut: the same kind comes back, its vertices doubled along the cuts."""

import koebe
import meshio
import nibabel
import numpy as np
import pytest
import pyvista
import trimesh
from test_meshes import angle_errors, gifti


def torus(n=24, m=12, turn=0.3):
    """Vertices and quadrilaterals, and a loose vertex at the end."""
    u, v = (a.ravel() for a in np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij"))
    points = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v) + turn * np.sin(u)], axis=1)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    at = lambda i, j: (i % n) * m + j % m  # noqa: E731
    quads = np.stack([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], axis=1)
    return np.vstack([points, [9.0, 9.0, 9.0]]), quads


VERTICES, QUADS = torus()
TRIANGLES = QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
HEIGHT = VERTICES[:, 2]


def polydata(quads=False):
    mesh = pyvista.PolyData(VERTICES, np.insert(QUADS, 0, 4, axis=1).ravel()) if quads else (
        pyvista.PolyData(VERTICES, lines=[2, 0, 1], faces=np.insert(TRIANGLES, 0, 3, axis=1).ravel()))
    mesh.point_data["height"] = HEIGHT
    return mesh


def grid(cells, corners):
    mesh = pyvista.UnstructuredGrid({cells: corners}, VERTICES)
    mesh.point_data["height"] = HEIGHT
    return mesh


MESHES = {
    "trimesh": lambda: trimesh.Trimesh(VERTICES, TRIANGLES, process=False, vertex_attributes={"height": HEIGHT}),
    "PolyData with a line": polydata,
    "PolyData of quadrilaterals": lambda: polydata(quads=True),
    "UnstructuredGrid": lambda: grid(9, QUADS),
    "UnstructuredGrid of pixels": lambda: grid(8, QUADS[:, [0, 1, 3, 2]]),
    "meshio": lambda: meshio.Mesh(
        VERTICES, [("vertex", [[0]]), ("triangle", TRIANGLES[:100]), ("quad", QUADS[50:])],
        point_data={"height": HEIGHT},
    ),
    "meshio, polygons": lambda: meshio.Mesh(
        VERTICES, [("polygon", [list(q) for q in QUADS[:3]]), ("triangle", TRIANGLES[6:])],
        point_data={"height": HEIGHT},
    ),
}  # fmt: skip


def parts_of(mesh):
    """Points, faces as lists of vertices, and the fields of the vertices, whatever the package."""
    if isinstance(mesh, trimesh.Trimesh):
        uv = {} if mesh.visual.kind != "texture" else {"koebe_uv": mesh.visual.uv}
        return mesh.vertices, mesh.faces.tolist(), {**mesh.vertex_attributes, **uv}
    if isinstance(mesh, meshio.Mesh):
        faces = [list(map(int, face)) for block in mesh.cells if block.type != "vertex" for face in block.data]
        return mesh.points, faces, mesh.point_data
    faces = [list(mesh.get_cell(i).point_ids) for i in range(mesh.n_cells)]
    if isinstance(mesh, pyvista.UnstructuredGrid) and mesh.celltypes[0] == 8:
        faces = [[a, b, d, c] for a, b, c, d in faces]
    return mesh.points, [face for face in faces if len(face) > 2], mesh.point_data


@pytest.mark.parametrize("kind", MESHES)
def test_the_same_kind_comes_back_with_the_same_faces(kind):
    mesh = MESHES[kind]()
    result = koebe.uniformize(mesh, cut=True)
    back = result.to_mesh()
    assert type(back) is type(mesh) and back is not mesh
    points, faces, fields = parts_of(back)
    old = np.asarray(fields["koebe_vertex"])
    assert len(old) == len(points) > len(VERTICES) and (old[: len(VERTICES)] == np.arange(len(VERTICES))).all()
    assert np.array_equal(points, np.asarray(parts_of(mesh)[0])[old])
    assert [[old[v] for v in face] for face in faces] == parts_of(mesh)[1]
    assert np.array_equal(fields["height"], HEIGHT[old])
    errors = np.asarray(angle_errors(back))
    if len(faces) == len(result.uv):
        assert np.isclose(np.nanmean(errors), result.angle_error_deg["mean"], rtol=1e-6)


@pytest.mark.parametrize("kind", MESHES)
def test_each_corner_has_the_uv_of_the_result_and_no_vertex_is_there_twice(kind):
    result = koebe.uniformize(MESHES[kind](), cut=True)
    _, faces, fields = parts_of(result.to_mesh())
    uv, old = np.asarray(fields["koebe_uv"]), np.asarray(fields["koebe_vertex"])
    given = {(v, *place) for v, place in zip(result.surface[1].ravel().tolist(), result.uv.reshape(-1, 2).tolist())}
    used = np.unique(np.concatenate(faces))
    assert {(int(old[v]), *uv[v].tolist()) for v in used} == given and len(used) == len(given)
    assert np.isnan(uv[len(VERTICES) - 1]).all() and np.isfinite(uv[used]).all()  # the loose one has none
    # Face by face: the triangles of a polygon are those of the result, in the same order.
    if len(faces) == len(result.uv):
        assert np.array_equal(uv[np.array(faces)], result.uv)


def test_a_gifti_surface_comes_back_with_its_vertices(tmp_path):
    single = VERTICES[:-1].astype(np.float32)
    result = koebe.uniformize(gifti(single, TRIANGLES), cut=True)
    nibabel.save(result.to_mesh(), tmp_path / "cut.gii")
    points, triangles, *fields = nibabel.load(tmp_path / "cut.gii").darrays
    by_name = {array.meta["Name"]: array.data for array in fields}
    assert np.array_equal(points.data, single) and np.array_equal(triangles.data, TRIANGLES)
    assert np.allclose(by_name["koebe_corner_uv"].reshape(-1, 3, 2), result.uv, atol=1e-6)
    at_vertices = by_name["koebe_uv"][triangles.data]
    known = np.isfinite(at_vertices[..., 0])
    assert np.allclose(at_vertices[known], result.uv[known], atol=1e-6) and 0.5 < known.mean() < 1.0


def test_what_comes_back_is_the_cut_surface():
    """What was closed, with a handle, is a disk now; the loose vertex has the number before the doubled ones."""
    back = koebe.uniformize(MESHES["trimesh"](), cut=True).to_mesh()
    loose = len(VERTICES) - 1
    faces = np.asarray(back.faces)
    again = koebe.uniformize(np.delete(back.vertices, loose, axis=0), faces - (faces > loose))
    assert len(again.loops) == 1 and again.flipped == 0


def test_arrays_have_no_mesh_to_give_back():
    with pytest.raises(koebe.InputError, match="no mesh to give back"):
        koebe.uniformize(VERTICES[:-1], TRIANGLES, cut=True).to_mesh()


def ball(kind):
    """A closed ball of quadrilaterals, or of their triangles, stretched and turned away from its axis."""
    n, m = 20, 11
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    u, v = 2 * np.pi * i / n, np.pi * (j + 0.5) / m - np.pi / 2
    points = np.stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)], axis=1)
    ends = np.array([[0, 0, -1.0], [0, 0, 1.0]])
    turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    points = np.vstack([points, ends]) @ turn.T * [1, 1.2, 1.5]
    at = lambda i, j: i % n * m + j  # noqa: E731
    quads = [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(n) for j in range(m - 1)]
    fans = [[at(i + 1, 0), at(i, 0), n * m] for i in range(n)] + [
        [at(i, m - 1), at(i + 1, m - 1), n * m + 1] for i in range(n)
    ]
    if kind == "meshio":
        return meshio.Mesh(points, [("quad", quads), ("triangle", fans)])
    if kind == "PolyData":
        return pyvista.PolyData(points, np.concatenate([[len(face), *face] for face in [*quads, *fans]]))
    triangles = np.array([half for a, b, c, d in quads for half in ((a, b, c), (a, c, d))] + fans)
    return trimesh.Trimesh(points, triangles, process=False)


@pytest.mark.parametrize("layout", ["equirectangular", "octahedral"])
@pytest.mark.parametrize("kind", ["meshio", "PolyData", "trimesh"])
def test_a_sphere_comes_back_as_the_same_kind(kind, layout):
    """Its faces in their order, its vertices in their places, doubled along the cut; the UVs those of the corners."""
    mesh = ball(kind)
    sphere = koebe.sphere_map(mesh, layout=layout)
    assert sphere.converged
    back = sphere.to_mesh()
    assert type(back) is type(mesh)
    points, faces, fields = parts_of(back)
    old_points, old_faces, _ = parts_of(mesh)
    vertex = np.asarray(fields["koebe_vertex"], int)
    assert len(points) > len(old_points) and np.allclose(points, np.asarray(old_points)[vertex])
    assert [[int(vertex[v]) for v in face] for face in faces] == [list(map(int, face)) for face in old_faces]
    uv = np.asarray(fields["koebe_uv"], float)
    given = zip(sphere.surface[1].ravel().tolist(), np.round(sphere.uv.reshape(-1, 2), 5).tolist(), strict=True)
    corners = {(v, *place) for v, place in given}
    assert {(int(vertex[v]), *np.round(uv[v], 5)) for face in faces for v in face} == corners


def test_a_sphere_of_arrays_has_no_mesh():
    mesh = ball("trimesh")
    with pytest.raises(koebe.InputError, match="arrays"):
        koebe.sphere_map(mesh.vertices, mesh.faces).to_mesh()


@pytest.mark.parametrize("unwrap", [koebe.torus_map, koebe.schottky_map], ids=["torus", "schottky"])
@pytest.mark.parametrize("kind", ["PolyData", "meshio", "trimesh"])
def test_a_torus_comes_back_with_the_uvs_of_its_tile(kind, unwrap):
    points = VERTICES[:-1]
    if kind == "PolyData":
        mesh = pyvista.PolyData(points, np.insert(QUADS, 0, 4, axis=1).ravel())
    elif kind == "meshio":
        mesh = meshio.Mesh(points, [("quad", QUADS)])
    else:
        mesh = trimesh.Trimesh(points, TRIANGLES, process=False)
    result = unwrap(mesh)
    assert result.converged
    back = result.to_mesh()
    assert type(back) is type(mesh)
    places, faces, fields = parts_of(back)
    vertex, uv = np.asarray(fields["koebe_vertex"], int), np.asarray(fields["koebe_uv"], float)
    assert len(places) > len(points) and np.allclose(places, points[vertex])
    given = zip(result.surface[1].ravel().tolist(), np.round(result.uv.reshape(-1, 2), 5).tolist(), strict=True)
    assert {(int(vertex[v]), *np.round(uv[v], 5)) for face in faces for v in face} == {(v, *at) for v, at in given}
