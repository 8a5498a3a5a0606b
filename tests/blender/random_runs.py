"""Random files, random acts of an artist, and random calls of the operators, all from one number."""

import bmesh
import bpy
import faults
import fingerprint
import numpy as np
import scenes
import states
from runs import operator
from tori import torus_arrays
from touched import Touched
from wild import wild

NOT_UNDONE = ("file: report", "file: shapes")
LAYERS = ("Koebe", "Koebe", "Koebe", "Koebe", "First", "Other", "uv_seam", "Own 0")
ERRORS = (KeyboardInterrupt, ValueError, MemoryError, RuntimeError)


def closed(name="Closed"):
    return scenes.add_cube(name)


def lone(name="Lone"):
    return scenes.add_object(name, [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])


def collapsed(name="Collapsed"):
    obj = states.plain(name)
    obj.scale = (1.0, 0.0, 0.0)
    return obj


def bare(name="Bare"):
    return scenes.add_object(name, [(0, 0, 0), (1, 0, 0)], [])


def ring(name="Ring"):
    """A tube, to be unrolled."""
    vertices, faces = scenes.panel_arrays(12, holes=((0.0, 1.0, 0.2, 0.5),), height=lambda x, y: 0 * x)
    inner = [face for face in faces if 0 not in face]
    return scenes.add_object(name, *_used(vertices, inner))


def donut(name="Donut"):
    """A torus, maybe to be a tile."""
    vertices, faces = torus_arrays(8, 6, holes=((2, 3),))
    return scenes.add_object(name, vertices, faces)


def _used(vertices, faces):
    used, index = np.unique(np.concatenate(faces), return_inverse=True)
    return vertices[used], [part.tolist() for part in np.split(index, np.cumsum([len(face) for face in faces])[:-1])]


MAKERS = (
    states.plain, states.dressed, states.numbered, states.layered, states.keyed, states.named, states.twins,
    states.full, states.broken, closed, lone, collapsed, bare, ring, donut,
)  # fmt: skip


def of_the_window(name):
    """Whether that belongs to the window, which no undo changes: reports, and what the screens show. Of an edited mesh
    Blender's undo knows the window's select mode only."""
    return name in NOT_UNDONE or name.endswith(": select mode") or (
        name.startswith("file: ") and name.endswith((" shading", " custom", " select mode"))
    )


class RandomRun:
    """One sequence: a file, then calls with acts between them. `wrong` says what changed that must not."""

    def __init__(self, folder, scratch, seed):
        """@param folder the add-on's, @param scratch a Path for files"""
        self._folder, self._scratch, self._random = folder, scratch, np.random.default_rng(seed)
        self.wrong, self.calls, self.finished, self.faults = [], 0, 0, 0

    def go(self, calls):
        """Build the file, and do so many calls."""
        states.new_file()
        for maker in self._random.permutation(len(MAKERS))[: self._random.integers(2, 6)]:
            MAKERS[maker]()
        for number in range(self._random.integers(0, 4)):
            wild(self._random, f"Wild {number}")
        if self._random.random() < 0.3:
            self._link()
        states.consistent(self._meshes())
        scenes.select(*self._some(self._meshes()))
        for _ in range(calls):
            for _ in range(self._random.integers(0, 3)):
                self._act()
            self._call()

    # ---------------------------------------------------------------- chances

    def _one(self, items):
        items = list(items)
        return items[self._random.integers(len(items))]

    def _some(self, items):
        """At least one of them."""
        items = list(items)
        chosen = self._random.permutation(len(items))[: self._random.integers(1, len(items) + 1)]
        return [items[index] for index in chosen]

    def _link(self):
        """An object of another file, and one with a mesh of that file, which cannot be written."""
        path = str(self._scratch / "library.blend")
        lent = wild(self._random, "Lent")
        bpy.data.libraries.write(path, {lent}, fake_user=True)
        bpy.data.objects.remove(lent)
        for mesh in [mesh for mesh in bpy.data.meshes if not mesh.users]:
            bpy.data.meshes.remove(mesh)
        with bpy.data.libraries.load(path, link=True) as (_, here):
            here.objects = ["Lent"]
        linked = here.objects[0]
        bpy.context.collection.objects.link(linked)
        bpy.context.collection.objects.link(bpy.data.objects.new("Borrower", linked.data))

    def _meshes(self):
        bpy.context.view_layer.update()
        return [obj for obj in bpy.context.view_layer.objects if obj.type == "MESH"]

    # ---------------------------------------------------------------- what an artist does between

    def _act(self):
        acts = [self._select, self._mode, self._mode, self._hide, self._lock, self._marks, self._pick, self._twin,
                self._seams, self._turn, self._name, self._pin]  # fmt: skip
        self._one(acts)()
        bpy.context.view_layer.update()

    def _select(self):
        if bpy.context.mode == "OBJECT":
            chosen = self._some(self._meshes())
            for obj in self._meshes():
                obj.select_set(obj in chosen)
            bpy.context.view_layer.objects.active = self._one([*chosen, *self._meshes()])

    def _mode(self):
        active = bpy.context.view_layer.objects.active
        if active is None or active.library or active.data.library or not active.visible_get():
            return  # Blender raises
        if bpy.ops.object.mode_set.poll():
            bpy.ops.object.mode_set(mode="OBJECT" if bpy.context.mode == "EDIT_MESH" else "EDIT")

    def _hide(self):
        obj = self._one(self._meshes())
        obj.hide_set(not obj.hide_get())

    def _lock(self):
        obj = self._one(self._meshes())
        obj.hide_select = not obj.hide_select

    def _marks(self):
        """Select faces."""
        if bpy.context.mode == "EDIT_MESH" and bpy.ops.mesh.select_all.poll():
            bpy.ops.mesh.select_all(action=self._one(["SELECT", "DESELECT", "INVERT"]))
            if self._random.random() < 0.5:
                bpy.ops.mesh.select_random(ratio=0.6, seed=int(self._random.integers(1000)))

    def _pick(self):
        """Another select mode, of all the meshes that are edited: Blender leaves out those that are hidden, but gives
        it to them when it undoes."""
        if bpy.context.mode == "EDIT_MESH" and bpy.ops.mesh.select_mode.poll():
            bpy.ops.mesh.select_mode(type=self._one(["VERT", "EDGE", "FACE"]))
            modes = zip(("VERT", "EDGE", "FACE"), bpy.context.tool_settings.mesh_select_mode)
            chosen = {mode for mode, on in modes if on}
            for obj in [obj for obj in bpy.context.view_layer.objects if obj.type == "MESH" and obj.mode == "EDIT"]:
                edited = bmesh.from_edit_mesh(obj.data)
                if edited.select_mode != chosen:
                    edited.select_mode = chosen
                    edited.select_flush_mode()

    def _twin(self):
        """Another object with the same mesh, which may be in Edit Mode."""
        obj = self._one(self._meshes())
        if len(bpy.data.objects) < 9:
            other = bpy.data.objects.new(f"{obj.name} again", obj.data)
            bpy.context.collection.objects.link(other)
            bpy.context.view_layer.update()
            if bpy.context.mode == "OBJECT" and not obj.data.is_editmode:
                other.select_set(True)

    def _seams(self):
        obj = self._one(self._meshes())
        if not obj.data.is_editmode and len(obj.data.edges):
            seams = self._random.random(len(obj.data.edges)) < self._one([0.0, 0.02, 0.3])
            obj.data.edges.foreach_set("use_seam", seams)

    def _turn(self):
        self._one(self._meshes()).rotation_euler.x += 1.0

    def _name(self):
        """Give something of the add-on's another name."""
        for obj in self._meshes():
            if "Koebe" in obj.data.uv_layers and not obj.data.is_editmode and self._random.random() < 0.5:
                obj.data.uv_layers["Koebe"].name = "Was Koebe"

    def _pin(self):
        """Pin some UVs of a layer, or none."""
        obj = self._one(self._meshes())
        if len(obj.data.uv_layers) and not obj.data.is_editmode and not obj.data.library:
            corners = self._random.random(len(obj.data.loops)) < self._one([0.0, 0.01, 0.1])
            scenes.pin(obj.data, self._one(obj.data.uv_layers).name, corners)

    def _pinned(self):
        """Where the UVs are pinned, by mesh and layer: corners and their UVs. Not of what is in Edit Mode."""
        return {
            (obj.data.name_full, layer.name): (pins, scenes.corner_uv(obj.data, layer.name)[pins])
            for obj in self._meshes() if not obj.data.is_editmode
            for layer in obj.data.uv_layers
            for pins in [scenes.pins(obj.data, layer.name)] if pins.any()
        }  # fmt: skip

    # ---------------------------------------------------------------- calls

    def _options(self, name):
        one, layer = self._one, self._one(LAYERS)
        if name == "uv.koebe_uniformize":
            return {"layer": layer, "checker": one([True, False]), "checker_size": one([8.0, 32.0]),
                    "checker_even": one([True, False]), "tube": one(["annulus", "unroll"]),
                    "placement": one(["pack", "together", "keep"]), "outer": one(["auto", "auto", "longest", "active"]),
                    "method": one(["gk", "ck"]), "max_sweeps": one([1, 50]), "upright": one([True, False]),
                    "cut": one([True, True, False]), "symmetry": one(["off", "auto"]),
                    "polish": one([False, False, True]),
                    "balance": one(["none", "area"]), "importance": one(["", "", "Weight"]),
                    "center": one(["auto", "auto", "cursor", "active"]),
                    "point": one(["auto", "auto", "cursor", "active"])}  # fmt: skip
        if name == "uv.koebe_parts":
            return {"layer": layer, "checker": one([True, False]), "evenness": one([0.0, 0.5, 1.0]),
                    "seams": one(["add", "only"]), "write_seams": one([True, False]),
                    "show": one(["", "", "Weight"])}  # fmt: skip
        if name in ("uv.koebe_torus", "uv.koebe_ring", "uv.koebe_sphere", "uv.koebe_schottky"):
            own = {
                "uv.koebe_torus": {"fit": one(["inside", "period", "square"])},
                "uv.koebe_ring": {"fit": one(["inside", "period", "square"]), "rims": one(["auto", "auto", "selected"]),
                                  "holes": one(["circles", "concentric", "radial"])},
                "uv.koebe_sphere": {"layout": one(["equirectangular", "octahedral"]), "add_sphere": one([True, False]),
                                    "even": one([0.0, 0.0, 0.5])},
                "uv.koebe_schottky": {"normalization": one(["area", "circles"])},
            }[name]  # fmt: skip
            return {"layer": layer, "checker": one([True, False]), "checker_even": one([True, False]),
                    "checker_size": one([8.0, 32.0]), "max_sweeps": one([1, 50]), **own}  # fmt: skip
        if name == "uv.koebe_sequence":
            start = int(self._random.integers(5))
            return {"layer": layer, "source": one(["FRAMES", "SHAPE_KEYS"]), "target": one(["LAYERS", "ATTRIBUTE"]),
                    "frame_start": start, "frame_end": start + int(self._random.integers(4)), "frame_step": 1,
                    "max_sweeps": one([1, 50]), "cut": one([True, True, False]), "upright": one([True, False]),
                    "balance": one(["none", "area"]), "outer": one(["auto", "auto", "longest", "active"])}  # fmt: skip
        if name == "uv.koebe_checker":
            return {"layer": layer, "checker_even": one([True, False])}
        if name == "uv.koebe_distortion":
            return {"layer": layer, "kind": one(["angle", "area", "none"])}
        if name == "mesh.koebe_fill_holes":
            return {"which": one(["holes", "selected", "all"])}
        if name == "uv.koebe_carry_texture":
            return {"layer": layer, "fit_holes": one([True, False]), "material": one([True, False])}
        if name == "uv.koebe_moebius":
            return {"layer": layer, "rim": int(self._random.integers(4)), "island": int(self._random.integers(2)),
                    "center": tuple(self._random.uniform(-0.6, 0.6, 2)), "rotation": one([0.0, 1.0])}  # fmt: skip
        if name == "object.koebe_lift":
            return {"pattern": one(["circles", "voronoi", "hexagons", "stripes"]), "way": one(["perforate", "raise"]),
                    "size": one([0.15, 0.3, 1.0]) * max([1e-3, *(max(obj.dimensions) for obj in self._meshes())]),
                    "thickness": one([0.0, 0.0, 0.05]), "hide": one([True, False]),
                    "shape": one(["disk", "disk", "ring", "torus", "parts"]), "seams": one([True, False]),
                    "height": one([0.0, -0.05])}  # fmt: skip
        if name == "uv.koebe_unwrap":
            return {"layer": layer, "shape": one(["AUTO", "AUTO", "PARTS", "DISK", "RING"]),
                    "placement": one(["pack", "together", "keep"]), "seams": one(["add", "only"]),
                    "keep_angles": one([True, False]), "even": one([0.0, 0.6]), "tiles": one([1, 1, 1, 3]),
                    "atlas": one([True, False, False]), "stack": one([True, False, False])}  # fmt: skip
        if name == "uv.koebe_pack":
            return {"layer": layer, "atlas": one([True, False]), "average_scale": one([True, False]),
                    "keep_places": one(["NONE", "PINNED", "OTHERS", "BOTH"]), "tiles": one([1, 1, 3])}  # fmt: skip
        if name == "uv.koebe_relax":
            return {"layer": layer, "center": tuple(self._random.uniform(0.0, 1.0, 2)), "radius": one([0.1, 0.5])}
        if name in ("uv.koebe_set_density", "uv.koebe_copy_density", "object.koebe_flat_copy", "uv.koebe_symmetrize",
                    "uv.koebe_sew", "uv.koebe_use_for_rendering"):  # fmt: skip
            return {"layer": layer}
        if name == "uv.koebe_measure_density":
            return {"layer": layer, "take": one([True, False])}
        if name == "uv.koebe_preset":
            return {"preset": "LIGHTMAP"}
        if name == "uv.koebe_arrange":
            return {"layer": layer, "mode": one(["LEFT", "ROW", "SIZE", "MATERIAL", "PART", "TRIM", "MIRROR"])}
        if name == "uv.koebe_trims":
            return {"action": one(["GRID", "ADD", "REMOVE"])}
        return {"loop": int(self._random.integers(4))} if name == "uv.koebe_select_loop" else {}

    def _call(self):
        name = self._one([
            "uv.koebe_uniformize", "uv.koebe_uniformize", "uv.koebe_parts", "uv.koebe_checker",
            "uv.koebe_torus", "uv.koebe_ring", "uv.koebe_sphere", "uv.koebe_sphere", "uv.koebe_schottky",
            "uv.koebe_sequence", "uv.koebe_sequence",
            "uv.koebe_distortion", "uv.koebe_distortion", "mesh.koebe_fill_holes", "uv.koebe_carry_texture",
            "uv.koebe_moebius", "uv.koebe_moebius", "object.koebe_flat_copy", "object.koebe_lift",
            "mesh.koebe_loops_around_holes", "node.koebe_add_groups",
            "uv.koebe_compare_shapes", "uv.koebe_select_cuts", "uv.koebe_select_loop", "uv.koebe_select_flipped",
            "uv.koebe_select_torn",
            "uv.koebe_select_offenders", "uv.koebe_reset", "uv.koebe_symmetrize", "uv.koebe_pack", "uv.koebe_sew",
            "uv.koebe_arrange", "uv.koebe_arrange", "uv.koebe_trims", "uv.koebe_unwrap", "uv.koebe_unwrap",
            "uv.koebe_unwrap", "uv.koebe_pack", "uv.koebe_sew", "uv.koebe_relax", "uv.koebe_set_density",
            "uv.koebe_copy_density", "uv.koebe_measure_density", "uv.koebe_use_for_rendering", "uv.koebe_preset",
        ])  # fmt: skip
        options, fault = self._options(name), None
        if self._random.random() < 0.5:
            at = int(np.exp(self._random.uniform(0.0, np.log(3000.0))))
            fault = faults.Fault(self._folder, at, self._one(ERRORS))
        bpy.context.view_layer.update()
        undoes = self._random.random() < 0.3
        if undoes:
            # With the whole file in it, in Edit Mode too: what was done since by a script has left no step.
            bpy.data.meshes.remove(bpy.data.meshes.new("step"))
            bpy.ops.ed.undo_push(message="before")
        before = fingerprint.fingerprint()
        pinned = self._pinned()
        touched = Touched(name, options, self._targets(name))
        answer = faults.call(operator(name), fault, **options)
        after = fingerprint.fingerprint()
        finished = answer == {"FINISHED"}
        self.calls, self.finished = self.calls + 1, self.finished + finished
        self.faults += fault is not None and fault.fired
        allowed = touched.when_finished if finished else touched.on_error
        stay = options.get("keep_places") in (None, "PINNED", "BOTH")
        spoilt = [key for key in fingerprint.differences(before, after) if not allowed(key)]
        spoilt += self._moved(pinned) * stay
        if spoilt:
            where = fault.steps[-1] if fault is not None and fault.fired else None
            self.wrong.append((name, options, str(answer)[-300:], where, spoilt))
        if undoes and finished:
            self._undo(name, options, before, after)

    def _moved(self, pinned):
        """Pinned UVs that have moved, as keys of what is spoilt."""
        now = {obj.data.name_full: obj.data for obj in self._meshes() if not obj.data.is_editmode}
        found = []
        for (mesh, layer), (corners, uv) in pinned.items():
            there = mesh in now and layer in now[mesh].uv_layers and len(now[mesh].loops) == len(corners)
            if there and not np.array_equal(scenes.corner_uv(now[mesh], layer)[corners], uv, equal_nan=True):
                found.append(f"pins of {layer} of {mesh}")
        return found

    def _undo(self, name, options, before, after):
        """A step back brings the file back as it was, and one forth as it became."""
        bpy.ops.ed.undo_push(message="after")
        for step, was in ((bpy.ops.ed.undo, before), (bpy.ops.ed.redo, after)):
            step()
            changed = [key for key in fingerprint.differences(was, fingerprint.fingerprint()) if not of_the_window(key)]
            if changed:
                self.wrong.append((name, options, str(step), None, changed))

    def _targets(self, name):
        """The objects that an operator is for."""
        context = bpy.context
        if name.startswith("uv.koebe_select"):
            return []
        if context.mode == "EDIT_MESH":
            return list(context.objects_in_mode_unique_data)
        return [obj for obj in context.selected_objects if obj.type == "MESH"]
