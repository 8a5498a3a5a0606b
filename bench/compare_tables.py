# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of docs/comparison.md and its data in docs/data/: figures of all maps, and ours over another's."""

import csv
import math
import statistics

from compare_unwraps import SETTINGS, UNWRAPS

BEGIN, END = "<!-- the table of `make compare` -->", "<!-- its end -->"
HEAD = ["islands", "cuts / √area", "density, 5 to 95 %", "area within a factor 3, %", "angle error, °", "coverage, %",
        "flips", "faces lost", "overlap, %", "seconds"]  # fmt: skip
SUMMARY = [*HEAD[:6], "models with flips", "with faces lost", "with overlap", "seconds"]
OURS = ("ours, in parts", *SETTINGS)
TIE = 1.01  # of density and angle error: ours over theirs that counts as equal
# Of a goal: its words, the figure, and the most that ours over theirs may be.
CUTS = ("cuts at most 0.6 times as long", "seams", 0.6)
AT_ITS_CUTS = ("cuts at most as long", "seams", 1.0)
BESIDE_XATLAS = (("density at most as large", "spread", TIE), ("angle error at most 1.1 times as large", "angle", 1.1),
                 ("islands at most half as many, or 1", "islands", 0.5),
                 ("seconds at most as many", "seconds", 1.0))  # fmt: skip
BESIDE_SMART = (("density at most as large", "spread", TIE), ("angle error at most as large", "angle", TIE),
                ("islands at most as many", "islands", 1.0))  # fmt: skip


def done(rows, unwrap):
    return unwrap in rows and "error" not in rows[unwrap]


def meets(ours, theirs, goal):
    _, key, most = goal
    limit = max(most * theirs[key], 1.0) if key == "islands" else most * theirs[key] + 1e-9
    return ours[key] <= limit


def ratio(ours, theirs, key):
    """Ours over theirs; 1 where both are nothing."""
    return (ours[key] + 1e-9) / (theirs[key] + 1e-9)


def chosen(rows, peer, cuts, goals):
    """Our setting that meets most goals at the length of cuts asked for; where all are longer, that of the shortest."""
    theirs, found = rows[peer], [setting for setting in OURS if done(rows, setting)]
    short = [setting for setting in found if meets(rows[setting], theirs, cuts)]
    if not short:
        return min(found, key=lambda setting: rows[setting]["seams"])

    def rank(setting):
        met = sum(meets(rows[setting], theirs, goal) for goal in goals)
        return -met, sum(max(math.log(ratio(rows[setting], theirs, key) / most), 0.0) for _, key, most in goals)

    return min(short, key=rank)


def beside(rows_of, peer, cuts, goals, setting_of):
    """Rows of a table: each goal, the median of ours over theirs, and on how many of the models it is met together
    with the goal for cuts. @param setting_of rows -> our setting"""
    pairs = [(rows[setting_of(rows)], rows[peer]) for rows in rows_of.values() if done(rows, peer)]
    lines, every = [], [True] * len(pairs)
    for goal in (cuts, *goals):
        met = [meets(ours, theirs, goal) and meets(ours, theirs, cuts) for ours, theirs in pairs]
        every = [a and b for a, b in zip(every, met)]
        middle = statistics.median(ratio(ours, theirs, goal[1]) for ours, theirs in pairs)
        lines.append([goal[0], f"{middle:.2f}", f"{sum(met)} of {len(pairs)}"])
    return [*lines, ["all of these", "", f"{sum(every)} of {len(pairs)}"]]


def default(rows):
    return "ours, in parts"


def goal_rows(groups, peer, cuts, goals, setting_of):
    """A goal and a group of models a row: the median ratio, and how often the goal is met."""
    return [[peer, f"cuts {cuts[2]:g} times as long", heading, *line] for heading, rows_of in groups.items()
            for line in beside(rows_of, peer, cuts, goals, setting_of)]  # fmt: skip


def ratio_rows(rows_of):
    """The settings that the goals beside xatlas were met with, and ours over its on each model."""
    lines = []
    for model, rows in rows_of.items():
        if done(rows, "xatlas"):
            setting = chosen(rows, "xatlas", CUTS, BESIDE_XATLAS)
            pair = rows[setting], rows["xatlas"]
            lines.append([model, setting, *(short(ratio(*pair, goal[1])) for goal in (CUTS, *BESIDE_XATLAS))])
    return lines


def short(value):
    return f"{value:.2f}" if value < 100.0 else f"{value:.0e}"


def cells(facts):
    """A row as it is printed."""
    if "error" in facts:
        return [facts["error"][:110], *[""] * (len(HEAD) - 1)]
    return [str(facts["islands"]), f"{facts['seams']:.1f}", short(facts["spread"]), f"{100.0 * facts['even']:.0f}",
            f"{facts['angle']:.2f}", f"{100.0 * facts['coverage']:.0f}", str(facts["flips"]), str(facts["lost"]),
            f"{100.0 * facts['overlap']:.1f}", f"{facts['seconds']:.2f}"]  # fmt: skip


def model_rows(heading, rows_of):
    """The figures of each model and unwrap."""
    for model, rows in rows_of.items():
        faces = next((facts["faces"] for facts in rows.values() if "faces" in facts), 0)
        yield from ([model, heading, faces, unwrap, *cells(rows[unwrap])] for unwrap in UNWRAPS if unwrap in rows)


def median_rows(rows_of, unwraps):
    """Models together: medians, and how many maps have a fault. @param rows_of model -> unwrap -> figures"""
    lines = []
    for unwrap in unwraps:
        some = [rows[unwrap] for rows in rows_of.values() if done(rows, unwrap)]
        if some:
            keys = ("islands", "seams", "spread", "even", "angle", "coverage", "seconds")
            middle = {key: statistics.median(facts[key] for facts in some) for key in keys}
            faulty = [sum(facts[key] > most for facts in some)
                      for key, most in (("flips", 0), ("lost", 0), ("overlap", 0.001))]  # fmt: skip
            row = cells({**middle, "flips": 0, "lost": 0, "overlap": 0.0, "islands": round(middle["islands"])})
            lines.append([unwrap, len(some), *row[:6], *faulty, row[-1]])
    return lines


def markdown(head, lines):
    rows = [head, ["---"] * len(head), *lines]
    return "".join("| " + " | ".join(map(str, row)) + " |\n" for row in rows)


def save(folder, name, head, lines):
    """A table as a data file, which the site shows sortable."""
    with (folder / f"comparison_{name}.csv").open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *lines])


def write(page, groups):
    """Put the medians into the page, and all tables beside it. @param groups heading -> model -> unwrap -> figures"""
    groups = {heading: rows_of for heading, rows_of in groups.items() if rows_of}
    every = {model: rows for rows_of in groups.values() for model, rows in rows_of.items()}

    def best(peer, cuts, goals):
        return lambda rows: chosen(rows, peer, cuts, goals)

    goals = [*goal_rows(groups, "xatlas", CUTS, BESIDE_XATLAS, best("xatlas", CUTS, BESIDE_XATLAS)),
             *goal_rows(groups, "xatlas", AT_ITS_CUTS, BESIDE_XATLAS, default),
             *goal_rows(groups, "Smart UV", AT_ITS_CUTS, BESIDE_SMART, default)]  # fmt: skip
    if any(done(rows, "OptCuts") for rows in every.values()):
        goals += goal_rows(groups, "OptCuts", AT_ITS_CUTS, BESIDE_SMART, default)
    data = page.parent / "data"
    save(data, "goals", ["beside", "at most", "set", "goal", "median ratio", "met"], goals)
    medians = [[heading, *line] for heading, rows_of in groups.items()
               for line in median_rows(rows_of, (*UNWRAPS, *SETTINGS))]  # fmt: skip
    save(data, "medians", ["set", "unwrap", "done", *SUMMARY], medians)
    ratios = ["model", "setting", "cuts", "density", "angle error", "islands", "seconds"]
    save(data, "ratios", ratios, ratio_rows(every))
    save(data, "models", ["model", "set", "triangles", "unwrap", *HEAD],
         [line for heading, rows_of in groups.items() for line in model_rows(heading, rows_of)])
    shown = [[line[0], *line[2:5], *line[6:8], line[8], line[10], line[11]] for line in median_rows(every, UNWRAPS)]
    text = markdown(["unwrap", *SUMMARY[:3], *SUMMARY[4:6], SUMMARY[6], *SUMMARY[8:]], shown)
    before, rest = page.read_text(encoding="utf-8").split(BEGIN)
    page.write_text(f"{before}{BEGIN}\n\n{text}\n{END}{rest.split(END)[1]}", encoding="utf-8")
    print(text)
