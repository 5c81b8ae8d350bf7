"""Write the tables of docs/start/configuration.md: `python -m tests.docs.configuration_keys`."""

from pathlib import Path

from rapidgen.config.schema_reference import reference

PAGE = Path(__file__).resolve().parents[2] / "docs" / "start" / "configuration.md"
BEFORE = "All keys, generated from the schema.\n\n"


def main() -> None:
    """Replace everything after the sentence that introduces the tables."""
    text = PAGE.read_text(encoding="utf-8")
    head, mark, _ = text.partition(BEFORE)
    assert mark, f"{PAGE}: {BEFORE.strip()!r} is missing"
    PAGE.write_text(head + mark + reference(), encoding="utf-8")


if __name__ == "__main__":
    main()
