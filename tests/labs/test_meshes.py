"""Meshes of PyVista, trimesh, meshio and nibabel in and back, in an environment that has them."""

import importlib
import sys
from pathlib import Path
from types import SimpleNamespace

import koebe
import meshio
import nibabel
import numpy as np
import pytest
import pyvista
import trimesh

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
from cli_support import perforated, triangles_of  # noqa: E402

FIELDS = {"koebe_uv", "koebe_log_scale"}
VERTICES, QUADS = perforated(20, ((0.3, 0.3, 0.12), (0.7, 0.6, 0.16)))
TRIANGLES = triangles_of(QUADS)


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


def test_a_scene_is_all_of_its_meshes():
    one = trimesh.Trimesh(VERTICES, TRIANGLES, process=False)
    scene = trimesh.Scene([one])
    assert np.array_equal(koebe.uniformize(scene).uv, koebe.uniformize(one).uv)
    scene.add_geometry(one.copy(), transform=trimesh.transformations.translation_matrix([3, 0, 0]))
    two = koebe.parts(scene)
    assert two.face_count == 2 * len(TRIANGLES) and np.ptp(two.vertices[:, 0]) > 3
    assert isinstance(two.to_mesh(), trimesh.Trimesh)
    with pytest.raises(koebe.InputError, match="no triangles"):
        koebe.parts(trimesh.Scene())


@pytest.mark.parametrize("name", ["vertices", "points", "coordinates"])
def test_any_object_with_points_and_faces_is_a_surface(name):
    for faces in (TRIANGLES, QUADS, [list(map(int, face)) for face in QUADS]):
        thing = SimpleNamespace(**{name: VERTICES, "faces": faces})
        result = koebe.uniformize(thing)
        assert result.vertex_count == len(VERTICES) and result.flipped == 0
    with pytest.raises(koebe.InputError, match="no mesh to give back"):
        result.to_mesh()
    with pytest.raises(koebe.InputError, match="does not exist"):
        koebe.uniformize(SimpleNamespace(**{name: VERTICES, "faces": TRIANGLES + 10_000}))
    with pytest.raises(koebe.InputError, match="faces must be"):
        koebe.uniformize(SimpleNamespace(**{name: VERTICES, "faces": TRIANGLES.ravel()}))


def test_meshes_of_nilearn_and_vtk_are_surfaces():
    surface = pytest.importorskip("nilearn.surface")
    plain = koebe.uniformize(VERTICES, TRIANGLES)
    left = surface.InMemoryMesh(VERTICES, TRIANGLES)
    brain = surface.PolyMesh(left=left)
    for mesh in (left, brain, surface.SurfaceImage(brain, {"left": VERTICES[:, 0].astype(np.float32)})):
        assert np.array_equal(koebe.uniformize(mesh).uv, plain.uv)
    with pytest.raises(koebe.InputError, match="the parts left, right"):
        koebe.uniformize(surface.PolyMesh(left=left, right=left))
    poly = importlib.import_module("vtkmodules.vtkCommonDataModel").vtkPolyData()
    poly.DeepCopy(MESHES["PolyData"]())
    wrapped = SimpleNamespace(VTKObject=poly)  # as BrainSpace's
    for mesh in (poly, wrapped):
        result = koebe.uniformize(mesh)
        assert np.array_equal(result.uv, plain.uv) and isinstance(result.to_mesh(), pyvista.PolyData)


def test_meshes_of_open3d_and_mne_are_surfaces():
    """Open3D's have `vertices` and `triangles`, as vectors that NumPy reads; MNE's are dicts."""
    plain = koebe.uniformize(VERTICES, TRIANGLES)

    class Vectors:
        def __init__(self, values):
            self.values = values

        def __array__(self, *_, **__):
            return self.values

    open3d = SimpleNamespace(vertices=Vectors(VERTICES), triangles=Vectors(TRIANGLES.astype(np.int32)))
    mne = {"rr": VERTICES, "tris": TRIANGLES, "nn": None}
    for mesh in (open3d, mne, plain):
        assert np.array_equal(koebe.uniformize(mesh).uv, plain.uv)
    for wrong in ({"rr": VERTICES}, {"rr": VERTICES, "tris": TRIANGLES + 10_000}):
        with pytest.raises(koebe.InputError):
            koebe.uniformize(wrong)


def test_strips_are_triangles_and_carry_their_data(tmp_path):
    grid = np.arange(6 * 7).reshape(6, 7)
    strips = [np.stack([grid[k], grid[k + 1]], axis=1).ravel() for k in range(5)]
    x, y = np.meshgrid(np.arange(7.0), np.arange(6.0))
    points = np.stack([x.ravel(), y.ravel(), np.sin(x.ravel())], axis=1)
    mesh = pyvista.PolyData(points, strips=np.concatenate([[len(one), *one] for one in strips]))
    mesh.cell_data["row"] = np.arange(5)
    mesh.point_data["height"] = points[:, 2]
    mesh.save(tmp_path / "strips.vtp")
    for given in (mesh, tmp_path / "strips.vtp"):
        result = koebe.uniformize(given)
        back = result.to_mesh()
        assert back.n_cells == 5 * 12 and result.flipped == 0
        assert np.array_equal(back.cell_data["row"], np.repeat(np.arange(5), 12))
        assert np.array_equal(back.point_data["height"], points[:, 2])
        assert not [one for one in result.warnings if one.kind == "reoriented_faces"]


@pytest.mark.parametrize("function", [koebe.uniformize, koebe.parts])
def test_colours_materials_and_data_stay(function):
    colours = np.arange(4 * len(VERTICES), dtype=np.uint8).reshape(-1, 4)
    back = function(trimesh.Trimesh(VERTICES, TRIANGLES, process=False, vertex_colors=colours)).to_mesh()
    old = back.vertex_attributes.get("koebe_vertex", np.arange(len(VERTICES)))
    assert np.array_equal(back.vertex_attributes["color"], colours[old])
    assert np.array_equal(back.visual.vertex_attributes["color"], colours[old])
    shades = np.arange(4 * len(TRIANGLES), dtype=np.uint8).reshape(-1, 4)
    back = function(trimesh.Trimesh(VERTICES, TRIANGLES, process=False, face_colors=shades)).to_mesh()
    assert np.array_equal(back.face_attributes["color"], shades)
    material = trimesh.visual.material.SimpleMaterial(diffuse=[9, 8, 7, 255])
    textured = trimesh.Trimesh(VERTICES, TRIANGLES, process=False)
    textured.visual = trimesh.visual.TextureVisuals(uv=VERTICES[:, :2], material=material)
    back = function(textured).to_mesh()
    assert back.visual.material.diffuse.tolist() == [9, 8, 7, 255] and len(back.visual.uv) == len(back.vertices)
    grid = MESHES["PolyData"]()
    grid.point_data["RGB"], grid.field_data["note"] = colours[:, :3], ["kept"]
    back = function(grid).to_mesh()
    old = back.point_data["koebe_vertex"] if "koebe_vertex" in back.point_data else np.arange(len(VERTICES))
    assert np.array_equal(back.point_data["RGB"], colours[old][:, :3]) and back.field_data["note"][0] == "kept"


@pytest.mark.parametrize("kind", ["trimesh", "PolyData", "meshio"])
def test_a_welded_mesh_comes_back_with_its_own_vertices(kind):
    whole, faces = MESHES[kind](), TRIANGLES
    apart, own = VERTICES[faces.ravel()], np.arange(faces.size).reshape(-1, 3)
    mesh = {
        "trimesh": lambda: trimesh.Trimesh(apart, own, process=False),
        "PolyData": lambda: pyvista.PolyData.from_regular_faces(apart, own),
        "meshio": lambda: meshio.Mesh(apart, [("triangle", own)]),
    }[kind]()
    result = koebe.uniformize(mesh, weld=0)
    assert [len(loop) for loop in result.loops] == [len(loop) for loop in koebe.uniformize(whole).loops]
    back = result.to_mesh()
    assert len(back.vertices if kind == "trimesh" else back.points) == faces.size
    assert np.isfinite(koebe.uniformize(back, weld=0).uv).all()


def test_objects_that_only_look_like_surfaces_are_told_so():
    for thing in (
        SimpleNamespace(vertices=VERTICES, faces=[[[0, 1, 2]], [[0, 1, 2]]]),
        SimpleNamespace(vertices=VERTICES, faces=[None]),
        SimpleNamespace(vertices=np.ma.masked_greater(VERTICES, 0.5), faces=TRIANGLES),
        SimpleNamespace(VTKObject=5),
    ):
        with pytest.raises(koebe.InputError):
            koebe.parts(thing)
