# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of one run, shared by the operator and the batch script."""

import dataclasses
import math
from typing import Any

METHODS = ("gk", "ck")
ENGINES = ("condensed", "mesh")
OUTER_LOOPS = ("auto", "longest", "active")
BALANCES = ("none", "area")
PLACES = ("auto", "active", "cursor")
TUBES = ("annulus", "unroll")
SYMMETRIES = ("off", "auto")
PLACEMENTS = ("pack", "together", "keep")
TILE_DOMAINS = ("torus", "ring")
SPHERE = "sphere"
SCHOTTKY = "schottky"
LAYOUTS = ("equirectangular", "octahedral")
HOLES = ("circles", "concentric", "radial")
RIMS = ("auto", "selected")
FITS = ("inside", "period", "square")
NORMALIZATIONS = ("area", "circles")
SEAMS = ("add", "only")
SEQUENCE_SOURCES = ("FRAMES", "SHAPE_KEYS")
SEQUENCE_TARGETS = ("ATTRIBUTE", "LAYERS")
MOST_LOST = 0.01  # share of the area, as of the solver

# Blender keeps names of UV layers in 64 bytes, the last of them zero (3.4; 68 later).
MAX_LAYER_NAME_BYTES = 63


# Blender keeps values of its own under these names from 4.0 on, of edges, faces or vertices: where a UV layer has the
# name, it reads the one for the other, and ends when it writes.
BLENDERS_OWN = {
    "position", "material_index", "uv_seam", "sharp_edge", "sharp_face", "custom_normal", "crease_edge", "crease_vert",
    "bevel_weight_edge", "bevel_weight_vert", "freestyle_edge", "freestyle_face",
}  # fmt: skip


class OptionError(ValueError):
    """An option has a value that cannot be used: its name, and why."""

    def __init__(self, option: str, reason: str) -> None:
        super().__init__(f"{option}: {reason}")
        self.option, self.reason = option, reason


@dataclasses.dataclass(frozen=True)
class Options:
    """What to compute and what to write.

    outer         "auto", "longest", "active" (the loop of the active vertex, in Edit Mode) or the index of a
                  mesh vertex on the loop which becomes the unit circle
    center        what goes to the centre of the disk: "auto", "active" (the active vertex, in Edit Mode), "cursor" (the
                  vertex inside the surface nearest to the 3D cursor) or the index of a mesh vertex. The island that
                  has it is not balanced then: both choose the centre
    point         what goes to the right end of the disk: "auto", or a boundary vertex as for center. The island that
                  has it has that vertex's loop as its rim, and is not turned upright
    tolerance     change of the circles between two sweeps, in units of the disk's radius
    polish        lower the angle error at the end, circles as they are; takes one to three times as long as the map
    cut           open, cut and split in the UVs what cannot be mapped as it is; else it is refused
    importance    name of a vertex group by which the balance is weighed, or empty
    upright       turn every island so that the world's up is up in the UV Editor, else as computed
    symmetry      "off", or "auto": an island that is its own mirror image gets exactly symmetric UVs
    tube          what an island with two loops becomes: "annulus", or "unroll" (a rectangle with a wrap seam)
    placement     "pack" (each object has the unit square for itself), "together" (all objects share it) or
                  "keep" (every island goes where it was before)
    margin        between islands, in units of the UV square
    most_lost     share of the surface's area that may have no area in the UVs before a warning comes first
    checker_size  squares across the UV square of the first object
    checker_even  the other objects' squares are as large in space; else as many across the UV square
    """

    method: str = "gk"
    engine: str = "condensed"
    cut: bool = True
    outer: str | int = "auto"
    center: str | int = "auto"
    point: str | int = "auto"
    tolerance: float = 1e-6
    max_sweeps: int = 50
    balance: str = "area"
    importance: str = ""
    polish: bool = False
    threads: int = 0
    upright: bool = True
    symmetry: str = "off"
    tube: str = "annulus"
    layer: str = "Koebe"
    placement: str = "pack"
    margin: float = 0.02
    most_lost: float = MOST_LOST
    checker: bool = True
    checker_size: float = 32.0
    checker_even: bool = True

    def __post_init__(self) -> None:
        _one_of("method", self.method, METHODS)
        _one_of("engine", self.engine, ENGINES)
        _one_of("balance", self.balance, BALANCES)
        _one_of("tube", self.tube, TUBES)
        _one_of("symmetry", self.symmetry, SYMMETRIES)
        _one_of("placement", self.placement, PLACEMENTS)
        for name, value, words in (
            ("outer", self.outer, OUTER_LOOPS), ("center", self.center, PLACES), ("point", self.point, PLACES),
        ):  # fmt: skip
            if isinstance(value, str):
                _one_of(name, value, words)
            elif value < 0:
                raise OptionError(name, f"{value} is not a vertex index")
        if self.symmetry != "off" and (self.center != "auto" or self.point != "auto"):
            raise OptionError("symmetry", "it excludes a centre and a rim point: all choose where the disk's centre is")
        if self.importance and self.balance != "area":
            raise OptionError("importance", "it weighs the balance: set Balance to Area")
        _check_iteration(self)
        if self.threads < 0:
            raise OptionError("threads", f"{self.threads} is negative")
        if not 0.0 <= self.margin < 0.5:
            raise OptionError("margin", f"{self.margin} is not in [0, 0.5)")
        if not (math.isfinite(self.checker_size) and self.checker_size > 0.0):
            raise OptionError("checker_size", f"{self.checker_size} is not a positive number")
        _check_layer_name(self.layer)

    def solver_arguments(self) -> dict[str, Any]:
        """Keyword arguments of `koebe.uniformize`, but for the vertices, which depend on the island."""
        return {
            "method": self.method,
            "engine": self.engine,
            "tolerance": self.tolerance,
            "max_sweeps": self.max_sweeps,
            "balance": self.balance,
            "polish": self.polish,
            "threads": self.threads,
            "most_lost": self.most_lost,
        }


@dataclasses.dataclass(frozen=True)
class PartsChoice:
    """How a surface is cut into parts.

    evenness     from 0, few parts, to 1, texels as even as can be
    seams        "add": cut along seams, and further where that pays; "only": nowhere else, but to get a map at all
    write_seams  make seams of the cuts
    most_lost    share of the surface's area that may have no area in the UVs; with more of it nothing is written
    """

    evenness: float = 0.5
    seams: str = "add"
    write_seams: bool = False
    most_lost: float = MOST_LOST

    def __post_init__(self) -> None:
        _check_share("evenness", self.evenness)
        _check_share("most_lost", self.most_lost)
        _one_of("seams", self.seams, SEAMS)


@dataclasses.dataclass(frozen=True)
class TileChoice:
    """What to compute of a map whose UVs are a tile.

    holes  of a ring, what becomes of the loops that are no rims: "circles", "concentric" or "radial"
    rims   of a ring: "auto" (the two longest loops; in Edit Mode the two with selected vertices, if there are just two)
           or "selected" (those two, or an error)
    fit    "inside": the tile is as large as it fits the UV square. "period": its first period is 1 along u. "square":
           its periods are 1 along u and 1 along v, the height of a ring is 1; that is not conformal
    """

    domain: str = "torus"
    holes: str = "circles"
    rims: str = "auto"
    fit: str = "inside"
    tolerance: float = 1e-6
    max_sweeps: int = 50
    most_lost: float = MOST_LOST

    def __post_init__(self) -> None:
        _one_of("domain", self.domain, TILE_DOMAINS)
        _one_of("holes", self.holes, HOLES)
        _one_of("rims", self.rims, RIMS)
        _one_of("fit", self.fit, FITS)
        _check_iteration(self)


@dataclasses.dataclass(frozen=True)
class SphereChoice:
    """What to compute of a map to the sphere.

    layout      how the sphere becomes UVs: "equirectangular" (u the longitude, v the latitude) or "octahedral"
    add_sphere  whether to add the sphere itself as an object, too
    """

    layout: str = "equirectangular"
    tolerance: float = 1e-6
    max_sweeps: int = 50
    most_lost: float = MOST_LOST
    add_sphere: bool = False

    def __post_init__(self) -> None:
        _one_of("layout", self.layout, LAYOUTS)
        _check_iteration(self)

    @property
    def domain(self) -> str:
        """As of a `TileChoice`."""
        return SPHERE


@dataclasses.dataclass(frozen=True)
class SchottkyChoice:
    """What to compute of a map to a fundamental domain of a Schottky group.

    normalization  of a surface with holes, "area" (texels as even as can be) or "circles" (the most room for equally
                   large circles of the handles)
    """

    normalization: str = "area"
    tolerance: float = 1e-6
    max_sweeps: int = 50
    most_lost: float = MOST_LOST

    def __post_init__(self) -> None:
        _one_of("normalization", self.normalization, NORMALIZATIONS)
        _check_iteration(self)

    @property
    def domain(self) -> str:
        """As of a `TileChoice`."""
        return SCHOTTKY


@dataclasses.dataclass(frozen=True)
class SequenceChoice:
    """Which shapes of a mesh are mapped one after the other, and what holds their UVs.

    frames  of the source "FRAMES"; None: the scene's
    target  "ATTRIBUTE" (a vector attribute for each shape) or "LAYERS" (a UV layer for each)
    play    show the attributes of the frames in a UV layer, by a modifier
    """

    source: str = "FRAMES"
    frames: range | None = None
    target: str = "ATTRIBUTE"
    play: bool = True

    def __post_init__(self) -> None:
        _one_of("source", self.source, SEQUENCE_SOURCES)
        _one_of("target", self.target, SEQUENCE_TARGETS)
        if self.source == "FRAMES" and self.frames is not None and not self.frames:
            raise OptionError("frames", "the last frame is before the first one")

    def name(self, layer: str, shape: str | int) -> str:
        """The name of what holds the UVs of one shape, which is a frame or the name of a key. Raises OptionError."""
        number = f"{shape:04d}" if isinstance(shape, int) else shape
        name = f"{layer}{' ' if self.target == 'LAYERS' else '_'}{number}"
        if len(name.encode("utf-8")) > MAX_LAYER_NAME_BYTES:
            raise OptionError("layer", f"{name!r} is longer than {MAX_LAYER_NAME_BYTES} bytes: choose a shorter name")
        return name


def label_of(shape: str | int) -> str:
    """What a shape is called in messages."""
    return f"frame {shape}" if isinstance(shape, int) else f"key {shape!r}"


OtherDomain = TileChoice | SphereChoice | SchottkyChoice  # of maps that are to no disk
CHOICES = {"torus": TileChoice, "ring": TileChoice, SPHERE: SphereChoice, SCHOTTKY: SchottkyChoice}


def _check_iteration(choice: Any) -> None:
    if not (math.isfinite(choice.tolerance) and choice.tolerance > 0.0):
        raise OptionError("tolerance", f"{choice.tolerance} is not a positive number")
    if choice.max_sweeps < 1:
        raise OptionError("max_sweeps", f"{choice.max_sweeps} is less than 1")
    _check_share("most_lost", choice.most_lost)


def _check_share(name: str, value: float) -> None:
    if not 0.0 <= value <= 1.0:
        raise OptionError(name, f"{value} is not from 0 to 1")


def _one_of(name: str, value: str, allowed: tuple[str, ...]) -> None:
    if value not in allowed:
        raise OptionError(name, f"{value!r} is not one of {', '.join(allowed)}")


def _check_layer_name(name: str) -> None:
    if not name.strip():
        raise OptionError("layer", "the name of the UV layer is empty")
    if name.startswith("."):
        raise OptionError("layer", "Blender keeps names that start with a dot to itself")
    if name in BLENDERS_OWN:
        raise OptionError("layer", f"Blender uses the name {name!r} itself")
    if len(name.encode("utf-8")) > MAX_LAYER_NAME_BYTES:
        raise OptionError("layer", f"the name is longer than {MAX_LAYER_NAME_BYTES} bytes")
