"""One page for every diagnostic code: `RGnnn.md`, with a bad and a good example."""

from pathlib import Path

_FOLDER = Path(__file__).resolve().parent


def codes() -> list[str]:
    """All codes, sorted."""
    return sorted(path.stem for path in _FOLDER.glob("RG*.md"))


def page(code: str) -> str:
    """Text of a code's page (Markdown)."""
    return (_FOLDER / f"{code}.md").read_text(encoding="utf-8")


def title(code: str) -> str:
    """Title of a code's page, without the code."""
    return page(code).partition("\n")[0].removeprefix(f"# {code}: ")
