"""Numbers and lines as the page writes them."""
import textwrap


def percent(value, digits=2):
    """Two figures; from 10 % on no decimals."""
    if value is None:
        return ""
    value *= 100
    return f"{value:.0f} %" if abs(value) >= 9.95 else f"{value:.{digits}g} %"


def points(value):
    """Of strain, in percent with a tenth."""
    return "-" if value is None else f"{100 * value:.1f} %"


def seconds(value):
    if value is None:
        return ""
    if value < 100:
        return f"{value:.2g} s"
    return f"{value:.0f} s" if value < 600 else f"{value / 60:.0f} min" if value < 7200 else \
        f"{value / 3600:.0f} h" if value < 2 * 86400 else f"{value / 86400:.0f} days"


def mega(value):
    return "-" if value is None else f"{value / 1e6:.0f}"


def giga(value):
    return "-" if value is None else f"{value / 1e9:.2f}"


def filled_in(text, values):
    """What the file `text` says, with these values in the place of their names in braces."""
    page = text.read_text()
    for key, value in values.items():
        if "{" + key + "}" not in page:
            raise RuntimeError(f"{text.name} does not use {key}")
        page = page.replace("{" + key + "}", value.rstrip("\n"))
    return page


def finished(text, page):
    """The page, wrapped; nothing is left in braces of what the file `text` names."""
    if "{" in page:
        raise RuntimeError(f"{text.name}: nothing is known for {page[page.index('{'):][:30]}")
    return wrapped(page)


def wrapped(page):
    """Paragraphs and lists in lines of 100; tables, code, headings and figures as they are."""
    def filled(block):
        if block.startswith(("|", "```", "#", "!")):
            return block
        items = block.split("\n- ") if block.startswith("- ") else [block]
        indent = "  " if block.startswith("- ") else ""
        return "\n".join(textwrap.fill(" ".join(("- " * bool(k) + item).split()), 100,
                                       subsequent_indent=indent, break_long_words=False,
                                       break_on_hyphens=False) for k, item in enumerate(items))

    blocks = [block.strip("\n") for block in page.split("\n\n")]
    return "\n\n".join(filled(block) for block in blocks if block) + "\n"
