# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands run with the processor time they took, which other work on the machine changes less than the time that
passed."""

import resource
import subprocess


def run_timed(command, limit):
    """The finished command and its processor seconds; None if it was stopped after `limit` seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def minutes(seconds):
    """As m:ss, or m:ss.s where that says too little."""
    if seconds < 9.95:
        return f"0:0{seconds:.1f}"
    return f"{int(seconds + 0.5) // 60}:{int(seconds + 0.5) % 60:02d}"
