"""A job array on a Slurm that runs here: one node lost half way, every file done once, and the throughput."""

import os
import shutil
import time

import pytest
from conftest import COMMAND, FILES, ROOT, contents, koebe
from slurm_cluster import Cluster

SCRIPT = ROOT / "scripts" / "farms" / "slurm_array.sh"
IN_ELEMENT = 5  # files

pytestmark = pytest.mark.skipif(
    not shutil.which("slurmctld", path=f"{os.environ['PATH']}:/usr/sbin"), reason="Slurm is not here"
)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    with Cluster(tmp_path_factory.mktemp("slurm") / "cluster") as cluster:
        yield cluster


def submit(cluster, library, results, tmp_path, *words):
    """Starts the array as the script's head says; the job's number."""
    listed = koebe("batch", library, "--output", results, "--list").stdout
    assert listed.count("\n") == FILES
    (tmp_path / "files.txt").write_text(listed)
    elements = -(-FILES // IN_ELEMENT)
    told = cluster.run(
        *("sbatch", f"--array=1-{elements}", f"--export=ALL,KOEBE={COMMAND},FILES={IN_ELEMENT}"),
        *("--output", tmp_path / "log-%a", SCRIPT, tmp_path / "files.txt", results, *words),
    )
    return told.split()[-1]


def is_over(cluster, job):
    return not cluster.run("squeue", "-h", "-j", job).strip()


def done_in(results):
    return sum(1 for path in results.rglob("*.json") if path.name != "summary.json") if results.exists() else 0


def test_forty_files_on_two_nodes_are_the_results_of_one_process(cluster, library, undisturbed, tmp_path):
    results, begin = tmp_path / "results", time.monotonic()
    job = submit(cluster, library, results, tmp_path)
    cluster.wait_for(lambda: is_over(cluster, job), 600)
    seconds = time.monotonic() - begin
    assert koebe("batch", library, "--output", results, "--summary-only").returncode == 0
    assert contents(results) == contents(undisturbed[0])
    told = "".join(path.read_text() for path in tmp_path.glob("log-*"))
    assert told.count(": done, ") == FILES - 1 and told.count(": failed, ") == 1
    alone = undisturbed[1]
    print(f"\n{FILES} files: one process {alone:.1f} s, two nodes {seconds:.1f} s, {alone / seconds:.2f} times as fast,"
          f" load {os.getloadavg()[0]:.1f}")  # fmt: skip


def test_a_node_that_is_lost_half_way_costs_nothing(cluster, library, undisturbed, tmp_path):
    results = tmp_path / "results"
    job = submit(cluster, library, results, tmp_path, "--stale", "5")
    cluster.wait_for(lambda: done_in(results) >= FILES // 2, 300)
    cluster.lose("n2")
    at_loss = done_in(results)
    cluster.wait_for(lambda: is_over(cluster, job), 600)
    assert FILES // 2 <= at_loss < FILES
    assert koebe("batch", library, "--output", results, "--summary-only").returncode == 0
    assert contents(results) == contents(undisturbed[0])
    told = "".join(path.read_text() for path in tmp_path.glob("log-*"))
    settled = [line.split("] ")[1].split(":")[0] for line in told.splitlines() if ": done, " in line]
    assert len(settled) == len(set(settled)) == FILES - 1, "a file was done twice, or not at all"
