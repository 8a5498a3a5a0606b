"""Random calls on random files: what does not finish changes nothing, what does only what the guide says it touches.

More of them: KOEBE_RANDOM_RUNS=300 in the environment, and KOEBE_RANDOM_FIRST, the number of the first.
"""

import os

import pytest
from random_runs import RandomRun

pytestmark = pytest.mark.alike

COUNT = int(os.environ.get("KOEBE_RANDOM_RUNS", "12"))
FIRST = int(os.environ.get("KOEBE_RANDOM_FIRST", "0"))
CALLS = 8


@pytest.mark.parametrize("seed", range(FIRST, FIRST + COUNT))
def test_only_what_the_guide_says(folder, tmp_path, seed):
    run = RandomRun(folder, tmp_path, seed)
    run.go(CALLS)
    print(f"Random run {seed}: {run.calls} calls, {run.finished} finished, {run.faults} faults")
    assert run.wrong == []
