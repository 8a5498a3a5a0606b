"""The reference of the command: a page for each sub-command, from its --help, which the table of options makes."""

import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from markup import escaped, indented, sentence, title, toctree

ROOT = Path(__file__).resolve().parents[2]
COMMAND = ROOT / "build" / "koebe"
COLUMN = 30  # where the help's texts begin
EXAMPLE = re.compile(r"^(?:build/koebe .* && )?build/koebe (\S+) .*$", re.MULTILINE)


@dataclass
class Option:
    """An option or an argument: what stands for its value, its default or None, its text, its words."""

    name: str
    value: str
    default: str | None
    required: bool
    text: str = ""
    words: list[tuple[str, str]] = field(default_factory=list)


def help_of(*words):
    return subprocess.run([COMMAND, *words, "--help"], capture_output=True, text=True, check=True).stdout


def commands():
    """The sub-commands and what each does."""
    listed = help_of().partition("Subcommands:\n")[2].partition("\n\n")[0]
    return dict(re.findall(r"^  (\w+) +(.+)$", listed, re.MULTILINE))


def option(head):
    """An option from the left side of its line."""
    head = re.sub(r" Excludes: .*", "", head)
    required = head.endswith(" REQUIRED")
    name, _, value = head.removesuffix(" REQUIRED").partition(" ")
    value, equal, default = value.partition("=")
    choices = re.fullmatch(r"TEXT:\{(.*)\}", value)
    value = choices[1].replace(",", "|") if choices else re.sub(r"^(TEXT|INT)(?=$| )", "", value).strip()
    return Option(name, value, default if equal else None, required)


def groups(text):
    """The groups of a help text: heading -> options."""
    found, group = {}, []
    for line in text.splitlines()[2:]:
        if line.startswith("Exit codes:"):
            break
        if re.fullmatch(r"\S.*:", line):
            group = found.setdefault(line[:-1], [])
        elif line.startswith(" " * COLUMN):
            said = line.strip()
            word = re.match(r"([\w-]+): (.+)", said)
            if word and group[-1].text and word[1] in group[-1].value.split("|"):
                group[-1].words.append((word[1], word[2]))
            else:
                group[-1].text = f"{group[-1].text} {said}".strip()
        elif line.startswith("  "):
            head, gap, said = line.strip().partition("  ")
            if not gap and line[COLUMN - 1 : COLUMN] == " " and "Excludes" not in line:  # the head ends at the texts
                head, said = line[:COLUMN].strip(), line[COLUMN:]
            group.append(option(head))
            group[-1].text = said.strip()
    return found


def options(name):
    """All options of a sub-command, by their names."""
    return {one.name: one for group in groups(help_of(name)).values() for one in group}


def entry(one):
    """An option in reStructuredText."""
    head = one.name.replace(",", ", ") + (f" {one.value}" if one.value else "")
    text = sentence(escaped(one.text))
    if one.required and one.name.startswith("-"):
        text += " Required."
    if one.default not in (None, ""):
        text += f" Default: ``{one.default}``."
    words = "".join(f"- ``{word}``: {escaped(means)}\n" for word, means in one.words)
    return f".. option:: {head}\n\n{indented(text)}\n\n" + (indented(words) + "\n" if words else "")


def examples():
    """The examples of the pages, which the tests run: sub-command -> lines."""
    found = {}
    for page in sorted((ROOT / "docs").glob("*.md")):
        for match in EXAMPLE.finditer(page.read_text(encoding="utf-8")):
            found.setdefault(match[1], []).append(match[0])
    return found


def page(name, does, lines):
    """The page of a sub-command."""
    text = help_of(name)
    usage = re.search(r"^Usage: (.+)$", text, re.MULTILINE)[1]
    made = title(f"koebe {name}") + sentence(escaped(does)) + "\n\n"
    made += f".. code-block:: text\n\n   {usage}\n\n"
    if lines:
        made += "For example:\n\n.. code-block:: sh\n\n" + indented("\n".join(dict.fromkeys(lines[:3]))) + "\n\n"
    made += f".. program:: koebe {name}\n\n"
    for heading, group in groups(text).items():
        group = [one for one in group if one.name != "-h,--help"]
        made += title({"Positionals": "Arguments"}.get(heading, heading), "-") if group else ""
        made += "".join(map(entry, group))
    return made


def faults():
    """Sub-commands without an example that is run, and options without a text."""
    shown = examples()
    bare = [f"koebe {name} has no example in docs/" for name in commands() if name not in shown]
    silent = [
        f"koebe {name}: {one.name} has no text" for name in commands() for one in options(name).values() if not one.text
    ]
    return bare + silent


def pages():
    """The pages: name -> text."""
    made, shown = {}, examples()
    index = title("The command") + "``koebe COMMAND --help`` prints the same. :doc:`/command` is the introduction.\n\n"
    index += ".. list-table::\n   :class: names\n\n"
    for name, does in commands().items():
        index += f"   * - :doc:`koebe {name} <{name}>`\n     - {sentence(escaped(does))}\n"
        made[f"reference/command/{name}.rst"] = page(name, does, shown.get(name, []))
    made["reference/command/index.rst"] = index + "\n" + toctree(commands(), ":hidden:")
    return made
