"""Small pieces of reStructuredText."""

import re
import textwrap


def title(text, mark="="):
    """A heading."""
    return f"{text}\n{mark * len(text)}\n\n"


def escaped(text):
    """Plain text, with the marks of reStructuredText escaped."""
    return re.sub(r"([\\*|`])|(?<=\w)(_)(?=\W|$)", lambda mark: "\\" + mark.group(), text)


def indented(text, by=3):
    """The text moved to the right."""
    return textwrap.indent(text, " " * by)


def toctree(names, *options):
    """A list of pages."""
    return ".. toctree::\n" + "".join(f"   {line}\n" for line in (*options, "", *names)) + "\n"


def sentence(text):
    """The text with a capital and a full stop."""
    text = text.strip()
    if text and text[0].islower() and not re.match(r"\w+[_(]", text):
        text = text[0].upper() + text[1:]
    return text if not text or text[-1] in ".!?:" else text + "."
