"""koebe.cortex: fsaverage5, which nilearn brings, as FreeSurfer's and fMRIPrep's folders have it."""

import inspect
import subprocess
import sys
from pathlib import Path

import koebe
import nibabel
import numpy as np
import pytest
from koebe.labs import cortex_command
from nibabel import freesurfer
from nilearn.datasets import fetch_surf_fsaverage
from uv_measures import signed_areas, triangle_areas

FILES = fetch_surf_fsaverage("fsaverage5")
SIDES = {"left": "lh", "right": "rh"}


def arrays(name, side):
    return [array.data for array in nibabel.load(FILES[f"{name}_{side}"]).darrays]


def cortex_of(side):
    """Vertices: those of the flat map and those beside them. The rest is the medial wall, without the cuts."""
    flat, kept = arrays("flat", side)
    faces = arrays("white", side)[1]
    inside = np.zeros(len(flat), bool)
    inside[kept] = True
    for _ in range(2):
        inside[faces[inside[faces].any(axis=1)]] = True
    return inside


@pytest.fixture(scope="module")
def subject(tmp_path_factory):
    """FreeSurfer's folder, both hemispheres."""
    folder = tmp_path_factory.mktemp("fs") / "sub"
    (folder / "surf").mkdir(parents=True)
    (folder / "label").mkdir()
    for side, h in SIDES.items():
        for name, theirs in {"white": "white", "sphere.reg": "sphere"}.items():
            freesurfer.write_geometry(str(folder / "surf" / f"{h}.{name}"), *arrays(theirs, side))
        inside = np.flatnonzero(cortex_of(side))
        rows = "\n".join(f"{vertex} 0 0 0 0" for vertex in inside)
        (folder / "label" / f"{h}.cortex.label").write_text(f"#!ascii label\n{len(inside)}\n{rows}\n")
    return folder


@pytest.fixture(scope="module")
def own(subject):
    return koebe.cortex(subject, "lh")


def is_right(flat):
    """No face turned over, of the surface's area, upright; angles and areas as bounds of fsaverage5's say."""
    corners, points = flat.places[flat.map.triangles], flat.map.vertices[flat.map.triangles]
    signs = signed_areas(corners)
    assert (signs > 0).all() and flat.map.flipped == 0
    assert signs.sum() == pytest.approx(triangle_areas(points).sum(), rel=1e-9)
    assert flat.map.angle_error_deg["mean"] < 11 and flat.map.area_distortion["log_sd"] < 0.2
    assert not (flat.wall & flat.cuts).any()
    assert np.array_equal(np.isfinite(flat.places[:, 0]), ~(flat.wall | flat.cuts))
    return True


def test_cuts_are_found_that_lower_the_distortion(subject, own):
    assert is_right(own) and 20 < own.cuts.sum() < 400 and 0.0 < own.left_out < 0.06
    uncut = koebe.cortex(subject, "left", darts=0)
    assert not uncut.cuts.any() and uncut.left_out == 0.0
    assert own.map.angle_error_deg["mean"] < 0.8 * uncut.map.angle_error_deg["mean"]
    front = own.map.vertices[:, 1] > 40
    assert np.nanmean(own.places[front, 0]) < np.nanmean(own.places[~front, 0]) - 20  # as seen from the left


def test_the_cuts_of_a_flat_map_are_carried_over(subject):
    """From nilearn's files through the sphere that lies beside them."""
    flat = koebe.cortex(subject, "right", cuts=FILES["flat_right"])
    assert is_right(flat)
    kept = arrays("flat", "right")[1]
    theirs = np.ones(len(flat.wall), bool)
    theirs[kept] = False
    assert theirs[flat.cuts].sum() > 5 and 60 < flat.cuts.sum() < 250
    front = flat.map.vertices[:, 1] > 40
    assert np.nanmean(flat.places[front, 0]) > np.nanmean(flat.places[~front, 0]) + 20  # as seen from the right


def test_a_flat_map_of_the_subject_says_what_is_left_out():
    flat = koebe.cortex(Path(FILES["flat_left"]).parent, "left", cuts=FILES["flat_left"])
    assert is_right(flat) and flat.left_out == 0.0
    assert np.array_equal(np.sort(flat.map.triangles), np.sort(arrays("flat", "left")[1]))
    assert flat.map.angle_error_deg["mean"] < 10  # FreeSurfer's has 12.9


def test_patches_are_written_and_read_as_cuts(subject, own):
    for name in ("lh.k.flat.patch.3d", "lh.k.patch.3d"):
        own.write(subject / "surf" / name)
        patch = koebe.read_patch(subject / "surf" / name)
        assert np.array_equal(patch.vertices, np.flatnonzero(np.isfinite(own.places[:, 0])))
        assert patch.border.sum() == len(koebe.boundary_loops(own.map.triangles)[0])
        again = koebe.cortex(subject, "lh", cuts=subject / "surf" / name)
        assert is_right(again) and np.array_equal(again.map.triangles, own.map.triangles)
    assert np.allclose(patch.points, own.map.vertices[patch.vertices], atol=1e-4)  # the second one is not flat


def test_gifti_and_pycortex_read_the_flat_map(tmp_path, own):
    for name in ("flat_lh.gii", "sub_hemi-L_flat.surf.gii"):
        own.write(tmp_path / name)
        points, faces = (array.data for array in nibabel.load(tmp_path / name).darrays)
        assert np.allclose(points[:, :2], np.nan_to_num(own.places), atol=1e-3) and not points[:, 2].any()
        assert np.array_equal(faces, own.map.triangles)


def test_fmriprep_annotations_and_arrays(tmp_path, subject, own):
    anat = tmp_path / "sub-01" / "ses-1" / "anat"
    anat.mkdir(parents=True)
    points, faces = arrays("white", "left")
    inside = cortex_of("left")
    image = nibabel.GiftiImage(darrays=[
        nibabel.gifti.GiftiDataArray(np.float32(points), "NIFTI_INTENT_POINTSET"),
        nibabel.gifti.GiftiDataArray(np.int32(faces), "NIFTI_INTENT_TRIANGLE"),
    ])  # fmt: skip
    nibabel.save(image, anat / "sub-01_ses-1_hemi-L_white.surf.gii")
    koebe.write_field(anat / "sub-01_ses-1_hemi-L_desc-cortex_mask.label.gii", inside.astype(int), names={1: "cortex"})
    koebe.write_field(tmp_path / "lh.aparc.annot", inside.astype(int), names={0: "unknown", 1: "all"})
    for region in (None, tmp_path / "lh.aparc.annot"):
        flat = koebe.cortex(tmp_path / "sub-01", "L", region=region, even=0, darts=0)
        assert np.array_equal(flat.wall, own.wall) and not flat.cuts.any()


def test_the_command(subject, tmp_path):
    """The exit code, the files, and nothing is left of a run that fails."""

    def run(*words):
        command = [sys.executable, "-m", "koebe", "cortex", *map(str, words)]
        return subprocess.run(command, capture_output=True, text=True)

    done = run(subject, "lh", tmp_path / "lh.flat.patch.3d", "--json", tmp_path / "r.json", "--darts", "0")
    assert done.returncode == 0 and "0 flipped" in done.stdout and (tmp_path / "r.json").stat().st_size > 100
    before = sorted(tmp_path.iterdir())
    assert run(subject, "nose", tmp_path / "x.gii").returncode == 2
    assert run(subject, "lh", tmp_path / "x.gii", "--even", "2").returncode == 2
    missing = run(tmp_path, "lh", tmp_path / "x.gii")
    assert missing.returncode == 3 and missing.stderr.startswith("FileError") and "sought" in missing.stderr
    no_folder = run(subject, "lh", tmp_path / "no" / "x.gii", "--json", tmp_path / "x.json", "--darts", "0")
    assert no_folder.returncode == 3
    assert sorted(tmp_path.iterdir()) == before


def test_the_command_says_that_a_map_is_not_done(subject, tmp_path, monkeypatch, capsys):
    def unfinished(*given, **named):
        flat = koebe.cortex(*given, **named)
        object.__setattr__(flat.map, "converged", False)
        return flat

    unfinished.__signature__ = inspect.signature(koebe.cortex)
    monkeypatch.setattr(cortex_command, "cortex", unfinished)
    assert cortex_command.run([str(subject), "lh", str(tmp_path / "lh.flat.patch.3d"), "--darts", "0"]) == 4
    assert capsys.readouterr().out.endswith("not converged\n")


def wrong(subject, folder):
    """Calls that must fail, and the words of their errors."""
    flat = folder / "flat_left.gii"
    image = nibabel.load(FILES["flat_left"])
    nibabel.save(image, flat)
    patch = folder / "lh.p.patch.flat"
    patch.write_bytes(b"\xff\xff\xff\xff" + (1).to_bytes(4, "big") + (99999).to_bytes(4, "big") + bytes(12))
    cut_off = folder / "lh.short.patch.flat"
    cut_off.write_bytes(b"\xff\xff\xff\xff" + (5).to_bytes(4, "big"))
    nothing = folder / "lh.empty.patch.flat"
    nothing.write_bytes(b"\xff\xff\xff\xff" + bytes(4))
    return [
        ({"cuts": FILES["flat_right"]}, koebe.InputError, "other hemisphere"),
        ({"cuts": flat}, koebe.FileError, "no sphere lies beside"),
        ({"cuts": patch}, koebe.FileError, "no sphere lies beside"),
        ({"cuts": cut_off}, koebe.FileError, "cut off"),
        ({"cuts": nothing}, koebe.FileError, "no sphere lies beside"),
        ({"cuts": folder / "none"}, OSError, "none"),
        ({"region": np.ones(7, bool)}, koebe.InputError, "region must be"),
        ({"region": np.zeros(10242, bool)}, koebe.InputError, "nothing"),
        ({"surface": "pial"}, koebe.FileError, "sought surf/lh.pial"),
        ({"even": 2.0}, koebe.OptionError, "even"),
        ({"darts": -1.0}, koebe.OptionError, "darts"),
    ]


@pytest.mark.parametrize("number", range(11))
def test_errors_have_types_and_say_why(subject, tmp_path, number):
    options, kind, words = wrong(subject, tmp_path)[number]
    with pytest.raises(kind, match=words):
        koebe.cortex(subject, "lh", **options)


def test_a_patch_of_another_surface_is_refused(subject):
    surf = subject / "surf"
    for name, vertex in (("lh.far.patch.flat", 99999), ("lh.one.patch.flat", 5)):
        (surf / name).write_bytes(b"\xff\xff\xff\xff" + (1).to_bytes(4, "big") + vertex.to_bytes(4, "big") + bytes(12))
        with pytest.raises(koebe.FileError, match="not among|no face"):
            koebe.cortex(subject, "lh", cuts=surf / name)
    other = surf / "lh.sphere.reg"
    kept = other.read_bytes()
    points, faces = arrays("sphere", "left")
    try:
        for damaged, words in (((points[:9000], faces[(faces < 9000).all(axis=1)]), "other faces"),
                               ((points + [90.0, 0, 0], faces), "no sphere")):  # fmt: skip
            freesurfer.write_geometry(str(other), *damaged)
            with pytest.raises(koebe.FileError, match=words):
                koebe.cortex(subject, "lh", cuts=FILES["flat_left"])
    finally:
        other.write_bytes(kept)


def test_a_lesion_stays_open_and_no_face_turns_over(subject):
    """A hole beside the wall: the cortex is opened to it, or the map has it as a hole."""
    points = arrays("white", "left")[0]
    region = cortex_of("left") & (np.linalg.norm(points - (-50.0, 18.0, 12.0), axis=1) > 12.0)
    flat = koebe.cortex(subject, "lh", region=region)
    assert (signed_areas(flat.places[flat.map.triangles]) > 0).all() and not np.isfinite(flat.places[~region]).any()
