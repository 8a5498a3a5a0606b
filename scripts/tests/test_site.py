"""The sources of the site (`make docs`): every page is listed, every public name is documented, every example runs."""

import doctest
import importlib.util
import inspect
import json
from pathlib import Path

import blender_pages
import command_pages
import cpp_pages
import docstrings
import koebe
import links
import pages
import pytest
import python_pages

ROOT = Path(__file__).resolve().parents[2]
TABLE = json.loads((ROOT / "native" / "options" / "options.json").read_text(encoding="utf-8"))
FUNCTIONS = [name for name in koebe.__all__ if inspect.isroutine(getattr(koebe, name))]
CALLED = [*FUNCTIONS, *sorted(python_pages.CALLED)]
COMMANDS = command_pages.commands()
FLAGS = doctest.ELLIPSIS | doctest.IGNORE_EXCEPTION_DETAIL


def test_every_page_is_in_one_list():
    entries = [name for name, _ in pages.contents()]
    written = {name.rpartition(".")[0] for name in {**pages.texts(), **python_pages.pages(), **command_pages.pages()}}
    top = {name for name in written if "/" not in name} - {"index"}
    top |= {f"reference/{room}/index" for room in ("python", "command", "blender", "cpp")}
    assert len(entries) == len(set(entries)) and set(entries) == top


def test_every_public_name_of_python_is_documented():
    assert python_pages.faults() == []


def test_a_name_without_an_entry_or_a_docstring_is_seen(monkeypatch):
    monkeypatch.setattr(python_pages, "PUBLIC", {*koebe.__all__, "secret"})
    monkeypatch.setattr(koebe.parts, "__doc__", "")
    assert python_pages.faults() == ["koebe.secret is on no page of the reference", "koebe.parts has no docstring"]


@pytest.mark.parametrize("name", [name for name in koebe.__all__ if inspect.isclass(getattr(koebe, name))])
def test_every_public_method_is_documented(name):
    own = [cls for cls in getattr(koebe, name).__mro__ if cls.__module__.startswith("koebe")]
    members = {key: one for cls in own for key, one in vars(cls).items() if not key.startswith("_")}
    bare = [key for key, one in members.items() if hasattr(one, "__get__") and not one.__doc__]
    assert bare == []


@pytest.mark.parametrize("name", CALLED)
def test_the_examples_of_a_docstring_run(name, monkeypatch):
    monkeypatch.chdir(ROOT)
    (found,) = doctest.DocTestFinder(recurse=False).find(getattr(koebe, name), name, module=False, globs={})
    assert found.examples, "no example"
    packages = {"plot": "matplotlib", "dispersion_test": "skbio", "spharm": "pyshtools"}
    package = {**packages, **dict.fromkeys(("read_field", "read_region", "write_field"), "nibabel")}.get(name)
    if package and not importlib.util.find_spec(package):
        pytest.skip(f"{package} is not here")
    said = []
    doctest.DocTestRunner(optionflags=FLAGS).run(found, out=said.append)
    assert not said, "".join(said)


def test_every_command_is_documented():
    assert command_pages.faults() == []


@pytest.mark.parametrize("name", COMMANDS)
def test_the_options_of_a_command_are_the_tables(name):
    found = command_pages.options(name)
    for row in TABLE:
        if name in row["maps"].split() and "command" in row.get("in", "command").split() and row["kind"] != "weights":
            one = found[f"--{row['name'].replace('_', '-')}"]
            assert one.text.startswith(row.get("of", {}).get(name, row["does"]))
            words = [word for word, _, _ in row.get("choices", ())]
            assert [word for word, _ in one.words][: len(words)] == words


def test_a_subcommand_without_an_example_is_seen(monkeypatch):
    monkeypatch.setattr(command_pages, "examples", lambda: {name: [] for name in COMMANDS if name != "lift"})
    assert command_pages.faults() == ["koebe lift has no example in docs/"]


def test_every_public_header_says_what_it_is_for():
    assert [name for name in cpp_pages.headers() if not cpp_pages.subject(name)] == []


def test_the_maps_of_the_library_have_examples():
    shown = cpp_pages.examples()
    maps = {"uniformize", "uniformize_with_cuts", "parts_of", "flatten", "torus_map", "ring_map", "sphere_map", "lift",
            "schottky_map", "fit_circles", "disk_map", "annulus_map", "conformal_module"}  # fmt: skip
    assert maps <= set(shown) and len(shown) == len(set(shown))


def test_operators_without_a_description_are_seen():
    said = {"name": "even", "does": "", "hidden": False}
    found = [{"name": "uv.koebe_even", "does": "Map", "properties": [said]},
             {"name": "uv.koebe_b", "does": "", "properties": []}]  # fmt: skip
    assert blender_pages.faults(found) == [
        "bpy.ops.uv.koebe_b has no description", "bpy.ops.uv.koebe_even: even has no description",
        "bpy.ops.uv.koebe_b has no picture",
    ]  # fmt: skip


def test_the_pictures_of_the_operators_are_there():
    assert [name for name in blender_pages.PICTURES if not (ROOT / "docs" / "images" / name).exists()] == []


def test_a_link_that_is_named_by_its_file_gets_the_title_of_the_contents():
    text = "[parts.md](parts.md#darts), [here](../parts.md), [docs/lift.md](docs/lift.md), [t](../../THIRD_PARTY.md)"
    assert pages.flat(text) == (
        "[Parts](parts.md#darts), [here](parts.md), [Patterns on surfaces](lift.md), [t](THIRD_PARTY.md)"
    )


def test_a_list_of_data_becomes_tables_to_sort():
    made = pages.flat("- [times](data/benchmark_times.csv)\n\n<!-- figures: polish | face -->\n\n<!-- end -->\n")
    assert made.count(":class: sortable") == 2 and "| surprised |" in made and ":file: data/benchmark_times.csv" in made
    assert all((ROOT / "docs" / name).exists() for name in pages.linked_files(ROOT / "docs" / "comparison.md"))


def test_the_page_for_browsers_is_one_click_from_the_first_screen(monkeypatch, tmp_path):
    link = 'href="try/index.html?sample"'
    monkeypatch.setattr(pages, "WEB", tmp_path)
    assert link not in pages.texts()["index.md"]
    (tmp_path / "index.html").touch()
    front = pages.texts()["index.md"]
    assert front.index(link) < front.index("![")


def test_the_front_page_is_the_index_of_the_site():
    assert pages.flat("[zip](../README.md#get-it)") == "[zip](index.md#get-it)"


def test_the_releases_of_the_repository_are_no_page_of_the_site():
    assert pages.flat("the [releases](../../releases)") == "the releases"


def test_a_docstring_becomes_definitions_links_and_an_example():
    lines = ["Maps like uniformize.", "", "uv, part    (F,) of *each*,", "            and more", "", ">>> 1", "1"]
    text = "\n".join(docstrings.converted(lines, False, {"uniformize"}))
    assert ":py:obj:`~koebe.uniformize`" in text
    assert "**uv, part**\n   (F,) of \\*each\\*, and more" in text
    assert ".. rubric:: Example\n\n>>> 1\n1" in text


def test_a_dead_link_is_seen(tmp_path):
    (tmp_path / "a.html").write_text('<p id="here"><a href="b.html#there">b</a> <a href="#here">a</a></p>')
    (tmp_path / "b.html").write_text('<a href="c.html">c</a> <a href="a.html#here">a</a> <a href="https://x.y">x</a>')
    assert links.dead(tmp_path) == [
        "a.html: b.html#there leads to no place of the page", "b.html: c.html leads to no file",
    ]  # fmt: skip
