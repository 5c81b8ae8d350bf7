"""Known variants as models: complete ones load, others name the gaps."""

import math
import re

import pytest

from rapidgen.axes.kinematics import Kinematics
from rapidgen.cli.app import main
from rapidgen.config import load_config
from rapidgen.config.variant_library import variants
from rapidgen.config.variant_model import missing_figures, model_name, named
from rapidgen.diagnostics import DiagnosticError

KNOWN = [v for v in variants() if not v.model and not missing_figures(v)]
LACKING = [v for v in variants() if not v.model and missing_figures(v)]


def loaded(tmp_path, variant):
    """A configuration of a variant; speeds that no source has are 100."""
    speeds = "".join(f"  joint_{a.axis[-1]}: {{speed: 100}}\n" for a in variant.axes if not a.speed)
    path = tmp_path / "cell.yaml"
    path.write_text(
        f"model: {model_name(variant)}\ncontroller: {{type: irc5, robotware: 6.15}}\n"
        + (f"joints:\n{speeds}" if speeds else "")
    )
    return load_config(path)


@pytest.mark.parametrize("variant", KNOWN, ids=model_name)
def test_a_variant_is_a_model_with_its_own_figures(tmp_path, variant):
    config = loaded(tmp_path, variant)
    group = config.groups[0]
    assert {d.code for d in config.diagnostics} <= {"RG016"}
    for joint, axis in zip(group.joints, variant.axes, strict=True):
        assert joint.axis == axis.axis
        ends = (math.degrees(joint.lower), math.degrees(joint.upper))
        assert ends == pytest.approx((axis.lower, axis.upper), abs=0.011)
    place, q = Kinematics.of(group).forward((0.0,) * 6)
    assert place == pytest.approx(variant.skeleton.end, abs=1e-6)
    assert q == pytest.approx((math.sqrt(0.5), 0, math.sqrt(0.5), 0))  # tool0 looks ahead


def test_names_of_variants_are_their_own():
    names = [model_name(v) for v in variants()]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(r"[a-z0-9_]+", name) for name in names)
    assert model_name(named("IRB 6700-155/2.85")) == "irb6700_155_285"
    assert model_name(named("irb 1100-4/0.475")) == "irb1100_4_475"


@pytest.mark.parametrize("variant", LACKING, ids=model_name)
def test_incomplete_variant_names_its_missing_figures(tmp_path, variant):
    with pytest.raises(DiagnosticError) as fault:
        loaded(tmp_path, variant)
    (result,) = fault.value.diagnostics
    assert result.code == "RG009"
    assert all(text in result.message for text in missing_figures(variant))


def test_new_writes_a_variant(tmp_path, capsys):
    file = tmp_path / "cell.yaml"
    assert main(["new", str(file), "--robot", "IRB 6700-155/2.85"]) == 0
    assert "model: irb6700_155_285" in file.read_text()
    assert main(["check", str(file)]) == 0
    capsys.readouterr()
    other = tmp_path / "other.yaml"
    assert main(["new", str(other), "--robot", "irb1300_7_140"]) == 1
    assert "'joints.joint_6.speed' is open" in capsys.readouterr().err
    assert main(["check", str(other)]) == 1
    given = ["--speed", "120", "--force"]
    assert main(["new", str(other), "--robot", "irb1300_7_140", *given]) == 0


def test_robots_lists_the_names_of_variants(capsys):
    assert main(["robots", "6700"]) == 0
    text = capsys.readouterr().out
    assert re.search(r"^irb6700_155_285 +ABB IRB 6700-155/2.85$", text, re.MULTILINE)
    assert re.search(r"^- +ABB IRB 6700-245/3.0 \(recognised only; lacks", text, re.MULTILINE)
    assert main(["robots", "show", "irb6700_155_285"]) == 0
    assert "(model irb6700_155_285)" in capsys.readouterr().out
