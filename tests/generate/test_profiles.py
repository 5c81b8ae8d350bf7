"""Features that the basic profile omits."""

import pytest

from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build


@pytest.mark.parametrize("name", ["irb120", "irb4600", "irb460", "irb910sc"])
def test_basic_profile_has_no_stream_and_no_control_server(name):
    files = build(load_config(name, overrides=["profile=basic"])).files
    names = {f.path.rpartition("/")[2].partition(".")[0] for f in files if f.kind == "module"}
    assert not names & {"ROS_stream", "ROS_control"}


@pytest.mark.parametrize("key", ["ports.control=11001", "signals.valve={kind: DO}"])
def test_basic_profile_rejects_options_of_the_full_one(key):
    with pytest.raises(DiagnosticError, match="full profile"):
        load_config("irb120", overrides=["profile=basic", key])
