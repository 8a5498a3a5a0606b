"""Errors of the native module: each carries the offending elements."""

from collections.abc import Sequence


class KoebeError(Exception):
    """Base of all errors.

    elements   the offending elements, by number; edges by their two vertices
    of         what the elements are: "vertices", "faces", "edges", "loops", "landmarks" or "none"
    """

    def __init__(self, message: str = "", elements: Sequence[int] = (), of: str = "none") -> None:
        super().__init__(message)
        self.elements = elements
        self.of = of


class InputError(KoebeError):
    """The arrays are not a mesh: shape, dtype, index range, NaN or infinity."""


class OptionError(InputError, ValueError):
    """An option out of its range or of an unknown name."""


class TopologyError(KoebeError):
    """The mesh is not a connected, orientable surface of genus 0 with boundary.

    ``kind`` is closed, genus, nonmanifold_edge, nonmanifold_vertex, nonorientable or disconnected.
    """

    kind: str = ""


class SolverError(KoebeError):
    """A linear system could not be solved, or its solution is not finite."""


class FileError(KoebeError, OSError):
    """A file cannot be read, or is not a file of the expected type."""


class Cancelled(KoebeError):
    """The caller asked to stop."""
