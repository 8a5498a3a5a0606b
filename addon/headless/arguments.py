# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of the batch script: what is out of range is wrong usage, said in one line."""

import argparse
import csv
import dataclasses
from typing import Any, NoReturn

from ..maps import options
from .exit_and_signals import USAGE, Stop
from .flags import flag

LARGEST = 2**31 - 1  # of the native module's whole numbers
LARGEST_FRAME = 1048574  # that Blender has
CHECKER_SIZES = (1e-3, 1e6)  # squares across the UV square that a 32-bit texture coordinate can tell apart
DISK = "disk"
OF_DOMAINS = ("domain", "holes", "fit", "layout", "normalization")
OF_PARTS = ("parts", "evenness", "seams", "write_seams")
WRITTEN = {"layer", "checker", "checker_size", "checker_even"}  # of all but sequences
OF_ALL = {"tolerance", "max_sweeps", "most_lost", "threads", *WRITTEN}  # of every domain
OF_SEQUENCES = ("sequence", "frames", "sequence_target", "play")
NOT_OF_SEQUENCES = ("parts", "domain", "engine", "tube", "symmetry", "placement", "checker_size", "checker_even")
IN_BLENDER = "blender -b IN.blend --python-exit-code 1 -P batch.py -- --output OUT.blend [options]"
WITH_BPY = "python batch.py IN.blend -- --output OUT.blend [options]"


@dataclasses.dataclass(frozen=True)
class Library:
    """What a run on many files takes beside: `batch` are words of `koebe batch`, `each` those of a run on one file."""

    batch: list[str]
    each: list[str]


@dataclasses.dataclass(frozen=True)
class Request:
    """What to do: files as they were given, names of objects or None for all, and the options of the map.

    parts     of a cut into parts, else None
    domain    of a map that is to no disk, else None
    sequence  of maps of frames or shape keys, else None
    """

    sources: list[str]
    output: str
    report: str | None
    names: list[str] | None
    options: options.Options
    parts: options.PartsChoice | None
    domain: options.OtherDomain | None
    sequence: options.SequenceChoice | None
    library: Library
    ends_with_input: bool


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise Stop(USAGE, message)


def parse(arguments: list[str]) -> Request:
    """The request. Raises Stop if it is wrong; ends the program after --help."""
    default = options.Options()
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
    parser.add_argument("--end-with-input", action="store_true", help=argparse.SUPPRESS)  # said by koebe batch
    parser.add_argument(
        "--objects", action="append", metavar="A,B,...",
        help='default: all meshes of the scene. May be repeated; a name with commas in quotes: \'"A, B",C\'',
    )  # fmt: skip
    parser.add_argument("--parts", action="store_true", help="cut into even parts, any surface")
    parser.add_argument("--evenness", type=float, metavar="0..1", help="of --parts: 0 few, 1 as even as can be")
    parser.add_argument("--seams", choices=options.SEAMS, help="of --parts: cuts beside the seams, or only these")
    parser.add_argument(
        "--write-seams", action=argparse.BooleanOptionalAction, help="of --parts: make seams of its cuts"
    )
    parser.add_argument(
        "--domain", choices=(DISK, *options.CHOICES), default=DISK,
        help="torus, ring: UVs that are a tile; sphere: its layout; schottky: handles cut open",
    )  # fmt: skip
    parser.add_argument("--holes", choices=options.HOLES, help="of --domain ring")
    parser.add_argument("--fit", choices=options.FITS, help="of --domain torus and ring")
    parser.add_argument("--layout", choices=options.LAYOUTS, help="of --domain sphere")
    parser.add_argument("--normalization", choices=options.NORMALIZATIONS, help="of --domain schottky")
    parser.add_argument(
        "--sequence", choices=options.SEQUENCE_SOURCES, help="a map of each frame or shape key, laid over the first"
    )
    parser.add_argument("--frames", metavar="A:B[:STEP]", help="of --sequence FRAMES; default: the scene's")
    parser.add_argument(
        "--sequence-target", choices=[target.lower() for target in options.SEQUENCE_TARGETS],
        help="what holds the UVs of each shape; default: attribute, a vector attribute",
    )  # fmt: skip
    parser.add_argument(
        "--play", action=argparse.BooleanOptionalAction,
        help="of --sequence FRAMES: show the frames in the UV layer, by a modifier; default: yes",
    )  # fmt: skip
    parser.add_argument("--method", choices=options.METHODS, default=default.method)
    parser.add_argument("--engine", choices=options.ENGINES, default=default.engine)
    parser.add_argument(
        "--cut", action=argparse.BooleanOptionalAction, default=default.cut,
        help="open, cut and split in the UVs what cannot be mapped as it is; default: yes",
    )  # fmt: skip
    parser.add_argument("--outer", type=_outer_loop, default=default.outer, metavar="auto|longest|VERTEX")
    for name in ("--center", "--point"):
        parser.add_argument(name, type=_whole_number, metavar="VERTEX", help="of each object")
    parser.add_argument("--tolerance", type=float, default=default.tolerance)
    parser.add_argument("--max-sweeps", type=_whole_number, default=default.max_sweeps)
    parser.add_argument(
        "--most-lost", type=float, default=default.most_lost, metavar="SHARE",
        help="of the area that may have no area in the UVs; default: 0.01. With more of it parts and other domains are "
        "not done",
    )  # fmt: skip
    parser.add_argument("--balance", choices=options.BALANCES)
    parser.add_argument(
        "--importance", default=default.importance, metavar="GROUP", help="vertex group that weighs the balance"
    )
    parser.add_argument("--polish", action=argparse.BooleanOptionalAction, default=default.polish)
    parser.add_argument("--threads", type=_whole_number, default=default.threads, help="0: all cores")
    parser.add_argument("--upright", action=argparse.BooleanOptionalAction, default=default.upright)
    parser.add_argument("--symmetry", choices=options.SYMMETRIES, default=default.symmetry)
    parser.add_argument("--tube", choices=options.TUBES, default=default.tube)
    parser.add_argument("--layer", default=default.layer, help="UV layer to write")
    parser.add_argument("--placement", choices=options.PLACEMENTS, default=default.placement)
    parser.add_argument("--margin", type=float, default=default.margin, help="between islands, in UV units")
    parser.add_argument("--checker", action=argparse.BooleanOptionalAction, default=default.checker)
    parser.add_argument("--checker-size", type=_checker_size, default=default.checker_size, metavar="SQUARES")
    parser.add_argument("--checker-even", action=argparse.BooleanOptionalAction, default=default.checker_even)
    values = vars(parser.parse_args(arguments))
    files = {name: values.pop(name) for name in ("sources", "output", "report")}
    batch = _words({name: values.pop(name) for name in ("workers", "time_limit", "retry")})
    ends_with_input = values.pop("end_with_input")
    each = _words({name: value for name, value in values.items() if value != parser.get_default(name)})
    names = values.pop("objects")
    given = {name for name, value in values.items() if value != parser.get_default(name)}
    sequence = _sequence_choice({name: values.pop(name) for name in OF_SEQUENCES}, given)
    if sequence is not None:
        values["checker"] = False
    parts = _parts_choice({name: values.pop(name) for name in OF_PARTS}, values, given)
    domain = _domain_choice({name: values.pop(name) for name in OF_DOMAINS}, values, given)
    if values["center"] is not None and values["balance"] == "area":
        raise Stop(USAGE, "--center excludes --balance area: both choose the centre of the disk")
    for name in ("center", "point", "balance"):
        if values[name] is None:
            values[name] = getattr(default, name)
    try:
        chosen = options.Options(**values)
    except options.OptionError as error:
        raise _wrong(error) from None
    except UnicodeError as error:
        raise Stop(USAGE, error) from None
    return Request(
        **files, names=None if names is None else _split(names), options=chosen, parts=parts, domain=domain,
        sequence=sequence, library=Library(batch, each), ends_with_input=ends_with_input,
    )  # fmt: skip


def _wrong(error: options.OptionError) -> Stop:
    """The end because an option cannot have its value."""
    return Stop(USAGE, f"{flag(error.option)}: {error.reason}")


def _parts_choice(own: dict[str, Any], values: dict[str, Any], given: set[str]) -> options.PartsChoice | None:
    """What is asked for of parts, or None without them."""
    if not own.pop("parts"):
        for name in own:
            if own[name] is not None:
                raise Stop(USAGE, f"{flag(name)} needs --parts")
        return None
    for name in sorted(given - WRITTEN - {*OF_PARTS, "most_lost", "objects"}):
        raise Stop(USAGE, f"{flag(name)} is not of --parts")
    try:
        asked = {name: value for name, value in own.items() if value is not None}
        return options.PartsChoice(**asked, most_lost=values["most_lost"])
    except options.OptionError as error:
        raise _wrong(error) from None


def _sequence_choice(own: dict[str, Any], given: set[str]) -> options.SequenceChoice | None:
    """What is asked for of a sequence, or None without one."""
    source, frames, target, play = (own[name] for name in OF_SEQUENCES)
    for name in () if source == "FRAMES" else ("frames", "play"):
        if own[name] is not None:
            raise Stop(USAGE, f"{flag(name)} needs --sequence FRAMES")
    if source is None:
        if target is not None:
            raise Stop(USAGE, f"{flag('sequence_target')} needs --sequence")
        return None
    for name in NOT_OF_SEQUENCES:
        if name in given:
            raise Stop(USAGE, f"{flag(name)} is not of --sequence")
    try:
        found = None if frames is None else _frame_range(frames)
        return options.SequenceChoice(source, found, (target or "attribute").upper(), play is not False)
    except options.OptionError as error:
        raise _wrong(error) from None


def _frame_range(text: str) -> range:
    """The frames A:B or A:B:STEP, B among them."""
    try:
        first, last, step = (int(word) for word in (*text.split(":"), "1")[:3])
        if text.count(":") not in (1, 2) or step < 1:
            raise ValueError
    except ValueError:
        raise Stop(USAGE, f"--frames {text}: not A:B or A:B:STEP, whole numbers with a step from 1 on") from None
    if max(abs(first), abs(last)) > LARGEST_FRAME:
        raise Stop(USAGE, f"--frames {text}: Blender's frames are from -{LARGEST_FRAME} to {LARGEST_FRAME}")
    return range(first, last + 1, step)


def _domain_choice(own: dict[str, Any], values: dict[str, Any], given: set[str]) -> options.OtherDomain | None:
    """What is asked for of a domain, or None for a disk; options of another domain are wrong usage."""
    domain = own["domain"]
    known = {
        DISK: set(values), "torus": {"fit"}, "ring": {"holes", "fit"}, options.SPHERE: {"layout"},
        options.SCHOTTKY: {"normalization"},
    }[domain]  # fmt: skip
    others = {*own, *values} - known - OF_ALL - {"domain"}
    for name in sorted(given & others):
        raise Stop(USAGE, f"{flag(name)} is not of --domain {domain}")
    if domain == DISK:
        return None
    try:
        asked = {name: value for name, value in own.items() if value is not None}
        asked.update({name: values[name] for name in ("tolerance", "max_sweeps", "most_lost")})
        if domain not in options.TILE_DOMAINS:
            del asked["domain"]
        return options.CHOICES[domain](**asked)
    except options.OptionError as error:
        raise _wrong(error) from None


def _words(values: dict[str, Any]) -> list[str]:
    """Options as they are written on a command line; those that are None are left out."""
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


def _checker_size(text: str) -> float:
    least, most = CHECKER_SIZES
    if not least <= float(text) <= most:
        raise argparse.ArgumentTypeError(f"{text} is not from {least:g} to {most:g}")
    return float(text)


def _split(texts: list[str]) -> list[str]:
    """The names in the values of --objects: commas divide them, except in double quotes, as in a CSV file."""
    try:
        names = [name for text in texts for name in next(csv.reader([text], strict=True), None) or [""]]
    except csv.Error as error:
        raise Stop(USAGE, f"--objects: {error}") from None
    if "" in names:
        raise Stop(USAGE, "--objects: a name is empty")
    return names
