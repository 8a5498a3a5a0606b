"""The guide's table of what each operator touches names all of them, and no other."""

import csv
from pathlib import Path

import bpy

TABLE = Path(__file__).resolve().parents[2] / "docs" / "data" / "operators.csv"


def rows():
    """The table's rows as lists of cells: button, operator, what it writes, what an error leaves."""
    return list(csv.reader(TABLE.read_text(encoding="utf-8").splitlines()))[1:]


def registered():
    """Label of each operator of the add-on, by its name."""
    names = [f"{space}.{name}" for space in dir(bpy.ops) for name in dir(getattr(bpy.ops, space)) if "koebe" in name]
    return {name: getattr(getattr(bpy.ops, name.split(".")[0]), name.split(".")[1]) for name in names}


def test_the_table_names_every_operator_by_its_label():
    operators = registered()
    assert len(operators) >= 11
    labels = {name: operator.get_rna_type().name for name, operator in operators.items()}
    assert {name: label for label, name, *_ in rows()} == labels


def test_every_row_says_what_is_written_and_what_becomes_of_it_on_an_error():
    for row in rows():
        assert len(row) == 4 and all(len(cell) > 5 for cell in row[1:]), row


def test_the_properties_that_it_names_are_the_ones_that_are_written(addon):
    text = " ".join(cell for row in rows() for cell in row)
    for key in (addon("blender.checker").MEMORY_KEY, addon("blender.distortion_attribute").MEMORY_KEY):
        assert key in text


def test_no_job_takes_two_clicks_more_than_elsewhere():
    jobs = list(csv.DictReader(TABLE.with_name("clicks.csv").read_text(encoding="utf-8").splitlines()))
    assert len(jobs) == 40 and {job["operator"] for job in jobs} - {""} <= registered().keys()
    for job in jobs:
        others = [int(job[name]) for name in ("Blender", "Zen UV", "UVPackmaster", "RizomUV") if job[name]]
        assert not (job["Koebe UV"] and others) or int(job["Koebe UV"]) <= min(others) + 1, job
