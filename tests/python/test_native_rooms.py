"""The rooms of native/: includes run one way, and each room is on the map in CONTRIBUTING.md."""

import collections
import hashlib
import re
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NATIVE = ROOT / "native"
ROOMS = sorted(path.name for path in NATIVE.iterdir() if path.is_dir())
FRONTS = {"cli", "python"}  # nothing includes them
OTHERS = "bundle"  # what the library is built from, where that is built too
WITH_THE_COMMAND = {"batch"}  # built with it, by a list of its own


def included(source):
    """What a file includes of native/: room/file."""
    return re.findall(r'^#include "(\w+)/[\w.]+"', source, re.MULTILINE)


def arrows():
    """room -> the other rooms that its files include."""
    graph = {room: set() for room in ROOMS}
    for room in ROOMS:
        for path in (NATIVE / room).rglob("*"):
            if path.suffix in {".h", ".cpp"}:
                graph[room] |= set(included(path.read_text(encoding="utf-8"))) - {room}
    return graph


def test_includes_run_one_way():
    graph = arrows()
    try:
        order = list(TopologicalSorter(graph).static_order())
    except CycleError as error:
        pytest.fail(f"rooms that include each other: {' -> '.join(error.args[1])}")
    assert order[0] == "core" and "pipeline" in order
    assert graph["core"] == set()
    assert all(graph[room] for room in ROOMS if room not in {"core", OTHERS})


def test_nothing_includes_a_front():
    assert not [room for room, others in arrows().items() if others & FRONTS]
    assert [room for room, others in arrows().items() if others & WITH_THE_COMMAND] == ["cli"]


def test_circles_know_no_mesh():
    assert arrows()["circles"] == {"core"}


def test_every_room_is_on_the_map():
    page = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert set(re.findall(r"\bnative/(\w+)/", page)) == set(ROOMS)


def test_every_source_is_built():
    built = (NATIVE / "CMakeLists.txt").read_text(encoding="utf-8")
    listed = set(re.findall(r"^ +(\w+/\w+\.cpp)$", built, re.MULTILINE))
    others = FRONTS | WITH_THE_COMMAND | {OTHERS}
    there = {path.relative_to(NATIVE).as_posix() for path in NATIVE.glob("*/*.cpp") if path.parent.name not in others}
    assert listed == there


@pytest.mark.parametrize("room", sorted(FRONTS | WITH_THE_COMMAND))
def test_every_source_of_a_room_with_a_list_of_its_own_is_built(room):
    built = (NATIVE / room / "CMakeLists.txt").read_text(encoding="utf-8")
    assert {path.name for path in (NATIVE / room).glob("*.cpp")} == set(re.findall(r"\b\w+\.cpp\b", built))


def hidden_names(text):
    """Functions in nameless namespaces of a source."""
    inside = "".join(re.findall(r"^namespace \{\n(.*?)^\}  // namespace\n", text, re.MULTILINE | re.DOTALL))
    return set(re.findall(r"^(?:\w[\w:<>,&* ]*[ &*])(\w+)\(", inside, re.MULTILINE))


def test_no_hidden_function_has_the_name_of_a_public_one():
    # The wheels' library is compiled several sources at once: there it would hide the public one from the others, and
    # be called wherever the numbers can be converted.
    headers = [path.read_text(encoding="utf-8") for path in NATIVE.rglob("*.h")]
    public = set(re.findall(r"^(?:inline |constexpr )*\w[\w:<>,&* ]*[ &*](\w+)\(", "\n".join(headers), re.MULTILINE))
    assert {"triangle_area", "uniformize", "flipped_faces"} <= public
    hidden = {path.name: hidden_names(path.read_text(encoding="utf-8")) & public for path in NATIVE.rglob("*.cpp")}
    assert not {name: names for name, names in hidden.items() if names}


def heap_of(source):
    """Which sources the wheels' library compiles with it, as native/bundle/library.cmake has it."""
    digits = hashlib.md5(str(source.relative_to(NATIVE)).encode(), usedforsecurity=False).hexdigest()[6:10]
    return int(digits, 16) % 14


def hidden_values_and_types(text):
    """Names of constants and types in nameless namespaces of a source, and of functions with their parameters."""
    for inside in re.findall(r"^namespace \{\n(.*?)^\}  // namespace\n", text, re.MULTILINE | re.DOTALL):
        inside = re.sub(r"//.*", "", inside)
        for declared in re.findall(r"^(?:static )?constexpr [^;]*;", inside, re.MULTILINE):
            yield from re.findall(r"(\w+)(?:\[\w*\])? ?(?:=|\{)", declared)
        yield from re.findall(r"^(?:struct|class|enum class|enum) (\w+)", inside, re.MULTILINE)
        for name, parameters in re.findall(r"^\w[\w:<>,&* ]*[ &*](\w+)(\([^{;]*\))\s*\{", inside, re.MULTILINE):
            yield name + re.sub(r"\w+(?=[,)])|\s", "", parameters)


def test_a_hidden_name_is_once_in_a_heap():
    heaps = collections.defaultdict(list)
    for source in sorted(NATIVE.rglob("*.cpp")):
        text = source.read_text(encoding="utf-8")
        if source.parent.name in FRONTS | WITH_THE_COMMAND | {OTHERS} or "<windows.h>" in text:
            continue
        heaps[heap_of(source)] += [(name, source.name) for name in set(hidden_values_and_types(text))]
    assert len(heaps) == 14
    twice = [
        (name, [file for other, file in found if other == name])
        for found in heaps.values()
        for name, count in collections.Counter(name for name, _ in found).items()
        if count > 1
    ]
    assert not twice


@pytest.mark.parametrize(
    ("module", "use"),
    {
        "Geometry": r"\.cross\(|unitOrthogonal|AngleAxis|Quaternion",
        "LU": r"\.determinant\(\)|PartialPivLU|partialPivLu",
        "Eigenvalues": r"EigenSolver",
    }.items(),
)
def test_what_is_used_of_eigen_is_included(module, use):
    # Without the precompiled header, as the wheels' library is compiled, its functions would be declared and not there.
    used = [path for path in NATIVE.rglob("*.[ch]*") if re.search(use, path.read_text(encoding="utf-8"))]
    included = re.compile(f"#include <Eigen/({module}|Dense)>")
    assert used and not [path.name for path in used if not included.search(path.read_text(encoding="utf-8"))]


def test_no_header_includes_that_of_windows():
    # It makes macros of "near", "far" and other words, in every source of a heap that follows.
    assert not [path for path in NATIVE.rglob("*.h") if "<windows.h>" in path.read_text(encoding="utf-8")]
