"""Shapes: the module of the active object, distances, and one texture carried to another surface."""

import cmath
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes

FOLDER = Path(__file__).resolve().parents[2] / "blend_samples"

SAME = 1e-5  # UV units, between two runs whose vertices differ by 32-bit rounding
OTHER_HOLES = ((0.03, 0.20, 0.35, 0.65), (0.30, 0.45, 0.30, 0.70), (0.66, 0.86, 0.40, 0.62))


def shapes():
    """What the operators leave for the panel."""
    return bpy.context.window_manager.koebe_shapes


AS_MEASURED = {"checker": False, "balance": "none", "outer": "longest"}  # as shapes are mapped


def pair(size=26, holes=scenes.HOLES, target_size=None, target_holes=None, **options):
    """A mapped panel and a second one, both selected, the first one active."""
    source = scenes.add_panel("Source", size=size, holes=holes)
    bpy.ops.uv.koebe_uniformize(**{**AS_MEASURED, **options})
    target = scenes.add_panel("Target", size=target_size or size, holes=holes if target_holes is None else target_holes)
    scenes.select(source, target)
    return source, target


def circles(obj, layer="Koebe"):
    """Centres and radii of the loops in the UVs, by the place of their vertices on the surface: rim first."""
    found = []
    for loop in scenes.boundary_loops(obj.data):
        (x, y), radius, _ = scenes.fit_circle(scenes.loop_uv(obj.data, layer, loop))
        places = np.array([obj.data.vertices[v].co[:2] for v in loop])
        is_hole = np.linalg.norm(places, axis=1).min() < 0.99
        middle = places.mean(axis=0)
        found.append((is_hole, np.arctan2(middle[1], middle[0]) % (2 * np.pi), x, y, radius))
    return np.array(sorted(found))[:, 2:]


def set_uv(obj, uv, layer="Koebe"):
    obj.data.uv_layers[layer].data.foreach_set("uv", np.float32(uv).ravel())


# ---------------------------------------------------------------- comparing


@pytest.mark.alike
def test_the_same_shape_is_near_and_another_far_and_nothing_is_changed():
    one, moved, other = scenes.add_panel("One"), scenes.add_panel("Moved"), scenes.add_panel("Other", holes=OTHER_HOLES)
    moved.location, moved.rotation_euler, moved.scale = (4, 5, 6), (1.0, 0.3, -0.7), (2.5, 2.5, 2.5)
    scenes.select(one, moved, other)
    before = [scenes.mesh_state(obj.data) for obj in (one, moved, other)]
    assert bpy.ops.uv.koebe_compare_shapes() == {"FINISHED"}
    assert [scenes.mesh_state(obj.data) for obj in (one, moved, other)] == before
    assert shapes().source == "One"
    found = {entry.name: entry.distance for entry in shapes().others}
    assert found["Moved"] < 1e-5 and found["Other"] > 0.01


@pytest.mark.alike
def test_the_module_is_that_of_the_native_package(koebe):
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_compare_shapes()
    result = koebe.uniformize(
        scenes.read(obj.data.vertices, "co", np.float32, 3), scenes.triangles(obj.data)[0], outer="longest"
    )
    assert [number.name for number in shapes().module] == ["r_1", "y_2", "r_2", "x_3", "y_3", "r_3"]
    values = [number.value for number in shapes().module]
    assert values == pytest.approx(koebe.conformal_module(result).tolist(), abs=1e-6)


@pytest.mark.alike
def test_what_has_no_distance_says_why():
    one, two = scenes.add_panel("One"), scenes.add_panel("Two", holes=scenes.HOLES[:2])
    closed = scenes.add_cube("Closed")
    scenes.select(one, two, closed)
    assert bpy.ops.uv.koebe_compare_shapes() == {"FINISHED"}
    found = {entry.name: entry for entry in shapes().others}
    assert not found["Two"].measured and found["Two"].message == "3 loops, not 4"
    assert not found["Closed"].measured and "closed" in found["Closed"].message
    scenes.select(closed, one)
    with pytest.raises(RuntimeError, match="closed"):
        bpy.ops.uv.koebe_compare_shapes()


# ---------------------------------------------------------------- carrying


@pytest.mark.alike
def test_the_same_surface_gets_the_same_uvs():
    source, target = pair()
    target.location, target.scale = (5, 0, 1), (2, 2, 2)
    before = scenes.mesh_state(source.data), scenes.corner_uv(source.data, "Koebe").copy()
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    given = scenes.corner_uv(source.data, "Koebe")
    assert scenes.mesh_state(source.data) == before[0] and np.array_equal(given, before[1])
    assert np.abs(scenes.corner_uv(target.data, "Koebe") - given).max() < SAME
    assert target.data.uv_layers.active.name == "Koebe" and shapes().carried[0].distance < SAME


@pytest.mark.alike
def test_on_a_balanced_source_it_is_the_same_up_to_the_meshs_resolution():
    apart = []
    for size in (26, 52):
        source, target = pair(size, balance="area")
        bpy.ops.uv.koebe_carry_texture()
        apart.append(np.abs(scenes.corner_uv(target.data, "Koebe") - scenes.corner_uv(source.data, "Koebe")).max())
        bpy.data.objects.remove(source)
        bpy.data.objects.remove(target)
    assert apart[0] < 1e-2 and apart[1] < apart[0] / 2.0


@pytest.mark.alike
@pytest.mark.parametrize("fit_holes", [False, True])
def test_the_reported_residual_is_how_far_the_holes_are_apart(fit_holes):
    source, target = pair(target_holes=OTHER_HOLES)
    before = scenes.mesh_state(target.data)
    assert bpy.ops.uv.koebe_carry_texture(fit_holes=fit_holes) == {"FINISHED"}
    assert scenes.mesh_state(target.data, but_layer="Koebe") == before
    apart = circles(source) - circles(target)
    assert np.abs(apart[0]).max() < SAME  # the rims
    residual = np.sqrt((apart[1:] ** 2).sum(axis=1).mean())
    assert shapes().carried[0].distance > 0.005
    assert residual == pytest.approx(0.0 if fit_holes else shapes().carried[0].distance, abs=SAME)
    assert (scenes.signed_areas(target.data, "Koebe") > 0.0).all()


@pytest.mark.alike
def test_aligned_holes_are_circles_and_no_turn_would_fit_better():
    source, target = pair(target_holes=OTHER_HOLES)
    bpy.ops.uv.koebe_carry_texture()
    scenes.assert_circle_domain(target)
    mine, given = circles(target) - [0.5, 0.5, 0.0], circles(source) - [0.5, 0.5, 0.0]

    def squares(turn):
        z = (mine[1:, 0] + 1j * mine[1:, 1]) * cmath.exp(1j * turn)
        return (np.abs(z - given[1:, 0] - 1j * given[1:, 1]) ** 2).sum()

    assert squares(0.0) <= min(squares(0.01), squares(-0.01))


@pytest.mark.alike
def test_the_source_may_lie_anywhere_in_its_layer_with_any_loop_outside():
    source, target = pair(52)
    x, y, radius = circles(source)[1]
    z = scenes.corner_uv(source.data, "Koebe").astype(float) @ [1.0, 1j]
    w = 0.3 + 0.4j + 0.2 * cmath.exp(0.5j) * radius / (z - x - 1j * y)  # the first hole is the rim
    set_uv(source, np.column_stack([w.real, w.imag]))
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    given, uv = scenes.corner_uv(source.data, "Koebe"), scenes.corner_uv(target.data, "Koebe")
    # The target is mapped anew with that loop outside: the same up to the mesh's resolution, worst at holes' corners.
    assert np.abs(uv - given).mean() < 1e-3
    assert shapes().carried[0].distance < 1e-3


@pytest.mark.alike
@pytest.mark.parametrize("holes", [(), scenes.HOLES[:1]])
def test_with_fewer_than_two_holes_up_stays_up(holes):
    source, target = pair(holes=holes, balance="none" if holes else "area")
    target.scale = (3, 3, 3)
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    assert np.abs(scenes.corner_uv(target.data, "Koebe") - scenes.corner_uv(source.data, "Koebe")).max() < SAME


@pytest.mark.alike
def test_a_mesh_with_other_triangles_is_fitted_too():
    source, target = pair(target_size=40)
    bpy.ops.uv.koebe_carry_texture()
    assert 0.0 < shapes().carried[0].distance < 0.05
    scenes.assert_circle_domain(target)


def test_material_goes_to_those_that_have_none():
    source, bare = pair()
    clothed = scenes.add_panel("Clothed")
    paint, own = bpy.data.materials.new("Paint"), bpy.data.materials.new("Own")
    source.data.materials.append(paint)
    clothed.data.materials.append(own)
    scenes.select(source, bare, clothed)
    bpy.ops.uv.koebe_carry_texture(material=False)
    assert list(bare.data.materials) == []
    bpy.ops.uv.koebe_carry_texture()
    assert list(bare.data.materials) == [paint] and list(clothed.data.materials) == [own]


def test_the_report_and_its_circles_follow():
    source, target = scenes.add_panel("Source"), scenes.add_panel("Target", holes=OTHER_HOLES)
    scenes.select(source, target)
    bpy.ops.uv.koebe_uniformize(checker=False)
    before = bpy.context.window_manager.koebe_uv.islands[0].angle_error
    bpy.ops.uv.koebe_carry_texture(fit_holes=True)
    mine, entry = bpy.context.window_manager.koebe_uv.islands
    assert mine.angle_error == before and entry.angle_error > before and entry.flipped == 0
    found = np.array(sorted([*loop.uv_center, loop.uv_radius] for loop in entry.loops))
    assert found == pytest.approx(np.array(sorted(circles(target).tolist())), abs=SAME)


def test_undo_takes_the_layer_away_again():
    source, target = pair()
    before = scenes.mesh_state(target.data)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.uv.koebe_carry_texture("EXEC_DEFAULT", True)
    assert "Koebe" in bpy.data.objects["Target"].data.uv_layers
    bpy.ops.ed.undo()
    target = bpy.data.objects["Target"]
    assert scenes.mesh_state(target.data) == before and len(target.data.uv_layers) == 0


def test_the_two_faces_of_the_samples_share_a_texture():
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / "face_five_holes.blend"))
    source = bpy.data.objects["face_five_holes"]
    with bpy.data.libraries.load(str(FOLDER / "face_surprised.blend")) as (_, loaded):
        loaded.objects = ["face_surprised"]
    (target,) = loaded.objects
    bpy.context.collection.objects.link(target)
    scenes.select(source)
    bpy.ops.uv.koebe_uniformize(checker=False)
    scenes.select(source, target)
    bpy.ops.uv.koebe_compare_shapes()
    assert shapes().others[0].distance == pytest.approx(0.069, abs=0.003)
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    assert shapes().carried[0].distance < 0.015
    scenes.assert_circle_domain(target, holes=5)


# ---------------------------------------------------------------- refusing


def refused(message, *targets):
    """The operator fails with this message and leaves the targets as they are."""
    before = [(scenes.mesh_state(obj.data), len(obj.data.uv_layers), list(obj.data.materials)) for obj in targets]
    with pytest.raises(RuntimeError, match=message):
        bpy.ops.uv.koebe_carry_texture()
    after = [(scenes.mesh_state(obj.data), len(obj.data.uv_layers), list(obj.data.materials)) for obj in targets]
    assert after == before


def test_a_source_without_a_circle_domain_is_refused():
    source, target = pair()
    uv = scenes.corner_uv(source.data, "Koebe").copy()
    set_uv(source, uv * [1.0, 0.8])
    refused("not a disk with round holes", target)
    cut = uv.copy()
    cut[:40] += 0.2
    set_uv(source, cut)
    refused("are cut", target)
    source.data.uv_layers.remove(source.data.uv_layers["Koebe"])
    refused("no UV layer 'Koebe'", target)


def test_targets_that_cannot_be_used_are_named_and_left_alone():
    source, good = pair()
    fewer, closed = scenes.add_panel("Fewer", holes=scenes.HOLES[:2]), scenes.add_cube("Closed")
    scenes.select(source, fewer)
    refused("Fewer: it has 3 loops, not 4", fewer)
    scenes.select(source, closed)
    refused("Closed: the surface is closed", closed)
    scenes.select(source, fewer, good)
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    assert "Koebe" in good.data.uv_layers and len(fewer.data.uv_layers) == 0


def test_a_target_that_cannot_be_written_is_left_alone_and_the_others_are_done():
    source, target = pair()
    full = scenes.add_panel("Full")
    for index in range(8):
        full.data.uv_layers.new(name=f"Layer {index}")
    scenes.select(source, full)
    refused("8 UV layers", full)
    before = scenes.mesh_state(full.data)
    scenes.select(source, target, full)
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    assert "Koebe" in target.data.uv_layers and scenes.mesh_state(full.data) == before


def test_it_wants_two_surfaces_in_object_mode():
    source, target = pair()
    scenes.select(source)
    assert not bpy.ops.uv.koebe_carry_texture.poll()
    twin = bpy.data.objects.new("Twin", source.data)
    bpy.context.collection.objects.link(twin)
    scenes.select(source, twin)
    refused("select another surface too")
    scenes.select(source, target)
    bpy.ops.object.mode_set(mode="EDIT")
    assert not bpy.ops.uv.koebe_carry_texture.poll() and not bpy.ops.uv.koebe_compare_shapes.poll()


def test_a_failure_while_computing_leaves_everything(koebe, monkeypatch):
    source, target = pair()

    def broken(*arguments, **options):
        raise koebe.SolverError("out of luck")

    monkeypatch.setattr(koebe, "uniformize", broken)
    refused("out of luck", target)


def test_everything_has_a_tooltip_that_teaches():
    for operator in (bpy.ops.uv.koebe_carry_texture, bpy.ops.uv.koebe_compare_shapes):
        kind = operator.get_rna_type()
        assert len(kind.description) > 40
        for prop in kind.properties:
            assert prop.identifier == "rna_type" or len(prop.description) > 20
