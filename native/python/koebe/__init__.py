"""Conformal maps of surfaces with holes onto circle domains, by the generalized Koebe iteration.

W. Zeng, X. Yin, M. Zhang, F. Luo, X. Gu, "Generalized Koebe's Method for Conformal Mapping Multiply Connected
Domains". Arrays in, UVs and a report out; nothing here knows Blender.
"""

from . import _docstrings
from ._batch import batch
from ._example import example
from ._fields import disk_to_uv, uv_to_disk
from ._koebe import CancelToken, CutSketch, __version__
from ._load import load
from ._native import _koebe
from ._plot import plot
from ._report_entries import WARNING_ELEMENTS, Loop, Warning
from .errors import Cancelled, FileError, InputError, KoebeError, OptionError, SolverError, TopologyError
from .io.formats import Patch, read_patch
from .io.vertex_fields import VertexField, read_field, read_region, write_field
from .maps.cut_result import CutResult
from .maps.even_dial import EvenDial
from .maps.image import from_image, to_image
from .maps.layout import fit_circle, mirror_image, pack_disks
from .maps.opened import LeftOutFace, OpenedSurface, SurfaceCut, SurfacePiece, open_surface
from .maps.pack import PackResult, pack
from .maps.parts import PartsResult, parts
from .maps.result import CIRCLE_TOLERANCE, UV_RESOLUTION, ConformalDomain, MapReport, UniformizeResult
from .maps.schottky import SchottkyMap, schottky_map
from .maps.sew import SewnUV, sew
from .maps.sphere import SphereMap, sphere_map
from .maps.surface import Surface
from .maps.tiles import TileMap, ring_map, torus_map
from .maps.uniformize import (
    annulus_map,
    boundary_loops,
    disk_map,
    distortion,
    fill_holes,
    harmonic_map,
    uniformize,
    weld,
)

__all__ = [
    "CIRCLE_TOLERANCE",
    "CancelToken",
    "Cancelled",
    "ConformalDomain",
    "CutResult",
    "CutSketch",
    "EvenDial",
    "FileError",
    "InputError",
    "KoebeError",
    "LeftOutFace",
    "Loop",
    "MapReport",
    "OpenedSurface",
    "OptionError",
    "PackResult",
    "PartsResult",
    "Patch",
    "SchottkyMap",
    "SewnUV",
    "SolverError",
    "SphereMap",
    "Surface",
    "SurfaceCut",
    "SurfacePiece",
    "TileMap",
    "TopologyError",
    "UV_RESOLUTION",
    "UniformizeResult",
    "VertexField",
    "WARNING_ELEMENTS",
    "Warning",
    "__version__",
    "annulus_map",
    "batch",
    "boundary_loops",
    "disk_map",
    "disk_to_uv",
    "distortion",
    "example",
    "fill_holes",
    "fit_circle",
    "from_image",
    "harmonic_map",
    "load",
    "mirror_image",
    "open_surface",
    "pack",
    "pack_disks",
    "parts",
    "plot",
    "read_field",
    "read_patch",
    "read_region",
    "ring_map",
    "schottky_map",
    "sew",
    "sphere_map",
    "to_image",
    "torus_map",
    "uniformize",
    "uv_to_disk",
    "weld",
    "write_field",
]

# The extras, if the compiled module has them.
if hasattr(_koebe, "LiftOptions"):
    from .making.flatten import FlattenResult, flatten
    from .making.lift import LiftResult, lift

    __all__ += [
        "FlattenResult",
        "LiftResult",
        "flatten",
        "lift",
    ]

if hasattr(_koebe, "conformal_module"):
    from .labs.certified import CertifiedModuli, certified_moduli
    from .labs.corresponding import PointFamily
    from .labs.cortex import FlatCortex, cortex
    from .labs.family import Family, family
    from .labs.fit import FitResult, fit_circles
    from .labs.harmonics import SphereHarmonics, spharm
    from .labs.noise import noise_error, vertex_noise
    from .labs.planar import PlanarMap, planar
    from .labs.shapes import (
        DomainAlignment,
        LoopMatch,
        align_domains,
        canonical_order,
        conformal_module,
        match_loops,
        module_distance,
        module_error,
        module_names,
        separation_distance,
        separations,
    )
    from .labs.sphere_family import SphereFamily
    from .labs.sphere_transfer import SphereCorrespondence
    from .labs.statistics import PermutationTest, PointTest, dispersion_test, permutation_test, point_test
    from .labs.teichmueller import TeichmuellerMap, teichmueller
    from .labs.transfer import Correspondence, transfer

    __all__ += [
        "CertifiedModuli",
        "Correspondence",
        "DomainAlignment",
        "Family",
        "FitResult",
        "FlatCortex",
        "LoopMatch",
        "PermutationTest",
        "PlanarMap",
        "PointFamily",
        "PointTest",
        "SphereCorrespondence",
        "SphereFamily",
        "SphereHarmonics",
        "TeichmuellerMap",
        "align_domains",
        "canonical_order",
        "certified_moduli",
        "conformal_module",
        "cortex",
        "dispersion_test",
        "family",
        "fit_circles",
        "match_loops",
        "module_distance",
        "module_error",
        "module_names",
        "noise_error",
        "permutation_test",
        "planar",
        "point_test",
        "separation_distance",
        "separations",
        "spharm",
        "teichmueller",
        "transfer",
        "vertex_noise",
    ]

_docstrings.write({name: globals()[name] for name in __all__})
