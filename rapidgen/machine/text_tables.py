"""Text tables that programs install from files [K §15]."""

import re

_TABLE_NAME = re.compile(r"(\S.{0,79})::")
_INDEX = re.compile(r"(\d+):")


class TextTables:
    """Installed text tables: names, numbers from 1, texts by index."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._texts: list[dict[int, str]] = []

    def number(self, name: str) -> int | None:
        """Return the number of a table."""
        return self._numbers.get(name)

    def text(self, number: int, index: int) -> str | None:
        """Return a text."""
        if not 1 <= number <= len(self._texts):
            return None
        return self._texts[number - 1].get(index)

    def install(self, text: str) -> None:
        """Install the tables of a file [K §15], or extend existing ones.

        ValueError: a line of another format.
        """
        table: dict[int, str] | None = None
        index: int | None = None
        for number, line in enumerate(text.splitlines(), 1):
            if index is not None and table is not None:
                table[index] = line.replace("\\n", "\n")
                index = None
            elif not line.strip() or line.startswith("#"):
                continue
            elif match := _TABLE_NAME.fullmatch(line.strip()):
                table = self._table(match[1])
            elif (match := _INDEX.fullmatch(line.strip())) and table is not None:
                index = int(match[1])
            else:
                raise ValueError(f"line {number}")

    def _table(self, name: str) -> dict[int, str]:
        number = self._numbers.setdefault(name, len(self._texts) + 1)
        if number > len(self._texts):
            self._texts.append({})
        return self._texts[number - 1]
