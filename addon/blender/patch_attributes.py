# SPDX-License-Identifier: GPL-3.0-or-later
"""Continues the data of a hole's vertices and corners into its patch."""

import dataclasses
from types import ModuleType
from typing import Any

import bmesh
import numpy as np

# Layers of vertices and of corners whose values can be mixed: kind, numbers in each. Others are copied from the rim.
MIXED = (("float", 1), ("float_vector", 3), ("float_color", 4), ("color", 4))
LEAST_WEIGHT = 1e-6  # of a vertex group: with less a vertex stays out


@dataclasses.dataclass
class Continued:
    """Values (n + k, ...) at the n vertices of a hole and the k new ones of its patch.

    nearest  (k,) the hole's vertex nearest to each new vertex, which gets a copy of the data that cannot be mixed
    weights  of the vertex groups, by number
    shapes   positions in the shape keys, by name
    vertices, corners   of the layers that can be mixed, by kind and name
    """

    nearest: np.ndarray
    weights: dict[int, np.ndarray]
    shapes: dict[str, np.ndarray]
    vertices: dict[tuple[str, str], np.ndarray]
    corners: dict[tuple[str, str], np.ndarray]

    @classmethod
    def of(
        cls,
        koebe: ModuleType,
        mesh: bmesh.types.BMesh,
        loop: list[bmesh.types.BMLoop],
        positions: np.ndarray,
        triangles: np.ndarray,
        keys: dict[str, np.ndarray],
    ) -> "Continued":
        """For the patch of one loop of a bmesh. keys: positions (V, 3) of all vertices in each shape key, by name."""
        rim = [corner.vert for corner in loop]
        given, added = positions[: len(rim)], positions[len(rim) :]
        mix = _Mixer(koebe, positions, triangles, len(rim))
        # Weights of vertex groups at the rim; 0 where a vertex is in no group.
        deform = mesh.verts.layers.deform.active
        groups = [dict(vertex[deform].items()) if deform else {} for vertex in rim]
        # A shape key moves the rim; the patch follows.
        shapes = {}
        for name, places in keys.items():
            here = np.array([places[vertex.index] for vertex in rim], dtype=np.float64)
            if np.isfinite(here).all():
                shapes[name] = positions + mix(here - given)
        return cls(
            _nearest(added, given),
            {
                number: np.clip(mix.bounded(np.array([[group.get(number, 0.0)] for group in groups]))[:, 0], 0.0, 1.0)
                for number in sorted(set().union(*groups))
            },
            shapes,
            _layers(mix, mesh.verts.layers, rim),
            _layers(mix, mesh.loops.layers, loop),
        )

    def give(
        self,
        mesh: bmesh.types.BMesh,
        corners: list[bmesh.types.BMLoop],
        added: list[bmesh.types.BMVert],
        faces: list[bmesh.types.BMFace],
        triangles: list[list[int]],
    ) -> None:
        """Give this data to the new vertices and faces of a bmesh.

        They were made after examples on the rim. The corners are copied here, which invalidates references to them.
        """
        # Faces take the data of the nearest rim corners, which also fills what cannot be mixed.
        rim = len(corners)
        for face, triangle in zip(faces, triangles, strict=True):
            for corner, v in zip(face.loops, triangle, strict=True):
                corner.copy_from(corners[v if v < rim else self.nearest[v - rim]])
        # Then what was mixed: shape keys, weights, layers of vertices and corners.
        new = range(rim, rim + len(added))
        for name, values in self.shapes.items():
            layer = mesh.verts.layers.shape[name]
            for vertex, v in zip(added, new, strict=True):
                vertex[layer] = values[v]
        deform = mesh.verts.layers.deform.active
        for vertex, v in zip(added, new, strict=True) if self.weights else ():
            vertex[deform].clear()
            for number, values in self.weights.items():
                if values[v] > LEAST_WEIGHT:
                    vertex[deform][number] = values[v]
        for (kind, name), values in self.vertices.items():
            layer = getattr(mesh.verts.layers, kind)[name]
            for vertex, v in zip(added, new, strict=True):
                vertex[layer] = _value(kind, values[v])
        for (kind, name), values in self.corners.items():
            layer = getattr(mesh.loops.layers, kind)[name]
            for face, triangle in zip(faces, triangles, strict=True):
                for corner, v in zip(face.loops, triangle, strict=True):
                    corner[layer] = _value(kind, values[v])


class _Mixer:
    """Continues values (n, w) at the rim of a patch into it, (n + k, w), harmonically."""

    def __init__(self, koebe: ModuleType, positions: np.ndarray, triangles: np.ndarray, rim: int) -> None:
        self._koebe, self._positions, self._triangles = koebe, positions, triangles
        self._fixed = np.arange(rim)

    def __call__(self, values: np.ndarray) -> np.ndarray:
        """Mixes as smoothly as the patch's own shape allows."""
        return self._mixed(values, uniform=False)

    def bounded(self, values: np.ndarray) -> np.ndarray:
        """Mixes within the range of the values at the rim."""
        return self._mixed(values, uniform=True)

    def _mixed(self, values: np.ndarray, uniform: bool) -> np.ndarray:
        result = np.repeat(values[:1], len(self._positions), axis=0)  # right for a value that is equal all around
        result[self._fixed] = values
        different = np.flatnonzero((values != values[:1]).any(axis=0))
        if len(self._positions) == len(values):
            return result
        for pair in np.split(different, range(2, len(different), 2)):
            plane = np.zeros((len(values), 2))
            plane[:, : len(pair)] = values[:, pair]
            result[:, pair] = self._harmonic(plane, uniform)[:, : len(pair)]
        result[self._fixed] = values
        return result

    def _harmonic(self, plane: np.ndarray, uniform: bool) -> np.ndarray:
        if not uniform:
            try:
                found = self._koebe.harmonic_map(self._positions, self._triangles, self._fixed, plane)
            except self._koebe.KoebeError:
                found = np.array(np.nan)
            if np.isfinite(found).all():
                return found
        return self._koebe.harmonic_map(self._positions, self._triangles, self._fixed, plane, uniform=True)


def _layers(mix: _Mixer, layers: Any, elements: list[Any]) -> dict[tuple[str, str], np.ndarray]:
    """Continued values of the layers that can be mixed, by kind and name."""
    found = {}
    for kind, width in MIXED:
        for layer in getattr(layers, kind).values():
            values = np.array([element[layer] for element in elements], dtype=np.float64).reshape(-1, width)
            if np.isfinite(values).all():
                found[kind, layer.name] = mix.bounded(values)
    return found


def _value(kind: str, value: np.ndarray) -> float | np.ndarray:
    return float(value[0]) if kind == "float" else value


def _nearest(points: np.ndarray, given: np.ndarray) -> np.ndarray:
    """Number (k,) of the given point that each point is nearest to."""
    return np.array([np.argmin(((given - point) ** 2).sum(axis=1)) for point in points], dtype=int)
