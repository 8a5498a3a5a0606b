# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of docs/comparison.md: figures of all maps, and ours over another's."""

import math
import statistics

from compare_unwraps import SETTINGS, UNWRAPS

BEGIN, END = "<!-- the tables of `make compare` -->", "<!-- their end -->"
HEAD = ["unwrap", "islands", "cuts / √area", "density, 5 to 95 %", "area within a factor 3", "angle error", "coverage",
        "flips", "faces lost", "overlap", "seconds"]  # fmt: skip
SUMMARY = ["unwrap", "models done", *HEAD[1:7], "models with flips", "with faces lost", "with overlap", "seconds"]
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


def goal_table(groups, peer, cuts, goals, setting_of):
    """A goal a row, and of each group of models the median ratio and how often the goal is met."""
    head = ["goal", *(f"{heading}: {what}" for heading in groups for what in ("ratio", "goal met"))]
    columns = [beside(rows_of, peer, cuts, goals, setting_of) for rows_of in groups.values()]
    return markdown(head, [[lines[0][0], *(cell for line in lines for cell in line[1:])] for lines in zip(*columns)])


def setting_table(groups):
    """The settings that the goals beside xatlas were met with, and ours over its on each model."""
    lines = []
    for rows_of in groups.values():
        for model, rows in rows_of.items():
            if done(rows, "xatlas"):
                setting = chosen(rows, "xatlas", CUTS, BESIDE_XATLAS)
                pair = rows[setting], rows["xatlas"]
                cells = [marked(ratio(*pair, goal[1]), meets(*pair, goal)) for goal in (CUTS, *BESIDE_XATLAS)]
                lines.append([model, "" if setting in UNWRAPS else f"`{setting}`", *cells])
    return markdown(["model", "setting", "cuts", "density", "angle error", "islands", "seconds"], lines)


def marked(value, met):
    text = f"{value:.2f}" if value < 100.0 else f"{value:.0e}"
    return text if met else f"**{text}**"


def markdown(head, lines):
    rows = [head, ["---"] * len(head), *lines]
    return "".join("| " + " | ".join(map(str, row)) + " |\n" for row in rows)


def cells(facts):
    """A row as it is printed."""
    if "error" in facts:
        return [facts["error"][:110], *[""] * (len(HEAD) - 2)]
    spread = f"{facts['spread']:.2f}" if facts["spread"] < 100.0 else f"{facts['spread']:.0e}"
    return [f"{facts['islands']:,}", f"{facts['seams']:.1f}", spread, f"{100.0 * facts['even']:.0f} %",
            f"{facts['angle']:.2f}°", f"{100.0 * facts['coverage']:.0f} %", f"{facts['flips']:,}", f"{facts['lost']:,}",
            f"{100.0 * facts['overlap']:.1f} %", f"{facts['seconds']:.2f}"]  # fmt: skip


def table(model, rows):
    """One model's figures."""
    faces = next((facts["faces"] for facts in rows.values() if "faces" in facts), 0)
    lines = [[unwrap, *cells(rows[unwrap])] for unwrap in UNWRAPS if unwrap in rows]
    return f"#### {model}, {faces:,} triangles\n\n" + markdown(HEAD, lines)


def summary(rows_of):
    """Models together: medians, and how many maps have a fault. @param rows_of model -> unwrap -> figures"""
    lines = []
    for unwrap in (*UNWRAPS, *SETTINGS):
        some = [rows[unwrap] for rows in rows_of.values() if done(rows, unwrap)]
        if some:
            keys = ("islands", "seams", "spread", "even", "angle", "coverage", "seconds")
            middle = {key: statistics.median(facts[key] for facts in some) for key in keys}
            faulty = [sum(facts[key] > most for facts in some)
                      for key, most in (("flips", 0), ("lost", 0), ("overlap", 0.001))]  # fmt: skip
            row = cells({**middle, "flips": 0, "lost": 0, "overlap": 0.0, "islands": round(middle["islands"])})
            name = unwrap if unwrap in UNWRAPS else f"ours, `{unwrap}`"
            lines.append([name, len(some), *row[:6], *faulty, row[-1]])
    return markdown(SUMMARY, lines)


def write(page, groups):
    """Put the tables into the page. @param groups heading -> model -> unwrap -> figures"""
    groups = {f"{len(rows_of)} {heading}": rows_of for heading, rows_of in groups.items() if rows_of}

    def best(peer, cuts, goals):
        return lambda rows: chosen(rows, peer, cuts, goals)

    text = ["### Compared with xatlas, with 60 % of its cuts\n",
            goal_table(groups, "xatlas", CUTS, BESIDE_XATLAS, best("xatlas", CUTS, BESIDE_XATLAS)),
            "### Compared with xatlas, with our default\n",
            goal_table(groups, "xatlas", AT_ITS_CUTS, BESIDE_XATLAS, default),
            "### Compared with Smart UV, with our default\n",
            goal_table(groups, "Smart UV", AT_ITS_CUTS, BESIDE_SMART, default)]  # fmt: skip
    if any(done(rows, "OptCuts") for rows_of in groups.values() for rows in rows_of.values()):
        text += ["### Compared with OptCuts, with our default\n",
                 goal_table(groups, "OptCuts", AT_ITS_CUTS, BESIDE_SMART, default)]  # fmt: skip
    for heading, rows_of in groups.items():
        text += [f"### {heading}\n", summary(rows_of)]
    text += ["### Our figures over the figures of xatlas, with 60 % of its cuts\n", setting_table(groups),
             "### Each model\n"]  # fmt: skip
    text += [table(model, rows) for rows_of in groups.values() for model, rows in rows_of.items()]
    before, rest = page.read_text(encoding="utf-8").split(BEGIN)
    page.write_text(f"{before}{BEGIN}\n\n" + "\n".join(text) + f"\n{END}{rest.split(END)[1]}", encoding="utf-8")
    print("\n".join(text[: -sum(map(len, groups.values()))]))
