"""Meshes of PyVista, trimesh, meshio and nibabel in and back, in an environment that has them."""

import koebe
import meshio
import nibabel
import numpy as np
import pytest
import pyvista
import trimesh

FIELDS = {"koebe_uv", "koebe_log_scale"}


def perforated(n=20, holes=((0.3, 0.3, 0.12), (0.7, 0.6, 0.16))):
    """A wavy square of n x n cells with two holes: vertices and quadrilaterals, no vertex unused."""
    t = np.linspace(0.0, 1.0, n + 1)
    points = np.stack([a.ravel() for a in np.meshgrid(t, t)], axis=1)
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quads = np.stack([corner, corner + 1, corner + n + 2, corner + n + 1], axis=1)
    for *middle, radius in holes:
        quads = quads[np.linalg.norm(points[quads].mean(axis=1) - middle, axis=1) >= radius]
    used, quads = np.unique(quads, return_inverse=True)
    x, y = points[used].T
    return np.stack([x, y, 0.15 * np.sin(3.0 * x) * np.cos(2.0 * y)], axis=1), quads.reshape(-1, 4)


VERTICES, QUADS = perforated()
TRIANGLES = QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def gifti(vertices, triangles):
    points = nibabel.gifti.GiftiDataArray(vertices.astype(np.float32), "NIFTI_INTENT_POINTSET")
    faces = nibabel.gifti.GiftiDataArray(triangles.astype(np.int32), "NIFTI_INTENT_TRIANGLE")
    return nibabel.gifti.GiftiImage(darrays=[points, faces])


MESHES = {
    "trimesh": lambda: trimesh.Trimesh(VERTICES, TRIANGLES, process=False),
    "PolyData": lambda: pyvista.PolyData.from_regular_faces(VERTICES, TRIANGLES),
    "PolyData with a line": lambda: pyvista.PolyData(
        VERTICES, lines=[2, 0, 1], faces=np.insert(TRIANGLES, 0, 3, axis=1).ravel()
    ),
    "UnstructuredGrid": lambda: pyvista.PolyData.from_regular_faces(VERTICES, TRIANGLES).cast_to_unstructured_grid(),
    "meshio": lambda: meshio.Mesh(VERTICES, [("triangle", TRIANGLES)]),
    "meshio, unsigned": lambda: meshio.Mesh(VERTICES, [("triangle", TRIANGLES.astype(np.uint64))]),
    "meshio, with a point": lambda: meshio.Mesh(VERTICES, [("vertex", [[0]]), ("triangle", TRIANGLES)]),
}


def angle_errors(mesh):
    """One number per face, whatever the package."""
    if isinstance(mesh, trimesh.Trimesh):
        return mesh.face_attributes["koebe_angle_error"]
    if isinstance(mesh, meshio.Mesh):
        return np.concatenate(mesh.cell_data["koebe_angle_error"])
    return mesh.cell_data["koebe_angle_error"]


@pytest.mark.parametrize("kind", MESHES)
def test_a_mesh_is_mapped_as_its_arrays_are_and_comes_back(kind):
    mesh, plain = MESHES[kind](), koebe.uniformize(VERTICES, TRIANGLES)
    result = koebe.uniformize(mesh)
    assert np.array_equal(result.uv, plain.uv)
    back = result.to_mesh()
    assert type(back) is type(mesh) and back is not mesh
    errors = np.asarray(angle_errors(back))
    assert np.isclose(np.nanmean(errors), result.angle_error_deg["mean"], rtol=1e-6)
    assert np.isnan(errors).sum() == len(errors) - len(TRIANGLES)  # points and lines have none


def test_texture_coordinates_are_where_each_package_looks_for_them():
    uv = koebe.disk_to_uv(koebe.uniformize(VERTICES, TRIANGLES).uv)
    assert np.allclose(koebe.uniformize(MESHES["trimesh"]()).to_mesh().visual.uv, uv)
    grid = koebe.uniformize(MESHES["PolyData"]()).to_mesh()
    assert np.allclose(grid.active_texture_coordinates, uv)
    assert set(grid.point_data.keys()) >= FIELDS
    assert set(koebe.uniformize(MESHES["meshio"]()).to_mesh().point_data) == FIELDS


def test_quadrilaterals_and_polygons_are_cut_and_carry_one_value_each():
    quads = koebe.uniformize(meshio.Mesh(VERTICES, [("quad", QUADS)]))
    mixed = meshio.Mesh(VERTICES, [("triangle", TRIANGLES[:200]), ("quad", QUADS[100:])])
    faces = np.insert(QUADS, 0, 4, axis=1).ravel()
    for mesh in (pyvista.PolyData(VERTICES, faces), pyvista.UnstructuredGrid({9: QUADS}, VERTICES)):
        assert np.array_equal(koebe.uniformize(mesh).uv, quads.uv)
        assert angle_errors(koebe.uniformize(mesh).to_mesh()).shape == (len(QUADS),)
    # VTK's pixel has its last two corners the other way round.
    pixels = pyvista.UnstructuredGrid({8: QUADS[:, [0, 1, 3, 2]]}, VERTICES)
    assert np.array_equal(koebe.uniformize(pixels).uv, quads.uv)
    assert [len(part) for part in koebe.uniformize(mixed).to_mesh().cell_data["koebe_angle_error"]] == [
        *(200, len(QUADS) - 100)
    ]
    polygons = meshio.Mesh(VERTICES, [("polygon", [list(q) for q in QUADS[:3]]), ("quad", QUADS[3:])])
    assert np.array_equal(koebe.uniformize(polygons).uv, quads.uv)


def test_formats_that_meshio_and_pyvista_read(tmp_path):
    for name in ("surface.vtk", "surface.ply", "surface.vtu"):
        meshio.write(tmp_path / name, MESHES["meshio"]())
        result = koebe.uniformize(meshio.read(tmp_path / name))
        assert result.flipped == 0 and result.converged
        meshio.write(tmp_path / f"mapped_{name}", result.to_mesh())
        assert (tmp_path / f"mapped_{name}").stat().st_size > 0
    MESHES["PolyData"]().save(tmp_path / "pyvista.vtp")
    assert koebe.uniformize(pyvista.read(tmp_path / "pyvista.vtp")).converged


def test_a_gifti_surface_is_mapped_and_comes_back_with_its_fields(tmp_path):
    single = VERTICES.astype(np.float32)
    nibabel.save(gifti(single, TRIANGLES), tmp_path / "lh.surf.gii")
    result = koebe.uniformize(nibabel.load(tmp_path / "lh.surf.gii"))
    assert np.array_equal(result.uv, koebe.uniformize(single, TRIANGLES).uv)
    nibabel.save(result.to_mesh(), tmp_path / "mapped.gii")
    back = {array.meta["Name"]: array for array in nibabel.load(tmp_path / "mapped.gii").darrays[2:]}
    assert set(back) == {*FIELDS, "koebe_angle_error"}
    assert np.allclose(back["koebe_uv"].data, koebe.disk_to_uv(result.uv), atol=1e-6)
    assert np.allclose(back["koebe_log_scale"].data, result.log_scale, atol=1e-5)
    assert back["koebe_angle_error"].data.shape == (len(TRIANGLES),)
    assert koebe.uniformize(result.to_mesh()).vertex_count == len(VERTICES)  # once more
    with pytest.raises(koebe.InputError, match="0 arrays of points"):
        koebe.uniformize(nibabel.gifti.GiftiImage())


@pytest.mark.parametrize(
    ("mesh", "error", "says"),
    [
        (meshio.Mesh(VERTICES, [("tetra", [[0, 1, 2, 3]])]), koebe.InputError, "'tetra'"),
        (meshio.Mesh(VERTICES, [("line", [[0, 1]])]), koebe.InputError, "no faces"),
        (meshio.Mesh(VERTICES, [("triangle", [[0, 1, 9999]])]), koebe.InputError, "does not exist"),
        (pyvista.UnstructuredGrid({10: np.array([[0, 1, 2, 3]])}, VERTICES), koebe.InputError, "extract_surface"),
        (pyvista.PolyData(VERTICES, strips=[4, 0, 1, 2, 3]), koebe.InputError, "triangulate"),
        (pyvista.Sphere(), koebe.TopologyError, "closed"),
        (pyvista.ImageData(dimensions=(3, 3, 3)), koebe.InputError, "PyVista"),
        (42, koebe.InputError, "PyVista"),
        ("no_such_file.obj", FileNotFoundError, "no_such_file"),
    ],
)
def test_what_is_no_surface_is_told_so(mesh, error, says):
    with pytest.raises(error, match=says):
        koebe.uniformize(mesh)


def test_a_mesh_brings_its_own_faces():
    with pytest.raises(TypeError, match="own faces"):
        koebe.uniformize(MESHES["trimesh"](), TRIANGLES)
    with pytest.raises(koebe.InputError, match="no mesh to give back"):
        koebe.uniformize(VERTICES, TRIANGLES).to_mesh()


@pytest.mark.parametrize("kind", ["trimesh", "PolyData", "meshio"])
def test_a_surface_takes_new_positions_as_such_a_mesh(kind):
    surface = koebe.Surface(MESHES[kind]())
    surface.uniformize()
    there = MESHES[kind]()
    moved = VERTICES + 0.01 * np.sin(3.0 * VERTICES[:, [1, 2, 0]])
    setattr(there, "vertices" if kind == "trimesh" else "points", moved)
    back = surface.uniformize(there).to_mesh()
    assert type(back) is type(there)
    assert np.allclose(back.vertices if kind == "trimesh" else back.points, moved)


def test_a_surface_refuses_a_mesh_with_other_faces():
    surface = koebe.Surface(MESHES["trimesh"]())
    with pytest.raises(koebe.InputError, match="other faces"):
        surface.uniformize(trimesh.Trimesh(VERTICES, TRIANGLES[::-1], process=False))
