# SPDX-License-Identifier: GPL-3.0-or-later
"""Many small surfaces at once: surfaces a second a core, and what processes and Dask cost.

Usage: many_surfaces.py [COUNT=10000] [FILES=COUNT]     with the packages of `make build/venv-labs/.done`

The surfaces are atria (atrium_templates.py), bodies with five tubes, each bent in its own way. COUNT of them are
mapped as arrays: on one thread, on a thread for each core, and as tasks of Dask, 100 atria in each. Dask gives its
workers a threshold below which freed memory stays with them (MALLOC_TRIM_THRESHOLD_): the first row of Dask has that,
the second one a higher one. FILES of them are mapped as files, by `koebe.batch` with Dask. Rows that are there to
compare take 1,000 at most. A row has the time that passed, the processor time of all
processes together, which other work on the machine changes less, and the peak memory of one process that maps.
"""

import concurrent.futures
import json
import os
import resource
import sys
import tempfile
import time
from pathlib import Path

import dask
import distributed
import koebe
import numpy as np
from atrium_templates import atrium

CORES = os.cpu_count() or 1
FEW = 1000  # surfaces of a row that is there to compare
AT_A_TIME = 100  # surfaces of a task of Dask
# Bytes. Workers keep freed memory up to these. With the lower ones of Dask each surface gets its memory anew.
KEPT = {"MALLOC_TRIM_THRESHOLD_": 2**28, "MALLOC_MMAP_THRESHOLD_": 2**25}
WAVES = 6  # of a bend


def bent(vertices, seed):
    """The surface moved along waves of random directions and phases: smooth, by a tenth of its size."""
    random = np.random.default_rng(seed)
    result = vertices.copy()
    for _ in range(WAVES):
        wave = vertices @ random.normal(scale=1.5, size=3) + random.uniform(0, 2 * np.pi)
        result += np.outer(np.sin(wave), random.normal(scale=0.04, size=3))
    return result


def is_mapped(vertices, triangles, seed):
    """Maps an atrium on one thread. Returns whether its map is finished and no face is flipped."""
    found = koebe.uniformize(bent(vertices, seed), triangles, threads=1)
    return found.converged and found.flipped == 0


def map_some(vertices, triangles, seeds):
    """A task of Dask: the mapped surfaces, and the largest memory of its worker in MB."""
    mapped = sum(is_mapped(vertices, triangles, seed) for seed in seeds)
    return mapped, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def used():
    """Processor seconds of this process and of its ended children."""
    own, others = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return own.ru_utime + own.ru_stime + others.ru_utime + others.ru_stime


def measured(name, count, work):
    """Prints the row of a way to map `count` surfaces. `work` returns the mapped ones and the memory in MB."""
    began, before = time.perf_counter(), used()
    mapped, memory = work()
    seconds, processor = time.perf_counter() - began, used() - before
    figures = f"{seconds:.1f} | {processor:.1f} | {count / processor:.1f} | {memory:.0f}"
    print(f"| {name} | {count:,} | {mapped:,} | {figures} |", flush=True)


def with_dask(work, kept=KEPT):
    """Calls work(client) between the start and the end of a cluster, with a worker for each core.

    The workers' processes are children of this process, whose time counts once they have ended.
    """
    before = dict(os.environ)  # Dask sets its workers' variables here
    with (
        dask.config.set({f"distributed.nanny.pre-spawn-environ.{name}": size for name, size in kept.items()}),
        distributed.LocalCluster(n_workers=CORES, threads_per_worker=1, dashboard_address=None) as workers,
        distributed.Client(workers) as client,
    ):
        result = work(client)
    os.environ.clear()
    os.environ.update(before)
    return result


def of_arrays(vertices, triangles, count):
    """Ways to map arrays."""
    few = min(count, FEW)
    here = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024  # noqa: E731
    measured("one thread", few, lambda: (sum(is_mapped(vertices, triangles, seed) for seed in range(few)), here()))

    def by_threads():
        with concurrent.futures.ThreadPoolExecutor(CORES) as pool:
            return sum(pool.map(lambda seed: is_mapped(vertices, triangles, seed), range(count))), here()

    def by_dask(client, count):
        mesh = [client.scatter(array, broadcast=True) for array in (vertices, triangles)]
        parts = [range(k, min(k + AT_A_TIME, count)) for k in range(0, count, AT_A_TIME)]
        found = client.gather([client.submit(map_some, *mesh, part, pure=False) for part in parts])
        return sum(mapped for mapped, _ in found), max(memory for _, memory in found)

    measured(f"{CORES} threads", count, by_threads)
    measured(f"Dask, {CORES} workers", few, lambda: with_dask(lambda client: by_dask(client, few), {}))
    measured("Dask, freed memory is kept", count, lambda: with_dask(lambda client: by_dask(client, count)))


def of_files(vertices, triangles, count):
    """Ways to map files."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder) / "atria"
        home.mkdir()
        faces = "".join(f"f {a} {b} {c}\n" for a, b, c in triangles + 1)
        text = "v %.6g %.6g %.6g\n" * len(vertices)
        for seed in range(count):
            (home / f"{seed:05}.obj").write_text(text % tuple(bent(vertices, seed).ravel()) + faces)

        def work(name, files, client=None):
            rows = koebe.batch(files, Path(folder) / name, base=home, threads=1, scheduler=client)
            reports = [(Path(folder) / name / row["name"]).with_suffix(".json") for row in rows[:FEW]]
            mapped = sum(row["exit_code"] == 0 and row["flipped"] == 0 for row in rows)
            return mapped, max(json.loads(report.read_text())["peak_memory_mb"] for report in reports)

        few = sorted(home.iterdir())[:FEW]
        measured("`koebe.batch`", len(few), lambda: work("alone", few))
        measured("`koebe.batch` with Dask", count, lambda: with_dask(lambda client: work("dask", home, client)))


def main():
    words = [int(word) for word in sys.argv[1:]] or [10000]
    count, files = words[0], words[-1]
    vertices, triangles, _ = atrium()
    print(f"{len(triangles):,} faces an atrium, {CORES} cores")
    print("| way | surfaces | mapped | seconds | processor seconds | surfaces a processor second | MB a process |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    measured("Dask, nothing to map", 0, lambda: with_dask(lambda client: (0, 0)))
    of_arrays(vertices, triangles, count)
    of_files(vertices, triangles, files)


if __name__ == "__main__":
    main()
