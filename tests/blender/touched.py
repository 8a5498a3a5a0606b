"""What an operator may change, as the table in docs/data/operators.csv says, told by the names of a fingerprint."""

import contextlib

import bpy
import fingerprint

SELECTION = ("verts flags", "edges flags", "faces flags", "history", "active face")
SEAMS = ("seam", "edges", "attribute .uv_seam EDGE BOOLEAN", "attribute uv_seam EDGE BOOLEAN")
SLOTS = ("slots", "behind the slots", "custom", "active_material_index")


def is_uv_selection(what, layer):
    """Whether a fingerprint's name is that of flags of a UV layer, or from 5.0 on of all layers."""
    kinds = tuple(f"{of} .{flag}.{layer}" for of in ("attribute", "loops bool") for flag in ("vs", "es", "pn"))
    return what.startswith((*kinds, "attribute .uv_select_"))


def beside_uvs(changed):
    """Of a fingerprint's names that changed, those that tell neither of the UV layer Koebe nor of the report."""
    return [name for name in changed
            if not ("uv" in name or "attribute Koebe" in name or name == "file: report"
                    or is_uv_selection(name.partition(": ")[2], "Koebe"))]


@contextlib.contextmanager
def only_uvs_change():
    """Within it the file changes only in the UV layer Koebe and the report."""
    before = fingerprint.fingerprint()
    yield
    assert beside_uvs(fingerprint.differences(before, fingerprint.fingerprint())) == []


class Touched:
    """The objects that an operator works on, before it is called, and what it may change."""

    def __init__(self, name, options, objects):
        self._name, self._options = name, options
        if name in ("uv.koebe_carry_texture", "uv.koebe_copy_density"):
            source = bpy.context.active_object
            objects = [obj for obj in objects if source is None or obj.data != source.data]
        self._meshes = {f"mesh {obj.data.name_full}" for obj in objects}
        self._keys = {f"key {obj.data.shape_keys.name_full}" for obj in objects if obj.data.shape_keys}
        users = [obj for obj in bpy.data.objects if any(obj.data == one.data for one in objects)]
        self._users = {obj.name_full for obj in users}
        self._layer = options.get("layer", "Koebe")
        self._colors = {obj.data["koebe_distortion"].get("name") for obj in objects if "koebe_distortion" in obj.data}

    def on_error(self, key):
        """Whether that may differ after an operator that did not finish: it may say why, and select what is wrong."""
        owner, _, what = key.partition(": ")
        selecting = ("uv.koebe_uniformize", "uv.koebe_torus", "uv.koebe_ring", "uv.koebe_sphere", "uv.koebe_schottky",
                     "uv.koebe_unwrap")  # fmt: skip
        if self._name not in (*selecting, "uv.koebe_parts", "uv.koebe_sequence", "object.koebe_lift"):
            return False
        return key == "file: report" or (self._name in selecting and self._selects(owner, what))

    def when_finished(self, key):
        """Whether that may differ after an operator that finished."""
        owner, _, what = key.partition(": ")
        return getattr(self, f"_{self._name.partition('.koebe_')[2]}")(owner, what)

    def _selects(self, owner, what):
        return owner.startswith("mesh ") and what in (*SELECTION, "select mode") or (
            owner == "file" and what.endswith(" select mode")
        )

    def _writes_uv(self, owner, what):
        names = (f"uv {self._layer}", f"loops uv {self._layer}", f"attribute {self._layer} CORNER FLOAT2")
        return owner in self._meshes and (
            what == "uv layers" or any(what in (name, f"{name} select", f"{name} pin_uv") for name in names)
            or is_uv_selection(what, self._layer)
            or self._is_color(what, self._colors) or (bool(self._colors) and what == "active color")
            or (bool(self._colors) and what == "custom")
        )  # fmt: skip

    def _is_color(self, what, names):
        return any(what in (f"attribute {name} CORNER FLOAT_COLOR", f"loops float_color {name}") for name in names)

    def _dresses(self, owner, what):
        if owner in self._users:
            return what in SLOTS
        if owner in self._meshes:
            return what == "materials"
        if owner.startswith("material Koebe Checker"):
            return True
        return owner == "names of materials" or owner.startswith("material ") and what == "users"

    def _uniformize(self, owner, what):
        return (
            self._writes_uv(owner, what) or self._selects(owner, what) or (owner, what) == ("file", "report")
            or (self._options.get("checker", True) and self._dresses(owner, what))
        )  # fmt: skip

    _torus = _ring = _schottky = _uniformize

    def _sphere(self, owner, what):
        """With new data, if asked for: a copy of the object, which shares the materials."""
        added = " Sphere" in owner or owner in ("names of objects", "names of meshes", "names of collections") or (
            owner.startswith("material ") and what == "users"
        )
        return self._uniformize(owner, what) or (self._options.get("add_sphere", False) and added)

    def _parts(self, owner, what):
        seams = owner in self._meshes and self._options.get("write_seams") and what in SEAMS
        return seams or (self._uniformize(owner, what) and not self._selects(owner, what))

    def _sequence(self, owner, what):
        """A layer or an attribute for each shape, and what plays the attributes."""
        report = (owner, what) == ("file", "report") or self._selects(owner, what) or self._dresses(owner, what)
        if self._options.get("play", True) and (owner == "names of node_groups" or what == "modifiers"):
            return owner == "names of node_groups" or owner in self._users
        own = what == "uv layers" or self._layer in what or is_uv_selection(what, self._layer)
        return report or (owner in self._meshes and own)

    def _checker(self, owner, what):
        return self._dresses(owner, what)

    def _distortion(self, owner, what):
        if owner == "file":
            return what.endswith((" shading", " custom"))
        own = {f"Koebe Distortion.{number:03d}" if number else "Koebe Distortion" for number in range(9)}
        return owner in self._meshes and (what in ("custom", "active color") or self._is_color(what, own))

    def _fill_holes(self, owner, what):
        if owner in self._keys:
            return not what.endswith((" settings", " relative to")) and what not in ("custom", "relative", "reference")
        kept = ("custom", "users", "fake user", "materials", "edited", "active color", "select mode")
        return owner in self._meshes and what not in kept

    def _carry_texture(self, owner, what):
        reports = owner == "file" and what in ("report", "shapes")
        return reports or self._writes_uv(owner, what) or (
            self._options.get("material", True) and self._dresses(owner, what)
        )

    def _moebius(self, owner, what):
        return (owner, what) == ("file", "report") or self._writes_uv(owner, what)

    _symmetrize = _pack = _arrange = _sew = _relax = _set_density = _copy_density = _moebius

    def _unwrap(self, owner, what):
        return self._sphere(owner, what) or self._parts(owner, what)

    def _measure_density(self, owner, what):
        return owner == "file" and (what == "density" or what.endswith(" settings"))

    def _use_for_rendering(self, owner, what):
        return owner in self._meshes and what == "uv layers"

    def _preset(self, owner, what):
        return owner == "file" and what.endswith(" settings")

    def _bake_texture(self, owner, what):
        """New images and materials, in the slots."""
        return owner in ("names of images", "names of materials") or what in (*SLOTS, "materials") or (
            owner.startswith("material ") and what in ("users", "fake user") or " Koebe" in owner
        )

    def _trims(self, owner, what):
        return owner == "file" and what.endswith(" trims")

    def _flat_copy(self, owner, what):
        """New data, selected; the copy shares the materials."""
        return " Flat" in owner or owner.startswith("names of ") or what.startswith("selected in ") or (
            owner.startswith("material ") and what == "users" or owner == "file" and what.endswith(" active")
        )

    def _lift(self, owner, what):
        """New data, selected; the original is hidden; the report of an object that cannot be lifted."""
        added = " Pattern" in owner or owner.startswith("names of ") or what.startswith(("selected in ", "hidden in "))
        shared = owner.startswith("material ") and what == "users" or owner == "file" and what.endswith(" active")
        return added or shared or what == "hide_render" or (owner, what) == ("file", "report")

    def _add_groups(self, owner, what):
        return owner == "names of node_groups"

    def _flat_svg(self, owner, what):
        return False

    def _compare_shapes(self, owner, what):
        return (owner, what) == ("file", "shapes")

    def _select(self, owner, what):
        if owner == "file":
            return what == "mode" or what.endswith((" active", " select mode"))
        if owner.startswith(("mesh ", "key ")):
            return True  # Edit Mode is another representation: what is in it is compared where it is not changed
        return what == "mode" or what.startswith("selected in ")

    _select_loop = _select_cuts = _select_flipped = _select_torn = _select_offenders = _select
    _loops_around_holes = _select

    def _reset(self, owner, what):
        return owner == "file" and what.endswith(" settings")
