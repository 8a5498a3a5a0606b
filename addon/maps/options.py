# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of one run, shared by the operator and the batch script."""

import dataclasses
import inspect
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from .option_table import ROWS, Row, rows_of

WRITTEN = ("layer", "checker", "checker_size", "checker_even", "weld", "deformed")  # read and written alike by all maps
OF_RUNS = (*WRITTEN, "threads")  # in the `Options` of every run

# Blender keeps names of UV layers in 64 bytes, the last of them zero (3.4; 68 later).
MAX_LAYER_NAME_BYTES = 63


# From 4.0 on Blender keeps its own values under these names, for edges, faces or vertices. If a UV layer has the name,
# it confuses them, and crashes when it writes.
BLENDERS_OWN = {
    "position", "material_index", "uv_seam", "sharp_edge", "sharp_face", "custom_normal", "crease_edge", "crease_vert",
    "bevel_weight_edge", "bevel_weight_vert", "freestyle_edge", "freestyle_face",
}  # fmt: skip


class OptionError(ValueError):
    """An option has an unusable value: its name, and the reason."""

    def __init__(self, option: str, reason: str) -> None:
        super().__init__(f"{option}: {reason}")
        self.option, self.reason = option, reason


class Chosen:
    """Values of options by name: a frozen dataclass with the table's options of a map (`of_map`).

    Raises OptionError for a value that the option cannot have.
    """

    rows: ClassVar[list[Row]]

    if TYPE_CHECKING:  # the fields are unknown until the table is read

        def __init__(self, *values: Any, **named: Any) -> None: ...

        def __getattr__(self, name: str) -> Any: ...

    def __post_init__(self) -> None:
        for row in self.rows:
            if problem := row.problem(getattr(self, row.name)):
                raise OptionError(row.name, problem)
        self._check_importance()
        if getattr(self, "even", 0.0) and getattr(self, "holes", "circles") != "circles":
            raise OptionError("even", "it does not work with slits: set Holes to Circles")

    def _check_importance(self) -> None:
        """Raises OptionError if there is importance and nothing that it weighs."""
        if getattr(self, "importance", "") and not self.even > 0.0:
            raise OptionError("importance", "it needs Even: set Even above 0")

    def solver_arguments(self) -> dict[str, Any]:
        """Keyword arguments of the solver's function, except vertices and values computed for each island."""
        return {
            row.name: getattr(self, row.name)
            for row in self.rows
            if row.is_native and row.kind in ("number", "integer", "flag", "choice") and row.name not in ("cut", "weld")
        }


Kind = TypeVar("Kind", bound=type[Chosen])


def of_map(of: str, *without: str) -> Callable[[Kind], Kind]:
    """Gives a class the options of a map as fields, after its own fields."""

    def made(kind: Kind) -> Kind:
        kind.rows = [row for row in rows_of(of) if row.name not in without]
        kind.__annotations__ = {**inspect.get_annotations(kind), **{row.name: Any for row in kind.rows}}
        for row in kind.rows:
            setattr(kind, row.name, row.default)
        return dataclasses.dataclass(frozen=True)(kind)  # type: ignore[return-value]

    return made


@of_map("uniformize")
class Options(Chosen):
    """What to compute and what to write.

    Instead of their words, outer, center and point may be the index of a mesh vertex. The island with the centre is not
    balanced, as both choose the centre. The island with the rim point is not turned upright, and its rim is the loop of
    the point.
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.symmetry != "off" and (self.center != "auto" or self.point != "auto"):
            raise OptionError("symmetry", "it does not work with Centre or Rim Point")
        if self.even > 0.0 and self.symmetry != "off":
            raise OptionError("even", "it does not work with Symmetry: set Even to 0")
        if self.even > 0.0 and self.center != "auto":
            raise OptionError("even", "it does not work with Centre: set Even to 0")
        _check_layer_name(self.layer)

    def _check_importance(self) -> None:
        if self.importance and self.balance != "area" and not self.even > 0.0:
            raise OptionError("importance", "it needs Balance: set Balance to Area, or Even above 0")


@of_map("parts", *OF_RUNS)
class PartsChoice(Chosen):
    """How a surface is cut into parts."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.tiles == 0 and self.texels == "fill":
            raise OptionError("tiles", "0 needs a texel density: set Texels to By Number or Like a Layer")

    def _check_importance(self) -> None:
        """Parts as wholes obey it always."""

    def solver_arguments(self) -> dict[str, Any]:
        """As of `Chosen`. Without `even` the solver keeps the angles, without `density` it fills the square."""
        arguments = super().solver_arguments()
        if self.keep_angles:
            arguments["even"] = None
        if self.texels != "number":
            arguments["density"] = None
        return arguments


@dataclasses.dataclass(frozen=True)
class SequenceChoice:
    """The shapes of a mesh to map one after another, and where to keep their UVs.

    frames  of the source "FRAMES"; None: the scene's frames
    target  "ATTRIBUTE" (a vector attribute for each shape) or "LAYERS" (a UV layer for each)
    play    show the attributes of the frames in a UV layer, by a modifier
    """

    source: str = ROWS["source"].default
    frames: range | None = None
    target: str = ROWS["target"].default
    play: bool = ROWS["play"].default

    def __post_init__(self) -> None:
        for name in ("source", "target"):
            if problem := ROWS[name].problem(getattr(self, name)):
                raise OptionError(name, problem)
        if self.source == "FRAMES" and self.frames is not None and not self.frames:
            raise OptionError("frames", "the last frame is before the first one")

    def name(self, layer: str, shape: str | int) -> str:
        """The name of the layer or attribute for one shape, a frame or the name of a key. Raises OptionError."""
        number = f"{shape:04d}" if isinstance(shape, int) else shape
        name = f"{layer}{' ' if self.target == 'LAYERS' else '_'}{number}"
        if len(name.encode("utf-8")) > MAX_LAYER_NAME_BYTES:
            raise OptionError("layer", f"{name!r} is longer than {MAX_LAYER_NAME_BYTES} bytes: choose a shorter name")
        return name


def label_of(shape: str | int) -> str:
    """The shape's name in messages."""
    return f"frame {shape}" if isinstance(shape, int) else f"key {shape!r}"


def _check_layer_name(name: str) -> None:
    if not name.strip():
        raise OptionError("layer", "the name of the UV layer is empty")
    if name.startswith("."):
        raise OptionError("layer", "Blender keeps names that start with a dot to itself")
    if name in BLENDERS_OWN:
        raise OptionError("layer", f"Blender uses the name {name!r} itself")
    if len(name.encode("utf-8")) > MAX_LAYER_NAME_BYTES:
        raise OptionError("layer", f"the name is longer than {MAX_LAYER_NAME_BYTES} bytes")
