"""The public docstrings in numpydoc's form, made of rows and of the types in signatures.

In the source a row is a name, or several with commas, two spaces or more, and its text, which goes on in lines that are
indented. `PLAIN` keeps that form, by names such as "parts" and "PartsResult.export".
"""

import inspect
import re
import textwrap
import types
from collections.abc import Iterator, Mapping
from functools import cache, cached_property
from typing import Any

from . import errors
from ._comparable import Result

NAMES = r"\*{0,2}[A-Za-z_]\w*(?:, [A-Za-z_]\w*)*"
_ROW = re.compile(rf"({NAMES})  +(\S.*)")
_ONLY_NAMES = re.compile(rf"(?:{NAMES}),")
_SHAPE = re.compile(r"\([\w', +*-]+,?\)")
_AS_USUAL = {  # what needs no row
    **dict.fromkeys(("vertices", "triangles", "mask", "progress", "cancel", "options"), "as for `uniformize`"),
    **dict.fromkeys(("rims", "order"), "as in `conformal_module`"),
    "a": "a result", "b": "another one", "result": "of `uniformize`", "path": "of the file", "message": "the text",
    "any_outer": "the outer loop of one may correspond to a hole of the other", "labels": "as in Correspondence.carry",
    "elements": "the offending elements", "of": "what the elements are", "entries": "kind, elements and text",
    "more": "the same as keywords", "entry": "of a report", "field": "the values, (V,) or (V, k)",
    "loop_count": "the number of loops", "pixels": "along a side of an image", "steps": "at most so many",
    "number": "the number in the larger mesh for each one in this mesh", "points": "(n, 2) numbers",
    "uv": "(n, 2) numbers in [0, 1]^2", "radii": "(n,) of the disks", "image": "(n, n) or (n, n, k)",
    "fit": "whether holes are bent onto each other", "how": "as in `plot`",
}  # fmt: skip
_SHOWN_BY = {"LeftOutFace": "open_surface", "SurfaceCut": "open_surface", "SurfacePiece": "open_surface",
             "PointFamily": "family"}  # fmt: skip

PLAIN: dict[str, str] = {}
_MAKERS: dict[str, str] = {}  # of a word in the type of a result: the first function that returns it


def parts(lines: list[str]) -> list[tuple[str, str, list[str]]]:
    """A docstring in parts: (kind, names, text), where kind is row, text or example."""
    found: list[tuple[str, str, list[str]]] = []
    names = ""
    for line in lines:
        if found and found[-1][0] == "example" and line.strip():
            found[-1][2].append(line)
        elif line.startswith(">>> "):
            found.append(("example", "", [line]))
        elif row := _ROW.fullmatch(names + line):
            found.append(("row", row[1], [row[2]]))
            names = ""
        elif _ONLY_NAMES.fullmatch(line):
            names += line + " "
        elif line.startswith(" ") and found and found[-1][0] == "row":
            found[-1][2].append(line.strip())
        elif found and found[-1][0] == "text" and line.strip():
            found[-1][2].append(line)
        else:
            found.append(("text", "", [line] if line.strip() else []))
    return [one for one in found if one[2]]


@cache
def _filled(text: str, width: int) -> str:
    """In lines. Most texts are one, and many stand in several docstrings: this runs at each import."""
    return text if len(text) <= width else textwrap.fill(text, width)


def sentence(text: str) -> str:
    """The text with a capital and a full stop."""
    text = text.strip()
    if text and text[0].islower():
        text = text[0].upper() + text[1:]
    return text if not text or text[-1] == "." else text + "."


def sentences(text: str) -> list[str]:
    return re.split(r"(?<=[^.\d]\.)\s+(?=[A-Z'(])", text.strip())


def write(public: Mapping[str, Any]) -> None:
    """Give public functions, classes and their methods docstrings of numpydoc's form."""
    for name, one in public.items():
        if isinstance(one, types.FunctionType):
            for word in re.findall(r"\w+", _type(one.__annotations__.get("return", Any))):
                _MAKERS.setdefault(word, name)
    for name, one in public.items():
        if isinstance(one, types.FunctionType) or inspect.isclass(one) and one.__module__.startswith("koebe."):
            _write(name, one, public)
        if inspect.isclass(one):
            for base in one.__mro__:
                members = vars(base) if base.__module__.startswith("koebe.") else {}
                for key, method in members.items():
                    whole = f"{base.__name__}.{key}"
                    if not key.startswith("_") and isinstance(method, types.FunctionType) and whole not in PLAIN:
                        _write(whole, method, public)


def _write(name: str, one: Any, public: Mapping[str, Any]) -> None:
    if not one.__doc__:  # python -OO
        return
    PLAIN[name] = inspect.cleandoc(one.__doc__)
    of_result = inspect.isclass(one) and issubclass(one, Result)
    if of_result:
        one.__signature__ = inspect.Signature()  # users do not make results
    one.__doc__ = _numpydoc(PLAIN[name], one, public)


def _numpydoc(text: str, one: Any, public: Mapping[str, Any]) -> str:
    found = parts(text.splitlines())
    first = next((k for k, part in enumerate(found) if part[0] == "example"), len(found))
    summary, *more = sentences(" ".join(found[0][2])) if found[0][0] == "text" else ["The function."]
    texts = [" ".join(part[2]) for part in found[1:first] if part[0] == "text"]
    rows = {key.lstrip("*"): " ".join(part[2]) for part in found if part[0] == "row" for key in part[1].split(", ")}
    named, is_class = dict(_parameters(one)), inspect.isclass(one)
    said = {name: rows.get(name.lstrip("*")) or _AS_USUAL.get(name.lstrip("*"), "") for name in named}
    sections = {"Parameters": "".join(_entry(name, named[name], text) for name, text in said.items() if text)}
    if is_class:
        types_of = _attribute_types(one)
        own = {name: row for name, row in rows.items() if name not in named}
        sections["Attributes"] = "".join(_entry(name, types_of.get(name, "object"), row) for name, row in own.items())
    else:
        sections["Returns"] = _returns(one, [summary, *more, *texts], rows, public)
    sections["Raises"] = "".join(
        f"{name}\n    {sentence(sentences(' '.join(inspect.cleandoc(kind.__doc__ or '').split()))[0])}\n"
        for name, kind in vars(errors).items()
        if inspect.isclass(kind) and re.search(rf"Raises[^.]*\b{name}\b", " ".join(texts + more))
    )
    sections["Notes"] = "\n\n".join(_filled(one, 116) for one in [" ".join(more), *texts] if one)
    examples = found[first:] or (_borrowed(one, public) if is_class else [])
    sections["Examples"] = "\n\n".join("\n".join(part[2]) for part in examples)
    made = "".join(f"\n{name}\n{'-' * len(name)}\n{body.strip()}\n" for name, body in sections.items() if body.strip())
    return f"\n{sentence(summary)}\n{made}"


def _parameters(one: Any) -> Iterator[tuple[str, str]]:
    """Names, with ** of keywords, and types."""
    try:
        signature = inspect.signature(one)
    except ValueError:
        return
    for name, parameter in signature.parameters.items():
        if name != "self":
            kind, given = _type(parameter.annotation), parameter.default
            if kind == "object" and isinstance(given, (bool, int, float, str)):
                kind = type(given).__name__
            if given is not parameter.empty:
                kind += f", default {given!r}"
            yield ("**" if parameter.kind is parameter.VAR_KEYWORD else "") + name, kind


@cache
def _type(annotation: Any) -> str:
    """A type in words."""
    if annotation is inspect.Parameter.empty or annotation is Any:
        return "object"
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", "")
    text = text if text and not getattr(annotation, "__args__", None) else str(annotation)
    text = re.sub(r"numpy\.ndarray\[[^\[\]]*(?:\[[^\[\]]*\])?[^\[\]]*numpy\.dtype\[([\w.~]+)(?:\[[^\]]*\])?\]\]",
                  r"ndarray of \1", text)  # fmt: skip
    text = re.sub(r"\b(?:typing|collections\.abc|os|numpy|koebe(?:\.\w+)*|_koebe)\.", "", text)
    text = re.sub(r"\binteger(\[Any\])?", "int", text)
    return re.sub(r"\bNoneType\b", "None", text).replace("'", "").replace('"', "") or "object"


def _entry(name: str, kind: str, text: str) -> str:
    return f"{name} : {kind}\n{textwrap.indent(_filled(sentence(text), 112), '    ')}\n"


def _attribute_types(cls: type[Any]) -> dict[str, str]:
    found: dict[str, str] = {}
    for base in reversed(cls.__mro__):
        found |= {name: _type(kind) for name, kind in vars(base).get("__annotations__", {}).items()}
        for name, one in vars(base).items():
            getter = one.fget if isinstance(one, property) else one.func if isinstance(one, cached_property) else None
            if getter is not None:
                found[name] = _type(getattr(getter, "__annotations__", {}).get("return", Any))
    return found


def _returns(one: Any, texts: list[str], rows: Mapping[str, str], public: Mapping[str, Any]) -> str:
    kind = one.__annotations__.get("return")
    if kind is None or kind == "None":
        return ""
    word = _type(kind)
    known = [name for name in re.findall(r"\w+", word) if inspect.isclass(public.get(name))]
    said = next((part for text in texts for part in sentences(text) if part.startswith("Returns ")), "")
    if not said and known:
        said = sentences(" ".join(inspect.cleandoc(public[known[0]].__doc__ or "").split("\n\n")[0].split()))[0]
    text = _filled(sentence(said.removeprefix("Returns ") or texts[0]), 112)
    return f"{word}\n{textwrap.indent(text, '    ')}\n"


def _borrowed(cls: type[Any], public: Mapping[str, Any]) -> list[tuple[str, str, list[str]]]:
    """The example of a function that returns the class, or shows it."""
    shown = _SHOWN_BY.get(cls.__name__, _MAKERS.get(cls.__name__, "uniformize"))
    text = PLAIN.get(shown) or inspect.cleandoc(public[shown].__doc__ or "")
    found = parts(text.splitlines())
    return found[next((k for k, part in enumerate(found) if part[0] == "example"), len(found)) :]
