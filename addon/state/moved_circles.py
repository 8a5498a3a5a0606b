# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps the report's circles true where a Möbius map has moved them, and where undo and redo take that back."""

import hashlib
import json
from typing import Any

import bpy
import numpy as np

from ..blender.mesh_reading import bring_up_to_date, read_layer
from ..maps.circle_domain import CircleDomain, CircleImage
from ..maps.moebius import Moebius
from ..maps.wording import counted
from .run_report import KoebeIslandReport, report_of

MOVED, SYMMETRIC = "moved by hand", "made symmetric"
KEPT = 50  # states of an island that are known again after undo


def entry_of(context: bpy.types.Context, name: str, layer: str, domain: CircleDomain) -> KoebeIslandReport | None:
    """The report's island with the same loops, or None."""
    keys = {domain.key(loop) for loop in domain.loops}
    for entry in report_of(context).islands:
        if entry.mapped and entry.object_name == name and entry.layer == layer and set(loop_keys(entry)) == keys:
            return entry
    return None


def loop_keys(entry: KoebeIslandReport) -> list[int]:
    """By what `CircleDomain.key` knows each of the loops."""
    return [min(json.loads(loop.vertices)) for loop in entry.loops]


def begin(entry: KoebeIslandReport, domain: CircleDomain) -> None:
    """Note the entry as it is before its circles are moved for the first time."""
    if not entry.history:
        entry.corners = json.dumps(domain.island.some_corner()[_on_loops(domain)].tolist())
        _remember(entry, _hash(domain.old_uv, domain))


def show(entry: KoebeIslandReport, domain: CircleDomain, moved: Moebius) -> None:
    """Move the circles with a map that leaves the rim where it is; the domain's loops are numbered as the entry's."""
    for place, loop in zip(entry.loops, domain.loops, strict=True):
        center, radius = moved.circle(loop.center, loop.radius)
        _place(place, domain, center, radius)


def record(entry: KoebeIslandReport, image: CircleImage, angle_error: float, what: str = MOVED) -> None:
    """Bring the entry up to date with an image that was written. Its loops become those of the image, in its order."""
    domain = image.domain
    begin(entry, domain)
    before = {key: (loop.vertices, loop.roundness) for key, loop in zip(loop_keys(entry), entry.loops, strict=True)}
    entry.angle_error, entry.flipped = angle_error, len(image.flipped)
    entry.flipped_faces = json.dumps(np.unique(domain.island.triangle_face[image.flipped]).tolist())
    entry.moved = describe(image, what)
    for place, loop in zip(entry.loops, image.loops, strict=True):
        place.vertices, place.roundness = before[domain.key(loop)]
        place.radius = loop.radius
        _place(place, domain, loop.center, loop.radius)
    _remember(entry, _hash(image.uv, domain))


def describe(image: CircleImage, what: str = MOVED) -> str:
    """What was done with the island, in words; what to watch out for comes after the colon."""
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
    """By what the state of an island is known again: the UVs of its loops, as they are stored."""
    return _key(uv[_on_loops(domain)])


def _on_loops(domain: CircleDomain) -> np.ndarray:
    """The vertices on all loops, in an order that no map changes."""
    return np.sort(np.concatenate([loop.vertices for loop in domain.loops]))


def _key(uv: np.ndarray) -> str:
    return hashlib.sha256(np.ascontiguousarray(uv, dtype=np.float32).tobytes()).hexdigest()


OF_ISLAND = ("angle_error", "flipped", "flipped_faces", "moved")
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
    for name, value in zip(OF_ISLAND, known["island"], strict=True):
        setattr(entry, name, value)
    for loop, values in zip(entry.loops, known["loops"], strict=True):
        *plain, loop.uv_center = values
        for name, value in zip(OF_LOOP, plain, strict=True):
            setattr(loop, name, value)


def refresh(context: bpy.types.Context) -> None:
    """Let the islands that were moved show the circles of the UVs that they have now."""
    for entry in report_of(context).islands:
        obj = bpy.data.objects.get((entry.object_name, None)) if entry.history else None
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
    """Undo `register`."""
    for handlers in HANDLERS:
        handlers.remove(after_undo)
