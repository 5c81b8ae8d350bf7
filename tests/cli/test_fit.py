"""`rapidgen fit`: output, files and what is rejected, with nothing half-written."""

import json

import pytest

from rapidgen.cli.app import main

LINE = [(360, y, 200, 0, 0, 1) for y in range(-100, 101, 10)]


def curve(folder, rows=LINE):
    """Write a curve; return its path."""
    path = folder / "rim.csv"
    path.write_text("\n".join(",".join(map(str, row)) for row in rows), encoding="ascii")
    return str(path)


def test_fit_writes_a_module_and_prints_figures(tmp_path, capsys):
    output = tmp_path / "rim.mod"
    words = ["--robot", "irb120", "--speed", "100", "-o", str(output), "--json"]
    assert main(["fit", curve(tmp_path), *words]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures["deviation"] < 0.5
    assert figures["mean_speed"] == pytest.approx(100, rel=0.01)
    text = output.read_text("ascii")
    assert text.startswith("MODULE rim")
    assert text.count("MoveL") == figures["moves"]
    assert "MoveAbsJ" in text


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["--unit", "m"], "RG783"),
        (["--normals", "tool"], "RG784"),
        (["--speed", "9000"], "RG785"),
    ],
)
def test_rejected_fit_writes_nothing(tmp_path, capsys, words, code):
    output = tmp_path / "rim.mod"
    options = ["--robot", "irb120", "-o", str(output), *words]
    assert main(["fit", curve(tmp_path), *options]) in (1, 2)
    assert code in capsys.readouterr().err
    assert not output.exists()


@pytest.mark.parametrize(
    "words",
    [
        ["--tolerance", "0"],
        ["--tolerance", "nan"],
        ["--speed", "-5"],
        ["--moves", "2"],
        ["--tool", "1,2"],
        ["--tool", "1,2,nan"],
        ["-o", "rim.txt"],
    ],
)
def test_wrong_option_is_a_usage_error(tmp_path, words):
    assert main(["fit", curve(tmp_path), "--robot", "irb120", *words]) == 2
