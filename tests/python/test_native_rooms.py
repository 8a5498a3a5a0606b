"""The rooms of native/, folders of its layers: includes run one way, and each room is on docs/developers/rooms.md.

That a layer includes only the layers below it, the compiler sees (native/CMakeLists.txt).
"""

import collections
import re
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NATIVE = ROOT / "native"
NO_LAYERS = {"bundle", "options", "python"}  # what the library is built from; the table of options; the package
ROOMS = {path.name: path for path in sorted(NATIVE.glob("*/*")) if path.is_dir() and path.parent.name not in NO_LAYERS}
FRONTS = {"cli", "web"}  # nothing includes them, but the command is in the page too


def included(source):
    """The room of each file of native/ that a source includes."""
    return re.findall(r'^#include "(\w+)/[\w./]+"', source, re.MULTILINE)


def arrows():
    """room -> the other rooms that its files include."""
    graph = {room: set() for room in ROOMS}
    for room, folder in ROOMS.items():
        for path in folder.rglob("*"):
            if path.suffix in {".h", ".cpp"}:
                graph[room] |= set(included(path.read_text(encoding="utf-8"))) - {room}
    return graph


def test_a_room_has_one_layer():
    # Otherwise an include would name the folders of two.
    folders = [path.name for path in NATIVE.glob("*/*") if path.is_dir() and path.parent.name not in NO_LAYERS]
    assert "core" in folders and sorted(folders) == sorted(ROOMS)


def test_includes_run_one_way():
    graph = arrows()
    try:
        order = list(TopologicalSorter(graph).static_order())
    except CycleError as error:
        pytest.fail(f"rooms that include each other: {' -> '.join(error.args[1])}")
    assert graph["core"] == set() and {"kernels", "pipeline"} <= set(order) == set(ROOMS)


def test_nothing_includes_a_front():
    assert {room: others & FRONTS for room, others in arrows().items() if others & FRONTS} == {"web": {"cli"}}
    assert [room for room, others in arrows().items() if "batch" in others] == ["cli"]


def test_nothing_but_linear_includes_the_factor():
    sources = [path for path in NATIVE.rglob("*.[ch]*") if '"linear/factor/' in path.read_text(encoding="utf-8")]
    assert {path.relative_to(NATIVE).parts[:2] for path in sources} == {("base", "linear")}


def test_the_folders_of_the_command_are_one_upon_the_other():
    folders = ["process", "files", "options", "commands"]
    for k, folder in enumerate(folders):
        text = "".join(path.read_text(encoding="utf-8") for path in (ROOMS["cli"] / folder).glob("*.[ch]*"))
        included_folders = set(re.findall(r'^#include "cli/(\w+)/', text, re.MULTILINE))
        assert folder in included_folders and included_folders <= set(folders[: k + 1])


def test_every_room_is_on_the_map():
    page = (ROOT / "docs/developers/rooms.md").read_text(encoding="utf-8")
    shown = re.search(r"^```\n(native/.*?)^```$", page, re.MULTILINE | re.DOTALL)[1]
    layers = re.split(r"^native/(\w+)/", shown, flags=re.MULTILINE)
    named = {name for layer, text in zip(layers[1::2], layers[2::2]) if layer not in NO_LAYERS
             for name in re.findall(r"^  (\w+) ", text, re.MULTILINE)}  # fmt: skip
    assert named == set(ROOMS)


NAMED = re.compile(
    r"^(?!struct|class|enum)(?:inline |constexpr |static )*\w[\w:<>,&* ]*[ &*](\w+)(?:\(|\[\w*\] ?[={]| ?[={])"
    r"|^(?:struct|class|enum class|enum) (?:KOEBE_API )?(\w+)|^using (\w+) =",
    re.MULTILINE,
)


def names_in(text):
    """Functions, constants and types that stand at the left margin."""
    return {next(filter(None, groups)) for groups in NAMED.findall(text)}


def hidden_part(text):
    """What a source has in nameless namespaces."""
    return "".join(re.findall(r"^namespace \{\n(.*?)^\}  // namespace\n", text, re.MULTILINE | re.DOTALL))


def namespace_of(text):
    return (re.findall(r"^namespace ([\w:]+) \{$", text, re.MULTILINE) or [""])[0]


def test_no_hidden_name_is_a_public_one():
    # The library is compiled several sources at once: there it would hide the public one from the others, and be called
    # wherever the numbers can be converted, or be ambiguous.
    public = {}
    for path in NATIVE.rglob("*.h"):
        text = path.read_text(encoding="utf-8")
        public.setdefault(namespace_of(text), set()).update(names_in(text))
    assert {"triangle_area", "uniformize", "flipped_faces", "Part", "Index", "no_twin"} <= public["koebe"]
    twice = {}
    for path in NATIVE.rglob("*.cpp"):
        text = path.read_text(encoding="utf-8")
        seen = set().union(*(names for space, names in public.items()
                             if space and f"{namespace_of(text)}::".startswith(f"{space}::")))  # fmt: skip
        twice[path.name] = names_in(hidden_part(text)) & seen
    assert not {name: names for name, names in twice.items() if names}


def test_a_function_is_in_one_header():
    # Two headers with the same inline function compile until a source includes both.
    function = re.compile(r"^inline [\w:<>,&* ]*[ &*](\w+)(\([^{;]*?\))[\w ]*\s*\{", re.MULTILINE)
    found = collections.defaultdict(list)
    for path in NATIVE.rglob("*.h"):
        text = path.read_text(encoding="utf-8")
        for name, parameters in function.findall(text):
            types = re.sub(r"\w+(?=[,)])|\s", "", parameters)
            found[namespace_of(text), name, types].append(path.name)
    assert ("koebe", "cross", "(Complex,Complex)") in found
    assert not {key: names for key, names in found.items() if len(names) > 1}


@pytest.mark.parametrize(
    ("module", "use"),
    {
        "Geometry": r"\.cross\(|unitOrthogonal|AngleAxis|Quaternion",
        "LU": r"\.determinant\(\)|PartialPivLU|partialPivLu",
        "Eigenvalues": r"EigenSolver",
    }.items(),
)
def test_what_is_used_of_eigen_is_included(module, use):
    # Otherwise its functions are declared and not there, unless another source of its unity group includes it.
    used = [path for path in NATIVE.rglob("*.[ch]*") if re.search(use, path.read_text(encoding="utf-8"))]
    included = re.compile(f"#include <Eigen/({module}|Dense)>")
    assert used and not [path.name for path in used if not included.search(path.read_text(encoding="utf-8"))]


def test_no_header_includes_that_of_windows():
    # It makes macros of "near", "far" and other words, in every source of a unity group that follows.
    assert not [path for path in NATIVE.rglob("*.h") if "<windows.h>" in path.read_text(encoding="utf-8")]
