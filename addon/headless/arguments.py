# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of the batch script. Values out of range are wrong usage, reported in one line."""

import argparse
import csv
import dataclasses
from typing import Any, NoReturn

from ..maps import options
from ..maps.domain_table import DOMAINS
from ..maps.option_table import LARGEST, ROWS, Row, rows_of
from .exit_and_signals import USAGE, Stop
from .flag_names import flag

LARGEST_FRAME = 1048574  # in Blender
DISK = "disk"
OF_SEQUENCES = ("sequence", "frames", "sequence_target", "play")
OF_TWO = ("balance", "center", "point", "even")  # their default depends on another flag
OWN_FLAGS = ("source", "target")  # named after the sequence
IN_BLENDER = "blender -b IN.blend --python-exit-code 1 -P batch.py -- --output OUT.blend [options]"
WITH_BPY = "python batch.py IN.blend -- --output OUT.blend [options]"


@dataclasses.dataclass(frozen=True)
class Library:
    """Words for a run on many files: `batch` for `koebe batch`, `each` for the run on each file."""

    batch: list[str]
    each: list[str]


@dataclasses.dataclass(frozen=True)
class Request:
    """The request: files as given, names of objects or None for all, and the options of the map.

    parts     for a cut into parts, else None
    domain    for a map to another domain than the disk, else None
    sequence  for maps of frames or shape keys, else None
    """

    sources: list[str]
    output: str
    report: str | None
    names: list[str] | None
    options: options.Options
    parts: options.PartsChoice | None
    domain: options.Chosen | None
    sequence: options.SequenceChoice | None
    library: Library
    ends_with_input: bool


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise Stop(USAGE, message)


def parse(arguments: list[str]) -> Request:
    """The parsed request. Raises Stop if it is wrong; ends the program after --help."""
    parser = _Parser(
        prog="batch.py", usage=f"{IN_BLENDER}\n       {WITH_BPY}", allow_abbrev=False,
        description="Map the objects of a .blend file without a window.",
        epilog="Exit code: 0 done, 1 something broke, 2 wrong usage, 3 the file or an object cannot be mapped "
        "(no OUT.blend), 4 not converged (OUT.blend is written), 130 interrupted (nothing is written).",
    )  # fmt: skip
    parser.add_argument(
        "sources", nargs="*", metavar="IN.blend",
        help="opened by the script, if no file is open yet. Several, or a folder: each by a process of its own",
    )  # fmt: skip
    parser.add_argument("--output", required=True, metavar="OUT.blend", help="of several files or a folder: a folder")
    parser.add_argument("--report", metavar="OUT.json")
    many = parser.add_argument_group("of several files or a folder")
    many.add_argument("--workers", metavar="N", help="files at a time; default: one for each core")
    many.add_argument("--time-limit", metavar="SECONDS", help="for a file")
    many.add_argument("--retry", action="store_true", help="try files again that could not be mapped")
    parser.add_argument("--end-with-input", action="store_true", help=argparse.SUPPRESS)  # for koebe batch
    parser.add_argument(
        "--objects", action="append", metavar="A,B,...",
        help='default: all meshes of the scene. May be repeated; a name with commas in quotes: \'"A, B",C\'',
    )  # fmt: skip
    parser.add_argument(
        "--parts", action="store_true", help="cut into parts, any surface; without --even as even as angles allow"
    )
    parser.add_argument(
        "--domain", choices=(DISK, *DOMAINS), default=DISK,
        help="; ".join(f"{name}: {domain.title}" for name, domain in DOMAINS.items()),
    )  # fmt: skip
    parser.add_argument(
        "--sequence", choices=ROWS["source"].words, help="a map of each frame or shape key, laid over the first"
    )
    parser.add_argument("--frames", metavar="A:B[:STEP]", help="of --sequence FRAMES; default: the scene's")
    parser.add_argument(
        "--sequence-target", choices=[target.lower() for target in ROWS["target"].words],
        help="where the UVs of each shape are stored; default: attribute, a vector attribute",
    )  # fmt: skip
    for row in ROWS.values():
        if row.is_flag and row.name not in OWN_FLAGS:
            _add_option(parser, row)
    values = vars(parser.parse_args(arguments))
    files = {name: values.pop(name) for name in ("sources", "output", "report")}
    batch = _words({name: values.pop(name) for name in ("workers", "time_limit", "retry")})
    ends_with_input = values.pop("end_with_input")
    each = _words({name: value for name, value in values.items() if value != parser.get_default(name)})
    names = values.pop("objects")
    given = {name for name, value in values.items() if value != parser.get_default(name)}
    sequence = _sequence_choice({name: values.pop(name) for name in OF_SEQUENCES}, given)
    given -= {*OF_SEQUENCES}
    parts, domain = values.pop("parts"), values.pop("domain")
    of, asked = ("parts", "--parts") if parts else (domain, f"--domain {domain}")
    _refuse_others("uniformize" if of == DISK else of, asked, given)
    if values["center"] is not None and values["balance"] == "area":
        raise Stop(USAGE, "--center excludes --balance area: both choose the centre of the disk")
    try:
        choice = None if of == DISK else _choice(of, values)
        chosen = options.Options(**_known(options.Options, values))
    except options.OptionError as error:
        raise _wrong(error) from None
    except UnicodeError as error:
        raise Stop(USAGE, error) from None
    return Request(
        **files, names=None if names is None else _split(names), options=chosen, parts=choice if parts else None,
        domain=None if parts else choice, sequence=sequence, library=Library(batch, each),
        ends_with_input=ends_with_input,
    )  # fmt: skip


def _add_option(parser: argparse.ArgumentParser, row: Row) -> None:
    """A flag for a row. Options that not all disk maps have, or that two flags choose, are None unless given."""
    by_kind: dict[str, dict[str, Any]] = {
        "flag": {"action": argparse.BooleanOptionalAction},
        "integer": {"type": _whole_number, "metavar": "N"},
        "number": {"type": float, "metavar": row.unit or "NUMBER"},
        "loop": {"type": _outer_loop, "metavar": row.unit},
        "vertex": {"type": _whole_number, "metavar": row.unit},
        "choice": {"choices": row.words},
    }
    default = row.default if "uniformize" in row.maps and row.name not in OF_TWO else None
    of = "" if "uniformize" in row.maps else f"of {', '.join(row.maps)}: "
    said = "" if row.kind == "vertex" else f"; default: {row.default}"
    how = by_kind.get(row.kind, {"metavar": "NAME"})
    parser.add_argument(flag(row.name), default=default, help=f"{of}{row.does}{said}".replace("%", "%%"), **how)


def _refuse_others(of: str, asked: str, given: set[str]) -> None:
    """Refuse options of another map as wrong usage."""
    known = {row.name for row in rows_of(of)} | {"parts" if of == "parts" else "domain"}
    for name in sorted(given - known):
        only_parts = name in ROWS and ROWS[name].maps == ["parts"]
        raise Stop(USAGE, f"{flag(name)} needs --parts" if only_parts else f"{flag(name)} does not work with {asked}")


def _known(kind: Any, values: dict[str, Any]) -> dict[str, Any]:
    """The given values that a choice has."""
    names = {field.name for field in dataclasses.fields(kind)} & set(values)
    return {name: values[name] for name in names if values[name] is not None}


def _choice(of: str, values: dict[str, Any]) -> Any:
    """The choice for parts or for a domain. Raises OptionError."""
    kind = options.PartsChoice if of == "parts" else DOMAINS[of].choice
    own = {"keep_angles": values["even"] is None} if of == "parts" else {}
    return kind(**own, **_known(kind, values))


def _wrong(error: options.OptionError) -> Stop:
    """A Stop for an option with a wrong value."""
    return Stop(USAGE, f"{flag(error.option)}: {error.reason}")


def _sequence_choice(own: dict[str, Any], given: set[str]) -> options.SequenceChoice | None:
    """The choice for a sequence, or None without one."""
    source, frames, target, play = (own[name] for name in OF_SEQUENCES)
    for name in () if source == "FRAMES" else ("frames", "play"):
        if own[name] is not None:
            raise Stop(USAGE, f"{flag(name)} needs --sequence FRAMES")
    if source is None:
        if target is not None:
            raise Stop(USAGE, f"{flag('sequence_target')} needs --sequence")
        return None
    known = {row.name for row in rows_of("sequence")} | {*OF_SEQUENCES}
    for name in sorted(given - known):
        raise Stop(USAGE, f"{flag(name)} does not work with --sequence")
    try:
        found = None if frames is None else _frame_range(frames)
        return options.SequenceChoice(source, found, (target or "attribute").upper(), play is not False)
    except options.OptionError as error:
        raise _wrong(error) from None


def _frame_range(text: str) -> range:
    """The frames A:B or A:B:STEP, including B."""
    try:
        first, last, step = (int(word) for word in (*text.split(":"), "1")[:3])
        if text.count(":") not in (1, 2) or step < 1:
            raise ValueError
    except ValueError:
        raise Stop(USAGE, f"--frames {text}: not A:B or A:B:STEP, whole numbers with a step from 1 on") from None
    if max(abs(first), abs(last)) > LARGEST_FRAME:
        raise Stop(USAGE, f"--frames {text}: Blender's frames are from -{LARGEST_FRAME} to {LARGEST_FRAME}")
    return range(first, last + 1, step)


def _words(values: dict[str, Any]) -> list[str]:
    """Options as written on a command line, without those that are None."""
    words = []
    for name, value in values.items():
        dashed = name.replace("_", "-")
        if isinstance(value, bool):
            words += [f"--{dashed}"] if value else [] if name == "retry" else [f"--no-{dashed}"]
        elif value is not None:
            words += [f"--{dashed}={one}" for one in (value if isinstance(value, list) else [value])]
    return words


def _whole_number(text: str) -> int:
    if not (text.isascii() and text.isdigit() and int(text) <= LARGEST):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0 to {LARGEST}")
    return int(text)


def _outer_loop(text: str) -> str | int:
    return text if text in ("auto", "longest") else _whole_number(text)


def _split(texts: list[str]) -> list[str]:
    """The names in the values of --objects, separated by commas outside double quotes, as in a CSV file."""
    try:
        names = [name for text in texts for name in next(csv.reader([text], strict=True), None) or [""]]
    except csv.Error as error:
        raise Stop(USAGE, f"--objects: {error}") from None
    if "" in names:
        raise Stop(USAGE, "--objects: a name is empty")
    return names
