"""The command with files of FreeSurfer, GIfTI and VTK: they are converted to OBJ before it and from OBJ after it."""

import json
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._option_table import INTERRUPTED, NOT_CONVERGED, REFUSED, WRONG_USAGE
from ._types import Floats, Ints
from .errors import Cancelled, InputError, KoebeError, OptionError
from .io.corner_mesh import mesh_with_corner_uv
from .io.export import CUT_TEXT, export, has_one_place_a_vertex, obj_of
from .io.files import whole_file
from .io.formats import GIFTI, MESHIO, NATIVE, PYVISTA, is_foreign_surface, is_freesurfer_name, is_patch_name
from .io.mesh_copies import SPHERE
from .io.vertex_fields import read_region
from .maps.input import surface_of
from .maps.result import MapReport
from .maps.source import Source

_WRITE_NO_MESH = ("module", "compare", "batch", "sequence", "flatten")
_MAKE_CUTS = ("parts", "ring", "torus", "schottky")
_WRITE_A_SURFACE = ("fill", "lift", "transfer")
_ONLY_OWN_FORMATS = ("batch", "sequence")
_REGION = "--region"


def is_needed(words: Sequence[str]) -> bool:
    """Whether the words name a file that the command does not know, or a region."""
    return any(word.partition("=")[0] == _REGION or _is_foreign(word) for word in words)


def _is_foreign(word: str) -> bool:
    if word.startswith("-"):
        return False
    if word.lower().endswith((*GIFTI, *MESHIO, *PYVISTA)):
        return True
    if word.lower().endswith(NATIVE):
        return False
    return is_freesurfer_name(word) or is_patch_name(word) or is_foreign_surface(word)


def run(command: str, words: Sequence[str]) -> int:
    """The exit code of the command with converted files."""
    if words[0] in _ONLY_OWN_FORMATS:
        names = ", ".join(one[1:].upper() for one in NATIVE)
        print(f"koebe: {words[0]} takes {names} files: convert the others before", file=sys.stderr)
        return WRONG_USAGE

    def work() -> int:
        with tempfile.TemporaryDirectory(prefix="koebe-") as folder:
            return _Conversion(command, folder, list(words)).run()

    return ended(work)


def ended(work: Callable[[], int]) -> int:
    """The exit code of a command that runs here; errors are printed."""
    try:
        return work()
    except KeyboardInterrupt:
        return INTERRUPTED
    except Cancelled:
        return INTERRUPTED
    except OptionError as error:
        print(f"koebe: {error}", file=sys.stderr)
        return WRONG_USAGE
    except (KoebeError, OSError) as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
        return REFUSED


class _Map(MapReport):
    """A surface with the UVs that the command wrote, as far as files need it."""

    is_surface: bool

    def __init__(self, source: Source, uv: Floats, is_surface: bool) -> None:
        self._set(_source=source, uv=uv, is_surface=is_surface, loops=[])

    def to_mesh(self) -> Any:
        if not len(self.uv):
            return self._source.mesh
        corners = self.corner_uv
        points = getattr(self, "points", None)
        more = {} if points is None else {SPHERE: points}
        return mesh_with_corner_uv(self._source, corners, np.ones(len(corners), bool), more)


class _Conversion:
    def __init__(self, command: str, folder: str, words: list[str]) -> None:
        self._command, self._folder = command, Path(folder)
        self._shown: dict[str, str] = {}  # shown in place of: temporary file -> the user's
        self._sources: list[Source] = []
        self._words, self._region = _without_region(words)

    def run(self) -> int:
        """Convert, run, convert back."""
        words, output, sphere = list(self._words), "", ""
        places = [k for k, word in enumerate(words) if k and _is_mesh(word) and not _is_value(words[k - 1])]
        needed = 3 if words[0] == "transfer" else 2
        writes = words[0] not in _WRITE_NO_MESH and len(places) >= needed
        for k in places[:-1] if writes else places:
            words[k] = self._converted(words[k])
        if writes and _is_foreign(words[places[-1]]):
            output = words[places[-1]]
            if has_one_place_a_vertex(output) and (words[0] in _MAKE_CUTS or "--cut" in words):
                raise InputError(f"{output}: {CUT_TEXT}")
            words[places[-1]] = self._temporary(output)
        for k, word in enumerate(words):
            name, _, value = word.partition("=")
            if name == "--sphere" and _is_foreign(value or " ".join(words[k + 1 : k + 2])):
                sphere = value or words[k + 1]
                words[k : k + (1 if value else 2)] = [f"--sphere={self._temporary(sphere)}"]
        ball = sphere
        if words[0] == "sphere" and output and not ball and not any(word.startswith("--sphere") for word in words):
            ball = f"{output}.sphere"
            words.append(f"--sphere={self._temporary(ball)}")
        code = self._call(words)
        if code in (0, NOT_CONVERGED):
            self._write(output, sphere, ball)
        return code

    def _converted(self, word: str) -> str:
        """The file for the command: the same, or an OBJ file with the same vertices."""
        region = self._region if not self._sources else None
        if region is None and not _is_foreign(word):
            self._sources.append(surface_of(word, degenerate=True))
            return word
        source = surface_of(word, degenerate=True)
        if region is not None:
            source = surface_of(word, degenerate=True, mask=~read_region(region, len(source.vertices)))
        self._sources.append(source)
        place = self._temporary(word)
        Path(place).write_text(obj_of(source.vertices, source.triangles))
        return place

    def _temporary(self, word: str) -> str:
        number = len(self._shown)
        place = self._folder / str(number) / f"{Path(word).name}.obj"
        place.parent.mkdir()
        self._shown[str(place)] = word
        return str(place)

    def _call(self, words: list[str]) -> int:
        process = subprocess.Popen(
            [self._command, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", errors="replace"
        )
        try:
            printed, complaints = process.communicate()
        except KeyboardInterrupt:  # the command got it, too
            process.wait()
            raise
        for place, word in self._shown.items():
            printed, complaints = (text.replace(place, word) for text in (printed, complaints))
        sys.stdout.write(printed)
        sys.stderr.write(complaints)
        if process.returncode in (0, NOT_CONVERGED):
            self._rename_input(words)
        return process.returncode

    def _rename_input(self, words: list[str]) -> None:
        """The report names the user's file."""
        for k, word in enumerate(words):
            name, _, value = word.partition("=")
            if name != "--json":
                continue
            path = Path(value or words[k + 1])
            report = json.loads(path.read_text("utf-8"))
            names = {Path(place).name: Path(word).name for place, word in self._shown.items()}
            for key in ("input", "a", "b", "source", "target"):
                if isinstance(report, dict) and report.get(key) in names:
                    report[key] = names[report[key]]
            with whole_file(path) as file:
                file.write((json.dumps(report, indent=1, ensure_ascii=False) + "\n").encode())

    def _write(self, output: str, sphere: str, ball: str) -> None:
        temporary = {word: place for place, word in self._shown.items()}
        points = None if not ball else _read_obj(temporary[ball])[0]
        if output:
            result = self._result(*_read_obj(temporary[output]))
            if points is not None:
                result._set(points=result._source.outside_nan(points))
            export(result, output)
        if sphere:
            assert points is not None
            result = _Map(self._sources[0], np.zeros((0, 3, 2)), False)
            result._set(points=points)
            export(result, sphere)

    def _result(self, vertices: Floats, triangles: Ints, uv: Floats) -> _Map:
        """The written surface: the input with its UVs, or another one."""
        source = self._sources[0]
        same = np.array_equal(triangles, source.triangles) and len(vertices) == len(source.vertices)
        if not same or not np.allclose(vertices, source.vertices, rtol=1e-6, atol=1e-9 * np.abs(vertices).max()):
            source = Source(vertices, triangles)
        is_surface = self._words[0] in _WRITE_A_SURFACE
        if not len(uv):
            return _Map(source, uv, is_surface)
        of_vertices = np.full((len(vertices), 2), np.nan)
        of_vertices[triangles] = uv
        single = np.array_equal(of_vertices[triangles], uv)
        return _Map(source, 2.0 * of_vertices - 1.0 if single else uv, is_surface)


def _is_mesh(word: str) -> bool:
    return not word.startswith("-") and (word.lower().endswith(NATIVE) or _is_foreign(word))


def _is_value(word: str) -> bool:
    """Whether the word is an option that takes a mesh file."""
    return word == "--sphere"


def _without_region(words: list[str]) -> tuple[list[str], str | None]:
    left, region = [], None
    rest = iter(words)
    for word in rest:
        name, equals, value = word.partition("=")
        if name != _REGION:
            left.append(word)
        elif equals:
            region = value
        else:
            region = next(rest, None)
            if region is None:
                raise OptionError("--region needs a file")
    return left, region


def _read_obj(path: str) -> tuple[Floats, Ints, Floats]:
    """Vertices, triangles and the UVs (F, 3, 2) of their corners, or (0, 3, 2), of a file that the command wrote."""
    rows: dict[str, list[list[str]]] = {"v": [], "vt": [], "f": []}
    for line in Path(path).read_text("utf-8").splitlines():
        words = line.split()
        if words and words[0] in rows:
            rows[words[0]].append(words[1:])
    corners = [word.split("/") for face in rows["f"] for word in face]
    vertices = np.array([row[:3] for row in rows["v"]], float)
    triangles = np.array([corner[0] for corner in corners], np.int64).reshape(-1, 3) - 1
    if not rows["vt"]:
        return vertices, triangles.astype(np.int32), np.zeros((0, 3, 2))
    places = np.array([row[:2] for row in rows["vt"]], float)
    number = np.array([corner[1] for corner in corners], np.int64) - 1
    return vertices, triangles.astype(np.int32), places[number].reshape(-1, 3, 2)
