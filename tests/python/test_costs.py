"""Each number of native/atlas/cost has a unit, meaning, source and use, as docs/developers/costs.md prints it."""

import functools
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HEADERS = {space: (ROOT / f"native/atlas/cost/{name}.h").read_text(encoding="utf-8")
           for space, name in {"tuning": "tuning", "tolerance": "tolerances"}.items()}  # fmt: skip
PAGE = (ROOT / "docs/developers/costs.md").read_text(encoding="utf-8")
ROW = re.compile(r"^/// (.+?) \| (.+?) \| (.+)\ninline constexpr double (\w+) = (.+);$", re.MULTILINE)


def numbers(space):
    """name -> value, unit, meaning, source."""
    signs = {"1.0986122886681098": "log 3", "std::numbers::pi": "π", " * ": " "}
    return {name: (functools.reduce(lambda text, sign: text.replace(*sign), signs.items(), value), *words)
            for *words, name, value in ROW.findall(HEADERS[space])}  # fmt: skip


def test_the_page_prints_the_header():
    assert all(len(numbers(space)) == header.count("inline constexpr") > 5 for space, header in HEADERS.items())
    rows = [tuple(row.split(" | ")) for row in re.findall(r"^\| `(.+) \|$", PAGE, re.MULTILINE)]
    printed = {row[0].rstrip("`"): row[1:] for row in rows if len(row) == 5}
    known = numbers("tuning") | numbers("tolerance")
    assert len(printed) > 3 and printed.items() <= known.items()


def test_every_number_is_used():
    code = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "native/atlas").rglob("*.[ch]*"))
    for space in HEADERS:
        assert [name for name in numbers(space) if not re.search(rf"{space}::{name}\b", code)] == []


def test_the_page_names_functions_of_the_header():
    header = (ROOT / "native/atlas/cost/costs.h").read_text(encoding="utf-8")
    last_cells = re.findall(r"^\|.*\| (`[^|]+`) \|$", PAGE.partition("## The numbers")[0], re.MULTILINE)
    functions = re.findall(r"`(?:CutPrices::|ThroughPrice::)?(\w+)`", " ".join(last_cells))
    assert len(functions) > 15 and [name for name in functions if not re.search(rf"\b{name}[({{]", header)] == []
