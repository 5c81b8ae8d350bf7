"""Template lines of generated RAPID lines."""

import pytest

from rapidgen._data import data_folder
from rapidgen.config import load_config
from rapidgen.generate import build
from rapidgen.generate.source_map import origin_of
from rapidgen.system import expand_lines

TEMPLATES = data_folder("templates")


@pytest.fixture(scope="module")
def modules():
    """Path to text and line map, of one driver."""
    files = build(load_config("irb120")).files
    return {
        file.path: (text, expand_lines(file.lines, text.count("\n")))
        for file in files
        if file.kind == "module"
        for text in [file.data.decode()]
    }


def test_every_line_of_rapid_has_a_template_whose_text_it_is(modules):
    plain = 0
    for text, lines in modules.values():
        result = origin_of(text, lines)
        made = text.splitlines()
        assert [line for line, _, _ in result.lines] == [*range(1, len(made) + 1)]
        for line, template, number in result.lines:
            source = (TEMPLATES / template).read_text().splitlines()[number - 1]
            assert result.templates[template].splitlines()[number - 1] == source
            # What is outside of tags is in the line as it is.
            remaining = made[line - 1]
            for piece in outside(source):
                assert piece in remaining, (template, number, remaining)
                remaining = remaining.partition(piece)[2]
            plain += "{" not in source
    assert plain > 2000


def outside(source):
    """The pieces of a template's line that are text."""
    pieces = source.replace("}}", "{{").replace("%}", "{{").replace("{%", "{{").split("{{")
    return [piece.strip() for piece in pieces[::2] if piece.strip()]


def test_a_text_of_other_templates_has_names_and_lines_alone(modules):
    text, lines = modules["HOME/rapidgen/ROS_motion.mod"]
    assert origin_of(text, lines).templates
    other = text.replace("PROC main()", "PROC start()")
    assert other != text
    for bad, mapped in (
        (other, lines),
        (text, [(line, template, number + 1) for line, template, number in lines]),
        (text, [*lines, (len(lines) + 5, lines[0][1], 1)]),
        (text, [(1, lines[0][1], 10**9)]),
        (text, [(1, lines[0][1], 0)]),
    ):
        result = origin_of(bad, mapped)
        assert result.lines == tuple(mapped)
        assert result.templates == {}


@pytest.mark.parametrize(
    "name",
    ["../pyproject.toml", "/etc/passwd", "ros2", "ros2/README.md.j2", "", ".", "a\0b", "x.j2"],
)
def test_nothing_but_a_template_is_read(modules, name):
    text, lines = modules["HOME/rapidgen/ROS_motion.mod"]
    assert origin_of(text, [*lines, (1, name, 1)]).templates == {}
    assert origin_of("", [(1, name, 1)]).templates == {}
