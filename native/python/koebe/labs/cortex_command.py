"""koebe cortex SUBJECT HEMISPHERE OUT: the command for `koebe.cortex`."""

import argparse
import contextlib
import inspect
import json
import time
from collections.abc import Sequence
from pathlib import Path

from .._conversion import ended
from .._option_table import DONE, NOT_CONVERGED
from ..io.files import whole_file
from .cortex import cortex


def run(words: Sequence[str]) -> int:
    """The exit code of the command with these words behind its name."""
    even, darts = (inspect.signature(cortex).parameters[name].default for name in ("even", "darts"))
    parser = argparse.ArgumentParser(prog="koebe cortex", description="lay a hemisphere of the cortex flat")
    parser.add_argument("SUBJECT", help="folder of a subject of FreeSurfer or fMRIPrep, of pycortex's or nilearn's")
    parser.add_argument("HEMISPHERE", help="lh or rh, left or right")
    parser.add_argument("OUT", help="lh.NAME.flat.patch.3d, lh.NAME.patch.3d (cut, not flat), NAME.gii, ...")
    parser.add_argument("--surface", metavar="NAME", help="the surface that is mapped: white, ...")
    parser.add_argument("--region", metavar="FILE", help="label, annotation or GIfTI labels of the cortex")
    parser.add_argument("--cuts", metavar="FILE", help="a patch or flat map: of this subject, or beside its own sphere")
    parser.add_argument("--even", metavar="E", type=float, default=even, help="0: conformal, 1: true to size")
    parser.add_argument("--darts", metavar="DARTS", type=float, default=darts, help="how many cuts are found")
    parser.add_argument("--json", metavar="FILE", help="write the report there")
    parser.add_argument("--quiet", action="store_true", help="no result line")
    given = parser.parse_args(words)

    def work() -> int:
        begin = time.monotonic()
        flat = cortex(
            given.SUBJECT, given.HEMISPHERE, surface=given.surface, region=given.region, cuts=given.cuts,
            even=given.even, darts=given.darts,
        )  # fmt: skip
        with contextlib.ExitStack() as written:  # both files, or none
            if given.json:
                report = flat.map.to_dict() | {"input": Path(given.SUBJECT).name, "left_out": flat.left_out}
                file = written.enter_context(whole_file(given.json))
                file.write((json.dumps(report, indent=1, ensure_ascii=False) + "\n").encode())
            flat.write(given.OUT)
        done = flat.map.converged
        if not given.quiet:
            end = "" if done else ", not converged"
            print(f"{given.OUT}: {flat.figures}, {time.monotonic() - begin:.1f} s{end}")
        return DONE if done else NOT_CONVERGED

    return ended(work)
