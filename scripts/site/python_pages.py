"""The reference of the Python package: a page for each function, with the classes of its results.

`PAGES` is the only list. A public name that is on no page, or on two, ends the build, and so does one without a
docstring. autodoc and docstrings.py write the entries.
"""

import inspect
import re
import typing

import koebe
from docstrings import linked, parts, plain
from koebe import _report_entries
from koebe.labs import fit as _fit
from koebe.maps import figures as _figures
from koebe.maps import result as _result
from markup import escaped, indented, title, toctree

PAGES = {
    "Maps": {
        "uniformize": ["uniformize", "UniformizeResult", "ConformalDomain", "CutResult"],
        "parts": ["parts", "PartsResult"],
        "pack": ["pack", "PackResult"],
        "sew": ["sew", "SewnUV"],
        "flatten": ["flatten", "FlattenResult"],
        "ring_map": ["ring_map", "torus_map", "TileMap"],
        "sphere_map": ["sphere_map", "SphereMap"],
        "schottky_map": ["schottky_map", "SchottkyMap"],
        "fit_circles": ["fit_circles", "FitResult"],
        "cortex": ["cortex", "FlatCortex"],
    },
    "Many maps": {
        "Surface": ["Surface"],
        "EvenDial": ["EvenDial"],
        "batch": ["batch"],
        "load": ["load"],
        "CancelToken": ["CancelToken"],
        "CutSketch": ["CutSketch"],
        "example": ["example"],
        "read_field": ["read_field", "write_field", "VertexField", "read_region", "read_patch", "Patch"],
    },
    "Patterns and pictures": {"lift": ["lift", "LiftResult"], "plot": ["plot"]},
    "Shapes": {
        "conformal_module": [
            "conformal_module", "module_names", "module_error", "module_distance", "canonical_order", "match_loops",
            "LoopMatch", "separations", "separation_distance",
        ],
        "family": ["family", "PointFamily", "Family", "SphereFamily"],
        "permutation_test": ["permutation_test", "dispersion_test", "PermutationTest", "point_test", "PointTest"],
        "noise_error": ["noise_error", "vertex_noise"],
        "certified_moduli": ["certified_moduli", "CertifiedModuli"],
        "planar": ["planar", "PlanarMap"],
        "teichmueller": ["teichmueller", "TeichmuellerMap"],
        "transfer": ["transfer", "Correspondence", "SphereCorrespondence"],
        "spharm": ["spharm", "SphereHarmonics"],
        "to_image": ["to_image", "from_image"],
        "align_domains": ["align_domains", "DomainAlignment"],
    },
    "Steps of the method": {
        "disk_map": ["disk_map", "annulus_map", "harmonic_map"],
        "boundary_loops": ["boundary_loops", "fill_holes", "weld"],
        "open_surface": ["open_surface", "OpenedSurface", "SurfacePiece", "SurfaceCut", "LeftOutFace"],
        "distortion": ["distortion"],
        "disk_to_uv": ["disk_to_uv", "uv_to_disk", "fit_circle", "pack_disks", "mirror_image"],
    },
    "What they share": {
        "reports": [
            "MapReport", "Loop", "Warning", "CIRCLE_TOLERANCE", "UV_RESOLUTION", "WARNING_ELEMENTS", "__version__",
        ],
        "errors": [
            "KoebeError", "InputError", "OptionError", "TopologyError", "SolverError", "FileError", "Cancelled",
        ],
    },
}  # fmt: skip
ENTRIES = [
    _figures.AngleError, _figures.Beltrami, _figures.LogAreaRatio, _figures.AreaDistortion, _figures.Step,
    _figures.MeanOverLoops, _figures.MeanRoundness, _figures.Seconds, _fit.Distortion, _fit.Fit,
]  # fmt: skip
CALLED = {"Surface", "EvenDial", "CancelToken", "CutSketch"}  # classes that a program makes itself
PUBLIC = set(koebe.__all__)


def listed():
    """The names on all pages, in their order."""
    return [name for pages in PAGES.values() for names in pages.values() for name in names]


def faults():
    """What is wrong with the list and with the docstrings."""
    names = listed()
    missing = [f"koebe.{name} is on no page of the reference" for name in sorted(PUBLIC - set(names))]
    unknown = [f"koebe.{name} is in the reference, but not public" for name in sorted(set(names) - PUBLIC)]
    twice = [f"koebe.{name} is on two pages" for name in sorted({name for name in names if names.count(name) > 1})]
    bare = [f"koebe.{name} has no docstring" for name in sorted(PUBLIC & set(names)) if not text_of(name)]
    return missing + unknown + twice + bare


def text_of(name):
    """The docstring, or the comment above a constant."""
    one = getattr(koebe, name)
    if name == "__version__":
        return "The version of the package."
    if not callable(one):
        return comment_of(name)
    text = one.__dict__.get("__doc__") if inspect.isclass(one) else one.__doc__
    return text and ("\n".join(plain(one)) or text)


def results(function):
    """The public classes that a function returns."""
    said = inspect.signature(function).return_annotation
    return [one.__name__ for one in typing.get_args(said) or [said] if getattr(one, "__name__", None) in PUBLIC]


def comment_of(name):
    """The comment above a constant."""
    sources = "".join(inspect.getsource(module) for module in (_report_entries, _result))
    found = re.search(rf"((?:^# .*\n)+){name}\b", sources, re.MULTILINE)
    return " ".join(line.removeprefix("# ") for line in found[1].splitlines()) if found else ""


def first_sentence(name):
    text = " ".join(text_of(name).split("\n\n")[0].split())
    return re.split(r"(?<=[^.]\.)\s", text)[0]


def entry(name):
    """The entry of a public name."""
    one = getattr(koebe, name)
    if inspect.isclass(one):
        arguments = "" if name in CALLED else "()"  # conf.py hides these
        others = "dict, ndarray, Mapping, Exception"  # whose members are not ours
        rows = parts(plain(one) or inspect.cleandoc(one.__doc__).splitlines())
        described = ", ".join(names for kind, names, _ in rows if kind == "row") or "-"
        return (f".. autoclass:: koebe.{name}{arguments}\n   :members:\n   :inherited-members: {others}\n"
                f"   :exclude-members: {described}\n\n")  # fmt: skip
    if callable(one):
        return f".. autofunction:: koebe.{name}\n\n"
    value = f"   :value: {one!r}\n" if isinstance(one, float) else ""
    return f".. py:data:: {name}\n{value}\n{indented(linked(text_of(name), PUBLIC))}\n\n"


def dictionary(kind):
    """The entry of a dictionary of a report."""
    hints = typing.get_type_hints(kind)
    rows = "".join(f"- ``{name}``: {escaped(getattr(hint, '__name__', str(hint)))}\n" for name, hint in hints.items())
    return title(kind.__name__, "^") + linked(" ".join(kind.__doc__.split()), PUBLIC) + "\n\n" + rows + "\n"


def pages():
    """The pages: name -> text."""
    made = {}
    index = title("Python")
    index += (
        "``import koebe``. A surface is a pair of arrays, a file, or an object of trimesh, PyVista, meshio or nibabel. "
        "After the surface, arguments are given by name. Every example on these pages is run by the tests, in the "
        "folder of the project.\n\n"
    )
    for group, names in PAGES.items():
        index += title(group, "-")
        index += ".. list-table::\n   :class: names\n\n"
        for name in (name for page in names.values() for name in page):
            if not name.startswith("__"):
                index += f"   * - :py:obj:`koebe.{name}`\n     - {linked(first_sentence(name), PUBLIC)}\n"
        index += "\n" + toctree(names, ":hidden:")
        for page, entries in names.items():
            text = title(page if page not in ("errors", "reports") else page.capitalize())
            text += ".. py:currentmodule:: koebe\n\n" + "".join(map(entry, entries))
            if page == "reports":
                text += title("Dictionaries in reports", "-") + "".join(map(dictionary, ENTRIES))
            made[f"reference/python/{page}.rst"] = text
    made["reference/python/index.rst"] = index
    return made
