"""Capacities and moduli of a surface, enclosed between bounds that are proved."""

import copy
from typing import Any

import numpy as np

from .._arrays import as_indices
from .._comparable import Result
from .._native import _koebe
from .._options import listed, takes
from .._report_entries import Warning
from .._signatures import CertifiedOptions, Unpack
from .._types import Floats
from ..errors import InputError
from ..maps.domain_map import prepared


class CertifiedModuli(Result):
    """Enclosures of numbers of a polyhedral surface: the exact number is not below the first, nor above the second.

    capacities      (N, 2) float64: the least Dirichlet energy of a function on the surface that is 0 on some loops and
                    1 on others; without unit
    condensers      list of N pairs: the loops at 0 and the loops at 1, numbered as in boundary_loops
    modulus         pair, or None if the surface has not two loops: 1 / capacity, the conformal cylinder's height over
                    its girth
    module          dict: name -> pair, the numbers of conformal_module by their names (r_1, y_2, r_2, x_3, ...). With
                    four loops the sign of x_3 is not proved. Empty if it is not enclosed: `warnings` says why
    module_loops    the module's loops in their order, the outer one first, numbered as in boundary_loops
    rims            'polygonal': the numbers are of the polyhedron, as conformal_module(..., rims='polygonal') estimates
                    them
    warnings        list of Warning
    width           of the widest enclosure
    converged       whether no enclosure is wider than wanted. If not, they still hold
    face_count, levels    of the finest triangulation; number of triangulations
    """

    _report: dict[str, Any]
    capacities: Floats
    condensers: list[tuple[list[int], list[int]]]
    modulus: tuple[float, float] | None
    module: dict[str, tuple[float, float]]
    module_loops: list[int]
    warnings: list[Warning]
    rims: str
    width: float
    converged: bool
    face_count: int
    levels: int

    def __init__(self, report: dict[str, Any]) -> None:
        entries, loops = report["capacities"], report.get("loops", [])
        names = _koebe.module_names(len(loops)) if loops else []
        bounds = {name: (one["lower"], one["upper"]) for name in ("modulus", *names) if (one := report.get(name))}
        self._set(
            _report=report,
            capacities=np.array([(one["lower"], one["upper"]) for one in entries], float).reshape(-1, 2),
            condensers=[(one["low"], one["high"]) for one in entries],
            modulus=bounds.pop("modulus", None),
            module=bounds,
            module_loops=loops,
            warnings=[Warning(warning) for warning in report["warnings"]],
            face_count=report["faces"],
            **{name: report[name] for name in ("rims", "width", "converged", "levels")},
        )

    def _drawing(self) -> dict[str, Any]:
        return {"bars": self.capacities}

    def __repr__(self) -> str:
        count = len(self.capacities)
        return f"<koebe.CertifiedModuli {count} capacities, width {self.width:.2g}, {self.face_count} faces>"

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict, with options."""
        return copy.deepcopy(self._report)


def _loops(value: Any, name: str) -> list[int]:
    return as_indices(value, name, 2**31 - 1, "loops").tolist()


def _condenser(value: Any) -> tuple[list[int], list[int]]:
    try:
        low, high = value
    except (TypeError, ValueError):
        raise InputError(f"between must have pairs: loops at 0 and loops at 1, not {value!r}") from None
    return _loops(low, "between"), _loops(high, "between")


@takes("certified", between=None, progress=None, cancel=None)
def certified_moduli(vertices: Any, triangles: Any = None, **given: "Unpack[CertifiedOptions]") -> CertifiedModuli:
    """Enclose conformal invariants of a surface with holes between bounds that are proved, rounding included.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both. The bounds are of the
                 polyhedral surface of flat triangles, not of a smooth surface that it approximates
    {options}
    between      pairs of lists of loops, at 0 and at 1, numbered as in boundary_loops; no flux runs through the other
                 loops. None: each loop at 1 and all others at 0, then each pair
    mask, progress, cancel    as for `uniformize`
    The proof: docs/reliability.md. Raises InputError (OptionError for an option; also for faces without area),
    TopologyError, SolverError, Cancelled, or MemoryError.

    >>> import koebe
    >>> vertices, triangles, label = koebe.fill_holes("blend_samples/face.obj", loops=[2, 3])  # the eyes
    >>> found = koebe.certified_moduli(vertices, triangles)
    >>> low, high = found.modulus
    >>> low < 0.2987 < high and high - low < 0.001
    True
    """
    between = [_condenser(one) for one in listed(given["between"], "between")] if given["between"] is not None else []
    if given["between"] is not None and not between:
        raise InputError("between must have at least one pair of loops at 0 and loops at 1")
    options, said, source, run = prepared("certified", _koebe.CapacityOptions(), given, (vertices, triangles))
    report = source.call(_koebe.certified_capacities, between, options, *run)
    return CertifiedModuli({**report, "options": said})
