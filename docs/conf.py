"""The site: `make site` builds it from docs/ and the docstrings, with every warning an error."""

import re
from pathlib import Path
from typing import ClassVar

import typer
from pygments.lexer import RegexLexer, words
from pygments.token import Comment, Keyword, Name, Number, Punctuation, String, Whitespace
from sphinx.application import Sphinx

from rapidgen import __version__
from rapidgen.cli.app import COMMANDS, _app
from rapidgen.diagnostics.pages import codes, page
from rapidgen.rapid.syntax.lexer import KEYWORDS

project = "rapidgen"
author = project_copyright = "the authors of rapidgen"
release = version = __version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton"]
exclude_patterns = ["changes"]

html_theme = "furo"
html_search_scorer = str(Path(__file__).parent / "assets" / "scorer.js")
html_static_path = ["assets"]
html_css_files = ["versions.css"]
html_js_files = [("versions.js", {"defer": "defer"})]
html_title = f"rapidgen {release}"
html_copy_source = False
html_show_sphinx = False

myst_heading_anchors = 3
myst_enable_extensions = ["colon_fence"]
# A prompt is not part of a command.
copybutton_prompt_text = "$ "

# A word between single backticks in a docstring is code, as in Markdown.
default_role = "code"
# `Attributes:` of a docstring are a list, since members have entries of their own.
napoleon_use_ivar = True
autodoc_default_options = {"members": True, "undoc-members": True}
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True


class RapidLexer(RegexLexer):
    """Colours of RAPID; the reserved words are the front end's."""

    name = "RAPID"
    aliases: ClassVar = ["rapid"]
    flags = re.IGNORECASE
    tokens: ClassVar = {
        "root": [
            (r"![^\n]*", Comment.Single),
            (r'"(?:[^"\n]|"")*"', String),
            (words(sorted(KEYWORDS), prefix=r"\b", suffix=r"\b"), Keyword),
            (
                r"(?:num|dnum|bool|string|robtarget|jointtarget|speeddata|zonedata|tooldata)\b",
                Keyword.Type,
            ),
            (r"\d[\d.]*(?:E[+-]?\d+)?", Number),
            (r"\w+", Name),
            (r"\s+", Whitespace),
            (r".", Punctuation),
        ]
    }


def write_codes(app: Sphinx) -> None:
    """What `rapidgen explain` says becomes a page of the site."""
    chapters = (
        f"```{{index}} ! single: {code}\n```\n\n"
        + re.sub(r"^#", "##", page(code), flags=re.MULTILINE)
        for code in codes()
    )
    text = "# Diagnostics\n\nWhat `rapidgen explain CODE` says.\n\n" + "\n".join(chapters)
    write(app, "codes.md", text)


def write_commands(app: Sphinx) -> None:
    """The help of each command becomes a chapter of a page."""
    chapters = []
    for name in COMMANDS:
        command = typer.main.get_command(_app([name])).commands[name]
        context = command.make_context(name, [], resilient_parsing=True, max_content_width=90)
        context.info_name = f"rapidgen {name}"
        chapters.append(f"## {name}\n\n```text\n{command.get_help(context)}\n```\n")
    introduction = "# Commands\n\nWhat `rapidgen COMMAND --help` says.\n\n"
    write(app, "cli.md", introduction + "\n".join(chapters))


def write(app: Sphinx, name: str, text: str) -> None:
    """Write a page of the reference if it has changed, so that Sphinx reads it again only then."""
    path = Path(app.srcdir) / "reference" / name
    if not path.exists() or path.read_text("utf-8") != text:
        path.write_text(text, encoding="utf-8")


def setup(app: Sphinx) -> None:
    """Sphinx calls it when it has read this file."""
    app.connect("builder-inited", write_codes)
    app.connect("builder-inited", write_commands)
    app.add_lexer("rapid", RapidLexer)
