"""Theme files are cut into their programs; see tests/rapid_programs.py."""

import pytest

from tests.rapid_programs import read, read_all


def test_program_extends_to_next_header_line(tmp_path):
    file = tmp_path / "loops.mod"
    file.write_text("!=== one\nMODULE a\n !=== b\n\nENDMODULE\n\n!=== two\n! end\n", "utf-8")
    one, two = read_all(tmp_path)
    assert (one.text, one.line) == ("MODULE a\n !=== b\n\nENDMODULE\n\n", 1)
    assert (two.text, two.line) == ("! end\n", 7)
    assert two.below(tmp_path) == "loops/two"
    assert str(two) == f"{file}:7: two"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", 1),
        ("! theme\n!=== one\nMODULE a\n", 1),
        ("!=== one\nMODULE a\n!===two\nMODULE b\n", 3),
        ("!=== one\nMODULE a\n!=== two.mod\nMODULE b\n", 3),
        ("!=== one\nMODULE a\n!=== one\nMODULE b\n", 3),
        ("!=== one\n!=== two\nMODULE b\n", 1),
        ("!=== one\nMODULE a\n!=== two\n", 3),
        ("!=== one\nMODULE a\n!=== two", 3),
    ],
)
def test_unsplittable_file_is_rejected_with_line(tmp_path, text, line):
    file = tmp_path / "loops.mod"
    file.write_text(text, "utf-8")
    with pytest.raises(ValueError, match=rf"loops\.mod:{line}: "):
        read(file)
