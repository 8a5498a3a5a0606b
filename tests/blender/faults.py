"""Lets the add-on fail before any line that it executes inside a transaction, as memory, a key or a bug could."""

import contextlib
import os
import pickle
import sys

import bpy
import fingerprint

# In the environment: fail at every step, or, if it is "lines", at every line, and not at a choice of them.
EVERY_STEP = "KOEBE_EVERY_STEP"
# Blender calls them and swallows what they raise: no operator fails by it.
HANDLERS = ("after_update", "after_undo", "after_frame")


# Functions of the native package that take long.
MAPS = ("uniformize", "parts", "ring_map", "torus_map", "sphere_map", "schottky_map", "flatten", "lift")


@contextlib.contextmanager
def remembered_maps(koebe):
    """The native package computes each map once: the faults come later, while it is written."""
    own = {name: getattr(koebe, name) for name in MAPS}
    known = {}

    def remembering(name):
        def compute(*arrays, **options):
            asked = {key: value for key, value in options.items() if key not in ("progress", "cancel", "sketch")}
            key = pickle.dumps((name, arrays, asked))
            if key not in known:
                known[key] = own[name](*arrays, **options)
            return known[key]

        return compute

    try:
        for name in MAPS:
            setattr(koebe, name, remembering(name))
        yield
    finally:
        for name in MAPS:
            setattr(koebe, name, own[name])


class Fault:
    """Counts the lines of the add-on that are executed within a transaction, and raises before one of them."""

    def __init__(self, folder, at=None, error=KeyboardInterrupt):
        self.steps, self._folder, self._at, self._error, self._live = [], folder, at, error, False

    @property
    def fired(self):
        """Whether the exception was raised."""
        return self._at is not None and len(self.steps) >= self._at

    def __enter__(self):
        sys.settrace(self._enter)
        return self

    def __exit__(self, *error):
        sys.settrace(None)

    def _enter(self, frame, event, argument):
        code = frame.f_code
        if not code.co_filename.startswith(self._folder) or code.co_name in HANDLERS:
            return None
        if code.co_name == "transaction":  # which is entered at its start, and once more at its end
            self._live = not self._live
        return self._step

    def _step(self, frame, event, argument):
        if event == "line" and self._live:
            self.steps.append((frame.f_code.co_filename, frame.f_lineno))
            if len(self.steps) == self._at:
                raise self._error("a fault that was asked for")
        return self._step


def chosen(steps, most):
    """Numbers of steps: of each line the first and the last time, at most so many, evenly; or all if asked for.

    Another version of Blender has the steps between these: two of them test twice as many.
    """
    asked = os.environ.get(EVERY_STEP)
    if asked and asked != "lines":
        return range(1, len(steps) + 1)
    first, last = {}, {}
    for number, place in enumerate(steps, 1):
        first.setdefault(place, number)
        last[place] = number
    numbers = sorted({*first.values(), *last.values()})
    stride = 1 if asked else max(1, -(-len(numbers) // most))
    return numbers[stride // 2 if bpy.app.version >= (4, 0, 0) else 0 :: stride]


def call(operator, fault=None, **options):
    """Call an operator, maybe with a fault; what it answers, or the error's text."""
    try:
        if fault is None:
            return operator(**options)
        with fault:
            return operator(**options)
    except RuntimeError as error:
        return str(error)


def check_all_comes_back(folder, build, operator, options, most):
    """Fail at the steps of an operator by a key, which ends all of it: everything is as before, and then it works."""
    build()
    call(operator, **options)  # what is found out once a session would be missing later
    build()
    counting = Fault(folder)
    answer = call(operator, counting, **options)
    expected = fingerprint.fingerprint()
    build()
    before, wrong = fingerprint.fingerprint(), {}
    assert answer == {"FINISHED"} and fingerprint.differences(before, expected), "it does nothing"
    numbers, missed = chosen(counting.steps, most), 0
    for number in numbers:
        fault = Fault(folder, number)
        call(operator, fault, **options)
        # Some lines less than when they were counted, as Blender brings its arrays up to date or not.
        if not fault.fired:
            missed += 1
            build()
            continue
        found = fingerprint.differences(before, fingerprint.fingerprint())
        if found:
            wrong[_named(counting.steps[number - 1])] = found
            build()
    assert not wrong and missed <= len(numbers) // 10
    assert len(counting.steps) > 20 and call(operator, **options) == answer
    assert fingerprint.differences(expected, fingerprint.fingerprint()) == []


def check_each_for_itself(folder, build, operator, options, most):
    """Fail at the steps of an operator by an error: every object is as before, or as without the error."""
    build()
    before = fingerprint.fingerprint()
    counting = Fault(folder)
    call(operator, counting, **options)
    after, wrong = fingerprint.fingerprint(), {}
    for number in chosen(counting.steps, most):
        build()
        fault = Fault(folder, number, ValueError)
        call(operator, fault, **options)
        now = fingerprint.fingerprint()
        for obj in bpy.data.objects:
            mine = fingerprint.of_object(now, obj)
            found = [
                fingerprint.differences(mine, fingerprint.of_object(prints, obj)) for prints in (before, after)
            ]
            if all(found):
                wrong[_named(counting.steps[number - 1]), obj.name] = found
    assert not wrong


def _named(place):
    return f"{os.path.basename(place[0])}:{place[1]}"
