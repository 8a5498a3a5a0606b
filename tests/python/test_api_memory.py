"""Scarce memory is a MemoryError, never an end of the process and never a wait without end."""

import sys

import pytest
from test_api_calls import run_script

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform != "linux", reason="the limit is on the addresses of a process of Linux"),
]

CALLS = {
    "uniformize": "koebe.uniformize(*mesh).uv",
    "uniformize, mesh": "koebe.uniformize(*mesh, engine='mesh').uv",
    "fill_holes, fair": "koebe.fill_holes(*mesh, loops=[1], fair=True)[0]",
    "annulus_map, yamabe": "koebe.annulus_map(*plate(24, 1), backend='yamabe')[0]",
    "boundary_loops": "koebe.boundary_loops(mesh[1])[0]",
    "match_loops": "koebe.match_loops(domain(100), domain(100))[2]",
}
# Of addresses, in MB: none for the thread, few beside it, enough.
ROOM = (0, 12, 16, 24, 139, 1000)


@pytest.mark.parametrize("name", CALLS)
def test_a_call_with_little_memory_has_a_result_or_a_memory_error(name):
    outcomes = []
    for room in ROOM:
        run = run_script(f"""
            import resource
            mesh = plate(32, 2)
            with open("/proc/self/statm") as file:
                limit = int(file.read().split()[0]) * resource.getpagesize() + ({room} << 20)
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
            try:
                print(np.isfinite({CALLS[name]}).all())
            except MemoryError as error:
                print("MemoryError")
            except koebe.SolverError as error:
                print("SolverError")
        """)
        assert (run.returncode, run.stderr) == (0, ""), (room, run)
        outcomes.append(run.stdout.strip())
    if name != "boundary_loops":  # its few indices fit into what the process has already
        assert outcomes[0] == "MemoryError"
    assert outcomes[-1] == "True"
    assert set(outcomes) <= {"MemoryError", "SolverError", "True"}


def test_sizes_beyond_any_memory_are_errors():
    run = run_script("""
        far = np.broadcast_to(np.zeros(3), (2**40, 3)), np.broadcast_to(np.arange(3), (2**40, 3))
        for call in (koebe.uniformize, koebe.distortion, koebe.fill_holes):
            arguments = (*far, far[0][:, :2]) if call is koebe.distortion else far
            try:
                call(*arguments)
            except MemoryError:
                print("MemoryError")
    """)
    assert (run.returncode, run.stdout, run.stderr) == (0, 3 * "MemoryError\n", "")
