"""docs/troubleshooting.md has an entry for every error that the add-on can show."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TEXTS = [ROOT / "docs" / "troubleshooting.md", *sorted((ROOT / "docs" / "data").glob("*_errors.csv"))]
PAGE = " ".join(" ".join(path.read_text(encoding="utf-8") for path in TEXTS).split())
# What the add-on calls; the rest belongs to the command and to the annulus map of Python.
# Rooms of native/.
NOT_CALLED_FROM_BLENDER = {"baselines", "certified", "cli", "fit", "flow", "io", "planar_domain", "python", "report"}

# Errors that no mesh in Blender can cause: wrong calls, guards of inner steps, and what the add-on has ruled out.
NOT_FROM_BLENDER = (
    "the mesh has no vertices", "the mesh has no faces", "does not exist", "twice", "separate parts (faces",
    "must be shrunk at least once", "is no inner vertex", "no path joins", "points of a polygon coincide",
    "polygons cross", "a polygon", "there is no boundary loop", "dense ", "sparse factorization",
    "the order must name", "center and balance exclude", "a circle domain has one circle", "the first circle must be",
     "the match must name", "the schedule", "takes no schedule", "Yamabe flow", "changing partners",
     "the conventional method",
    "their modules cannot be compared", "out of the unit disk: faces round them", "positions that are not finite",
    "landmark", "the field of", "the bent map", "a point of the sphere", "the price must be positive",
    "the map must have a finite point", "the map has vertices that",
    "the density must be positive", "the texture needs at least", "the margin must not be", "tiles must be from 0",
    "as many tiles as needed", "the seconds must be positive", "cuts need cut = true",
    "an importance", "importance needs", "there must be ", "vertices have ",
    "disks to pack need",
)  # fmt: skip
OPTION_ERRORS = "maps/options.py", "batch.py"  # the panel's fields cannot take such values


def literals(node):
    """The texts that an expression can have, with {} for what is filled in."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    if isinstance(node, ast.IfExp):
        return literals(node.body) + literals(node.orelse)
    if isinstance(node, ast.JoinedStr):
        return ["".join(v.value if isinstance(v, ast.Constant) else "{}" for v in node.values)]
    return []


def key(message):
    """The first piece of a message, between what is filled in, colons and brackets, that says something."""
    pieces = (piece.strip(" .,;'") for piece in re.split(r"\{\w*\}|: | \(|\)|; ", message))
    return next((piece for piece in pieces if len(piece) > 6), None)


def addon_messages():
    for path in sorted((ROOT / "addon").rglob("*.py")):
        name = path.relative_to(ROOT / "addon").as_posix()
        if name in OPTION_ERRORS:
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call) and node.exc.args:
                for text in literals(node.exc.args[0]):
                    if key(text):  # else another error's message, passed on
                        yield name, text


def native_messages():
    thrown = re.compile(r"throw (?:Input|Topology|Solver)Error\((.*?)\)?;", re.DOTALL)
    for folder in sorted(path for path in (ROOT / "native").glob("*/*") if path.is_dir()):
        if NOT_CALLED_FROM_BLENDER & {folder.name, folder.parent.name}:
            continue
        for path in sorted(folder.rglob("*.*")):
            for match in thrown.finditer(path.read_text(encoding="utf-8")):
                if "TopologyKind::" in match[1]:  # the add-on says these in words of its own
                    continue
                argument = re.sub(r'"\s*\+?\s*"', "", match[1])  # a literal over several lines
                text = "{}".join(re.findall(r'"((?:[^"\\]|\\.)*)"', argument))
                if text and not any(words in text for words in NOT_FROM_BLENDER):
                    yield path.name, text


def topology_kinds():
    source = (ROOT / "native" / "base" / "core" / "errors.cpp").read_text(encoding="utf-8")
    words = re.search(r"to_string\(TopologyKind .*?\n}", source, re.DOTALL)
    kinds = re.findall(r'"(\w+)"', words.group())
    return [kind for kind in kinds if kind != "disconnected"]  # parts are islands, each mapped by itself


def reasons():
    source = ast.parse((ROOT / "addon" / "maps" / "wording.py").read_text(encoding="utf-8"))
    for node in source.body:
        if isinstance(node, ast.Assign) and node.targets[0].id == "REASONS":
            return ast.literal_eval(node.value)
    raise AssertionError("addon/maps/wording.py has no REASONS")


def test_messages_are_found_where_they_are_raised():
    assert len(list(addon_messages())) >= 42 and len(list(native_messages())) >= 8 and len(topology_kinds()) == 5


@pytest.mark.parametrize(("file", "message"), [*addon_messages(), *native_messages()])
def test_every_error_has_an_entry(file, message):
    assert key(message) in PAGE, f"{file}: docs/troubleshooting.md says nothing about {message!r}"


@pytest.mark.parametrize("kind", topology_kinds())
def test_every_kind_of_topology_error_has_an_entry(kind):
    assert key(reasons()[kind].split(": ")[0]) in PAGE
