"""The batch script's command line: what is out of range is exit code 2 and one line. Without Blender."""

import random
import re
from pathlib import Path

import pytest

ADDON = Path(__file__).resolve().parents[2] / "addon"
OUT = ["--output", "out.blend"]


WRONG = [
    [], ["--output"], ["--what"], [*OUT, "--out", "x"],
    *([*OUT, "--outer", value] for value in
      ("", "sideways", "-1", "1.5", "2147483648", "99999999999999999999999", "²", "٣", "0x10", "active", " 1")),
    *([*OUT, name, value] for name in ("--center", "--point") for value in ("", "auto", "-1", "1.5", "cursor")),
    [*OUT, "--center", "3", "--balance", "area"],
    *([*OUT, "--tolerance", value] for value in ("0", "-1e-6", "nan", "inf", "1e-400", "x", "")),
    *([*OUT, "--max-sweeps", value] for value in ("0", "-1", "1.0", "2147483648", "1e3", "nan", "")),
    *([*OUT, "--threads", value] for value in ("-1", "2147483648", "two", "")),
    *([*OUT, "--margin", value] for value in ("-0.001", "65537", "nan", "inf", "")),
    *([*OUT, "--checker-size", value] for value in ("0", "-1", "nan", "inf", "1e39", "1e-39", "")),
    *([*OUT, "--layer", value] for value in ("", "  ", ".hidden", "x" * 64, "ö" * 32, "\udcff")),
    *([*OUT, f"--{name}", "nonsense"] for name in ("method", "engine", "balance", "tube", "placement")),
    *([*OUT, "--objects", value] for value in ("", ",", "A,", ",A", '"A', '"A"B', '""')),
    [*OUT, "--polish=yes"], [*OUT, "--objects"],
    [*OUT, "--domain", "ball"], [*OUT, "--layout", "octahedral"], [*OUT, "--normalization", "area"],
    [*OUT, "--holes", "circles"], [*OUT, "--fit", "square"],
    *([*OUT, "--domain", "torus", *words] for words in
      (["--layout", "octahedral"],
       ["--holes", "radial"], ["--tube", "unroll"], ["--no-cut"], ["--outer", "3"], ["--tolerance", "0"])),
    *([*OUT, "--domain", "sphere", *words] for words in
      (["--layout", "flat"], ["--holes", "radial"], ["--fit", "inside"], ["--tube", "unroll"], ["--max-sweeps", "0"])),
    *([*OUT, "--domain", "schottky", *words] for words in
      (["--normalization", "none"], ["--layout", "octahedral"], ["--balance", "area"], ["--tolerance", "nan"])),
    [*OUT, "--frames", "1:3"], [*OUT, "--sequence-target", "layers"],
    [*OUT, "--sequence", "SHAPE_KEYS", "--frames", "1:3"],
    *([*OUT, "--sequence", *words] for words in
      (["KEYS"], ["FRAMES", "--frames", "3:1"], ["FRAMES", "--frames", "1"], ["FRAMES", "--frames", "1:2:0"],
       ["FRAMES", "--frames", "1:2:3:4"], ["FRAMES", "--frames", "a:b"], ["FRAMES", "--frames", "1:9999999"],
       ["FRAMES", "--sequence-target", "uv"], ["FRAMES", "--domain", "ring"], ["FRAMES", "--tube", "unroll"],
       ["FRAMES", "--engine", "mesh"], ["SHAPE_KEYS", "--symmetry", "auto"], ["FRAMES", "--placement", "keep"])),
    *([*OUT, "--domain", "ring", *words] for words in
      (["--holes", "square"], ["--fit", "tight"], ["--balance", "none"], ["--symmetry", "auto"], ["--margin", "0"])),
]  # fmt: skip


@pytest.mark.parametrize("words", WRONG, ids=ascii)
def test_wrong_usage_is_2_in_one_line(addon, capsys, words):
    with pytest.raises(addon("headless.exit_and_signals").Stop) as stop:
        addon("headless.arguments").parse(words)
    assert stop.value.code == 2
    addon("headless.exit_and_signals").tell(stop.value.reason)
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("koebe: ") and err.count("\n") == 1 and len(err) > 20


@pytest.mark.parametrize(
    ("values", "names"),
    [
        (["A"], ["A"]), (["A,B C"], ["A", "B C"]), (["A", "B"], ["A", "B"]), (['"A, B",C'], ["A, B", "C"]),
        (['"He said ""no"", twice"'], ['He said "no", twice']), (['5" pipe,B'], ['5" pipe', "B"]),
        ([" A ,B"], [" A ", "B"]), (['"two\nlines"'], ["two\nlines"]), (["ö,🍳"], ["ö", "🍳"]), (["-A"], ["-A"]),
        (["'A'"], ["'A'"]), (["A;B\\,C"], ["A;B\\", "C"]),
    ],
)  # fmt: skip
def test_names_are_divided_as_in_a_csv_file(addon, values, names):
    words = [*OUT, *(f"--objects={value}" for value in values)]
    assert addon("headless.arguments").parse(words).names == names


def test_every_name_can_be_asked_for(addon):
    noise = random.Random(3)
    for _ in range(300):
        names = ["".join(noise.choices('ab ,"\'\\\n\tö🍳', k=noise.randint(1, 8))) for _ in range(noise.randint(1, 4))]
        value = ",".join('"' + name.replace('"', '""') + '"' for name in names)
        assert addon("headless.arguments").parse([*OUT, f"--objects={value}"]).names == names


def test_the_defaults_are_those_of_the_options(addon):
    request = addon("headless.arguments").parse(OUT)
    assert request.options == addon("maps.options").Options() and request.names is None and request.report is None
    assert (request.sources, request.output) == ([], "out.blend")
    assert request.library.batch == request.library.each == []


def test_the_options_of_a_library_are_words_for_each_of_its_files(addon):
    words = ["a.blend", "folder", "--output", "out", "--workers", "2", "--time-limit=9.5", "--retry"]
    each = ["--method", "ck", "--no-upright", "--checker", "--tube=unroll", "--layer", "a b"]
    each += ["--objects", "A,B", "--objects=C"]
    request = addon("headless.arguments").parse([*words, *each])
    assert request.sources == ["a.blend", "folder"]
    assert request.library.batch == ["--workers=2", "--time-limit=9.5", "--retry"]
    expected = {"--method=ck", "--no-upright", "--tube=unroll", "--layer=a b", "--objects=A,B", "--objects=C"}
    assert set(request.library.each) == expected
    again = addon("headless.arguments").parse(["a.blend", "--output", "out", *request.library.each])
    assert (again.options, again.names) == (request.options, request.names)


def test_sequences(addon):
    parse, options = addon("headless.arguments").parse, addon("maps.options")
    assert parse(OUT).sequence is None
    request = parse([*OUT, "--sequence", "FRAMES", "--layer", "Own"])
    assert request.sequence == options.SequenceChoice("FRAMES", None, "ATTRIBUTE") and request.options.checker
    assert not parse([*OUT, "--sequence", "FRAMES", "--no-checker"]).options.checker
    assert request.domain is None and request.options.layer == "Own"
    words = ["--sequence", "FRAMES", "--frames=-2:9:3", "--sequence-target", "layers"]
    request = parse([*OUT, *words])
    assert request.sequence == options.SequenceChoice("FRAMES", range(-2, 10, 3), "LAYERS")
    assert parse([*OUT, *request.library.each]).sequence == request.sequence
    assert parse([*OUT, "--sequence", "SHAPE_KEYS"]).sequence.source == "SHAPE_KEYS"


def test_all_that_is_in_range_is_taken(addon):
    words = "in.blend --output o.blend --report r.json --method ck --engine mesh --outer 2147483647 --tolerance 1e-300"
    words += " --max-sweeps 2147483647 --balance none --polish --threads 1024 --no-upright --tube unroll --margin 0"
    words += " --placement keep --no-checker --checker-size 1e6 --no-checker-even"
    request = addon("headless.arguments").parse([*words.split(), "--layer", "ö" * 31])
    assert request.options.outer == request.options.max_sweeps == 2**31 - 1 and request.options.layer == "ö" * 31


def test_help_tells_the_exit_codes(addon, capsys):
    with pytest.raises(SystemExit) as end:
        addon("headless.arguments").parse(["--help"])
    assert end.value.code == 0
    text = " ".join(capsys.readouterr().out.split())
    assert all(word in text for word in ("130 interrupted", "4 not converged", "blender -b IN.blend", "--objects"))


def test_parts_keep_their_angles_unless_even_is_given(addon):
    parse, choice = addon("headless.arguments").parse, addon("maps.options").PartsChoice
    assert parse([*OUT, "--parts"]).parts == choice() and choice().solver_arguments()["even"] is None
    given = parse([*OUT, "--parts", "--even", "0", "--loops", "free"])
    assert given.parts == choice(keep_angles=False, even=0.0, loops="free")
    assert given.parts.solver_arguments()["even"] == 0.0
    assert given.library.each == ["--parts", "--even=0.0", "--loops=free"]
    assert parse([*OUT, "--even", "0.5"]).options == addon("maps.options").Options(even=0.5)


@pytest.mark.parametrize("words, reason", [
    (["--even", "0.5", "--symmetry", "auto"], "--even: it does not work with Symmetry.*take --even 0"),
    (["--even", "0.5", "--center", "3"], "--even: it does not work with Centre.*take --even 0"),
    (["--domain", "ring", "--even", "0.5", "--holes", "radial"], "--even: .* slits.*take --holes circles"),
    (["--domain", "schottky", "--even", "0.5"], "--even does not work with --domain schottky"),
    (["--even", "1.5"], "--even: 1.5 is not a number"),
], ids=str)  # fmt: skip
def test_what_even_excludes(addon, words, reason):
    with pytest.raises(addon("headless.exit_and_signals").Stop) as stop:
        addon("headless.arguments").parse([*OUT, *words])
    text = addon("headless.flag_names").in_flags(stop.value.reason)
    assert stop.value.code == 2 and re.search(reason, text), text


def test_the_options_of_a_tile(addon):
    parse = addon("headless.arguments").parse
    assert parse(OUT).domain is None
    words = ["--domain", "ring", "--holes", "radial", "--fit", "period", "--max-sweeps", "7", "--layer", "Own"]
    request = parse([*OUT, *words])
    domains = addon("maps.domain_table")
    assert request.domain == domains.RING.choice(holes="radial", fit="period", max_sweeps=7)
    assert request.options.layer == "Own"
    assert parse([*OUT, "--domain", "torus"]).domain == domains.TORUS.choice()
    assert request.library.each == ["--domain=ring", "--holes=radial", "--fit=period", "--max-sweeps=7", "--layer=Own"]
    sphere = domains.SPHERE.choice
    assert parse([*OUT, "--domain", "sphere", "--layout", "octahedral"]).domain == sphere(layout="octahedral")
    assert parse([*OUT, "--domain", "sphere", "--even", "0.5"]).domain == sphere(even=0.5)
    assert parse([*OUT, "--domain", "sphere", "--tolerance", "1e-4"]).domain == sphere(tolerance=1e-4)
    handles = domains.SCHOTTKY.choice
    words = ["--domain", "schottky", "--normalization", "circles"]
    assert parse([*OUT, *words, "--max-sweeps", "9"]).domain == handles("circles", max_sweeps=9)
    assert parse([*OUT, "--domain", "schottky"]).domain == handles()
    assert parse([*OUT, *words]).library.each == ["--domain=schottky", "--normalization=circles"]
