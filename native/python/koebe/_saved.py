"""Results in files, without pickles: a tree of what they hold, and its arrays."""

import json
import os
from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np

from ._comparable import Result, subclasses
from ._report_entries import Warning
from .errors import InputError
from .io.files import whole_file
from .maps.result import MapReport
from .maps.source import Source


def save(result: Any, path: str | os.PathLike[str]) -> None:
    """Writes a result, as Result.save says. Raises InputError for a result that holds what no file can keep."""
    arrays: dict[str, Any] = result._entries() if isinstance(result, MapReport) else {}
    if not arrays:
        tree = json.dumps(_tree(result, arrays))
        arrays |= {"kind": np.array(type(result).__name__), "tree": np.array(tree)}
    with whole_file(path) as file:
        np.savez_compressed(file, **arrays)


def _tree(value: Any, arrays: dict[str, Any]) -> Any:
    """The value as JSON has it. Its arrays are added to the others, by name."""
    if value is None or type(value) in (bool, int, float, str):
        return value
    if isinstance(value, np.generic):
        return _tree(value.item(), arrays)
    if isinstance(value, complex):
        return {"complex": [value.real, value.imag]}
    if isinstance(value, np.ndarray) and value.dtype.kind in "fiubcU":
        name = f"array_{len(arrays)}"
        arrays[name] = np.asarray(value)
        return {"array": name}
    if isinstance(value, Warning):
        return {"warning": _tree(dict(value), arrays)}
    if isinstance(value, Result):
        held = value._entries() if isinstance(value, MapReport) else value._state()
        return {type(value).__name__: _tree(held, arrays)}
    if isinstance(value, (list, tuple)):
        listed = [_tree(one, arrays) for one in value]
        return listed if isinstance(value, list) else {"tuple": listed}
    if isinstance(value, Mapping):
        return {"dict": [[_tree(key, arrays), _tree(one, arrays)] for key, one in value.items()]}
    if hasattr(value, "centers") and hasattr(value, "radii"):
        return {"circles": [_tree(np.asarray(one), arrays) for one in (value.centers, value.radii)]}
    raise InputError(f"the result holds a {type(value).__name__}, which cannot be saved")


def made_of(file: Mapping[str, Any]) -> Any:
    """The result in a file. Raises KeyError, TypeError, ValueError, IndexError or AttributeError for another file."""
    return _grown(json.loads(str(file["tree"])), file) if "tree" in file else _map_of(file)


def _grown(tree: Any, arrays: Mapping[str, Any]) -> Any:
    if isinstance(tree, list):
        return [_grown(one, arrays) for one in tree]
    if not isinstance(tree, dict):
        return tree
    ((kind, held),) = tree.items()
    if kind == "array":
        return arrays[held]
    grown = _grown(held, arrays)
    if kind == "complex":
        return complex(*grown)
    if kind == "tuple":
        return tuple(grown)
    if kind == "dict":
        return dict(grown)
    if kind == "warning":
        return Warning(grown)
    if kind == "circles":
        return SimpleNamespace(centers=grown[0], radii=grown[1])
    return _map_of(grown) if issubclass(_class(kind), MapReport) else _class(kind)._made(grown)


def _class(name: str) -> type[Result]:
    return {cls.__name__: cls for cls in subclasses(Result)}[name]


def _map_of(file: Mapping[str, Any]) -> Any:
    report = json.loads(str(file["report"]))
    before = "CutResult" if report.get("cut") is True else "UniformizeResult"  # 0.1 wrote no kind
    kind = str(file["kind"]) if "kind" in file else before
    if kind == "SphereCorrespondence":  # of 1.0
        warnings = [Warning(warning) for warning in report.pop("warnings")]
        held = {name: file[name] for name in file if name not in ("kind", "report")}
        return _class(kind)._made({**held, **report, "warnings": warnings})
    more = {name: file.get(name) for name in ("kept", "first", "filed")}
    source = Source(file["vertices"], file["triangles"], **more)
    made: Any = _class(kind)
    return made(report, SimpleNamespace(**file), source)
