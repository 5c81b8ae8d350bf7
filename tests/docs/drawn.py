"""A picture that stands between two marks of docs/develop/architecture.md."""

from dataclasses import dataclass

from tests.docs.tree import ROOT

PAGE = ROOT / "docs" / "develop" / "architecture.md"


@dataclass(frozen=True)
class Picture:
    """Its marks, each with its end of line."""

    begin: str
    end: str

    def on_the_page(self) -> str:
        """What the page has. Raises ValueError: a mark is missing."""
        text = PAGE.read_text(encoding="utf-8")
        return text[text.index(self.begin) + len(self.begin) : text.index(self.end)]

    def put(self, drawn: str) -> None:
        """Put a picture in the place of the page's."""
        text, old = PAGE.read_text(encoding="utf-8"), self.on_the_page()
        complete = f"{self.begin}{old}{self.end}"
        PAGE.write_text(text.replace(complete, f"{self.begin}{drawn}{self.end}"), "utf-8")
