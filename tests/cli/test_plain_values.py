"""Words that are read without pydantic become what typer makes of them."""

import os
import subprocess
import sys
from enum import Enum
from pathlib import Path
from typing import Annotated, Literal

import pytest
import typer
from typer.exceptions import TyperException

from rapidgen.cli.option_values import PlainCommand, plain

HELLO = 'MODULE hello\n PROC main()\n TPWrite "hello";\n ENDPROC\nENDMODULE\n'
SAID = [
    [],
    ["a.mod", "b c.mod", "-"],
    ["--count", "3"], ["--count", "-3"], ["--count", "0"], ["--count", "99"],
    ["--count", "3.0"], ["--count", "1_000"], ["--count", "٣"], ["--count", " 4"], ["--count", "x"],
    ["--count", "12345678901234567890"],
    ["--time", "2"], ["--time", "2.50"], ["--time", "-1"], ["--time", "1e3"], ["--time", "nan"],
    ["--time", "inf"], ["--time", ""], ["--time", ".5"],
    ["--cycle", "forever"], ["--cycle", "Forever"], ["--cycle", ""],
    ["--file", "nowhere"], ["--file", "/"], ["--file", "-"], ["--file", "."],
    ["--there", "/nowhere"], ["--there", "/"],
    ["--more", "one", "--more", "two"], ["--name", "3"], ["--on"], ["--off"], ["--on", "--off"],
    ["--named", "x"],
    ["--kind", "round"], ["--kind", "ROUND"], ["--kind", "flat"], ["--kind", ""],
]  # fmt: skip


class Kind(str, Enum):
    """A choice, as the formats of `check`."""

    ROUND = "round"
    SQUARE = "square"


def made(words, cls=None):
    """What a verb gets from the words, or how it is refused."""
    result = []
    app = typer.Typer()

    @app.command(cls=cls)
    def verb(
        files: Annotated[list[Path], typer.Argument()] = [],  # noqa: B006
        count: Annotated[int, typer.Option(min=-5, max=50)] = 1,
        time: Annotated[float, typer.Option(min=0)] = 2.0,
        cycle: Annotated[Literal["once", "forever"], typer.Option()] = "once",
        file: Annotated[Path | None, typer.Option()] = None,
        target: Annotated[Path | None, typer.Option(exists=True)] = None,
        more: Annotated[list[str] | None, typer.Option()] = None,
        name: str = "",
        switch: Annotated[bool, typer.Option("--on/--off")] = True,
        named: Annotated[str, typer.Option(callback=lambda text: text + "!")] = "n",
        kind: Kind = Kind.SQUARE,
    ):
        values = (files, count, time, cycle, file, target, more, name, switch, named, kind)
        result.append(values)

    try:
        typer.main.get_command(app).main(args=words, standalone_mode=False)
    except TyperException as fault:
        return fault.format_message()
    return [(one, type(one)) for one in result[0]]


@pytest.mark.parametrize("text", SAID, ids=" ".join)
def test_fast_conversion_equals_typer(text):
    assert made(text, PlainCommand) == made(text)


def test_a_plain_word_is_taken_and_another_is_left_to_typer():
    info = typer.Option(min=1)
    assert plain(int, info, "3") == 3
    assert plain(int, info, "0") not in (0, "0", None)


def test_a_run_does_not_load_pydantic(tmp_path):
    program = tmp_path / "hello.mod"
    program.write_text(HELLO)
    script = (
        "import sys, rapidgen.cli.app as app\n"
        f"assert app.main(['run', {str(program)!r}]) == 0\n"
        "print(sorted({'pydantic', 'jinja2', 'asyncio', 'ruamel.yaml', 'rich'} & set(sys.modules)))"
    )
    # The first run keeps the checked model of the robot beside the code, as Python its bytecode.
    free = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", script], capture_output=True, text=True, env=free
        )
    assert done.stdout == "hello\n[]\n", done.stderr
