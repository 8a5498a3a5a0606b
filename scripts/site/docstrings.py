"""The package's docstrings as reStructuredText: rows become definitions or attributes, and examples get a heading."""

import re

from koebe._docstrings import PLAIN, parts
from markup import escaped, sentence

# Public names that are words of English too: links only in backticks.
WORDS = {"Warning", "Surface", "Family", "batch", "distortion", "family", "flatten", "lift", "load", "parts", "plot",
         "transfer"}  # fmt: skip


def linked(text, public):
    """The text, escaped, with links to public names and to pages."""
    said = "|".join(sorted(map(re.escape, public - WORDS), key=len, reverse=True))
    marks = re.compile(
        rf"``(?P<literal>[^`]+)``|`(?P<code>[^`]+)`|(?P<page>docs/\w+\.md)"
        rf"|koebe\.(?P<full>\w+)|(?<![\w.'])(?P<name>{said})(?![\w'])"
        rf"|(?<![\w'])(?P<word>(?:\w+=)?'[\w .|-]{{1,24}}')(?![\w'])"
    )
    made, at = "", 0

    def add(mark):
        nonlocal made
        # A mark of reStructuredText needs a space before and after it, or an escaped one, which vanishes.
        made += ("" if not made or made[-1] in " (" else "\\ ") + mark + "\\ "

    for found in marks.finditer(text):
        made += escaped(text[at : found.start()])
        at = found.end()
        if page := found["page"]:
            add(f":doc:`/{page[5:-3]}`")
        elif (name := found["name"] or found["full"] or (found["code"] or "").removeprefix("koebe.")) in public:
            add(f":py:obj:`~koebe.{name}`")
        else:
            add(f"``{found['literal'] or found['code'] or found['word'] or found[0]}``")
    return made + escaped(text[at:])


def plain(one):
    """The lines of a docstring as the source has it, or nothing."""
    return PLAIN.get(getattr(one, "__qualname__", ""), "").splitlines()


def with_results(found, results):
    """The parts with a row for the classes of the results, after the arguments."""
    rows = [place for place, one in enumerate(found) if one[0] == "row"]
    place = rows[-1] + 1 if rows else 1
    text = ", or ".join(f"`{name}`" for name in results)
    return [*found[:place], ("row", "Returns", [text]), *found[place:]] if results else found


def converted(lines, of_class, public, results=()):
    """The lines of a docstring in reStructuredText."""
    made, before = [], ""
    for kind, names, text in with_results(parts(lines), results):
        if kind == "example":
            made += ["", *([] if before == "example" else [".. rubric:: Example", ""]), *text]
        elif kind == "text":
            made += ["", linked(" ".join(text), public)]
        elif not of_class:
            made += ["", f"**{escaped(names)}**", f"   {linked(sentence(' '.join(text)), public)}"]
        elif text[0].startswith("as "):  # of another class
            literal = ", ".join(f"``{name}``" for name in names.split(", "))
            made += ["", f"{literal}: {linked(' '.join(text), public)}"]
        else:
            first, *others = names.split(", ")
            made += ["", f".. attribute:: {first}", *(f"               {name}" for name in others)]
            made += ["", f"   {linked(' '.join(text), public)}"]
        before = kind
    return [*made, ""]
