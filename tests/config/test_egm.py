"""Externally guided motion in the configuration."""

from math import degrees, radians

import pytest

from rapidgen.config import from_manifest, load_config, to_manifest
from rapidgen.diagnostics import DiagnosticError, Severity

EGM = "egm: {address: 192.168.125.20, max_deviation: 20, max_speed: 45"
ARM = "model: irb120\ncontroller: {robotware: 6.15}\n"


@pytest.fixture
def load(tmp_path):
    def load(text):
        path = tmp_path / "cell.yaml"
        path.write_text(text)
        return load_config(path)

    return load


def test_settings_are_in_si_units_and_survive_the_manifest(load):
    config = load(ARM + EGM + "}\n")
    egm = config.groups[0].egm
    assert (egm.device, egm.address, egm.port) == ("ROS_EGM", "192.168.125.20", 6510)
    assert egm.max_deviation == pytest.approx(radians(20))
    assert degrees(egm.max_speed) == pytest.approx(45)
    assert from_manifest(to_manifest(config)).groups == config.groups


def test_manifest_without_egm_has_no_entry(load):
    (group,) = to_manifest(load(ARM))["groups"]
    assert "egm" not in group


@pytest.mark.parametrize("key", ["address", "max_deviation", "max_speed"])
def test_a_key_without_a_default_is_required(load, key):
    keys = {"address": "192.168.125.20", "max_deviation": 20, "max_speed": 45}
    given = ", ".join(f"{k}: {v}" for k, v in keys.items() if k != key)
    with pytest.raises(DiagnosticError) as caught:
        load(f"{ARM}egm: {{{given}}}\n")
    assert key in caught.value.diagnostics[0].message


@pytest.mark.parametrize(
    ("text", "code", "message"),
    [
        ("model: irb2400\ncontroller: {robotware: 5.61}\n" + EGM + "}", "RG072", "5.61"),
        ("model: irb120\ncontroller: {robotware: 6.06}\n" + EGM + "}", "RG072", "6.06"),
        (ARM + "profile: basic\n" + EGM + "}", "RG072", "control port"),
        (ARM + "ports: {control: 0}\n" + EGM + "}", "RG072", "control port"),
        ("model: irb910sc\ncontroller: {robotware: 6.15}\n" + EGM + "}", "RG073", "six or seven"),
        (ARM + EGM.replace("45", "400") + "}", "RG074", "max_speed of 400"),
        (ARM + EGM.replace("192.168.125.20", "0.0.0.0") + "}", "RG006", "'0.0.0.0'"),
    ],
)
def test_what_cannot_be_guided_is_rejected(load, text, code, message):
    with pytest.raises(DiagnosticError) as caught:
        load(text)
    (fault,) = [d for d in caught.value.diagnostics if d.severity is Severity.ERROR]
    assert fault.code == code
    assert message in fault.message


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (EGM.replace("20,", "0.35,", 1).replace(".125.0.35,", ".125.20,"), "max_deviation"),
        (EGM.replace("max_deviation: 20", "max_deviation: 1.5708"), "max_deviation"),
        (EGM.replace("45", "0.5"), "max_speed"),
    ],
)
def test_limits_in_rad_are_reported(load, text, name):
    if name == "max_deviation" and "1.5708" not in text:
        text = EGM.replace("max_deviation: 20", "max_deviation: 0.35")
    (finding,) = [d for d in load(ARM + text + "}\n").diagnostics if d.code == "RG071"]
    assert name in finding.message


def test_each_group_has_a_device_and_a_port(load):
    groups = "\n".join(
        f"  {name}: {{model: irb120, task: T_ROB{n}, mechanical_unit: ROB_{n}, {EGM}}}}}"
        for n, name in enumerate(("left", "right"), 1)
    )
    config = load(f"controller: {{robotware: 6.15}}\ngroups:\n{groups}\n")
    assert [(g.egm.device, g.egm.port) for g in config.groups] == [
        ("ROS_EGM", 6510),
        ("ROS_EGM_2", 6511),
    ]
    shared = groups.replace("max_speed: 45", "max_speed: 45, device: PC, port: 6510")
    with pytest.raises(DiagnosticError) as caught:
        load(f"controller: {{robotware: 6.15}}\ngroups:\n{shared}\n")
    assert [d.code for d in caught.value.diagnostics] == ["RG012", "RG012"]
