# SPDX-License-Identifier: GPL-3.0-or-later
"""Many small surfaces at once: surfaces a second a core, and what processes and Dask cost.

Usage: many_surfaces.py [COUNT=10000] [FILES=200]     with the packages of `make build/venv-labs/.done`

The surfaces are atria (atrium_templates.py), bodies with five tubes, each bent in its own way. COUNT of them are
mapped as arrays: on one thread, on a thread for each core, and as tasks of Dask, 20 atria in each. FILES of them are
mapped as files, by `koebe.batch` alone and with Dask. A row has the time that passed, the processor time of all
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

import distributed
import koebe
import numpy as np
from atrium_templates import atrium

CORES = os.cpu_count() or 1
AT_A_TIME = 20  # surfaces of a task of Dask
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


def cluster():
    """A worker for each core. Its processes are children of this process, whose time counts once they have ended."""
    return distributed.LocalCluster(n_workers=CORES, threads_per_worker=1, dashboard_address=None)


def with_dask(work):
    """Calls work(client) between the start and the end of a cluster."""
    with cluster() as workers, distributed.Client(workers) as client:
        return work(client)


def of_arrays(vertices, triangles, count):
    """Ways to map arrays."""
    seeds = range(count)
    some = range(min(count, 500))  # on one thread
    here = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024  # noqa: E731
    measured("one thread", len(some), lambda: (sum(is_mapped(vertices, triangles, seed) for seed in some), here()))

    def by_threads():
        with concurrent.futures.ThreadPoolExecutor(CORES) as pool:
            return sum(pool.map(lambda seed: is_mapped(vertices, triangles, seed), seeds)), here()

    measured(f"{CORES} threads", count, by_threads)

    def by_dask(client):
        mesh = [client.scatter(array, broadcast=True) for array in (vertices, triangles)]
        parts = [seeds[k : k + AT_A_TIME] for k in range(0, count, AT_A_TIME)]
        found = client.gather([client.submit(map_some, *mesh, part, pure=False) for part in parts])
        return sum(mapped for mapped, _ in found), max(memory for _, memory in found)

    measured(f"Dask, {CORES} workers", count, lambda: with_dask(by_dask))


def of_files(vertices, triangles, count):
    """Ways to map files."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder) / "atria"
        home.mkdir()
        faces = "".join(f"f {a} {b} {c}\n" for a, b, c in triangles + 1)
        for seed in range(count):
            points = "".join(f"v {x:.6g} {y:.6g} {z:.6g}\n" for x, y, z in bent(vertices, seed))
            (home / f"{seed:05}.obj").write_text(points + faces)

        def work(name, client=None):
            rows = koebe.batch(home, Path(folder) / name, threads=1, scheduler=client)
            reports = [json.loads(path.read_text()) for path in (Path(folder) / name).rglob("[0-9]*.json")]
            mapped = sum(row["exit_code"] == 0 and row["flipped"] == 0 for row in rows)
            return mapped, max(report["peak_memory_mb"] for report in reports)

        measured("`koebe.batch`", count, lambda: work("alone"))
        measured("`koebe.batch` with Dask", count, lambda: with_dask(lambda client: work("dask", client)))


def main():
    count, files = (int(word) for word in (sys.argv[1:] + ["10000", "200"][len(sys.argv) - 1 :])[:2])
    vertices, triangles, _ = atrium()
    print(f"{len(triangles):,} faces an atrium, {CORES} cores")
    print("| way | surfaces | mapped | seconds | processor seconds | surfaces a processor second | MB a process |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    measured("Dask, nothing to map", 0, lambda: with_dask(lambda client: (0, 0)))
    of_arrays(vertices, triangles, count)
    of_files(vertices, triangles, files)


if __name__ == "__main__":
    main()
