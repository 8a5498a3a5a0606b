"""Errors of the native module: each carries the offending elements."""


class KoebeError(Exception):
    """Base of all errors. ``elements`` lists the offending vertices or faces; the message says which."""

    elements: tuple[int, ...] = ()


class InputError(KoebeError):
    """The arrays are no mesh: shape, dtype, index range, NaN or infinity."""


class TopologyError(KoebeError):
    """The mesh is no connected, orientable surface of genus 0 with boundary.

    ``kind`` is closed, genus, nonmanifold_edge, nonmanifold_vertex, nonorientable or disconnected.
    """

    kind: str = ""


class SolverError(KoebeError):
    """A linear system could not be solved."""


class Cancelled(KoebeError):
    """The caller asked to stop."""
