"""Conformal maps of surfaces with holes onto circle domains, by the generalized Koebe iteration.

W. Zeng, X. Yin, M. Zhang, F. Luo, X. Gu, "Generalized Koebe's Method for Conformal Mapping Multiply Connected
Domains". Arrays in, UVs and a report out; nothing here knows Blender.
"""

from ._api import (
    annulus_map,
    boundary_loops,
    disk_map,
    distortion,
    fill_holes,
    harmonic_map,
    uniformize,
    weld,
)
from ._batch import batch
from ._certified import CertifiedModuli, certified_moduli
from ._cut_result import CutResult
from ._even_dial import EvenDial
from ._family import Family, family
from ._fields import disk_to_uv, uv_to_disk
from ._fit import FitResult, fit_circles
from ._flatten import FlattenResult, flatten
from ._formats import Patch, read_patch
from ._image import from_image, to_image
from ._koebe import CancelToken, __version__
from ._layout import fit_circle, mirror_image, pack_disks
from ._lift import LiftResult, lift
from ._load import load
from ._opened import LeftOutFace, OpenedSurface, SurfaceCut, SurfacePiece, open_surface
from ._parts import PartsResult, parts
from ._plot import plot
from ._report_entries import WARNING_ELEMENTS, Loop, Warning
from ._result import CIRCLE_TOLERANCE, UV_RESOLUTION, ConformalDomain, MapReport, UniformizeResult
from ._schottky import SchottkyMap, schottky_map
from ._shapes import (
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
from ._sphere import SphereMap, sphere_map
from ._sphere_family import SphereFamily
from ._sphere_transfer import SphereCorrespondence
from ._statistics import PermutationTest, noise_error, permutation_test, vertex_noise
from ._surface import Surface
from ._teichmueller import TeichmuellerMap, teichmueller
from ._tiles import TileMap, ring_map, torus_map
from ._transfer import Correspondence, transfer
from ._vertex_fields import VertexField, read_field, read_region, write_field
from .errors import Cancelled, FileError, InputError, KoebeError, OptionError, SolverError, TopologyError

__all__ = [
    "CIRCLE_TOLERANCE",
    "CancelToken",
    "Cancelled",
    "CertifiedModuli",
    "ConformalDomain",
    "Correspondence",
    "CutResult",
    "DomainAlignment",
    "EvenDial",
    "Family",
    "FileError",
    "FitResult",
    "FlattenResult",
    "InputError",
    "KoebeError",
    "LeftOutFace",
    "LiftResult",
    "Loop",
    "LoopMatch",
    "MapReport",
    "OpenedSurface",
    "OptionError",
    "PartsResult",
    "Patch",
    "PermutationTest",
    "SchottkyMap",
    "SolverError",
    "SphereCorrespondence",
    "SphereFamily",
    "SphereMap",
    "Surface",
    "SurfaceCut",
    "SurfacePiece",
    "TeichmuellerMap",
    "TileMap",
    "TopologyError",
    "UV_RESOLUTION",
    "UniformizeResult",
    "VertexField",
    "WARNING_ELEMENTS",
    "Warning",
    "__version__",
    "align_domains",
    "annulus_map",
    "batch",
    "boundary_loops",
    "canonical_order",
    "certified_moduli",
    "conformal_module",
    "disk_map",
    "disk_to_uv",
    "distortion",
    "family",
    "fill_holes",
    "fit_circle",
    "fit_circles",
    "flatten",
    "from_image",
    "harmonic_map",
    "lift",
    "load",
    "match_loops",
    "mirror_image",
    "module_distance",
    "module_error",
    "module_names",
    "noise_error",
    "open_surface",
    "pack_disks",
    "parts",
    "permutation_test",
    "plot",
    "read_field",
    "read_patch",
    "read_region",
    "ring_map",
    "schottky_map",
    "separation_distance",
    "separations",
    "sphere_map",
    "teichmueller",
    "to_image",
    "torus_map",
    "transfer",
    "uniformize",
    "uv_to_disk",
    "vertex_noise",
    "weld",
    "write_field",
]
