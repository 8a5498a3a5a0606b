"""The guide's table of what each operator touches names all of them, and no other."""

import re
from pathlib import Path

import bpy

GUIDE = Path(__file__).resolve().parents[2] / "docs" / "guide.md"
HEAD = "| operator | writes | on an error |"


def rows():
    """The table's rows as lists of cells."""
    lines = GUIDE.read_text(encoding="utf-8").split(HEAD)[1].split("\n\n")[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def registered():
    """Label of each operator of the add-on, by its name."""
    names = [f"{space}.{name}" for space in dir(bpy.ops) for name in dir(getattr(bpy.ops, space)) if "koebe" in name]
    return {name: getattr(getattr(bpy.ops, name.split(".")[0]), name.split(".")[1]) for name in names}


def test_the_table_names_every_operator_by_its_label():
    operators = registered()
    assert len(operators) >= 11
    told = dict(re.fullmatch(r"\*\*(.+)\*\* `(.+)`", row[0]).groups()[::-1] for row in rows())
    assert told == {name: operator.get_rna_type().name for name, operator in operators.items()}


def test_every_row_says_what_is_written_and_what_becomes_of_it_on_an_error():
    for row in rows():
        assert len(row) == 3 and all(len(cell) > 5 for cell in row[1:]), row


def test_the_properties_that_it_names_are_the_ones_that_are_written(addon):
    text = " ".join(cell for row in rows() for cell in row)
    for key in (addon("blender.checker").MEMORY_KEY, addon("blender.distortion_attribute").MEMORY_KEY):
        assert f"`{key}`" in text
