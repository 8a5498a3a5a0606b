"""Files of FreeSurfer, GIfTI, CIFTI and VTK in and out, with Connectome Workbench as a judge where it is installed."""

import doctest
import os
import shutil
import subprocess
import sys
from pathlib import Path

import koebe
import meshio
import nibabel
import numpy as np
import pytest
import pyvista
from test_cut_meshes import ball
from test_meshes import TRIANGLES, VERTICES, gifti

SINGLE = VERTICES.astype(np.float32)
MASK = np.linalg.norm(VERTICES[:, :2] - [0.7, 0.25], axis=1) < 0.09
BALL = ball("trimesh")


def workbench(path):
    """What Workbench says of the file; an empty text without Workbench."""
    if shutil.which("wb_command") is None:
        return ""
    done = subprocess.run(["wb_command", "-file-information", path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return " ".join(done.stdout.split())


def command(*words, code=0):
    done = subprocess.run([sys.executable, "-m", "koebe", *map(str, words)], capture_output=True, text=True)
    assert done.returncode == code, done.stderr
    return done.stdout if code == 0 else done.stderr


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.path.abspath(os.path.dirname(os.path.dirname(koebe.__file__))))
    monkeypatch.chdir(tmp_path)
    nibabel.freesurfer.write_geometry("lh.white", SINGLE, TRIANGLES)
    nibabel.freesurfer.write_geometry("rh.ball", BALL.vertices, BALL.faces)
    return tmp_path


def test_freesurfers_surface_is_a_surface(folder):
    result = koebe.uniformize("lh.white")
    assert np.array_equal(result.uv, koebe.uniformize(SINGLE, TRIANGLES).uv)
    assert isinstance(result.to_mesh(), nibabel.GiftiImage)
    assert sorted(map(len, koebe.boundary_loops("lh.white"))) == sorted(map(len, result.loops))


def test_a_map_lies_in_the_volume_of_its_surface(folder):
    """FreeSurfer adds the centre cras to all points of a surface."""
    volume = {
        "head": [2, 0, 20], "valid": "1  # volume info valid", "filename": "../mri/filled-pretess255.mgz",
        "volume": [256, 240, 200], "voxelsize": [1, 1.25, 1], "xras": [-1, 0, 0], "yras": [0, 0, -1],
        "zras": [0, 1, 0], "cras": [3.5, -17.25, 8.125],
    }  # fmt: skip
    nibabel.freesurfer.write_geometry("lh.pial", SINGLE, TRIANGLES, volume_info=volume)
    koebe.uniformize("lh.pial").export("lh.map")
    nibabel.save(koebe.uniformize("lh.pial").to_mesh(), "p.gii")
    koebe.uniformize("p.gii").export("lh.again")
    for name in ("lh.map", "lh.again"):
        found = nibabel.freesurfer.read_geometry(name, read_metadata=True)[2]
        assert set(found) == set(volume) and all(np.array_equal(found[row], volume[row]) for row in volume)
    scanner = nibabel.load("p.gii")
    scanner.darrays[0].coordsys.dataspace = 1
    koebe.uniformize(scanner).export("lh.scanner")
    for name, told in (("lh.scanner", None), ("lh.unknown", {**volume, "valid": "0"})):
        if told:
            nibabel.freesurfer.write_geometry("lh.pial", SINGLE, TRIANGLES, volume_info=told)
            koebe.uniformize("lh.pial").export(name)
        with pytest.warns(UserWarning):
            assert not nibabel.freesurfer.read_geometry(name, read_metadata=True)[2]
    with open("lh.pial", "rb+") as file:  # a footer that cannot be read
        file.truncate(os.path.getsize("lh.pial") - 40)
    assert koebe.uniformize("lh.pial").flipped == 0


def test_a_sphere_keeps_the_number_of_vertices(folder):
    """GIfTI files of one cortex belong together by the numbers of vertices. The map has cuts all the same."""
    sphere = koebe.sphere_map("rh.ball")
    back = {array.meta.get("Name", str(k)): array.data for k, array in enumerate(sphere.to_mesh().darrays)}
    assert np.array_equal(back["0"], np.float32(BALL.vertices)) and np.array_equal(back["1"], BALL.faces)
    assert np.allclose(back["koebe_sphere"], sphere.points, atol=1e-7)
    drawn = ~np.isin(np.arange(len(sphere.uv)), sphere.layout["torn"])
    assert np.allclose(back["koebe_corner_uv"][drawn], sphere.uv[drawn].reshape(-1, 6), atol=1e-6)
    assert np.isnan(back["koebe_corner_uv"][~drawn]).all()
    cut = np.isnan(back["koebe_uv"][:, 0])
    of = [{tuple(uv) for uv in sphere.uv[sphere.surface[1] == v]} for v in range(len(cut))]
    assert [len(places) > 1 for places in of] == cut.tolist() and 0 < cut.sum() < len(cut) / 2
    assert len(back["koebe_log_scale"]) == len(BALL.vertices) and np.isfinite(back["koebe_log_scale"]).mean() > 0.9


@pytest.mark.parametrize("name", ["rh.map.surf.gii", "rh.sphere"])
def test_a_sphere_is_written_as_a_surface_of_radius_100(folder, name):
    sphere = koebe.sphere_map("rh.ball")
    sphere.export(name)
    if name.endswith(".gii"):
        points, faces = (array.data for array in nibabel.load(name).darrays)
        assert not (said := workbench(name)) or all(
            words in said for words in ("Type: Surface", "Structure: CortexRight", "Spherical", "Correct: true")
        )
    else:
        points, faces = nibabel.freesurfer.read_geometry(name)
    assert np.array_equal(faces, BALL.faces) and np.allclose(points, 100 * sphere.points, atol=1e-4)


@pytest.mark.parametrize("name", ["lh.map.surf.gii", "lh.flat.patch.flat", "lh.map"])
def test_a_flat_map_is_written_in_the_surfaces_unit_with_its_numbers(folder, name):
    result = koebe.uniformize("lh.white", mask=MASK)
    result.export(name)
    used = np.unique(result.surface[1])
    if name.endswith(".flat"):
        patch = koebe.read_patch(name)
        assert np.array_equal(patch.vertices, used)
        assert set(patch.vertices[patch.border]) == set(np.concatenate(result.loops))
        assert np.array_equal(koebe.read_region(name, len(VERTICES)), np.isin(np.arange(len(VERTICES)), used))
        points = np.zeros((len(VERTICES), 3))
        points[used] = patch.points
    elif name.endswith(".gii"):
        points = nibabel.load(name).darrays[0].data
        said = workbench(name)
        assert not said or f"Number of Vertices: {len(VERTICES)}" in said and "Flat" in said and "CortexLeft" in said
    else:
        points = nibabel.freesurfer.read_geometry(name)[0]
    scale = np.linalg.norm(points[used]) / np.linalg.norm(result.uv[used])
    assert np.allclose(points[used], np.c_[scale * result.uv[used], np.zeros(len(used))], atol=1e-5)
    assert np.isclose(area(points, result.surface[1]), area(*result.surface), rtol=1e-4)


def area(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def test_a_patch_is_a_mask(folder):
    first = koebe.uniformize("lh.white", mask=MASK)
    first.export("lh.one.patch.flat")
    again = koebe.uniformize("lh.white", mask=~koebe.read_region("lh.one.patch.flat", len(VERTICES)))
    assert np.array_equal(first.uv, again.uv, equal_nan=True)
    kinds = {warning.kind for result in (first, koebe.sphere_map("lh.white", mask=MASK)) for warning in result.warnings}
    assert "unused_vertices" not in kinds
    with pytest.raises(koebe.InputError, match="no faces"):
        koebe.uniformize("lh.one.patch.flat")


def test_values_go_round(folder):
    values = np.random.default_rng(1).normal(size=len(VERTICES))
    hole = np.where(MASK, np.nan, values)
    for name in ("lh.x.curv", "lh.x.shape.gii", "lh.x.func.gii", "lh.x.dscalar.nii"):
        koebe.write_field(name, hole)
        back = koebe.read_field(name).values
        expected = np.where(MASK, 0.0, values) if name.endswith("curv") else hole
        assert back.dtype == np.float64 and np.allclose(back, expected, atol=1e-6, equal_nan=True)
        said = workbench(name) if not name.endswith("curv") else ""
        assert not said or "CortexLeft" in said
    assert np.allclose(nibabel.freesurfer.read_morph_data("lh.x.curv"), np.where(MASK, 0.0, values), atol=1e-6)
    koebe.write_field("both.dscalar.nii", values, hemisphere="right")
    assert np.allclose(koebe.read_field("both.dscalar.nii", hemisphere="right"), values, atol=1e-6)
    with pytest.raises(koebe.FileError, match="no left cortex"):
        koebe.read_field("both.dscalar.nii", hemisphere="left")


def test_labels_stay_labels(folder):
    labels = (np.arange(len(VERTICES)) % 300).astype(int)
    labels[MASK] = -1
    names, colors = {7: "seven", 8: "eight"}, {7: (1.0, 0.0, 0.0, 1.0), 8: (1.0, 0.0, 0.0, 1.0)}
    for name in ("rh.x.annot", "rh.x.label.gii", "rh.x.dlabel.nii"):
        koebe.write_field(name, labels, names=names, colors=colors)
        back = koebe.read_field(name)
        assert back.values.dtype == np.int32 and np.array_equal(back.values, labels)
        assert back.names[7] == "seven" and back.names[9] == "label 9"
        assert np.allclose(back.colors[7], colors[7])
        assert not (said := workbench(name) if name.endswith(("gii", "nii")) else "") or "CortexRight" in said
        koebe.write_field(f"again.{name}", back, hemisphere="right" if name.endswith("nii") else None)
        assert np.array_equal(koebe.read_field(f"again.{name}").values, labels)
        assert np.array_equal(koebe.read_region(name, len(labels)), labels > 0) or name.endswith("nii")
    theirs, _, words = nibabel.freesurfer.read_annot("rh.x.annot")
    assert [words[k].decode() for k in theirs[~MASK][:9]] == [back.names[k] for k in labels[~MASK][:9]]


def test_a_label_file_is_a_region(folder):
    listed = np.flatnonzero(MASK)
    rows = "\n".join(f"{v} 0 0 0 0" for v in listed)
    (folder / "lh.x.label").write_text(f"#!ascii label\n{len(listed)}\n{rows}\n")
    assert np.array_equal(koebe.read_region("lh.x.label", len(VERTICES)), MASK)
    with pytest.raises(koebe.FileError, match="not among"):
        koebe.read_region("lh.x.label", 3)
    koebe.write_field("lh.x.shape.gii", MASK.astype(float))
    assert np.array_equal(koebe.read_region("lh.x.shape.gii", len(VERTICES)), MASK)
    with pytest.raises(koebe.FileError, match="one for each"):
        koebe.read_region("lh.x.shape.gii", 3)


@pytest.mark.parametrize("name", ["a.vtk", "a.vtu", "a.vtp", "a.gii", "a.obj", "a.msh"])
def test_other_formats_come_back_as_the_surface(folder, name):
    result = koebe.uniformize("lh.white")
    result.export(name)
    again = koebe.uniformize(name)
    assert np.allclose(again.uv, result.uv, atol=1e-6) and np.array_equal(again.surface[1], TRIANGLES)
    if name in ("a.vtk", "a.vtu"):
        found = meshio.read(name).point_data["koebe_uv"][:, :2]
        assert np.allclose(found, koebe.disk_to_uv(result.uv), atol=1e-6)
    parts = koebe.parts("lh.white")
    parts.export(f"parts_{name}")
    assert os.path.getsize(f"parts_{name}") > 0


def test_polygons_of_an_old_vtk_file(folder):
    """meshio does not read them, PyVista does."""
    pyvista.PolyData.from_regular_faces(VERTICES, TRIANGLES).save("old.vtk")
    assert np.allclose(koebe.uniformize("old.vtk").uv, koebe.uniformize(SINGLE, TRIANGLES).uv, atol=1e-5)


def test_damaged_files_are_told_so(folder):
    """Each file cut off at many places, and with bytes changed: an error of ours, or a surface or values."""
    koebe.write_field("lh.a.annot", np.arange(len(VERTICES)) % 5)
    koebe.write_field("lh.a.curv", VERTICES[:, 0])
    koebe.write_field("lh.a.shape.gii", VERTICES[:, 0])
    koebe.write_field("lh.a.dscalar.nii", VERTICES[:, 0])
    result = koebe.uniformize("lh.white")
    for name in ("lh.p.patch.flat", "a.gii", "a.vtk", "a.vtu"):
        result.export(name)
    readers = {
        **dict.fromkeys(("lh.white", "a.gii", "a.vtk", "a.vtu"), koebe.boundary_loops),
        **dict.fromkeys(("lh.a.annot", "lh.a.curv", "lh.a.shape.gii", "lh.a.dscalar.nii"), koebe.read_field),
        "lh.p.patch.flat": koebe.read_patch,
    }
    rng = np.random.default_rng(0)
    for name, read in readers.items():
        whole = (folder / name).read_bytes()
        tried = [whole[: int(share * len(whole))] for share in (0.0, 0.001, 0.01, 0.1, 0.5, 0.9, 0.999)]
        for _ in range(6):
            changed = bytearray(whole)
            for place in rng.integers(0, min(len(whole), 400), 3):
                changed[place] = rng.integers(256)
            tried.append(bytes(changed))
        for number, text in enumerate(tried):
            (folder / name).write_bytes(text)
            try:
                read(name)
            except koebe.KoebeError:
                continue
            assert number >= 6 or name in ("a.vtk", "a.vtu", "lh.white"), (name, number)


def test_the_command_takes_and_writes_these_formats(folder):
    region = np.where(MASK, 0.0, 1.0)
    koebe.write_field("lh.in.shape.gii", region)
    expected = koebe.uniformize("lh.white", mask=MASK)
    out = command("uniformize", "lh.white", "out.gii", "--region", "lh.in.shape.gii", "--json", "r.json")
    assert out.startswith("out.gii: ") and '"input": "lh.white"' in (folder / "r.json").read_text()
    found = {array.meta.get("Name"): array.data for array in nibabel.load("out.gii").darrays}
    assert np.allclose(found["koebe_uv"], 0.5 + 0.5 * expected.uv, atol=1e-6, equal_nan=True)
    command("uniformize", "lh.white", "lh.x.patch.flat", "--region=lh.in.shape.gii")
    assert np.array_equal(koebe.read_patch("lh.x.patch.flat").vertices, np.unique(expected.surface[1]))
    command("sphere", "rh.ball", "rh.sphere.surf.gii")
    ours = nibabel.load("rh.sphere.surf.gii").darrays[0].data
    assert np.allclose(ours, 100 * koebe.sphere_map("rh.ball").points, atol=1e-3)
    command("fill", "lh.white", "filled.vtu")
    assert len(koebe.boundary_loops("filled.vtu")) == 1
    assert "several places" in command("parts", "lh.white", "lh.x.surf.gii", code=3)
    assert "lh.none" in command("module", "lh.none", code=3)
    assert "not_known" in command("uniformize", "lh.white", "out.gii", "--not_known", code=2)
    assert not [name for name in os.listdir(folder) if "koebe-" in name]


def test_what_has_no_such_form_is_told_so(folder):
    with pytest.raises(koebe.InputError, match="no format"):
        koebe.uniformize("lh.white").export("x.abc")
    with pytest.raises(koebe.InputError, match="cuts"):
        koebe.parts("lh.white").export("lh.x.surf.gii")
    with pytest.raises(koebe.InputError, match="whole numbers"):
        koebe.write_field("lh.x.annot", VERTICES[:, 0])
    with pytest.raises(koebe.InputError, match="hemisphere"):
        koebe.write_field("x.dscalar.nii", VERTICES[:, 0])
    koebe.write_field("lh.x.curv", VERTICES[:, 0])
    with pytest.raises(koebe.InputError, match="no surface"):
        koebe.uniformize("lh.x.curv")
    image = gifti(SINGLE, TRIANGLES)
    nibabel.save(image, "a.surf.gii")
    with pytest.raises(koebe.FileError, match="values at vertices"):
        koebe.read_field("a.surf.gii")
    with pytest.raises(FileNotFoundError):
        koebe.read_field("none.curv")


@pytest.mark.parametrize("name", ["read_field", "read_patch", "read_region", "write_field"])
def test_the_example_of_the_docstring_runs(name, monkeypatch):
    monkeypatch.chdir(Path(__file__).resolve().parents[2])
    (found,) = doctest.DocTestFinder(recurse=False).find(getattr(koebe, name), name, module=False, globs={})
    assert found.examples and doctest.DocTestRunner().run(found).failed == 0


@pytest.mark.parametrize("magic", [b"\xff\xff\xff", b"\xff\xff\xfd"])
def test_freesurfers_old_quadrilaterals_are_a_surface(tmp_path, magic):
    """The first kind has coordinates in hundredths, and begins like values at vertices."""
    n = 9
    grid = np.arange(n * n).reshape(n, n)
    quads = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=-1).reshape(-1, 4)
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    points = np.stack([x.ravel(), y.ravel(), (x * y).ravel() % 3], axis=1) / 4
    three = lambda numbers: b"".join(int(k).to_bytes(3, "big") for k in numbers)  # noqa: E731
    places = (100 * points).astype(">i2") if magic[2] == 0xFF else points.astype(">f4")
    data = magic + three([len(points), len(quads)]) + places.tobytes() + three(quads.ravel())
    (tmp_path / "lh.orig").write_bytes(data)
    result = koebe.uniformize(tmp_path / "lh.orig")
    assert np.allclose(result.vertices, points) and result.face_count == 2 * len(quads)
    assert [len(loop) for loop in result.loops] == [4 * (n - 1)]
    (tmp_path / "lh.short").write_bytes(data[:-5])
    with pytest.raises(koebe.KoebeError, match="values at vertices|cannot be read"):
        koebe.uniformize(tmp_path / "lh.short")
