"""The goals of docs/comparison.md: which of our settings stands for a model, and when a goal counts as met."""


import compare_tables
import pytest
from compare_tables import BESIDE_XATLAS, CUTS

THEIRS = {"seams": 10.0, "spread": 1.2, "angle": 1.0, "islands": 21, "seconds": 2.0}


def facts(**changes):
    return {**THEIRS, "seams": 6.0, "islands": 10, **changes}


def rows(**ours):
    return {"xatlas": THEIRS, **ours}


@pytest.mark.parametrize(
    "goal, most, over",
    [(CUTS, 6.0, 6.1), *zip(BESIDE_XATLAS, (1.2, 1.1, 10, 2.0), (1.23, 1.12, 11, 2.1))],
    ids=lambda value: value[1] if isinstance(value, tuple) else "",
)
def test_a_goal_is_met_up_to_its_limit(goal, most, over):
    assert compare_tables.meets(facts(**{goal[1]: most}), THEIRS, goal)
    assert not compare_tables.meets(facts(**{goal[1]: over}), THEIRS, goal)


def test_one_island_is_half_of_one():
    islands = next(goal for goal in BESIDE_XATLAS if goal[1] == "islands")
    assert compare_tables.meets(facts(islands=1), {**THEIRS, "islands": 1}, islands)


def test_the_setting_of_most_goals_within_the_cuts_stands_for_a_model():
    too_long = facts(seams=9.0, angle=0.1)
    some = rows(**{"--darts 0": facts(spread=3.0), "ours, in parts": facts(), "--darts 0.5": too_long})
    assert compare_tables.chosen(some, "xatlas", CUTS, BESIDE_XATLAS) == "ours, in parts"


def test_the_shortest_cuts_stand_for_a_model_if_all_are_too_long():
    some = rows(**{"--darts 0": facts(seams=8.0, spread=3.0), "ours, in parts": facts(seams=9.0)})
    assert compare_tables.chosen(some, "xatlas", CUTS, BESIDE_XATLAS) == "--darts 0"


def test_a_goal_counts_only_within_the_cuts():
    groups = {"a": rows(**{"ours, in parts": facts()}), "b": rows(**{"ours, in parts": facts(seams=8.0)})}
    table = compare_tables.beside(groups, "xatlas", CUTS, BESIDE_XATLAS, compare_tables.default)
    assert [line[2] for line in table] == ["1 of 2"] * (len(BESIDE_XATLAS) + 2)
