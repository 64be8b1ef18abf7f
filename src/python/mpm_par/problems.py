"""What can be wrong with results, and how it is said."""
import argparse
import sys
import textwrap

WIDTH = 80  # columns of the terminal


class ResultsError(Exception):
    """One sentence: place, what is wrong there, and what to do."""


class Options(argparse.ArgumentParser):
    """Options of a command, which says what is wrong with them as other mistakes are said."""

    def error(self, message):
        self.print_usage(sys.stderr)
        say(f"{self.prog}: error: {message}")
        sys.exit(2)


def folded(text, first="", others="    "):
    """The text's lines at most 80 columns wide, whose first begins with `first`, and what is folded over
    with `others`; a number stays with its %, and what has no blank is as long as it is."""
    joined = "\N{NO-BREAK SPACE}%"
    return "\n".join(
        textwrap.fill(line.replace(" %", joined), WIDTH, initial_indent=first, subsequent_indent=others,
                      break_long_words=False, break_on_hyphens=False).replace(joined, " %")
        if len(first) + len(line) > WIDTH else first + line for line in text.split("\n"))


def say(message):
    """On stderr: folded at 80 columns on a terminal, a line for each of its own elsewhere, as editors
    and logs take them."""
    text = str(message)
    print(folded(text) if sys.stderr.isatty() else text, file=sys.stderr)
