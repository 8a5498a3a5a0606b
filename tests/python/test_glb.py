"""GLB files: each mesh gets UVs, everything else stays bit for bit, and damaged files are refused."""

import json

import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, koebe, obj_rows, obj_text, perforated, succeeded
from glb_support import GlbBuilder, GlbReader


def plate(n=12):
    """A wavy plate with a hole, in triangles: vertices (V, 3) as 32-bit floats, faces (F, 3)."""
    vertices, quads = perforated(n, holes=((0.5, 0.5, 0.2),))
    quads = np.array(quads)
    return np.asarray(vertices, "<f4"), np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def cube():
    vertices = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], "<f4")
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return vertices, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def indexed(scene, vertices, faces, dtype="<u2", **more):
    indices = scene.accessor(np.asarray(faces, dtype).reshape(-1, 1), "SCALAR")
    return {"attributes": {"POSITION": scene.positions(vertices)}, "indices": indices, **more}


def flipped(corners):
    """Faces without a positive area as stored: v goes down, so that a face is clockwise in it."""
    b, c = np.moveaxis(corners[:, 1:].astype(float) - corners[:, :1], 1, 0)
    return np.flatnonzero(b[:, 0] * c[:, 1] - c[:, 0] * b[:, 1] >= 0)


def kinds_in(report):
    return {warning["kind"] for warning in report["warnings"]}


def mapped(folder, data, *words):
    """The result of a command on a GLB file, and its report."""
    (folder / "in.glb").write_bytes(data)
    succeeded(*words[:1], "in.glb", "out.glb", "--json", "out.json", *words[1:], cwd=folder)
    return GlbReader((folder / "out.glb").read_bytes()), json.loads((folder / "out.json").read_text())


def full_scene(extension="VENDOR_anything"):
    """A scene with all that a mesh can have: two primitives on the same vertices, normals in bytes, colours, joints,
    morph targets (one sparse), a material, a skin, extras, and a second mesh in strips."""
    scene = GlbBuilder()
    vertices, faces = cube()
    rng = np.random.default_rng(1)
    first = indexed(scene, vertices, faces[:6], material=0)
    first["attributes"] |= {
        "NORMAL": scene.accessor(
            rng.integers(-127, 127, (8, 4), "i1")[:, :3], "VEC3", scene.view(rng.bytes(32), byteStride=4)
        ),
        "COLOR_0": scene.accessor(rng.integers(0, 255, (8, 4), "u1"), "VEC4", normalized=True),
        "JOINTS_0": scene.accessor(np.zeros((8, 4), "u1"), "VEC4"),
        "WEIGHTS_0": scene.accessor(np.tile(np.array([1, 0, 0, 0], "<f4"), (8, 1)), "VEC4"),
        "TEXCOORD_0": scene.accessor(rng.random((8, 2)).astype("<f4"), "VEC2"),
        "TEXCOORD_1": scene.accessor(rng.random((8, 2)).astype("<f4"), "VEC2"),
    }
    sparse = scene.accessor(np.zeros((8, 3), "<f4"), "VEC3")
    indices, values = (
        scene.view(np.array([2, 5], "<u2").tobytes()),
        scene.view(rng.random((2, 3)).astype("<f4").tobytes()),
    )
    scene.json["accessors"][sparse] |= {
        "sparse": {
            "count": 2,
            "indices": {"bufferView": indices, "componentType": 5123},
            "values": {"bufferView": values},
        }
    }
    del scene.json["accessors"][sparse]["bufferView"], scene.json["accessors"][sparse]["byteOffset"]
    first["targets"] = [{"POSITION": scene.positions(rng.random((8, 3)))}, {"POSITION": sparse}]
    second = {
        **first,
        "indices": scene.accessor(faces[6:].astype("<u1").reshape(-1, 1), "SCALAR"),
        "extras": {"tag": [1, 0.1]},
    }
    scene.mesh(first, second, name="Cube", weights=[0.5, 0.0])
    strip = np.concatenate([np.stack([np.arange(9), np.zeros(9), np.arange(9) ** 2 / 9], 1), np.zeros((9, 3))])
    strip[9:] = strip[:9] + [0, 1, 0]
    order = np.arange(18).reshape(2, 9).T.reshape(-1)
    scene.mesh(indexed(scene, strip, order, mode=5), {"attributes": {"POSITION": 0}, "mode": 0}, name="Strip")
    scene.json |= {
        "materials": [{"name": "Red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0.1, 0, 1]}}],
        "nodes": [{"mesh": 0, "skin": 0}, {"mesh": 1, "translation": [1e-7, 0.1, 3]}, {"name": "Bone"}],
        "skins": [{"joints": [2]}],
        "scenes": [{"nodes": [0, 1, 2]}],
        "extensionsUsed": [extension],
        "extensions": {extension: {"deep": [[{"a": None}]], "text": "é"}},
    }
    return scene


@pytest.mark.parametrize("extension", ["VENDOR_anything", "KHR_materials_variants"])
@pytest.mark.parametrize("words", [("parts",), ("uniformize", "--cut")])
def test_everything_else_stays_bit_for_bit(tmp_path, words, extension):
    data = full_scene(extension).bytes()
    old = GlbReader(data)
    new, report = mapped(tmp_path, data, *words)
    for name in old.json.keys() - {"accessors", "bufferViews", "buffers", "meshes"}:
        assert new.json[name] == old.json[name], name
    if extension == "VENDOR_anything":  # which may refer to anything
        assert new.binary.startswith(old.binary)
        for name in ("accessors", "bufferViews"):
            assert new.json[name][: len(old.json[name])] == old.json[name]
    else:
        assert all(number in used_accessors(new.json) for number in range(len(new.json["accessors"])))
    split = 0
    for before, after in zip(old.json["meshes"], new.json["meshes"], strict=True):
        assert {**before, "primitives": 0} == {**after, "primitives": 0}
        for one, other in zip(before["primitives"], after["primitives"], strict=True):
            if one.get("mode") == 0:
                assert one == other
                continue
            moving = {"attributes", "indices", "targets", "mode"}
            assert {k: v for k, v in one.items() if k not in moving} == {
                k: v for k, v in other.items() if k not in moving
            }
            for name in one["attributes"].keys() - {"TEXCOORD_0"}:
                assert np.array_equal(old.of_corners(one, name), new.of_corners(other, name)), name
            for k, target in enumerate(one.get("targets", [])):
                for name in target:
                    assert np.array_equal(old.of_corners(one, name, k), new.of_corners(other, name, k))
            split += len(new.array(other["attributes"]["POSITION"])) > len(old.array(one["attributes"]["POSITION"]))
            uv = new.of_corners(other, "TEXCOORD_0")
            assert uv.min() >= 0 and uv.max() <= 1 and flipped(uv).size == 0
    assert split >= 2  # the cube's two primitives, on the same vertices
    cube_now = new.json["meshes"][0]["primitives"]
    assert cube_now[0]["attributes"] == cube_now[1]["attributes"] and cube_now[0]["targets"] == cube_now[1]["targets"]
    assert [mesh["name"] for mesh in report["meshes"]] == ["Cube", "Strip"] and report["converged"]
    assert [mesh["flipped"] for mesh in report["meshes"]] == [0, 0]
    assert "replaced_uvs" in kinds_in(report)


def used_accessors(scene):
    """The numbers of accessors that primitives, skins and animations use."""
    primitives = [primitive for mesh in scene["meshes"] for primitive in mesh["primitives"]]
    samplers = [sampler for animation in scene.get("animations", []) for sampler in animation["samplers"]]
    groups = [group for p in primitives for group in (p["attributes"], *p.get("targets", []))]
    used = [number for group in groups for number in group.values()]
    used += [p["indices"] for p in primitives if "indices" in p]
    return {*used, *(s[k] for s in samplers for k in ("input", "output"))}


def random_scene(rng):
    """Meshes whose attributes share views, interleaved or not, or accessors; points on the same vertices, an image, an
    animation, and bytes that nothing uses, at any place between them."""
    scene = GlbBuilder()

    def noise():
        if rng.random() < 0.3:
            scene.view(rng.bytes(int(rng.integers(1, 9))))
        scene.binary += rng.bytes(int(rng.integers(0, 2) * rng.integers(0, 9)))
        if rng.random() < 0.3:
            image = {"bufferView": scene.view(rng.bytes(int(rng.integers(1, 40)))), "mimeType": "image/png"}
            scene.json.setdefault("images", []).append(image)

    for _ in range(rng.integers(1, 4)):
        vertices, faces = cube() if rng.random() < 0.6 else plate(6)
        arrays = {"POSITION": vertices, "NORMAL": rng.random(vertices.shape).astype("<f4")}
        if rng.random() < 0.7:
            arrays["TEXCOORD_0"] = rng.random((len(vertices), 2)).astype("<f4")
        noise()
        attributes = {}
        if rng.random() < 0.5:  # interleaved
            together = np.concatenate(list(arrays.values()), 1)
            view, offset = scene.view(together.tobytes(), byteStride=4 * together.shape[1]), 0
            for name, array in arrays.items():
                attributes[name] = scene.accessor(array, f"VEC{array.shape[1]}", view, offset)
                offset += 4 * array.shape[1]
        else:
            for name, array in arrays.items():
                attributes[name] = scene.accessor(array, f"VEC{array.shape[1]}")
                noise()
        half = len(faces) // 2
        parts = (faces,) if rng.random() < 0.5 else (faces[:half], faces[half:])
        order = scene.view(np.concatenate(parts).astype("<u2").tobytes())
        primitives, begin = [], 0
        for part in parts:
            indices = scene.accessor(part.astype("<u2").reshape(-1, 1), "SCALAR", order, begin)
            begin += 6 * len(part)
            primitives.append({"attributes": dict(attributes), "indices": indices})
        scene.mesh(*primitives)
        if rng.random() < 0.3:
            scene.mesh(*primitives, name="again")
        if rng.random() < 0.3:
            scene.mesh({"attributes": {"POSITION": attributes["POSITION"]}, "mode": 0}, name="points")
        noise()
    if rng.random() < 0.5:
        time = scene.accessor(np.array([[0], [1]], "<f4"), "SCALAR", min=[0], max=[1])
        way = scene.accessor(rng.random((2, 3)).astype("<f4"), "VEC3")
        scene.json["nodes"] = [{"mesh": 0}]
        channel = {"sampler": 0, "target": {"node": 0, "path": "translation"}}
        scene.json["animations"] = [{"samplers": [{"input": time, "output": way}], "channels": [channel]}]
    return scene


def view_bytes(glb, number):
    view = glb.json["bufferViews"][number]
    return glb.binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]


@pytest.mark.parametrize("seed", range(4))
def test_data_that_nothing_uses_any_more_leave_the_file(tmp_path, seed):
    """What is not replaced has the same number and the same bytes, and a second run adds nothing."""
    rng = np.random.default_rng(seed)
    data = random_scene(rng).bytes()
    old = GlbReader(data)
    new, _ = mapped(tmp_path, data, "parts")
    assert all(view["byteOffset"] % 4 == 0 for view in new.json["bufferViews"])
    of_accessors = [{accessor["bufferView"] for accessor in glb.json["accessors"]} for glb in (old, new)]
    for number in set(range(len(old.json["bufferViews"]))) - of_accessors[0]:  # images, and what nothing uses
        assert view_bytes(old, number) == view_bytes(new, number)
    for number in range(len(new.json["bufferViews"])):
        assert number in of_accessors[1] or number not in of_accessors[0]
    assert old.json.get("animations") == new.json.get("animations")
    for animation in new.json.get("animations", []):
        for name in ("input", "output"):
            number = animation["samplers"][0][name]
            assert np.array_equal(old.array(number), new.array(number))
    for before, after in zip(old.json["meshes"], new.json["meshes"], strict=True):
        for one, other in zip(before["primitives"], after["primitives"], strict=True):
            if one.get("mode") == 0:
                points = (old.array(one["attributes"]["POSITION"]), new.array(other["attributes"]["POSITION"]))
                assert np.array_equal(*points)
                continue
            for name in one["attributes"].keys() - {"TEXCOORD_0"}:
                assert np.array_equal(old.of_corners(one, name), new.of_corners(other, name)), name
            assert flipped(new.of_corners(other, "TEXCOORD_0")).size == 0
    again, _ = mapped(tmp_path, (tmp_path / "out.glb").read_bytes(), "parts")
    assert len(again.binary) == len(new.binary)


def test_a_vertex_without_a_cut_keeps_its_place_and_has_the_uvs_of_obj(tmp_path):
    vertices, faces = plate()
    scene = GlbBuilder()
    scene.mesh(indexed(scene, vertices, faces))
    new, report = mapped(tmp_path, scene.bytes(), "uniformize")
    (tmp_path / "in.obj").write_text(obj_text(vertices.astype(float), faces))
    assert koebe("uniformize", "in.obj", "out.obj", cwd=tmp_path).returncode == 0
    uv = obj_rows(tmp_path / "out.obj", "vt")
    primitive = new.json["meshes"][0]["primitives"][0]
    assert primitive["indices"] == 0 and primitive["attributes"]["POSITION"] == 1
    expected = np.stack([uv[:, 0], 1 - uv[:, 1]], 1)
    assert np.abs(new.array(primitive["attributes"]["TEXCOORD_0"]) - expected).max() < 1e-7
    assert report["flipped"] == 0 and len(report["loops"]) == 2 and "meshes" not in report


def test_vertices_that_old_uvs_cut_are_one_surface(tmp_path):
    vertices, faces = plate()
    scene = GlbBuilder()
    loose = vertices[faces].reshape(-1, 3)  # each corner has a vertex of its own
    scene.mesh({"attributes": {"POSITION": scene.positions(loose)}})
    new, report = mapped(tmp_path, scene.bytes(), "uniformize")
    assert len(report["loops"]) == 2 and report["flipped"] == 0 and kinds_in(report) <= {"ears"}
    uv = new.array(new.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"])
    places = {}
    for position, point in zip(map(tuple, loose), map(tuple, uv), strict=True):
        assert places.setdefault(position, point) == point


@pytest.mark.parametrize("dtype", ["<u1", "<u2", "<u4"])
def test_indices_grow_with_the_copies(tmp_path, dtype):
    """250 vertices fit into bytes, and their copies do not."""
    turn = np.linspace(0, 2 * np.pi, 25, endpoint=False)
    rings = [np.stack([np.cos(turn), np.sin(turn), np.full(25, z)], 1) for z in np.linspace(0, 2, 10)]
    vertices = np.concatenate(rings).astype("<f4")
    quads = np.array(
        [
            [25 * i + j, 25 * i + (j + 1) % 25, 25 * i + 25 + (j + 1) % 25, 25 * i + 25 + j]
            for i in range(9)
            for j in range(25)
        ]
    )
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    scene = GlbBuilder()
    scene.mesh(indexed(scene, vertices, faces, dtype))
    new, report = mapped(tmp_path, scene.bytes(), "parts")
    primitive = new.json["meshes"][0]["primitives"][0]
    assert len(new.array(primitive["attributes"]["POSITION"])) > 255 and new.corners(primitive).max() > 255
    assert np.array_equal(new.of_corners(primitive), vertices[faces])
    assert report["flipped"] == flipped(new.of_corners(primitive, "TEXCOORD_0")).size == 0


def test_quantized_positions_have_the_same_map(tmp_path):
    """Normalized 16-bit integers (KHR_mesh_quantization)."""
    vertices, faces = plate()
    short = np.round(vertices * 32767).astype("<i2")
    scenes = GlbBuilder(), GlbBuilder()
    padded = np.concatenate([short, np.zeros((len(short), 1), "<i2")], 1)
    scenes[0].mesh(indexed(scenes[0], vertices, faces))
    scenes[0].json["accessors"][1] = {
        "bufferView": scenes[0].view(padded.tobytes(), byteStride=8), "componentType": 5122, "normalized": True,
        "count": len(short), "type": "VEC3",
    }  # fmt: skip
    scenes[1].mesh(indexed(scenes[1], short / 32767, faces))
    (a, first), (b, second) = (mapped(tmp_path, scene.bytes(), "uniformize") for scene in scenes)
    uvs = [one.of_corners(one.json["meshes"][0]["primitives"][0], "TEXCOORD_0") for one in (a, b)]
    assert np.abs(uvs[0] - uvs[1]).max() < 1e-5 and first["loops"][1]["vertices"] == second["loops"][1]["vertices"]


def test_a_mesh_that_cannot_be_mapped_is_named_and_nothing_is_written(tmp_path):
    scene = GlbBuilder()
    scene.mesh(indexed(scene, *plate()), name="Plate")
    scene.mesh(indexed(scene, *cube()), name="Box")
    (tmp_path / "in.glb").write_bytes(scene.bytes())
    run = koebe("uniformize", "in.glb", "out.glb", cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED and run.stderr.startswith("TopologyError(closed): mesh 1 (Box): ")
    run = koebe("parts", "in.glb", "out.glb", "--svg", "out.svg", cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED and "--svg draws one mesh, and the GLB file has 2" in run.stderr
    run = koebe("parts", "in.glb", "out.obj", cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED and "only maps that are written as GLB take several" in run.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["in.glb"]


def test_a_scene_of_one_mesh_is_an_input_of_every_command(tmp_path):
    vertices, faces = plate()
    scene = GlbBuilder()
    scene.mesh({"attributes": {"POSITION": scene.positions(vertices[faces].reshape(-1, 3))}})
    (tmp_path / "in.glb").write_bytes(scene.bytes())
    succeeded("uniformize", "in.glb", "out.obj", "--json", "out.json", cwd=tmp_path)
    lines = (tmp_path / "out.obj").read_text().splitlines()
    assert sum(line.startswith("v ") for line in lines) == len(vertices)
    assert kinds_in(json.loads((tmp_path / "out.json").read_text())) == {"ears", "not_kept"}


def test_wrong_usage_is_refused(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*perforated()))
    scene = GlbBuilder()
    scene.mesh(indexed(scene, *plate()))
    (tmp_path / "in.glb").write_bytes(scene.bytes())
    for words, sentence in (
        (("parts", "in.obj", "out.glb"), "only a GLB file is written as GLB: IN must end in .glb, too"),
        (("sphere", "in.glb", "out.glb", "--sphere", "s.obj"), "--sphere: needs an OUT that ends in .obj or .ply"),
        (("fill", "in.glb", "out.glb"), "the format '.glb' cannot be written"),
    ):
        run = koebe(*words, cwd=tmp_path)
        assert run.returncode == USAGE and sentence in run.stderr, run.stderr
    run = succeeded("fill", "in.glb", "out.obj", cwd=tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["in.glb", "in.obj", "out.obj"]


def broken(change):
    """A scene after a change of its JSON."""
    scene = GlbBuilder()
    scene.mesh(indexed(scene, *plate()))
    change(scene.json)
    return scene.bytes()


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda j: j["accessors"][0].update(count=10**9), "buffer view 0 of the GLB file is too short"),
        (lambda j: j["accessors"][1].update(count=20), "faces name a vertex that does not exist (faces listed)"),
        (lambda j: j["accessors"][1].update(bufferView=99), "the GLB file names buffer view 99, and has 2"),
        (lambda j: j["accessors"][1].update(type="VEC2"), "positions without three coordinates"),
        (lambda j: j["accessors"][0].update(componentType=5126, count=9), "indices that are no whole numbers"),
        (
            lambda j: j["meshes"][0]["primitives"][0].update(indices=7),
            "damaged: primitive indices accessor out of bounds",
        ),
        (lambda j: j["meshes"][0]["primitives"][0].update(mode=1), "the GLB file has no triangles"),
        (lambda j: j["buffers"].append({"byteLength": 4, "uri": "other.bin"}), "has its data in another file"),
        (lambda j: j["buffers"].append({"byteLength": 0}), "the GLB file is damaged: empty data"),
        (lambda j: j["bufferViews"].append(7), "damaged"),
        (lambda j: j.update(extras=json.loads("[" * 300 + "]" * 300)), "nested too deeply"),
        (
            lambda j: j.update(extensionsRequired=["KHR_draco_mesh_compression"]),
            "the GLB file is compressed (KHR_draco_mesh_compression): save it without compression",
        ),
        (
            lambda j: j.update(extensionsUsed=["EXT_bent"], extensionsRequired=["EXT_bent"]),
            "the GLB file requires the extension EXT_bent, which may change its shapes",
        ),
        (lambda j: j["bufferViews"][1].update(byteStride=4), "elements of accessor 1 of the GLB file overlap"),
    ],
)
def test_bad_files_are_refused_with_the_reason(tmp_path, change, sentence):
    (tmp_path / "in.glb").write_bytes(broken(change))
    run = koebe("uniformize", "in.glb", "out.glb", cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED and sentence in run.stderr, run.stderr
    assert not (tmp_path / "out.glb").exists()


@pytest.mark.parametrize("extension", ["VENDOR_anything", "KHR_materials_variants"])
def test_damaged_files_are_mapped_or_refused(tmp_path, extension):
    data = full_scene(extension).bytes()
    rng = np.random.default_rng(2)
    ends = set()
    for k in range(60):
        bad = bytearray(data[: rng.integers(len(data))] if k % 4 == 0 else data)
        for place in rng.integers(min(len(bad), 2500), size=rng.integers(1, 4)):
            bad[place] = rng.choice(list(b'0123456789{}[]",:-e') if place > 20 else range(256))
        (tmp_path / "in.glb").write_bytes(bad)
        run = koebe("parts", "in.glb", "out.glb", cwd=tmp_path)
        ends.add(run.returncode)
        assert run.returncode in (0, CANNOT_BE_MAPPED, 4), (k, run.returncode, run.stderr)
        assert (tmp_path / "out.glb").exists() == (run.returncode != CANNOT_BE_MAPPED)
        (tmp_path / "out.glb").unlink(missing_ok=True)
    assert ends >= {0, CANNOT_BE_MAPPED}


def test_a_batch_maps_each_scene_to_a_scene(tmp_path):
    (tmp_path / "library").mkdir()
    scene = GlbBuilder()
    for n in (10, 12):
        scene.mesh(indexed(scene, *plate(n)))
    (tmp_path / "library" / "scene.glb").write_bytes(scene.bytes())
    (tmp_path / "library" / "bad.glb").write_bytes(scene.bytes()[:99])
    run = koebe("batch", "library", "--output", "out", cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED, run.stderr
    rows = {row["name"]: row for row in json.loads((tmp_path / "out" / "summary.json").read_text())["files"]}
    assert rows["bad.glb"]["error"] == "InputError" and not (tmp_path / "out" / "bad.glb").exists()
    koebe("uniformize", "library/scene.glb", "alone.glb", cwd=tmp_path)
    assert (tmp_path / "out" / "scene.glb").read_bytes() == (tmp_path / "alone.glb").read_bytes()
    assert rows["scene.glb"]["exit_code"] == 0
    assert rows["scene.glb"]["faces"] == len(plate(10)[1]) + len(plate(12)[1])


def lit_scene(transform=None, texcoord=0, tangents=True, second=False):
    """A plate with normals, tangents and a normal map; with `second` another mesh of lines has the material too."""
    scene = GlbBuilder()
    vertices, faces = plate()
    one = indexed(scene, vertices, faces, material=0)
    count = len(vertices)
    one["attributes"]["NORMAL"] = scene.accessor(np.tile(np.array([0, 0, 1], "<f4"), (count, 1)), "VEC3")
    if tangents:
        one["attributes"]["TANGENT"] = scene.accessor(np.tile(np.array([1, 0, 0, 1], "<f4"), (count, 1)), "VEC4")
    one["attributes"]["TEXCOORD_0"] = scene.accessor(vertices[:, :2], "VEC2")
    scene.mesh(one, name="Plate")
    if second:
        scene.mesh({"attributes": {"POSITION": one["attributes"]["POSITION"]}, "mode": 1, "material": 0})
    texture = {"index": 0, **({"texCoord": texcoord} if texcoord else {})}
    if transform:
        texture["extensions"] = {"KHR_texture_transform": transform}
    scene.json |= {
        "materials": [{"normalTexture": texture, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{}],
        "extensionsUsed": ["KHR_texture_transform"],
    }
    return scene


def test_tangents_go_with_the_uvs_that_they_follow(tmp_path):
    data = lit_scene().bytes()
    new, report = mapped(tmp_path, data, "parts")
    attributes = new.json["meshes"][0]["primitives"][0]["attributes"]
    assert {*attributes} == {"POSITION", "NORMAL", "TEXCOORD_0"}
    assert any("tangents" in warning["text"] for warning in report["warnings"])
    # As a second set they leave the first set and its tangents alone.
    second, report = mapped(tmp_path, data, "parts", "--uv-channel", 1)
    attributes = second.json["meshes"][0]["primitives"][0]["attributes"]
    assert {*attributes} == {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1"}
    assert not kinds_in(report) & {"not_kept", "replaced_uvs"}
    assert np.array_equal(second.array(attributes["TEXCOORD_1"]),
                          new.array(new.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"]))  # fmt: skip
    old = GlbReader(data)
    before = old.json["meshes"][0]["primitives"][0]["attributes"]
    count = len(old.array(before["POSITION"]))
    for name in ("TANGENT", "TEXCOORD_0"):
        assert np.array_equal(second.array(attributes[name])[:count], old.array(before[name]))
    # A normal map on the second set: the tangents follow that one.
    third, _ = mapped(tmp_path, lit_scene(texcoord=1).bytes(), "parts")
    assert "TANGENT" in third.json["meshes"][0]["primitives"][0]["attributes"]


def test_textures_that_were_moved_show_in_whole_on_new_uvs(tmp_path):
    eighth = {"scale": [0.125, 0.125], "offset": [0.5, 0]}
    new, report = mapped(tmp_path, lit_scene(eighth).bytes(), "parts")
    assert "extensions" not in new.json["materials"][0]["normalTexture"]
    assert any("moved" in warning["text"] for warning in report["warnings"])
    # The transform may choose the set.
    chosen, _ = mapped(tmp_path, lit_scene(eighth | {"texCoord": 0}, texcoord=1).bytes(), "parts")
    assert chosen.json["materials"][0]["normalTexture"] == {"index": 0}
    other = lit_scene(eighth | {"texCoord": 1})
    kept, report = mapped(tmp_path, other.bytes(), "parts")
    assert kept.json["materials"] == other.json["materials"]
    # Lines have the material too, or an animation moves it: it stays, with a warning.
    shared, moved = lit_scene(eighth, second=True), lit_scene(eighth)
    pointer = "/materials/0/normalTexture/extensions/KHR_texture_transform/offset"
    target = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}
    moved.json["animations"] = [{"channels": [{"sampler": 0, "target": target}], "samplers": []}]
    for scene in (shared, moved):
        left, report = mapped(tmp_path, scene.bytes(), "parts")
        assert left.json["materials"] == scene.json["materials"]
        assert any("still move" in warning["text"] for warning in report["warnings"])


def test_a_further_set_of_uvs_needs_those_before_it_and_a_glb_file(tmp_path):
    (tmp_path / "in.glb").write_bytes(lit_scene().bytes())
    run = koebe("parts", "in.glb", "out.glb", "--uv-channel", 3, cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED and "has no TEXCOORD_1" in run.stderr
    (tmp_path / "in.obj").write_text(obj_text(*plate()))
    run = koebe("parts", "in.obj", "out.obj", "--uv-channel", 1, cwd=tmp_path)
    assert run.returncode == USAGE and "--uv-channel" in run.stderr
    assert not (tmp_path / "out.glb").exists() and not (tmp_path / "out.obj").exists()


def test_positions_may_be_sparse_alone(tmp_path):
    vertices, faces = plate()
    scene = GlbBuilder()
    scene.mesh(indexed(scene, vertices, faces))
    whole, _ = mapped(tmp_path, scene.bytes(), "parts")
    accessor = scene.json["accessors"][scene.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    numbers = scene.view(np.arange(len(vertices), dtype="<u2").tobytes())
    values = {"bufferView": accessor.pop("bufferView"), "byteOffset": accessor.pop("byteOffset")}
    indices = {"bufferView": numbers, "componentType": 5123}
    accessor["sparse"] = {"count": len(vertices), "indices": indices, "values": values}
    sparse, _ = mapped(tmp_path, scene.bytes(), "parts")
    uvs = [file.array(file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"]) for file in (whole, sparse)]
    assert np.array_equal(*uvs)
    accessor["count"] = 2**40
    (tmp_path / "in.glb").write_bytes(scene.bytes())
    assert koebe("parts", "in.glb", "out.glb", cwd=tmp_path).returncode == CANNOT_BE_MAPPED


def test_meshes_without_a_triangle_do_not_stop_a_scene(tmp_path):
    scene = GlbBuilder()
    vertices, faces = plate()
    point = scene.positions(np.zeros((3, 3)))
    empty = {"attributes": {"POSITION": point}}
    scene.mesh(empty, name="Point")
    scene.mesh(indexed(scene, vertices, faces), name="Plate")
    scene.mesh({**empty, "mode": 0}, name="Points")
    scene.mesh({**empty, "indices": scene.accessor(np.zeros((6, 1), "<u2"), "SCALAR")}, name="Degenerate")
    scene.mesh({"attributes": {}}, name="Nothing")
    new, _ = mapped(tmp_path, scene.bytes(), "parts")
    for before, after in zip(scene.json["meshes"], new.json["meshes"], strict=True):
        assert (before == after) == (before["name"] != "Plate")
