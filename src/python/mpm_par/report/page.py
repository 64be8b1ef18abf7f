"""HTML: one page, everything in it."""
import base64
import pathlib
from html import escape

TYPES = {"svg": "image/svg+xml", "png": "image/png"}


def source_of(drawing):
    """The picture itself, as an address."""
    picture = base64.b64encode(drawing.files[drawing.shown]).decode()
    return f"data:{TYPES[drawing.shown]};base64,{picture}"


def figure(drawing, still=None):
    """`still`: what whoever wants no motion sees in its place."""
    image = (f'<img src="{source_of(drawing)}" alt="{escape(drawing.alt)}" loading="lazy">')
    if still is not None:
        image = ('<picture><source media="(prefers-reduced-motion: reduce)" '
                 f'srcset="{source_of(still)}">{image}</picture>')
    return f"<figure>{image}<figcaption>{escape(drawing.caption)}</figcaption></figure>"


def table(caption, titles, rows):
    """The first cell of a row is its header."""
    head = "".join(f'<th scope="col">{escape(title)}</th>' for title in titles)
    head = f"<thead><tr>{head}</tr></thead>" if any(titles) else ""
    body = "".join(
        f'<tr><th scope="row">{escape(str(row[0]))}</th>'
        + "".join(f"<td>{escape(str(cell))}</td>" for cell in row[1:]) + "</tr>" for row in rows)
    return (f'<div class="wide"><table><caption>{escape(caption)}</caption>'
            f"{head}<tbody>{body}</tbody></table></div>")


def paragraphs(sentences, kind=""):
    of = f' class="{kind}"' if kind else ""
    return "".join(f"<p{of}>{escape(sentence)}</p>" for sentence in sentences)


def listed(sentences):
    return "<ul>" + "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences) + "</ul>"


def gallery(drawings):
    return '<div class="gallery">' + "".join(map(figure, drawings)) + "</div>"


def folded(title, text):
    return (f"<details><summary>{escape(title)}</summary>"
            f'<pre tabindex="0">{escape(text)}</pre></details>')


def page(title, subtitle, ending, sections, foot):
    """`ending`: (kind, sentence); `sections`: (id, title, HTML), left out without HTML."""
    style = (pathlib.Path(__file__).parent / "page.css").read_text(encoding="utf-8")
    there = [section for section in sections if section[2]]
    links = "".join(f'<li><a href="#{name}">{escape(words)}</a></li>' for name, words, _ in there)
    body = "".join(f'<section id="{name}" aria-labelledby="{name}-title">'
                   f'<h2 id="{name}-title">{escape(words)}</h2>{inner}</section>'
                   for name, words, inner in there)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="mpm_report">
<title>{escape(title)}</title>
<style>
{style}</style>
</head>
<body>
<header><h1>{escape(title)}</h1><p class="subtitle">{escape(subtitle)}</p>
<p class="ending {ending[0]}">{escape(ending[1])}</p>
<nav aria-label="Contents"><ul>{links}</ul></nav></header>
<main>{body}</main>
<footer>{paragraphs(foot)}</footer>
</body>
</html>
"""
