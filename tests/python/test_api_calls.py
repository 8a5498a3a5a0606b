"""Calls of the package: other threads, Ctrl-C, callbacks, tokens, and the end of the interpreter."""

import contextlib
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import koebe
import numpy as np
import pytest
from test_package import FACES, VERTICES

HERE = Path(__file__).resolve().parent


def plate(cells, holes=4):
    """A square of cells x cells squares, each cut in two, with holes x holes square holes, bent a little."""
    i, j = np.meshgrid(np.arange(cells), np.arange(cells), indexing="ij")
    period, width = cells // holes, cells // (3 * holes)
    inside = (i % period >= width) & (i % period < 2 * width) & (j % period >= width) & (j % period < 2 * width)
    corner = (i * (cells + 1) + j)[~inside]
    quads = np.stack([corner, corner + cells + 1, corner + cells + 2, corner + 1], axis=1)
    used, quads = np.unique(quads, return_inverse=True)
    x, y = used // (cells + 1) / cells, used % (cells + 1) / cells
    quads = quads.reshape(-1, 4)
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.int32)
    return np.stack([x, y, 0.2 * np.sin(3 * x) * np.cos(2 * y)], axis=1), faces


SMALL = plate(24, 2)
LARGE = plate(160)  # 45,000 faces, half a second


def run_script(text, timeout=120, **options):
    """A Python process of its own with the functions of this file."""
    script = "from test_api_calls import *\n" + textwrap.dedent(text)
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join([str(HERE), *sys.path]))
    return subprocess.run(
        [sys.executable, "-X", "faulthandler", "-c", script],
        capture_output=True, text=True, timeout=timeout, env=environment, **options,
    )  # fmt: skip


# ---------------------------------------------------------------- other threads


def test_eight_calls_at_once_are_as_one():
    meshes = [SMALL, (VERTICES, FACES)]
    alone = [koebe.uniformize(*mesh).uv for mesh in meshes]
    with ThreadPoolExecutor(8) as pool:
        together = [pool.submit(koebe.uniformize, *meshes[i % 2]) for i in range(32)]
    for i, one in enumerate(together):
        assert np.array_equal(one.result().uv, alone[i % 2])


def test_the_other_functions_at_once_are_as_one():
    rim = np.concatenate(koebe.boundary_loops(FACES))
    domain = koebe.uniformize(*SMALL)

    def all_of_them(_=0):
        return [
            *koebe.fill_holes(*SMALL), *koebe.fill_holes(VERTICES, FACES, fair=True),
            *koebe.annulus_map(VERTICES, FACES),
            koebe.harmonic_map(VERTICES, FACES, rim, VERTICES[rim, :2]),
            koebe.distortion(VERTICES, FACES, VERTICES[:, :2] / 2), koebe.conformal_module(domain),
            *koebe.match_loops(domain, domain), koebe.canonical_order(domain, any_outer=True),
            koebe.align_domains(domain, domain)(domain.uv), *koebe.boundary_loops(FACES),
        ]  # fmt: skip

    expected = all_of_them()
    with ThreadPoolExecutor(8) as pool:
        for found in pool.map(all_of_them, range(16)):
            for a, b in zip(found, expected, strict=True):
                assert a == b if isinstance(a, dict) else np.array_equal(a, b)


def test_another_thread_that_writes_into_the_arrays_does_no_harm():
    expected = koebe.uniformize(*SMALL).uv
    vertices, faces = (array.copy() for array in SMALL)
    stop = threading.Event()

    def scribble():
        while not stop.is_set():
            for array, noise in ((faces, 2**31 - 1), (vertices, np.nan), (faces, -(2**31)), (faces, 0)):
                array[:] = noise
            vertices[:], faces[:] = SMALL

    calls = {
        "uniformize": lambda: koebe.uniformize(vertices, faces).uv,
        "distortion": lambda: koebe.distortion(vertices, faces, vertices[:, :2]),
        "harmonic_map": lambda: koebe.harmonic_map(vertices, faces, [0, 1, 2], vertices[:3, :2]),
        "boundary_loops": lambda: koebe.boundary_loops(faces, vertex_count=len(vertices)),
        "fill_holes": lambda: koebe.fill_holes(vertices, faces),
        "fill_holes, fair": lambda: koebe.fill_holes(vertices, faces, fair=True),
    }
    writer = threading.Thread(target=scribble)
    switch = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    writer.start()
    try:
        for name, call in calls.items():
            for _ in range(30):
                try:
                    outcome = call()
                except koebe.KoebeError:
                    continue
                if name == "uniformize":
                    assert np.isfinite(outcome).all()
    finally:
        stop.set()
        writer.join()
        sys.setswitchinterval(switch)
    assert np.array_equal(koebe.uniformize(*SMALL).uv, expected)


def test_what_is_written_during_the_call_is_not_seen():
    expected = koebe.uniformize(*SMALL).uv
    vertices, faces = (array.copy() for array in SMALL)

    def scribble(fraction, stage):
        vertices[:] = np.nan
        faces[:] = -1

    assert np.array_equal(koebe.uniformize(vertices, faces, progress=scribble).uv, expected)


def test_the_interpreter_runs_on_during_a_call():
    ticks = []
    worker = threading.Thread(target=koebe.uniformize, args=LARGE)
    worker.start()
    while worker.is_alive():
        ticks.append(time.monotonic())
        time.sleep(0.001)
    assert len(ticks) > 20


# ---------------------------------------------------------------- Ctrl-C


class Interrupted(Exception):
    pass


@contextlib.contextmanager
def alarm(action):
    """Within it an action runs as the handler of a signal, every 20 ms."""
    before = signal.signal(signal.SIGALRM, lambda number, frame: action())
    signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_signal_handlers_run_while_a_call_computes():
    token = koebe.CancelToken()
    with pytest.raises(koebe.Cancelled), alarm(token.cancel):
        koebe.uniformize(*LARGE, cancel=token)  # a handler that ran after the map was made would change nothing


def domain(holes):
    """Circles on a grid that is not quite regular."""
    side = int(np.ceil(np.sqrt(holes)))
    k = np.arange(holes)
    centers = np.stack([k // side, k % side], axis=1) / (side - 1) * 1.3 - 0.65
    random = np.random.default_rng(1)
    found = type("Domain", (), {})()
    found.centers = np.vstack([[0.0, 0.0], centers + 0.02 / side * random.normal(size=centers.shape)])
    found.radii = np.concatenate([[1.0], (0.3 + 0.1 * random.random(holes)) / side])
    return found


LONG_CALLS = {
    "uniformize": lambda: partial(koebe.uniformize, *LARGE),
    "uniformize, mesh": lambda: partial(koebe.uniformize, *plate(80), engine="mesh"),
    "fill_holes, fair": lambda: partial(koebe.fill_holes, *plate(240, 1), loops=[1], fair=True),
    "annulus_map": lambda: partial(koebe.annulus_map, *plate(240, 1)),
    "disk_map": lambda: partial(koebe.disk_map, *koebe.fill_holes(*LARGE, loops=range(1, 17))[:2]),
    "harmonic_map": lambda: partial(koebe.harmonic_map, *plate(300), [0, 1, 2], np.eye(3, 2)),
    "match_loops": lambda: partial(koebe.match_loops, domain(1200), domain(1200)),
}


@pytest.mark.parametrize("name", LONG_CALLS)
def test_ctrl_c_ends_a_call_that_computes(name):
    call = LONG_CALLS[name]()
    ticks = []

    def third_time():
        ticks.append(1)
        if len(ticks) == 3:  # one may come before the call, and one is kept for after it
            raise Interrupted

    with pytest.raises(Interrupted), alarm(third_time):
        call()


@pytest.mark.slow
def test_a_true_ctrl_c_is_a_keyboard_interrupt_long_before_the_end():
    run = run_script("""
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell may have started this with it ignored
        mesh = plate(80)
        begin = time.monotonic()
        koebe.uniformize(*mesh, engine="mesh")
        whole = time.monotonic() - begin
        timer = threading.Timer(0.1 * whole, os.kill, (os.getpid(), signal.SIGINT))
        begin = time.monotonic()
        timer.start()
        try:
            koebe.uniformize(*mesh, engine="mesh")
        except KeyboardInterrupt:
            print(time.monotonic() - begin < 0.9 * whole, np.isfinite(koebe.uniformize(*SMALL).uv).all())
    """)
    assert (run.returncode, run.stdout, run.stderr) == (0, "True True\n", "")


# ---------------------------------------------------------------- progress and cancel


def test_what_a_progress_callback_raises_comes_out():
    class Own(BaseException):
        pass

    for error in (Own, KeyboardInterrupt, SystemExit, MemoryError, koebe.SolverError, StopIteration):
        for stage in ("topology", "factor", "iterate", "finish"):
            seen = []

            def stop(fraction, name, error=error, stage=stage, seen=seen):
                seen.append(name)
                if name == stage:
                    raise error

            with pytest.raises(error):
                koebe.uniformize(*SMALL, progress=stop)
            assert seen[-1] == stage and seen.count(stage) == 1


def test_a_callback_that_takes_other_arguments_is_an_error():
    with pytest.raises(TypeError):
        koebe.uniformize(*SMALL, progress=lambda: None)


def test_a_token_ends_a_call_before_it_begins_and_at_each_stage():
    raised = koebe.CancelToken()
    raised.cancel()
    assert raised.cancelled
    with pytest.raises(koebe.Cancelled):
        koebe.uniformize(*SMALL, cancel=raised)
    stages = []
    koebe.uniformize(*SMALL, progress=lambda fraction, stage: stages.append(stage))
    for wanted in dict.fromkeys(stages):
        token = koebe.CancelToken()
        with pytest.raises(koebe.Cancelled):
            koebe.uniformize(
                *SMALL,
                progress=lambda fraction, stage, wanted=wanted, token=token: stage == wanted and token.cancel(),
                cancel=token,
            )


def test_a_token_raised_after_the_end_changes_nothing():
    token = koebe.CancelToken()
    result = koebe.uniformize(*SMALL, cancel=token)
    token.cancel()
    assert np.array_equal(result.uv, koebe.uniformize(*SMALL, cancel=koebe.CancelToken()).uv)


def test_a_token_may_be_raised_by_any_thread_and_stop_many_calls():
    token = koebe.CancelToken()
    with ThreadPoolExecutor(8) as pool:
        calls = [pool.submit(koebe.uniformize, *LARGE, cancel=token) for _ in range(8)]
        time.sleep(0.05)
        token.cancel()
    assert all(isinstance(call.exception(), koebe.Cancelled) for call in calls)


def test_cancelled_calls_leave_nothing_that_changes_the_next():
    expected = koebe.uniformize(*SMALL).uv
    for delay in np.linspace(0.0, 0.05, 30):
        token = koebe.CancelToken()
        timer = threading.Timer(delay, token.cancel)
        timer.start()
        try:
            assert np.array_equal(koebe.uniformize(*SMALL, cancel=token).uv, expected)
        except koebe.Cancelled:
            assert token.cancelled
        timer.join()


def test_a_callback_may_call_again():
    expected = koebe.uniformize(VERTICES, FACES).uv
    inner = []

    def nested(fraction, stage, depth=0):
        if depth < 2 and stage == "factor":
            result = koebe.uniformize(VERTICES, FACES, progress=lambda f, s: nested(f, s, depth + 1))
            inner.append(result.uv)
            inner.append(koebe.fill_holes(VERTICES, FACES)[0])

    result = koebe.uniformize(*SMALL, progress=nested)
    assert np.array_equal(result.uv, koebe.uniformize(*SMALL).uv)
    assert len(inner) >= 4
    assert all(np.array_equal(uv, expected) for uv in inner if uv.shape[1] == 2)


# ---------------------------------------------------------------- the end of the interpreter


@pytest.mark.parametrize(
    "target",
    [
        "koebe.uniformize(*LARGE)",
        "koebe.uniformize(*LARGE, progress=lambda fraction, stage: None)",
        "koebe.uniformize(*LARGE, progress=lambda fraction, stage: time.sleep(0.01))",
        "koebe.fill_holes(*plate(240, 1), loops=[1], fair=True)",
        "koebe.match_loops(domain(100), domain(100))",
        "[koebe.uniformize(*SMALL) for _ in range(1000)]",
        "[koebe.boundary_loops(SMALL[1]) for _ in range(100000)]",
    ],
)
@pytest.mark.parametrize("delay", [0.0, 0.1])
def test_the_interpreter_ends_while_daemon_threads_call(target, delay):
    run = run_script(f"""
        for _ in range(3):
            threading.Thread(target=lambda: {target}, daemon=True).start()
        time.sleep({delay})
        sys.exit(5)
    """)
    assert (run.returncode, run.stdout, run.stderr) == (5, "", "")


def test_no_native_call_imports_numpys_functions_on_its_thread():
    """An import inside of the native module would let the interpreter end there, and abort."""
    run = run_script("""
        import builtins
        own, imported = builtins.__import__, []
        def spy(name, *rest, **more):
            if threading.current_thread() is not threading.main_thread() and "multiarray" in name: imported.append(name)
            return own(name, *rest, **more)
        builtins.__import__ = spy
        thread = threading.Thread(target=lambda: koebe.boundary_loops(SMALL[1]))
        thread.start()
        thread.join()
        sys.exit(5 if not imported else str(imported))
    """)
    assert (run.returncode, run.stdout, run.stderr) == (5, "", "")


@pytest.mark.slow
def test_a_callback_that_never_comes_back_holds_up_no_exit():
    run = run_script("""
        # That of 2 s and a little comes back while the interpreter ends, and asks for the GIL.
        waiting = threading.Barrier(6)
        def call(seconds):
            first = [waiting.wait]
            def sleep(fraction, stage):
                while first: first.pop()()
                time.sleep(seconds)
            koebe.uniformize(*SMALL, progress=sleep)
        for seconds in (2.02, 2.1, 2.2, 2.3, 1000):
            threading.Thread(target=call, args=(seconds,), daemon=True).start()
        waiting.wait()
        sys.exit(5)
    """)
    assert (run.returncode, run.stderr) == (5, "")


def test_the_interpreter_waits_for_threads_that_are_no_daemons():
    run = run_script("""
        threading.Thread(target=lambda: print(koebe.uniformize(*LARGE).flipped)).start()
    """)
    assert (run.returncode, run.stdout, run.stderr) == (0, "0\n", "")


def test_a_call_at_exit_is_answered():
    run = run_script("""
        import atexit
        atexit.register(lambda: print(koebe.uniformize(*SMALL).flipped))
        atexit._run_exitfuncs()
        atexit.register(lambda: print(koebe.uniformize(*SMALL).flipped))
    """)
    assert (run.returncode, run.stdout, run.stderr) == (0, "0\n0\n", "")


def test_a_forked_process_can_call():
    run = run_script("""
        koebe.uniformize(*SMALL)
        child = os.fork()
        if child == 0:
            print(koebe.uniformize(*SMALL).flipped, flush=True)
            sys.exit(3)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
    """)
    assert (run.returncode, run.stdout, run.stderr) == (0, "0\n3\n", "")
