"""The cases of externally guided motion hold for both generations, and detect defects."""

from dataclasses import replace

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.settings import assumed
from rapidgen.verification.suite.guidance import case
from rapidgen.verification.testbench import Bench

CASES = {made.name: made for made in case.cases}
IDLE = 2.0
"""s until a session ends at its target."""


def _idle(config):
    """Return the configuration with an idle time that a test can wait for."""
    (group,) = config.groups
    return replace(config, groups=(replace(group, egm=replace(group.egm, idle_timeout=IDLE)),))


CONFIGS = {
    6: load_config("robots/examples/irb120_egm-rw6.yaml"),
    7: load_config("robots/examples/crb15000_egm-rw7.yaml"),
}
CONFIGS["idle"] = _idle(CONFIGS[7])
OUTPUTS = {release: build(config) for release, config in CONFIGS.items()}
SYSTEMS = {release: make_system(CONFIGS[release], OUTPUTS[release]) for release in CONFIGS}


def _prove(release, name, system=None, texts=()):
    bench = Bench(CONFIGS[release], system or SYSTEMS[release], assumed(texts))
    try:
        CASES[name].prove(bench)
    finally:
        bench.close()


@pytest.mark.parametrize("name", sorted(CASES.keys() - {"egm-converged"}))
def test_case_holds_on_robotware_7(name):
    _prove(7, name)


def test_session_converges():
    _prove("idle", "egm-converged")


@pytest.mark.parametrize("name", ["egm-session", "egm-late", "egm-silent", "egm-motors-off"])
def test_case_holds_on_robotware_6(name):
    _prove(6, name)


def test_case_does_not_apply_without_egm():
    config = load_config("irb120")
    bench = Bench(config, make_system(config, build(config)))
    with pytest.raises(NotApplicable):
        CASES["egm-session"].prove(bench)
    bench.close()


@pytest.mark.long
@pytest.mark.parametrize(
    "texts", [("costs=4.0",), ("schedule=random", "seed=5"), ("schedule=pers",)]
)
@pytest.mark.parametrize("name", sorted(CASES.keys() - {"egm-converged"}))
def test_case_holds_in_other_schedules(name, texts):
    _prove(7, name, texts=texts)


@pytest.mark.long
@pytest.mark.parametrize(
    ("release", "name", "old", "new"),
    [
        (7, "egm-session", "OR heartbeat_timeout > MAX_SESSION_HEARTBEAT", ""),
        ("idle", "egm-converged", r"\CondTime:=IDLE_TIMEOUT", r"\CondTime:=3600"),
        (7, "egm-excludes", "ROS_rejected_in_routine := ROS_is_guided()", "SkipWarn"),
        (7, "egm-stop", r"EGMStop session, EGM_STOP_HOLD \RampOutTime:=RAMP_OUT;", ""),
        (7, "egm-stop-motion-port", "ROS_end_trajectory ROS_REASON_STOPPED;", ""),
        (7, "egm-left", "IF heartbeat_timeout > 0 request_stop ROS_REASON_CLIENT_LOST;", ""),
        (7, "egm-vanished", "IF heartbeat_timeout > 0 request_stop ROS_REASON_CLIENT_LOST;", ""),
        (7, "egm-late", "IF is_connected AND is_heartbeat_late() THEN", "IF FALSE THEN"),
        (6, "egm-silent", "IF ERRNO = ERR_UDPUC_COMM fault := ROS_REASON_CLIENT_LOST;", ""),
        (7, "egm-frozen", "IF is_lost RETURN TRUE;", ""),
        (7, "egm-e-stop", "            EXIT;", ""),
        (7, "egm-motors-off", "            EXIT;", ""),
        (7, "egm-program-stop", "            EXIT;", ""),
        (7, "egm-out-of-bounds", r"\MaxPosDeviation:=MAX_DEVIATION", r"\MaxPosDeviation:=1000"),
    ],
)
def test_case_detects_a_defect(release, name, old, new):
    output, changed = OUTPUTS[release], 0
    files = []
    for file in output.files:
        data = file.data
        if file.kind == "module" and old.encode() in data:
            data, changed = data.replace(old.encode(), new.encode()), changed + 1
        files.append(replace(file, data=data))
    assert changed == 1, "the template has changed"
    system = make_system(CONFIGS[release], replace(output, files=tuple(files)))
    with pytest.raises(CheckFailed):
        _prove(release, name, system)
