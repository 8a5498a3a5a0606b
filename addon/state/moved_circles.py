# SPDX-License-Identifier: GPL-3.0-or-later
"""Updates the report's circles after a Möbius map, and after undo and redo of it."""

import hashlib
import json
from typing import Any

import bpy
import numpy as np

from ..blender.mesh_reading import bring_up_to_date, read_layer
from ..layers.circle_domain import CircleDomain, CircleImage
from ..maps.wording import MOST_UNEVEN, counted
from ..surfaces.moebius import Moebius
from .run_report import KoebeIslandReport, report_of

MOVED, SYMMETRIC = "moved by hand", "made symmetric"
KEPT = 50  # states of an island that are recognized after undo


def entry_of(context: bpy.types.Context, name: str, layer: str, domain: CircleDomain) -> KoebeIslandReport | None:
    """The report's island with the same loops, or None."""
    keys = {domain.key(loop) for loop in domain.loops}
    for entry in report_of(context).islands:
        if entry.mapped and entry.owner_name == name and entry.layer == layer and set(loop_keys(entry)) == keys:
            return entry
    return None


def loop_keys(entry: KoebeIslandReport) -> list[int]:
    """The `CircleDomain.key` of each loop."""
    return [min(json.loads(loop.vertices)) for loop in entry.loops]


def begin(entry: KoebeIslandReport, domain: CircleDomain) -> None:
    """Note the entry's first state, before its circles move for the first time."""
    if not entry.history:
        entry.corners = json.dumps(domain.island.some_corner()[_on_loops(domain)].tolist())
        _remember(entry, _hash(domain.old_uv, domain))


def show(entry: KoebeIslandReport, domain: CircleDomain, moved: Moebius) -> None:
    """Move the circles by a map that keeps the rim. The domain's loops are numbered as the entry's."""
    for place, loop in zip(entry.loops, domain.loops, strict=True):
        center, radius = moved.circle(loop.center, loop.radius)
        _place(place, domain, center, radius)


def record(entry: KoebeIslandReport, image: CircleImage, figures: dict[str, float], what: str = MOVED) -> None:
    """Update the entry with a written image and its figures. Its loops become the image's, in their order."""
    domain = image.domain
    begin(entry, domain)
    before = {key: (loop.vertices, loop.roundness) for key, loop in zip(loop_keys(entry), entry.loops, strict=True)}
    for name, value in figures.items():
        setattr(entry, name, value)
    entry.flipped, entry.uneven = len(image.flipped), bool(image.too_small) or entry.density > MOST_UNEVEN
    entry.flipped_faces = json.dumps(np.unique(domain.island.triangle_face[image.flipped]).tolist())
    entry.moved = describe(image, what)
    for place, loop in zip(entry.loops, image.loops, strict=True):
        place.vertices, place.roundness = before[domain.key(loop)]
        place.radius = loop.radius
        _place(place, domain, loop.center, loop.radius)
    _remember(entry, _hash(image.uv, domain))


def describe(image: CircleImage, what: str = MOVED) -> str:
    """The change of the island in words; warnings follow the colon."""
    troubles = []
    if len(image.flipped):
        troubles.append(f"{counted(len(image.flipped), 'triangle')} turned over")
    if image.too_small:
        troubles.append(f"{counted(image.too_small, 'triangle')} too small for UVs of 32 bits")
    return what + (f": {' and '.join(troubles)}. Move less, or map it anew" if troubles else "")


def _place(place: Any, domain: CircleDomain, center: complex, radius: float) -> None:
    at = domain.offset + domain.scale * center
    place.uv_center, place.uv_radius = (at.real, at.imag), domain.scale * radius


def _hash(uv: np.ndarray, domain: CircleDomain) -> str:
    """Identifies a state of an island, by the stored UVs of its loops."""
    return _key(uv[_on_loops(domain)])


def _on_loops(domain: CircleDomain) -> np.ndarray:
    """The vertices on all loops, in an order that no map changes."""
    return np.sort(np.concatenate([loop.vertices for loop in domain.loops]))


def _key(uv: np.ndarray) -> str:
    return hashlib.sha256(np.ascontiguousarray(uv, dtype=np.float32).tobytes()).hexdigest()


OF_ISLAND = ("angle_error", "flipped", "flipped_faces", "moved", "density", "coverage", "uneven")
OF_LOOP = ("vertices", "radius", "roundness", "uv_radius")


def _remember(entry: KoebeIslandReport, key: str) -> None:
    known = json.loads(entry.history or "{}")
    known.pop(key, None)
    known[key] = {
        "island": [getattr(entry, name) for name in OF_ISLAND],
        "loops": [[*(getattr(loop, name) for name in OF_LOOP), list(loop.uv_center)] for loop in entry.loops],
    }
    entry.history = json.dumps(dict(list(known.items())[-KEPT:]))


def _recall(entry: KoebeIslandReport, known: dict[str, Any]) -> None:
    for name, value in zip(OF_ISLAND, known["island"], strict=False):  # files of earlier versions have fewer
        setattr(entry, name, value)
    for loop, values in zip(entry.loops, known["loops"], strict=True):
        *plain, loop.uv_center = values
        for name, value in zip(OF_LOOP, plain, strict=True):
            setattr(loop, name, value)


def refresh(context: bpy.types.Context) -> None:
    """Make the moved islands show the circles of their present UVs."""
    for entry in report_of(context).islands:
        obj = entry.owner if entry.history else None
        if obj is None or obj.type != "MESH" or entry.layer not in obj.data.uv_layers:
            continue
        bring_up_to_date(obj)
        uv, corners = read_layer(obj, entry.layer), np.array(json.loads(entry.corners))
        known = json.loads(entry.history).get(_key(uv[corners])) if corners.max() < len(uv) else None
        if known is not None:
            _recall(entry, known)


@bpy.app.handlers.persistent
def after_undo(*_: object) -> None:
    """Called by Blender after undo and redo."""
    refresh(bpy.context)


HANDLERS = (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post)


def register() -> None:
    """Follow undo and redo."""
    for handlers in HANDLERS:
        handlers.append(after_undo)


def unregister() -> None:
    """The reverse of `register`."""
    for handlers in HANDLERS:
        handlers.remove(after_undo)
