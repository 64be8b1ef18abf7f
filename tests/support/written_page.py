"""Pages of docs that a script writes out of what was measured."""
import sys


def table(heads, lines):
    """Markdown."""
    return "\n".join(["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
                     + ["| " + " | ".join(line) + " |" for line in lines]) + "\n"


def write_or_check(page, text):
    """Writes the page; with --check it only ends the script, with words, where the page is another one.
    Whether it was written."""
    if "--check" not in sys.argv[1:]:
        page.write_text(text)
        return True
    if page.read_text() != text:
        sys.exit(f"{page} is not what {sys.argv[0]} writes: run it")
    return False
