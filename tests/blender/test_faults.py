"""An operator that is broken off at any step leaves everything as it was; an object's own failure leaves that object.

All lines instead of a choice: KOEBE_EVERY_STEP=lines in the environment; each time that they run: =1.
"""

import faults
import pytest
from runs import RUNS, operator

MOST = 25  # steps at which an operator is broken off


@pytest.mark.parametrize("run", RUNS)
def test_what_is_broken_off_leaves_everything_as_it_was(folder, koebe, run):
    build, name, options = RUNS[run]
    with faults.remembered_maps(koebe):
        faults.check_all_comes_back(folder, build, operator(name), options, MOST)


@pytest.mark.parametrize("run", [
    "uniformize", "torus", "ring in Edit Mode", "checker off", "distortion changed", "fill", "carry",
])  # fmt: skip
@pytest.mark.alike
def test_an_error_is_that_of_one_object(folder, koebe, run):
    build, name, options = RUNS[run]
    with faults.remembered_maps(koebe):
        faults.check_each_for_itself(folder, build, operator(name), options, MOST // 2)
