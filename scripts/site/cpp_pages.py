"""The reference of the C++ library: a page for each room, from the public headers by Doxygen and Breathe.

The public headers are koebe.h, the headers that it includes, and theirs, as native/apps/package/CMakeLists.txt copies
them.
"""

import hashlib
import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from markup import escaped, title, toctree

ROOT = Path(__file__).resolve().parents[2]
LAYERS = [*sorted(path for path in (ROOT / "native").iterdir() if path.is_dir()), ROOT / "build" / "native" / "options"]
FIRST = ROOT / "native" / "apps" / "package" / "koebe.h"
EXAMPLES = ROOT / "tests" / "consumer" / "examples.cpp"
MARK = re.compile(r"^ *// \[(\w+)\]$", re.MULTILINE)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
SETTINGS = """
GENERATE_HTML=NO
GENERATE_LATEX=NO
GENERATE_XML=YES
XML_PROGRAMLISTING=NO
QUIET=YES
WARN_IF_UNDOCUMENTED=NO
WARN_NO_PARAMDOC=NO
WARN_IF_INCOMPLETE_DOC=NO
WARN_AS_ERROR=FAIL_ON_WARNINGS
MACRO_EXPANSION=YES
EXPAND_ONLY_PREDEF=YES
PREDEFINED=KOEBE_API=
"""
FILTER = Path(__file__).with_name("doxygen.sed")


def header(name):
    """The file of a header, in the folder of its layer."""
    return next(layer / name for layer in LAYERS if (layer / name).is_file())


def included(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def headers():
    """All public headers by their names, those that koebe.h includes first."""
    found = included(FIRST)
    for name in found:
        found += [other for other in included(header(name)) if other not in found]
    return found


def subject(name):
    """The comment at the head of a header."""
    lines = header(name).read_text(encoding="utf-8").splitlines()
    said = []
    for line in lines:
        if not line.startswith("// "):
            break
        said.append(line[3:])
    return " ".join(said)


def doxygen(folder):
    """Doxygen's XML of the public headers, in folder/xml. It stays while they stay: Sphinx goes by the files' times."""
    inputs = [header(name) for name in headers()]
    settings = f"OUTPUT_DIRECTORY={folder}\n{SETTINGS}INPUT_FILTER=sed -E -f {FILTER}\n"
    settings += "STRIP_FROM_PATH=" + " ".join(f'"{layer}"' for layer in LAYERS) + "\n"
    settings += "INPUT=" + " ".join(f'"{path}"' for path in inputs) + "\n"
    digest, stamp = hashlib.sha256(settings.encode()), folder / "inputs.sha256"
    for path in (FILTER, Path(__file__), *inputs):
        digest.update(path.read_bytes())
    if stamp.is_file() and stamp.read_text() == digest.hexdigest():
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True)
    stamp.write_text(digest.hexdigest())


def said(node):
    """Whether a node of the XML has a description."""
    return any("".join(node.find(kind).itertext()).strip() for kind in ("briefdescription", "detaileddescription"))


def faults(folder):
    """Headers without a subject, and functions of koebe.h's own headers of whose overloads none has a comment."""
    made = [f"{name} does not say what it is for" for name in headers() if not subject(name)]
    own = included(FIRST)
    tree = ElementTree.parse(folder / "xml" / "namespacekoebe.xml")
    functions = [member for member in tree.iter("memberdef") if member.get("kind") == "function"]
    names = {member.findtext("name") for member in functions} | {"SurfaceSolver"}
    made += [f"{EXAMPLES.name}: koebe.h declares no {name}" for name in examples() if name not in names]
    described = {member.findtext("name") for member in functions if said(member)}
    for member in functions:
        place, name = member.find("location").get("file"), member.findtext("name")
        if place in own and name not in described:
            made.append(f"{place}: {name} has no comment")
    return made


def entries(folder):
    """The entries of each header, in the order of its lines: its directives for Breathe."""
    found = {}

    def add(place, kind, name, *options):
        text = f".. doxygen{kind}:: {name}\n" + "".join(f"   :{option}:\n" for option in options)
        found.setdefault(place.get("file"), []).append((int(place.get("line")), text + "\n"))

    for path in sorted((folder / "xml").glob("*.xml")):
        for compound in ElementTree.parse(path).getroot().iter("compounddef"):
            kind, name = compound.get("kind"), compound.findtext("compoundname")
            if kind in ("struct", "class") and name.count("::") == 1 and "<" not in name:
                add(compound.find("location"), kind, name, "members", "undoc-members")
            elif kind == "namespace" and name == "koebe":
                for member in compound.iter("memberdef"):
                    kind, args = member.get("kind"), member.findtext("argsstring") or ""
                    if kind in ("function", "enum", "typedef", "variable"):
                        add(member.find("location"), kind, f"koebe::{member.findtext('name')}{args}")
    return {name: [text for _, text in sorted(lines)] for name, lines in found.items()}


def examples():
    """The names of the functions and classes that have an example."""
    return [name for name in MARK.findall(EXAMPLES.read_text(encoding="utf-8")) if name != "end"]


def example(name):
    """The example of a name, from a program that the tests compile and run."""
    return (
        f".. rubric:: Example: {name}\n\n.. literalinclude:: /code/{EXAMPLES.name}\n   :language: cpp\n   :dedent:\n"
        f"   :start-after: // [{name}]\n   :end-before: // [end]\n\n"
    )


def pages(folder):
    """The pages: name -> text."""
    rooms, written, shown = {}, entries(folder), examples()
    for name in headers():
        rooms.setdefault(name.split("/")[0], []).append(name)
    made = {}
    index = title("C++") + (
        "``#include <koebe/koebe.h>``, ``find_package(koebe)``, and link ``koebe::koebe``. The library never prints. "
        "Errors are exceptions. A whole program, which the tests compile and run:\n\n"
        ".. literalinclude:: /code/main.cpp\n   :language: cpp\n   :start-at: int main\n\n"
        ".. literalinclude:: /code/CMakeLists.txt\n   :language: cmake\n\n"
    )
    index += title("Headers that koebe.h includes", "-") + ".. list-table::\n   :class: names\n\n"
    for name in included(FIRST):
        room = name.split("/")[0]
        index += f"   * - :doc:`{name} <{room}>`\n     - {escaped(subject(name))}\n"
    index += "\n" + toctree(sorted(rooms), ":hidden:")
    for room, names in rooms.items():
        text = title(room)
        for name in names:
            text += title(f"koebe/{name}", "-") + escaped(subject(name)) + "\n\n"
            lines = written.get(name, [])
            named = dict.fromkeys(re.findall(r"koebe::(\w+)[\n(]", "".join(lines)))
            text += "".join(lines) + "".join(example(one) for one in named if one in shown)
        made[f"reference/cpp/{room}.rst"] = text
    made["reference/cpp/index.rst"] = index
    return made
