"""What can be wrong with results, and how it is said."""
import sys
import textwrap

WIDTH = 80  # columns of the terminal


class ResultsError(Exception):
    """One sentence: place, what is wrong there, and what to do."""


def say(message):
    """On stderr: folded at 80 columns on a terminal, a line for each of its own elsewhere, as editors
    and logs take them."""
    text = str(message)
    if sys.stderr.isatty():
        text = "\n".join(textwrap.fill(line, WIDTH, subsequent_indent="    ", break_long_words=False,
                                       break_on_hyphens=False) if len(line) > WIDTH else line
                         for line in text.split("\n"))
    print(text, file=sys.stderr)
