"""Packed UV layers: islands keep their shapes, their sizes and their distance, and files keep all else."""

import json
import threading
import time
from itertools import combinations

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, succeeded
from cli_support import koebe as run
from glb_support import GlbBuilder, GlbReader


def plane(w):
    return np.stack([np.real(w), np.imag(w)], axis=-1)


def fan(outline):
    """Triangles of a convex outline: places as complex numbers, and (F, 3)."""
    return np.asarray(outline), np.array([[0, k, k + 1] for k in range(1, len(outline) - 1)])


def layer_of(islands):
    """Vertices in space, triangles, and UVs (F, 3, 2) of islands side by side in the mesh."""
    w = np.concatenate([w for w, _ in islands])
    first = np.cumsum([0, *(len(w) for w, _ in islands)])
    triangles = np.concatenate([t + at for (_, t), at in zip(islands, first, strict=False)])
    return np.column_stack([plane(w), np.sin(w.real)]), triangles, plane(w)[triangles]


def convex_islands(rng, count):
    """Convex islands of all sizes, turned, some mirrored, on and beside each other."""
    islands = []
    for _ in range(count):
        w, t = fan(np.exp(2j * np.pi * np.sort(rng.uniform(0, 1, rng.integers(3, 9)))))
        w = (w.real + 1j * w.imag * rng.uniform(0.1, 1)) * np.exp(rng.normal(0, 0.8) + 1j * rng.uniform(0, 7))
        islands.append(((w if rng.random() < 0.7 else w.conj()) + complex(*rng.normal(0, 2, 2)) + 40, t))
    return islands


def distance(a, b):
    """Of two convex polygons that are apart; 0 if they are not."""
    apart, best = False, np.inf
    for p, q in ((a, b), (b, a)):
        edges = np.roll(p, -1) - p
        turn = 1 if (edges[0].conjugate() * (p.mean() - p[0])).imag > 0 else -1
        for start, edge in zip(p, edges, strict=True):
            away = (q - start) / edge
            apart |= bool((turn * away.imag < 0).all())
            best = min(best, (np.abs(away - np.clip(away.real, 0, 1)) * abs(edge)).min())
    return best if apart else 0.0


@pytest.mark.parametrize(("seed", "count", "tiles"), [(1, 1, 1), (2, 7, 1), (3, 40, 1), (4, 9, 3)])
def test_islands_are_moved_by_similarities_of_one_factor_and_keep_the_margin(seed, count, tiles):
    islands = convex_islands(np.random.default_rng(seed), count)
    vertices, triangles, uv = layer_of(islands)
    result = koebe.pack(vertices, triangles, uv=uv, margin=6, pixels=512, tiles=tiles)
    assert [len(island["faces"]) for island in result.islands] == [len(t) for _, t in islands]
    factors, outlines, tile_of = [], [], []
    for number, (w, t) in enumerate(islands):
        corners = result.uv[result.island == number] @ [1, 1j]
        moved = np.full(len(w), np.nan, complex)
        moved[t] = corners
        factor = (moved[1] - moved[0]) / (w[1] - w[0])
        assert np.abs(moved - moved[0] - factor * (w - w[0])).max() < 1e-12  # no island is mirrored
        tile = np.floor(moved.mean().real) + 1j * np.floor(moved.mean().imag)
        inside = plane(moved - tile)
        assert min(inside.min(), (1 - inside).min()) > 0.49 * result.margin / 512
        factors.append(abs(factor)), outlines.append(moved), tile_of.append(tile)
    assert np.ptp(factors) < 1e-12 * max(factors)
    assert set(tile_of) <= set(range(tiles)) and result.tiles == len(set(tile_of)) and 0 < result.margin <= 6
    assert all(distance(a, b) > 0.999 * result.margin / 512 for a, b in combinations(outlines, 2))
    areas = np.abs(np.cross(np.diff(result.uv, axis=1)[:, 0], np.diff(result.uv, axis=1)[:, 1])) / 2
    assert result.coverage == pytest.approx(areas.sum() / result.tiles, rel=1e-5) and result.flipped == 0
    again = koebe.pack(vertices, triangles, uv=result.uv, margin=6, pixels=512, tiles=tiles)
    assert again.coverage > 0.97 * result.coverage


def test_straight_islands_are_turned_by_quarters_and_others_at_will():
    bar, tilted = fan([0, 5, 5 + 1j, 1j]), fan(np.array([0, 5, 5 + 1j, 1j]) * np.exp(0.3j))
    triangle = fan([0, 4, 4 + 2j])  # its smallest box lies along the long side
    vertices, triangles, uv = layer_of([bar, tilted, triangle])
    packed = koebe.pack(vertices, triangles, uv=uv).uv @ [1, 1j]
    for corners in (packed[0], packed[2], packed[4]):
        assert abs((corners[1] - corners[0]).real * (corners[1] - corners[0]).imag) < 1e-12


def square(at, side=1.0):
    return fan(at + side * np.array([0, 1, 1 + 1j, 1j]))


def test_locked_islands_keep_their_place_and_the_others_go_into_the_free_space():
    """Some locked islands lie on the tiles in part, one around them, and one far away."""
    rng = np.random.default_rng(5)
    for tiles in (1, 1, 1, 1, 2, 3):
        kept = [(w / 40 + complex(*rng.uniform(0, 1, 2)) - 1, t) for w, t in convex_islands(rng, 4)]
        frame = np.array([-9, 9 - 9j, 9 + 9j, -9 + 9j, -9 - 9j])
        kept.append((np.array([-9 - 9j, 9 - 9j, 0.5 - 0.2j]), np.array([[0, 1, 2]])))
        kept.append(((frame[1:4] + 3e7), np.array([[0, 1, 2]])))
        free = [(w / 20, t) for w, t in convex_islands(rng, 12)]
        vertices, triangles, uv = layer_of(kept + free)
        count = sum(len(t) for _, t in kept)
        locked = np.arange(len(triangles)) < count
        result = koebe.pack(vertices, triangles, uv=uv, locked=locked, margin=4, pixels=512, tiles=tiles)
        assert [island["locked"] for island in result.islands] == [k < len(kept) for k in range(len(kept + free))]
        assert np.array_equal(result.uv[:count], uv[:count]) and 0 < result.scale <= 1 + 1e-9
        moved = result.uv[count:]
        assert moved.min() > 0 and moved[..., 1].max() < 1 and result.tiles <= tiles
        tile = np.floor(moved[..., 0])
        assert np.array_equal(tile.min(axis=1), tile.max(axis=1)) and tile.max() < tiles
        outlines = [(result.uv @ [1, 1j])[result.island == k] for k in range(len(kept + free))]
        places = [np.r_[corners[:, 0][:1], corners[:, 1], corners[-1:, 2]] for corners in outlines]
        apart = [distance(places[i], places[k]) for k in range(len(kept), len(places)) for i in range(k)]
        assert min(apart) > 0.999 * result.margin / 512 and result.margin > 0


def test_free_islands_keep_their_size_where_there_is_room_and_get_the_density_of_the_locked_ones():
    vertices, triangles, uv = layer_of([square(0.1 + 0.1j, 0.5), square(7, 0.25), square(9, 0.125)])
    vertices[:, 2] = 0
    for average, sides in ((False, [0.5, 0.25, 0.125]), (True, [0.5, 0.25, 0.125])):
        result = koebe.pack(vertices, triangles, uv=uv, locked=[True] * 2 + [False] * 4, average_scale=average)
        found = np.abs(np.diff(result.uv @ [1, 1j])[::2, 0])
        assert found == pytest.approx(sides) and result.scale == pytest.approx(1)
    larger = uv.copy()
    larger[2:4] *= 3  # against its size on the surface
    result = koebe.pack(vertices, triangles, uv=larger, locked=[True] * 2 + [False] * 4, average_scale=True)
    assert np.abs(np.diff(result.uv @ [1, 1j])[::2, 0]) == pytest.approx([0.5, 0.25, 0.125])


def test_locked_islands_that_leave_no_room_are_told():
    vertices, triangles, uv = layer_of([square(-1 - 1j, 3), square(7)])
    locked = [True, True, False, False]
    with pytest.raises(koebe.InputError, match="leave no room"):
        koebe.pack(vertices, triangles, uv=uv, locked=locked)
    with pytest.raises(koebe.InputError, match="leave no room"):
        koebe.pack(vertices, triangles, uv=uv, locked=locked, tiles=2)  # it covers both
    result = koebe.pack(vertices, triangles, uv=uv, locked=locked, tiles=3)
    assert result.tiles == 3 and (result.uv[2:] @ [1, 1j] - 2).real.min() > 0 and result.uv[2:].max() < 3
    with pytest.raises(koebe.InputError, match="locked must be"):
        koebe.pack(vertices, triangles, uv=uv, locked=[1, 1, 0])
    whole = koebe.pack(vertices, triangles, uv=uv, locked=[True] * 4)
    assert np.array_equal(whole.uv, uv)


def test_the_command_locks_faces_of_a_file(tmp_path):
    lines = [f"v {x} {y} 0\nvt {x} {y}\n" for x, y in ((0, 0), (0.5, 0), (0.5, 0.5), (0, 0.5))]
    lines += [f"v {x} {y} 0\nvt {x} {y}\n" for x, y in ((3, 3), (3.5, 3), (3.5, 3.4), (3, 3.4))]
    (tmp_path / "i.obj").write_text("".join(lines) + "f 1/1 2/2 3/3 4/4\nf 5/5 6/6 7/7 8/8\n")
    (tmp_path / "locked.txt").write_text("1\n0\n")
    done = succeeded("pack", tmp_path / "i.obj", tmp_path / "o.obj", "--locked", tmp_path / "locked.txt", "--json",
               tmp_path / "j.json")  # fmt: skip
    report = json.loads((tmp_path / "j.json").read_text())
    assert [island["locked"] for island in report["islands"]] == [True, False] and report["scale"] > 0.99
    assert report["options"]["locked"] is True
    (tmp_path / "locked.txt").write_text("1\n")
    done = run("pack", tmp_path / "i.obj", tmp_path / "o.obj", "--locked", tmp_path / "locked.txt")
    assert done.returncode == CANNOT_BE_MAPPED and "2 faces" in done.stderr


def test_more_seconds_give_no_worse_packing_and_enough_ends_it():
    vertices, triangles, uv = layer_of(convex_islands(np.random.default_rng(6), 20))
    usual = koebe.pack(vertices, triangles, uv=uv)
    begin = time.monotonic()
    longer = koebe.pack(vertices, triangles, uv=uv, seconds=2)
    assert 1.9 < time.monotonic() - begin < 6 and longer.coverage >= usual.coverage
    token = koebe.CancelToken()
    threading.Timer(0.5, token.cancel).start()
    begin = time.monotonic()
    ended = koebe.pack(vertices, triangles, uv=uv, seconds=60, enough=token)
    assert time.monotonic() - begin < 20 and ended.coverage > 0.3 and ended.flipped == 0
    with pytest.raises(koebe.Cancelled):
        koebe.pack(vertices, triangles, uv=uv, seconds=60, cancel=token)


def test_average_scale_gives_all_islands_one_texel_density():
    vertices, triangles, uv = layer_of([fan([0, 1, 1 + 1j, 1j]), fan([3, 4, 4 + 1j, 3 + 1j])])
    uv[2:] *= 5
    vertices[:, 2] = 0
    sides = [np.abs(np.diff(koebe.pack(vertices, triangles, uv=uv, average_scale=flag).uv @ [1, 1j])[:, 0])
             for flag in (False, True)]  # fmt: skip
    assert sides[0][2] == pytest.approx(5 * sides[0][0]) and sides[1][2] == pytest.approx(sides[1][0])


def ring(turns, n=24):
    """A strip along so many turns of a circle: above 1 it lies on itself."""
    at = np.exp(2j * np.pi * turns * np.linspace(0, 1, n + 1))
    k = np.arange(n)
    inner, outer = np.stack([k, k + n + 1, k + n + 2], -1), np.stack([k, k + n + 2, k + 1], -1)
    return np.concatenate([at, 2 * at]), np.concatenate([inner, outer])


def test_islands_on_themselves_are_listed_and_moved_as_they_are():
    fold = fan([0, 2, 0.5 + 0.1j, 1 - 0.05j])  # two triangles on the same side of their common edge
    islands = [ring(0.9), ring(1.4), fold, fan([0, 1, 1j])]
    vertices, triangles, uv = layer_of([(w + 7 * k, t) for k, (w, t) in enumerate(islands)])
    result = koebe.pack(vertices, triangles, uv=uv)
    assert [island["overlaps"] for island in result.islands] == [False, True, True, False]
    assert result.overlaps == 2 and result.converged and result.flipped == 1
    (warning,) = result.warnings
    expected = [*result.islands[1]["faces"], *result.islands[2]["faces"]]
    assert warning.kind == "not_one_to_one" and warning.elements == expected


def test_touching_corners_join_and_wrong_uvs_are_refused():
    square = [0, 1, 1 + 1j, 1j]
    vertices, triangles, uv = layer_of([fan(square), fan(square)])
    triangles[2:][triangles[2:] == 4] = 2  # one vertex of the mesh, at one place in the UVs for the two squares or not
    uv[2:] += [1, 1]
    assert len(koebe.pack(vertices, triangles, uv=uv).islands) == 1
    uv[2:] += [0.5, 0]
    assert len(koebe.pack(vertices, triangles, uv=uv).islands) == 2
    uv[3, 1, 0] = np.inf
    with pytest.raises(koebe.InputError, match="NaN or infinite") as caught:
        koebe.pack(vertices, triangles, uv=uv)
    assert caught.value.elements == [3] and caught.value.of == "faces"
    for wrong in (None, uv[:2], uv.astype(str)):
        with pytest.raises(koebe.InputError, match="uv must be"):
            koebe.pack(vertices, triangles, uv=wrong)


VERTICES = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [3, 0, 1], [3, 1, 1]], float)
POLYGONS = [[0, 1, 2, 3], [1, 4, 5, 2]]
UVS = np.array([[[3, 0], [5, 0], [5, 1], [3, 1]], [[0, 0], [1.5, 0], [1.5, 1], [0, 1]]], float)


def write_obj(path):
    lines = [f"v {x} {y} {z}" for x, y, z in VERTICES] + ["g Part"] + [f"vt {u} {v}" for u, v in UVS.reshape(-1, 2)]
    lines += ["f " + " ".join(f"{v + 1}/{4 * f + k - 8}" for k, v in enumerate(p)) for f, p in enumerate(POLYGONS)]
    path.write_text("\n".join(lines) + "\n")


def write_ply(path):
    head = ["ply", "format ascii 1.0", "element vertex 6", *(f"property double {axis}" for axis in "xyz"),
            "element face 2", "property list uchar int vertex_indices", "property list uchar double texcoord",
            "end_header"]  # fmt: skip
    rows = [" ".join(map(str, p)) for p in VERTICES.tolist()]
    rows += [f"4 {' '.join(map(str, p))} 8 {' '.join(map(str, w.ravel()))}" for p, w in zip(POLYGONS, UVS, strict=True)]
    path.write_text("\n".join(head + rows) + "\n")


def write_glb(path):
    scene = GlbBuilder()
    triangles = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]], "<u2")
    uv = UVS.reshape(-1, 2) * [1, -1] + [0, 1]
    attributes = {"POSITION": scene.positions(VERTICES[np.concatenate(POLYGONS)]),
                  "TEXCOORD_0": scene.accessor(uv.astype("<f4"), "VEC2")}  # fmt: skip
    scene.mesh({"attributes": attributes, "indices": scene.accessor(triangles.ravel(), "SCALAR"), "mode": 4})
    path.write_bytes(scene.bytes())


def read_glb(path):
    scene = GlbReader(path.read_bytes())
    (primitive,) = scene.json["meshes"][0]["primitives"]
    uv = scene.array(primitive["attributes"]["TEXCOORD_0"])[scene.array(primitive["indices"]).ravel()]
    return (uv * [1, -1] + [0, 1]).reshape(-1, 3, 2)[:, :2].reshape(2, 2, 2, 2)[:, 0]


def first_sides(path):
    """The UVs (2, 2, 2) of the first side of each face."""
    if path.suffix == ".glb":
        return read_glb(path)
    lines = [line.split() for line in path.read_text().splitlines()]
    if path.suffix == ".ply":
        return np.array([line[6:10] for line in lines[-2:]], float).reshape(2, 2, 2)
    places = [tuple(map(float, line[1:])) for line in lines if line[0] == "vt"]
    return np.array([[places[int(w.split("/")[1]) - 1] for w in line[1:3]] for line in lines if line[0] == "f"])


def test_the_command_packs_the_uvs_of_all_formats_alike(tmp_path):
    expected = None
    for suffix, write in ((".obj", write_obj), (".ply", write_ply), (".glb", write_glb)):
        given, out = tmp_path / f"given{suffix}", tmp_path / f"out{suffix}"
        write(given)
        succeeded("pack", given, out, "--margin", 4, "--pixels", 256, "--json", tmp_path / "report.json")
        report = json.loads((tmp_path / "report.json").read_text())
        assert len(report["islands"]) == 2 and report["margin"] == 4 and report["overlaps"] == 0
        sides = first_sides(out)
        lengths = np.linalg.norm(sides[:, 1] - sides[:, 0], axis=1)
        assert lengths[0] / lengths[1] == pytest.approx(2 / 1.5) and 0.5 < report["coverage"] < 1
        expected = sides if expected is None else expected
        assert np.abs(sides - expected).max() < 1e-6
    assert "g Part" in (tmp_path / "out.obj").read_text()


def test_the_command_refuses_files_without_uvs(tmp_path):
    write_obj(tmp_path / "given.obj")
    text = (tmp_path / "given.obj").read_text()
    for change, reason in (
        (text.replace("/-4", ""), "faces without texture coordinates"),
        (text.replace("/-4", "/99"), "texture coordinate that does not exist"),
        (text.replace("vt 5.0 1.0", "vt 5.0 nan"), "texture coordinate 2 is not two finite numbers"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "the file has no texture coordinates"),
    ):
        (tmp_path / "given.obj").write_text(change)
        done = run("pack", tmp_path / "given.obj", tmp_path / "out.obj")
        assert done.returncode == CANNOT_BE_MAPPED and reason in done.stderr, done.stderr
    assert not (tmp_path / "out.obj").exists()
