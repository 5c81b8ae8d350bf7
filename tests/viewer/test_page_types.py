"""The page's message types are those of the schema."""

from tests.viewer.page_types import TARGET, made


def test_the_types_are_those_of_the_schema():
    assert TARGET.read_text() == made(), "python -m tests.viewer.page_types"
