"""Unwrap Sequence: a mesh in frames and shape keys, each map laid over the first."""

import bpy
import fingerprint
import numpy as np
import pytest
import scenes

KEYS = {"Smile": (0.3, 2.0), "Frown": (-0.4, 1.0)}  # heights and turns of waves that are added


def unwrap(**options):
    return bpy.ops.uv.koebe_sequence(**options)


def entries():
    return list(bpy.context.window_manager.koebe_uv.islands)


def vectors(obj, name):
    """Values (n, 3) of an attribute."""
    return scenes.read(obj.data.attributes[name].data, "vector", np.float32, 3)


def add_keyed():
    """The panel with a basis and keys that add waves."""
    obj = scenes.add_panel()
    obj.shape_key_add(name="Basis")
    for name, (height, turns) in KEYS.items():
        block = obj.shape_key_add(name=name)
        for point in block.data:
            point.co.z += height * np.sin(turns * point.co.x + point.co.y)
    return obj


def add_waving(modifier=True):
    """The panel with a Wave and a SimpleDeform, in frame 7 of a scene with frames 1 to 4."""
    obj = scenes.add_panel()
    if modifier:
        wave = obj.modifiers.new("Wave", "WAVE")
        wave.height, wave.width, wave.time_offset = 0.3, 1.0, -20.0
        bend = obj.modifiers.new("Bend", "SIMPLE_DEFORM")
        bend.deform_method = "BEND"
        bend.deform_axis = "Z"
        for frame, angle in ((1, 0.0), (4, 0.6)):
            bend.angle = angle
            bend.keyframe_insert("angle", frame=frame)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 4
    scene.frame_set(7)
    return obj


def applied(obj, frame):
    """A copy of the object whose mesh is as it is in a frame."""
    scene, now = bpy.context.scene, bpy.context.scene.frame_current
    scene.frame_set(frame)
    mesh = bpy.data.meshes.new_from_object(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    copy = bpy.data.objects.new("Applied", mesh)
    bpy.context.collection.objects.link(copy)
    scene.frame_set(now)
    return copy


def uniformized(obj, **options):
    """The UVs of Koebe Unwrap to Disk."""
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize(checker=False, layer="Alone", **options) == {"FINISHED"}
    return scenes.corner_uv(obj.data, "Alone").copy()


def unchanged(before):
    """Nothing but the report differs."""
    return fingerprint.differences(before, fingerprint.fingerprint()) in ([], ["file: report"])


# ---------------------------------------------------------------- shape keys


def test_keys_become_layers_of_circle_domains_and_the_first_is_that_of_uniformize():
    obj = add_keyed()
    assert unwrap(source="SHAPE_KEYS", target="LAYERS") == {"FINISHED"}
    names = ["Koebe Basis", "Koebe Smile", "Koebe Frown"]
    assert [layer.name for layer in obj.data.uv_layers] == names
    assert obj.data.uv_layers.active.name == "Koebe Basis"
    for name in names:
        scenes.assert_circle_domain(obj, name)
    uv = [scenes.corner_uv(obj.data, name).copy() for name in names]
    assert not np.array_equal(uv[0], uv[1]) and not np.array_equal(uv[0], uv[2])
    assert np.array_equal(uniformized(obj), uv[0])


def test_a_key_is_mapped_as_it_is_at_value_one():
    obj = add_keyed()
    obj.data.shape_keys.key_blocks["Smile"].value = 0.3  # does not count, nor does that it is muted
    obj.data.shape_keys.key_blocks["Smile"].mute = True
    unwrap(source="SHAPE_KEYS", target="LAYERS")
    found = scenes.corner_uv(obj.data, "Koebe Smile").astype(float)
    places = scenes.read(obj.data.shape_keys.key_blocks["Smile"].data, "co", np.float32, 3)
    vertices, faces = scenes.panel_arrays()
    alone = uniformized(scenes.add_object("Alone", places, faces), upright=False).astype(float)
    # The same disk but for a Möbius map: cross ratios of points far apart are alike.
    assert len(vertices) == len(places)
    picked = np.random.default_rng(3).integers(0, len(found), (200, 4))
    one, other = (cross_ratios(uv[:, 0] + 1j * uv[:, 1], picked) for uv in (found, alone))
    assert np.median(np.abs(one - other) / np.abs(other)) < 1e-3
    basis = scenes.corner_uv(obj.data, "Koebe Basis").astype(float)
    assert np.median(np.abs(cross_ratios(basis @ (1, 1j), picked) - other) / np.abs(other)) > 1e-2


def cross_ratios(z, picked):
    a, b, c, d = z[picked].T
    with np.errstate(all="ignore"):
        ratio = (a - b) * (c - d) / ((a - d) * (c - b))
    return np.where(np.isfinite(ratio) & (np.abs(ratio) < 1e3) & (np.abs(ratio) > 1e-3), ratio, 1.0)


def test_a_shape_that_comes_back_lies_where_it_was():
    obj = add_keyed()
    block = obj.shape_key_add(name="Again")
    block.data.foreach_set("co", scenes.read(obj.data.vertices, "co", np.float32, 3).ravel())
    unwrap(source="SHAPE_KEYS", target="LAYERS")
    uv = [scenes.corner_uv(obj.data, f"Koebe {name}") for name in ("Basis", "Again")]
    assert np.abs(uv[0] - uv[1]).max() < 1e-3  # perhaps on the last shape's triangles, which are nearly Delaunay


def test_maps_lie_over_the_first_whichever_way_the_shape_is_turned():
    """The last key is the basis, turned in space: alone it would be turned in the UVs, as Upright goes by space."""
    obj = add_keyed()
    block = obj.shape_key_add(name="Turned")
    for point, vertex in zip(block.data, obj.data.vertices):
        point.co = (vertex.co.y, vertex.co.z, vertex.co.x)
    unwrap(source="SHAPE_KEYS", target="LAYERS")
    uv = {name: scenes.corner_uv(obj.data, f"Koebe {name}") for name in ("Basis", "Turned", "Smile")}
    assert np.abs(uv["Turned"] - uv["Basis"]).max() < 1e-3
    assert np.abs(uv["Smile"] - uv["Basis"]).max() < 0.2


def test_no_keys_are_told():
    scenes.add_panel()
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Panel: it has no shape keys"):
        unwrap(source="SHAPE_KEYS")
    assert unchanged(before)


# ---------------------------------------------------------------- frames


def test_frames_become_attributes_of_points_and_the_scene_stays_in_its_frame():
    obj = add_waving()
    before = scenes.mesh_state(obj.data)
    assert unwrap(play=False) == {"FINISHED"}
    assert bpy.context.scene.frame_current == 7 and scenes.mesh_state(obj.data) == before
    names = [f"Koebe_000{frame}" for frame in (1, 2, 3, 4)]
    assert not obj.data.uv_layers and all(
        (obj.data.attributes[name].domain, obj.data.attributes[name].data_type) == ("POINT", "FLOAT_VECTOR")
        for name in names
    )
    values = [vectors(obj, name) for name in names]
    assert all((one[:, 2] == 0.0).all() and one.min() >= 0.0 and one.max() <= 1.0 for one in values)
    corner = scenes.read(obj.data.loops, "vertex_index", np.int32)
    assert np.array_equal(values[0][corner, :2], uniformized(applied(obj, 1)))
    for one, two in zip(values, values[1:]):
        assert 1e-5 < np.abs(one - two).max() < 0.1  # it moves, and stays in its place


def test_a_driver_and_an_animated_scale_count():
    obj = add_keyed()
    driver = obj.data.shape_keys.key_blocks["Smile"].driver_add("value").driver
    driver.expression = "frame / 10"
    for frame, scale in ((1, 1.0), (5, 2.0)):
        obj.scale.x = scale
        obj.keyframe_insert("scale", frame=frame)
    assert unwrap(frame_start=5, frame_end=10, frame_step=5, target="LAYERS") == {"FINISHED"}
    assert [layer.name for layer in obj.data.uv_layers] == ["Koebe 0005", "Koebe 0010"]
    copy = applied(obj, 5)
    copy.scale = (2.0, 1.0, 1.0)
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe 0005"), uniformized(copy))
    assert np.abs(scenes.corner_uv(obj.data, "Koebe 0005") - scenes.corner_uv(obj.data, "Koebe 0010")).max() > 1e-3


@pytest.mark.parametrize("kind", ["DECIMATE", "SUBSURF", "MASK", "TRIANGULATE", "EDGE_SPLIT"])
def test_a_modifier_that_makes_other_faces_is_told_with_its_frame(kind):
    obj = add_waving()
    made = obj.modifiers.new("Changes", kind)
    if kind == "DECIMATE":
        made.ratio = 0.5
    elif kind == "EDGE_SPLIT":
        made.split_angle = 0.0
    elif kind == "MASK":
        made.vertex_group = obj.vertex_groups.new(name="Some").name
    made.show_viewport = False
    for frame, shown in ((1, False), (3, True)):
        made.show_viewport = shown
        made.keyframe_insert("show_viewport", frame=frame)
    bpy.context.scene.frame_set(7)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Panel: in frame 3 it has other faces .*'Changes'"):
        unwrap()
    assert unchanged(before) and bpy.context.scene.frame_current == 7


def test_quads_are_cut_as_blender_cuts_them_in_the_first_frame():
    """A face that is bent the other way is cut along its other diagonal."""
    obj = scenes.add_panel()
    obj.shape_key_add(name="Basis")
    places = scenes.read(obj.data.vertices, "co", np.float32, 3)
    places[1::2, 2] += 0.05
    obj.shape_key_add(name="Rough").data.foreach_set("co", places.ravel())
    obj.data.shape_keys.key_blocks["Rough"].value = 1.0
    assert unwrap(frame_start=1, frame_end=2, target="LAYERS") == {"FINISHED"}
    copy = applied(obj, 1)
    assert not np.array_equal(scenes.triangles(copy.data)[1], scenes.triangles(obj.data)[1])
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe 0001"), uniformized(copy))


def test_a_subframe_comes_back():
    add_waving()
    bpy.context.scene.frame_set(5, subframe=0.25)
    unwrap()
    assert (bpy.context.scene.frame_current, bpy.context.scene.frame_subframe) == (5, 0.25)


def test_a_frame_without_a_map_is_told_and_nothing_is_written():
    obj = add_keyed()
    for point in obj.data.shape_keys.key_blocks["Frown"].data:
        point.co.y = point.co.z = 0.0
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Panel, key 'Frown': .*collapsed"):
        unwrap(source="SHAPE_KEYS")
    assert unchanged(before)
    (entry,) = entries()
    assert not entry.mapped and "key 'Frown'" in entry.message


@pytest.mark.alike
def test_frames_that_do_not_converge_are_told(capfd):
    add_keyed()
    assert unwrap(source="SHAPE_KEYS", max_sweeps=1) == {"FINISHED"}
    assert "NOT CONVERGED: key 'Basis', key 'Smile', key 'Frown'" in capfd.readouterr().out
    assert not any(entry.converged for entry in entries())


def test_the_last_frame_before_the_first_is_refused():
    add_waving()
    with pytest.raises(RuntimeError, match="the last frame is before the first one"):
        unwrap(frame_start=3, frame_end=2)


# ---------------------------------------------------------------- what is written


def test_more_layers_than_blender_allows_are_refused_before_anything_is_computed():
    obj = add_waving()
    obj.data.uv_layers.new(name="Own")
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="8 new UV layers .* room for 7, as Blender allows 8: .* Attributes"):
        unwrap(frame_end=8, target="LAYERS")
    assert unchanged(before)
    assert unwrap(frame_end=7, target="LAYERS") == {"FINISHED"} and len(obj.data.uv_layers) == 8
    assert unwrap(frame_end=7, target="LAYERS") == {"FINISHED"}  # those are there now
    assert unwrap(frame_end=12, target="ATTRIBUTE") == {"FINISHED"} and len(obj.data.uv_layers) == 8


def test_where_seams_cut_the_attribute_is_of_corners():
    obj = add_keyed()
    assert unwrap(source="SHAPE_KEYS") == {"FINISHED"}
    assert obj.data.attributes["Koebe_Smile"].domain == "POINT"
    for edge in obj.data.edges:
        edge.use_seam = abs(sum(obj.data.vertices[v].co.x for v in edge.vertices)) < 0.02
    assert unwrap(source="SHAPE_KEYS") == {"FINISHED"}
    assert obj.data.attributes["Koebe_Smile"].domain == "CORNER"
    assert sum(one.name.startswith("Koebe_Smile") for one in obj.data.attributes) == 1
    assert len(entries()) > len(KEYS) + 1  # more than one island
    assert np.array_equal(vectors(obj, "Koebe_Basis")[:, :2], uniformized(obj))


def test_a_closed_surface_is_cut_alike_in_all_shapes():
    obj = scenes.add_cube()
    edited = obj.modifiers.new("Finer", "SUBSURF")
    edited.levels = 3
    scenes.select(obj)
    bpy.ops.object.modifier_apply(modifier="Finer")
    obj.shape_key_add(name="Basis")
    for point in obj.shape_key_add(name="Long").data:
        point.co.z *= 1.5
    assert unwrap(source="SHAPE_KEYS", target="LAYERS") == {"FINISHED"}
    for name in ("Koebe Basis", "Koebe Long"):
        assert (scenes.signed_areas(obj.data, name) > 0.0).all()
    corner = [scenes.corner_uv(obj.data, f"Koebe {name}") for name in ("Basis", "Long")]
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    split = [{v for v in vertex if len(np.unique(uv[vertex == v], axis=0)) > 1} for uv in corner]
    assert split[0] == split[1] and split[0]
    with pytest.raises(RuntimeError, match="closed"):
        unwrap(source="SHAPE_KEYS", cut=False)


def test_a_name_that_is_taken_is_refused():
    obj = add_keyed()
    obj.data.attributes.new("Koebe_Frown", "FLOAT", "POINT")
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="'Koebe_Frown' is taken by something else"):
        unwrap(source="SHAPE_KEYS")
    assert unchanged(before)


def test_a_name_that_is_too_long_is_refused():
    add_keyed()
    with pytest.raises(RuntimeError, match="longer than 63 bytes"):
        unwrap(source="SHAPE_KEYS", layer="L" * 60)


def test_an_attribute_that_cannot_be_written_leaves_none(addon, monkeypatch):
    obj = add_keyed()
    unwrap(source="SHAPE_KEYS", upright=False)
    old = fingerprint.fingerprint()
    module = addon("blender.vector_attribute")
    write = module.write

    def failing(run, written, values):
        if values.name.endswith("Frown"):
            raise MemoryError("no more")
        write(run, written, values)

    monkeypatch.setattr(module, "write", failing)
    with pytest.raises(RuntimeError, match="no more"):
        unwrap(source="SHAPE_KEYS", layer="Koebe", margin=0.1, balance="none")
    assert unchanged(old)
    with pytest.raises(RuntimeError, match="no more"):
        unwrap(source="SHAPE_KEYS", layer="Other")
    assert unchanged(old) and "Other_Basis" not in obj.data.attributes


@pytest.mark.parametrize("source", ["FRAMES", "SHAPE_KEYS"])
@pytest.mark.parametrize("target", ["ATTRIBUTE", "LAYERS"])
def test_in_edit_mode_the_selected_faces(source, target):
    obj = add_keyed()
    for frame in (1, 2):
        obj.data.shape_keys.key_blocks["Smile"].value = frame - 1.0
        obj.data.shape_keys.key_blocks["Smile"].keyframe_insert("value", frame=frame)
    chosen = range(0, 180)
    scenes.select_faces(obj, chosen)
    assert unwrap(source=source, target=target, frame_start=1, frame_end=2) == {"FINISHED"}
    assert obj.mode == "EDIT" and bpy.context.mode == "EDIT_MESH"
    bpy.ops.object.mode_set(mode="OBJECT")
    end = "0002" if source == "FRAMES" else "Smile"
    if target == "LAYERS":
        values = scenes.corner_uv(obj.data, f"Koebe {end}")
    else:
        values = vectors(obj, f"Koebe_{end}")
        values = values[scenes.read(obj.data.loops, "vertex_index", np.int32)]
    written = np.array([np.ptp(values[list(face.loop_indices)], axis=0).max() > 0.0 for face in obj.data.polygons])
    assert written[:180].all() and not written[300:].any()
    assert [face.select for face in obj.data.polygons] == [index in chosen for index in range(len(written))]


def played(obj, name="Koebe"):
    """UVs of the corners as the modifiers leave them: in 3.4 nodes store vectors in the place of a UV layer."""
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    if name in mesh.uv_layers:
        return scenes.corner_uv(mesh, name).copy()
    return scenes.read(mesh.attributes[name].data, "vector", np.float32, 3)[:, :2].copy()


@pytest.mark.parametrize("start, step", [(1, 1), (-3, 3), (9998, 1)])
def test_a_modifier_plays_the_frames(start, step):
    obj = add_waving()
    obj.modifiers["Wave"].time_offset = start - 20.0
    assert unwrap(frame_start=start, frame_end=start + 3 * step, frame_step=step) == {"FINISHED"}
    assert unwrap(frame_start=start, frame_end=start + 3 * step, frame_step=step, layer="Other") == {"FINISHED"}
    assert len([one for one in obj.modifiers if one.type == "NODES"]) == 1  # that of the last run
    corner = scenes.read(obj.data.loops, "vertex_index", np.int32)
    shown = []
    for frame in range(start - 1, start + 3 * step + 2):
        bpy.context.scene.frame_set(frame)
        last = start + step * min(max((frame - start) // step, 0), 3)
        shown.append(played(obj, "Other"))
        assert np.array_equal(shown[-1], vectors(obj, f"Other_{last:04d}")[corner, :2])
    assert not np.array_equal(shown[0], shown[-1])
    assert np.array_equal(scenes.corner_uv(obj.data, "Other"), vectors(obj, f"Other_{start:04d}")[corner, :2])


def test_faces_that_are_not_mapped_keep_their_uvs_while_it_plays():
    obj = add_waving()
    assert bpy.ops.uv.koebe_uniformize(checker=False) == {"FINISHED"}
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    scenes.select_faces(obj, range(0, 180))
    assert unwrap() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.scene.frame_set(3)
    kept = np.concatenate([list(face.loop_indices) for face in obj.data.polygons[300:]])
    now = played(obj)
    assert np.array_equal(now[kept], before[kept])
    assert np.abs(now - before).max() > 1e-3


@pytest.mark.parametrize("moves", [False, True])
def test_where_nothing_changes_one_map_is_written_and_that_is_said(capfd, moves):
    obj = add_waving(modifier=False)
    if moves:  # as a whole
        for frame in (1, 4):
            obj.location.x, obj.rotation_euler.y = frame, 0.3 * frame
            obj.scale = [frame] * 3
            for path in ("location", "rotation_euler", "scale"):
                obj.keyframe_insert(path, frame=frame)
        bpy.context.scene.frame_set(7)
    assert unwrap() == {"FINISHED"}
    assert "nothing moves" in capfd.readouterr().out
    assert "nothing moves" in entries()[0].message and entries()[0].layer == "Koebe"
    assert [one.name for one in obj.data.attributes if one.name.startswith("Koebe_")] == ["Koebe_0001"]
    assert not obj.modifiers and len(entries()) == 1
    corner = scenes.read(obj.data.loops, "vertex_index", np.int32)
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), vectors(obj, "Koebe_0001")[corner, :2])


def test_the_uv_editor_draws_the_present_frame(addon):
    """Its outlines and circles. Here they are as the panel has holes: a rim and three holes in each frame."""
    obj = add_waving()
    assert unwrap(frame_start=-2, frame_end=4, frame_step=2) == {"FINISHED"}
    player, outlines = addon("blender.sequence_player"), addon("ui.outline_overlay")
    corner, seen = scenes.read(obj.data.loops, "vertex_index", np.int32), []
    for frame in (-5, -2, -1, 0, 3, 4, 9):
        bpy.context.scene.frame_set(frame)
        attribute = player.attribute_shown(obj, "Koebe", frame)
        ends, uv = outlines.outlines_of(obj, "Koebe", attribute)
        assert np.array_equal(uv, played(obj)[ends]) and len(uv) > 40
        (entry,) = addon("ui.circle_overlay").visible_islands(bpy.context)
        assert np.array_equal(uv, vectors(obj, attribute)[corner, :2][ends])
        assert entry.shape == f"frame {min(max(frame - frame % 2, -2), 4)}" and len(entry.loops) == 4
        for loop in entry.loops:  # every circle goes through points of the outlines
            off = np.abs(np.linalg.norm(uv - np.array(loop.uv_center[:]), axis=2) - loop.uv_radius)
            assert off.min() < 1e-3 * loop.uv_radius
        seen.append(attribute)
    assert len(set(seen)) == 4
    assert player.attribute_shown(obj, "Other", 0) is None
    obj.modifiers["Koebe Sequence"].show_viewport = False
    assert player.attribute_shown(obj, "Koebe", 0) is None


def test_the_checker_is_of_the_layer_that_plays(capfd):
    obj = add_waving()
    assert unwrap(checker=False) == {"FINISHED"} and not obj.material_slots
    obj.modifiers["Koebe Sequence"].show_viewport = obj.modifiers["Koebe Sequence"].show_render = False
    assert unwrap() == {"FINISHED"}
    assert obj.modifiers["Koebe Sequence"].show_viewport and obj.modifiers["Koebe Sequence"].show_render
    assert "play the timeline" in capfd.readouterr().out and "play the timeline" in entries()[0].note
    nodes = obj.material_slots[0].material.node_tree.nodes
    assert [node.uv_map for node in nodes if node.type == "UVMAP"] == ["Koebe"]
    assert unwrap(target="LAYERS") == {"FINISHED"}
    nodes = obj.material_slots[0].material.node_tree.nodes
    assert [node.uv_map for node in nodes if node.type == "UVMAP"] == ["Koebe 0001"]


def test_one_frame_alone_is_said(capfd):
    add_waving()
    assert unwrap(frame_start=2, frame_end=2) == {"FINISHED"}
    assert "nothing moves" in capfd.readouterr().out and "nothing moves" in entries()[0].message


def test_a_map_that_the_modifier_hides_is_said(capfd):
    add_waving()
    unwrap()
    bpy.ops.uv.koebe_uniformize()
    assert "its modifier 'Koebe Sequence' hides this map" in capfd.readouterr().out


# ---------------------------------------------------------------- around it


def test_the_report_has_an_entry_for_each_shape():
    add_keyed()
    unwrap(source="SHAPE_KEYS", target="LAYERS")
    found = entries()
    assert [entry.shape for entry in found] == ["key 'Basis'", "key 'Smile'", "key 'Frown'"]
    assert [entry.layer for entry in found] == ["Koebe Basis", "Koebe Smile", "Koebe Frown"]
    for entry in found:
        assert entry.mapped and entry.converged and entry.flipped == 0 and entry.sweeps > 0 and entry.angle_error > 0
        assert "3 maps, angle error " in entry.note and "0 flips" in entry.note and len(entry.loops) == 4


def test_a_cancel_leaves_everything_as_it_was(addon, koebe, monkeypatch):
    """Esc, as the modal operator hears it: while frames are read, and while they are mapped."""
    obj = add_waving()
    job_of, choice = addon("jobs.sequence_job").SequenceJob, addon("maps.options").SequenceChoice
    before = fingerprint.fingerprint()
    options = addon("maps.options").Options(checker=False)
    job = job_of([obj], options, choice(frames=range(1, 5)))
    reading = job.read_shapes(bpy.context)
    assert next(reading) == 0.25 and bpy.context.scene.frame_current == 1
    reading.close()
    assert bpy.context.scene.frame_current == 7 and unchanged(before)
    job = job_of([obj], options, choice(frames=range(1, 5)))
    assert [*job.read_shapes(bpy.context)] == [0.25, 0.5, 0.75, 1.0]

    def stop(fraction, stage):
        if stage == "mapping frame 3":
            job.cancel_token.cancel()

    with pytest.raises(koebe.Cancelled):
        job.compute(stop)
    assert unchanged(before)


@pytest.mark.alike
def test_fifty_random_keys_never_flip():
    obj = scenes.add_panel(size=20)
    obj.shape_key_add(name="Basis")
    random = np.random.default_rng(19)
    for number in range(50):
        block = obj.shape_key_add(name=f"Random {number}")
        places = scenes.read(block.data, "co", np.float32, 3)
        for _ in range(4):
            wave, phase = random.normal(size=3) * 2.0, random.uniform(0.0, 6.0)
            places += np.outer(np.sin(places @ wave + phase), random.normal(size=3) * 0.15).astype(np.float32)
        block.data.foreach_set("co", places.ravel())
    assert unwrap(source="SHAPE_KEYS") == {"FINISHED"}
    found = entries()
    assert len(found) == 51 and all(entry.mapped and entry.flipped == 0 for entry in found)
    _, corners = scenes.triangles(obj.data)
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    for number in range(50):
        a, b, c = np.moveaxis(vectors(obj, f"Koebe_Random {number}")[vertex[corners], :2].astype(float), 1, 0)
        one, two = b - a, c - a
        assert (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0] > 0.0).all(), number


def test_hidden_objects_are_refused_with_the_reason(addon):
    obj = add_waving()
    obj.hide_set(True)
    job_of, choice = addon("jobs.sequence_job").SequenceJob, addon("maps.options").SequenceChoice
    with pytest.raises(addon("blender.errors").TransferError, match="it is hidden, so Blender does not animate it"):
        job_of([obj], addon("maps.options").Options(checker=False), choice(frames=range(1, 5)))


def test_options_without_room(addon):
    options = addon("maps.options")
    for values in ({"source": "ELSE"}, {"target": "ELSE"}, {"frames": range(3, 1)}):
        with pytest.raises(options.OptionError, match=next(iter(values))):
            options.SequenceChoice(**values)
