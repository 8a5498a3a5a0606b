"""The rooms of the add-on: each imports only those below it, and some of them never Blender."""

import ast
import re
import sys
from graphlib import TopologicalSorter
from pathlib import Path

import koebe
import pytest

ADDON = Path(__file__).resolve().parents[2] / "addon"
BATCH_NAME = "koebe_uv_batch"  # by which batch.py imports the add-on

# What each room may import beside itself. "" is the add-on's own folder.
MAY_IMPORT = {
    "surfaces": set(),
    "layers": {"surfaces"},
    "maps": {"surfaces", "layers"},
    "solver": set(),
    "blender": {"surfaces", "layers", "maps"},
    "jobs": {"surfaces", "layers", "maps", "solver", "blender"},
    "state": {"surfaces", "layers", "maps", "blender"},
    "operators": {"surfaces", "layers", "maps", "solver", "blender", "jobs", "state"},
    "ui": {"surfaces", "layers", "maps", "blender", "state", "operators"},
    "headless": {"maps", "blender"},
    "batch.py": {"surfaces", "maps", "solver", "blender", "jobs", "headless"},
    "__init__.py": {"blender", "state", "operators", "ui"},
}
BLENDERS = {"bpy", "bmesh", "gpu", "gpu_extras", "blf", "mathutils", "bl_ui", "bl_operators", "addon_utils"}
NEVER_BLENDER = (
    "surfaces/*.py", "layers/*.py", "maps/*.py", "solver/*.py", "headless/arguments.py",
    "headless/exit_and_signals.py", "headless/files.py", "blender/transaction.py", "*/__init__.py",
)  # fmt: skip
FILES = sorted(path.relative_to(ADDON) for path in ADDON.rglob("*.py"))


def room_of(file):
    """The room of a file, or its own name if it lies in the add-on's folder."""
    return file.parts[0]


def tree_of(file):
    return ast.parse((ADDON / file).read_text(encoding="utf-8"))


def imports(tree):
    """What is imported anywhere in it: (level of dots, module, names)."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((0, alias.name, []) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.level, node.module or "", [alias.name for alias in node.names]


def modules_imported(file):
    """Modules of the add-on, as paths without a suffix, that a file imports."""
    for level, module, names in imports(tree_of(file)):
        if level == 0 and module.partition(".")[0] != BATCH_NAME:
            continue
        base = file.parent.parts[: len(file.parent.parts) - level + 1] if level else ()
        parts = [*base, *(module.split(".") if level else module.split(".")[1:])]
        parts = [part for part in parts if part]
        for name in names:
            whole = Path(*parts, name)
            found = whole if (ADDON / whole).with_suffix(".py").exists() or (ADDON / whole).is_dir() else Path(*parts)
            if found != Path():  # else something of the add-on's own, as its name
                yield found


def third_parties(file):
    """Packages outside the add-on that a file imports; the native one may be named for the type checker."""
    tree = tree_of(file)
    for node in tree.body:
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            node.body = [one for one in node.body if {module for _, module, _ in imports(one)} != {"koebe"}]
    return {module.partition(".")[0] for level, module, _ in imports(tree) if level == 0} - {BATCH_NAME}


def test_every_file_is_in_a_room():
    assert {room_of(file) for file in FILES} == set(MAY_IMPORT)


@pytest.mark.parametrize("room", MAY_IMPORT)
def test_a_room_imports_only_what_it_may(room):
    wrong = [
        f"{file} imports {module}"
        for file in FILES
        if room_of(file) == room
        for module in modules_imported(file)
        if module.parts[0] not in MAY_IMPORT[room] | {room}
    ]
    assert not wrong


@pytest.mark.parametrize("room", [room for room in MAY_IMPORT if not room.endswith(".py")])
def test_a_room_says_what_it_may_import(room):
    text = ast.get_docstring(tree_of(Path(room) / "__init__.py"))
    said = set(text.partition("May import ")[2].rstrip(".").split(", ")) - {""}
    assert said == MAY_IMPORT[room] and "\n" not in text
    assert ("no other room" in text) == (not said)


def test_every_permission_is_used():
    used = {room: {module.parts[0] for file in FILES if room_of(file) == room for module in modules_imported(file)}
            for room in MAY_IMPORT}  # fmt: skip
    assert {room: found - {room} for room, found in used.items()} == MAY_IMPORT


def test_no_circle_among_files():
    graph = {file.with_suffix(""): set(modules_imported(file)) for file in FILES}
    order = list(TopologicalSorter(graph).static_order())  # raises CycleError, which names the files
    assert len(order) >= len(FILES)


@pytest.mark.parametrize("pattern", NEVER_BLENDER)
def test_what_never_imports_blender(pattern):
    files = [file for file in FILES if file.match(pattern)]
    assert files
    assert not [f"{file}: {names}" for file in files if (names := third_parties(file) & BLENDERS)]


def test_what_never_imports_blender_needs_numpy_alone():
    known = {*sys.stdlib_module_names, "numpy"}
    for pattern in NEVER_BLENDER:
        for file in FILES:
            if file.match(pattern):
                assert third_parties(file) <= known, file


def test_the_addon_and_the_library_agree_on_what_is_too_small_to_draw():
    source = (ADDON / "surfaces" / "rounding.py").read_text(encoding="utf-8")
    assert float(re.search(r"^RESOLUTION = (\S+)$", source, re.MULTILINE)[1]) == koebe.UV_RESOLUTION
