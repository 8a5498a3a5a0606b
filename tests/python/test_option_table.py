"""The table of options is what the command, the library, the package and the add-on have: one row, one option."""

import json
import math
import re
from pathlib import Path

import koebe
import pytest
from cli_support import koebe as run
from koebe import _koebe, _option_table, _options

ROOT = Path(__file__).resolve().parents[2]
TABLE = json.loads((ROOT / "native" / "options" / "options.json").read_text(encoding="utf-8"))
MAPS = {  # function, struct
    "uniformize": (koebe.uniformize, _koebe.UniformizeOptions),
    "sequence": (koebe.Surface, _koebe.UniformizeOptions),
    "ring": (koebe.ring_map, _koebe.TileOptions),
    "torus": (koebe.torus_map, _koebe.TileOptions),
    "sphere": (koebe.sphere_map, _koebe.SphereOptions),
    "schottky": (koebe.schottky_map, _koebe.SchottkyOptions),
    "parts": (koebe.parts, _koebe.PartsOptions),
    "pack": (koebe.pack, _koebe.PackOptions),
    "flatten": (koebe.flatten, _koebe.FlattenOptions),
    "certified": (koebe.certified_moduli, _koebe.CapacityOptions),
    "lift": (koebe.lift, _koebe.LiftOptions),
}
COMMANDS = sorted({*MAPS, "ricci"} - {"certified"})
OTHERS = {"fill", "compare", "transfer", "fit"}  # commands that make no map
KINDS = {"number", "integer", "flag", "choice", "vertex", "loop", "steps", "weights", "page", "text", "file", "array"}
OF_READING = {"weld", "cut_at"}  # obeyed where a surface is read: no struct of a map has it


def rows_in(front, of):
    """The rows of the map that this front has."""
    return {row["name"]: row for row in TABLE if of in row["maps"].split() and front in row.get("in", front).split()}


def test_every_row_is_of_the_form():
    for row in TABLE:
        assert row["kind"] in KINDS and row["does"] and not row["does"].endswith("."), row["name"]
        assert set(row["maps"].split()) <= {*MAPS, "ricci", "shapes", "module", "planar", *OTHERS}, row["name"]
        assert set(row.get("in", "command").split()) <= {"command", "python", "blender", "batch", "arrays"}, row["name"]
        assert ("choices" in row) == (row["kind"] in ("choice", "loop")), row["name"]
        assert row["kind"] != "choice" or row["default"] in [word for word, _, _ in row["choices"]], row["name"]
        if row["kind"] == "number":
            assert {*row["range"]} in ({"above"}, {"min", "max"}, {"min", "below"}), row["name"]
            if "python" in row.get("in", "python") and row["default"] is not None:
                assert _option_table.rows(row["maps"].split()[0])[row["name"]].has(row["default"]), row["name"]


def test_a_name_is_one_option_of_a_map_and_one_property():
    for of in (*MAPS, "ricci", "shapes", "module", "planar"):
        for front in ("command", "python"):
            names = [row["name"] for row in TABLE if of in row["maps"].split() and front in row.get("in", front)]
            assert len(names) == len(set(names))
    names = [row["name"] for row in TABLE if {"blender", "batch"} & set(row.get("in", "blender").split())]
    assert len(names) == len(set(names))


def test_the_enumerators_stand_in_the_order_of_the_tables_words():
    headers = "".join(header.read_text(encoding="utf-8") for header in (ROOT / "native").rglob("*.h"))
    text = re.sub("//.*", "", headers)
    enumerators = {
        of: re.findall(r"[\w-]+", inside.replace("automatic", "auto").replace("_", "-"))
        for of, inside in re.findall(r"enum class (\w+)[^{]*\{([^}]*)\}", text)
    }
    bound = [row for row in TABLE if "python" in row.get("in", "python") and row["maps"] != "shapes"]
    for row in (row for row in bound if row["kind"] in ("choice", "loop")):
        words = [word for word, _, _ in row["choices"]] + ["vertex"] * (row["kind"] == "loop")
        types = set(re.findall(rf"(\w+) {row['name']} = \1::", text))
        assert any(enumerators[of] == words for of in types), row["name"]


@pytest.mark.parametrize("of", MAPS)
def test_the_librarys_defaults_are_the_tables(of):
    native = MAPS[of][1]()
    found = {}
    for name, row in rows_in("python", of).items():
        holder = next((one for one in (native, getattr(native, "mesh", None)) if hasattr(one, name)), None)
        if holder is None:
            assert (of, name) == ("uniformize", "cut") or name in OF_READING
            continue
        value = getattr(holder, name)
        if row["kind"] in ("choice", "loop"):
            found[name] = row["choices"][value][0]
        elif row["kind"] in ("vertex", "steps", "weights"):
            found[name] = None if value == -1 or len(value) == 0 else value
        else:
            found[name] = value
    assert found == {name: row["default"] for name, row in rows_in("python", of).items() if name in found}


@pytest.mark.parametrize("of", COMMANDS)
def test_the_commands_flags_are_the_tables(of):
    text = run(of, "--help").stdout
    flags = set(re.findall(r"^ +(?:-\w,)?--([\w-]+)", text, re.MULTILINE)) - {"help"}
    files = {"json", "svg", "quiet", "sphere", "output", "format", "packing", "target", "triangulation"}
    expected = {name.replace("_", "-") for name, row in rows_in("command", of).items()
                if (of, name) != ("sequence", "importance")}  # fmt: skip
    assert flags - files == expected
    shown = " ".join(text.split())
    for row in rows_in("command", of).values():
        if row["kind"] == "number" and row["default"] is not None:  # CLI11 writes =1 or [1]
            number = re.search(
                rf"--{row['name'].replace('_', '-')} \w+(?:=| \[)([^]\s]+)", shown
            )  # newer or older CLI11
            assert number and float(number[1]) == row["default"], row["name"]


def at_the_bounds(row):
    """Numbers that the row's range has, and the nearest ones that it has not."""
    right = [bound for word, bound in row["range"].items() if word in ("min", "max")]
    wrong = [bound for word, bound in row["range"].items() if word in ("above", "below")]
    for word, way in (("min", -1), ("max", 1)):
        if (bound := row["range"].get(word)) is not None:
            wrong.append(bound + way if row["kind"] == "integer" else math.nextafter(bound, way * math.inf))
    return right, wrong


@pytest.mark.parametrize("of", COMMANDS)
def test_the_command_takes_what_is_in_the_range_and_nothing_else(of, tmp_path):
    for name, row in rows_in("command", of).items():
        if row["kind"] not in ("number", "integer"):
            continue
        flag, (right, wrong) = f"--{name.replace('_', '-')}", at_the_bounds(row)
        files = {
            "sequence": ["in.obj", "--output=out"],
            "flatten": ["in.obj", "out.svg"],
            "lift": ["in.obj", "circles", "out.obj"],
        }.get(of, ["in.glb", "out.glb"] if name == "uv_channel" else ["in.obj", "out.obj"])
        for value in (*wrong, "nan", ""):
            done = run(of, *files, f"{flag}={value}", cwd=tmp_path)
            assert done.returncode == 2 and flag in done.stderr, (name, value)
        for value in right:
            done = run(of, *files, f"{flag}={value}", cwd=tmp_path)
            assert done.returncode == 3 and "FileError" in done.stderr, (name, value)


@pytest.mark.parametrize("of", MAPS)
def test_python_refuses_what_is_out_of_range_and_what_is_misspelt(of):
    function = MAPS[of][0]
    triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    for name, row in rows_in("python", of).items():
        if row["kind"] in ("number", "integer"):
            right, wrong = at_the_bounds(row)
            for value in wrong:
                with pytest.raises(koebe.OptionError, match=name):
                    function(*triangle, **{name: value})
            for value in right:
                assert _options._checked(_option_table.rows(of)[name], value) == value
            with pytest.raises(TypeError, match=name):
                function(*triangle, **{name: "much"})
        elif row["kind"] == "choice":
            with pytest.raises(koebe.OptionError, match=name):
                function(*triangle, **{name: "nonsense"})
    with pytest.raises(TypeError, match="tolerence"):
        function(*triangle, tolerence=1e-3)


@pytest.mark.parametrize("of", [of for of in MAPS if of != "sequence"])
def test_docstrings_say_what_the_table_says(of):
    text = " ".join(MAPS[of][0].__doc__.lower().split())
    assert "{options}" not in text
    for name, row in rows_in("python", of).items():
        assert f"{name} : " in text and row.get("of", {}).get(of, row["does"]).lower() in text


def test_defaults_may_be_left_to_the_table():
    given = {"cut": True, "loops": "free", "darts": 0.5, "round_cuts": False, "most_lost": 0.5, "pixels": 64,
             "margin": 4.0, "tiles": 3, "rectify": False, "stack": True, "stack_mirrored": False,
             "hard_angle": 45.0, "cut_hard": True, "no_hard": True, "threads": 0}  # fmt: skip
    _, said = _options.filled("parts", _koebe.PartsOptions(), dict.fromkeys(rows_in("python", "parts"), None) | given)
    assert said == {
        "even": None, "loops": "free", "darts": 0.5, "price": 0.03, "cut": True, "round_cuts": False,
        "most_lost": 0.5, "density": None, "pixels": 64,
        "margin": 4.0, "tiles": 3, "rectify": False, "stack": True, "stack_mirrored": False, "weld": None,
        "hard_angle": 45.0, "cut_hard": True, "no_hard": True, "threads": 0,
    }  # fmt: skip
    with pytest.raises(TypeError, match="most_lost"):
        koebe.parts([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], most_lost=None)


def test_the_addon_hands_every_option_to_the_solver(addon):
    options = addon("maps.options")
    chosen = {"uniformize": options.Options(), "parts": options.PartsChoice(),
              **{name: domain.choice() for name, domain in addon("maps.domain_table").DOMAINS.items()}}  # fmt: skip
    by_island = {"price", "cut", "round_cuts", "outer", "inner", "center", "point", "importance", "show"} | OF_READING
    engine = {row["name"] for row in TABLE if "with" in row}
    not_there = {"sphere": {"threads"}, "parts": {"threads"}}  # by the run
    for of, choice in chosen.items():
        expected = {*rows_in("python", of)} - by_island - engine - not_there.get(of, set())
        assert {*choice.solver_arguments()} == expected, of


def test_the_addons_words_are_the_solvers(addon):
    for name, row in addon("maps.option_table").ROWS.items():
        if row.kind == "choice" and row.is_native:
            of = row.maps[0]
            assert set(row.words) <= set(_option_table.rows(of)[name].words)
