"""A session on a recording: steps in both directions, values of a moment, nothing to change."""

import pytest

from rapidgen.controller import VirtualController
from rapidgen.viewer.recording.writer import record
from tests.dap.own_client import Refused

PROGRAM = """MODULE m
  PERS num n := 0;
  PROC main()
    n := 1;
    WaitTime 0.5;
    n := 2;
    WaitTime 0.5;
    n := 3;
    WaitTime 0.5;
  ENDPROC
ENDMODULE
"""


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    """A recording of 1.4 s with the watched n."""
    folder = tmp_path_factory.mktemp("recorded")
    module, path = folder / "m.mod", folder / "run.mcap"
    module.write_text(PROGRAM)
    with VirtualController.from_files([module], cycle="once", tracing=True) as controller:
        end = record(controller, path, watches=[("T_ROB1", "n")])
        controller.run_for(1.4)
        end()
    return path


def opened(client, recording):
    client.ask("initialize")
    client.ask("attach", recording=str(recording))
    assert client.event("capabilities")["capabilities"]["supportsStepBack"]
    client.event("initialized")


def here(client):
    """Return line and n of the present moment."""
    _, frame = client.stopped()
    return frame["line"], client.value("n", frame)


def test_continue_and_back_in_time(client, recording):
    opened(client, recording)
    placed = client.set_lines(recording.parent / "m.mod", 7)
    assert placed == [{"verified": True, "line": 7}]
    client.ask("configurationDone")
    client.event("stopped")
    client.ask("continue", threadId=1)
    assert here(client) == (7, "2")
    client.ask("stepBack", threadId=1)
    assert here(client) == (5, "1")
    client.ask("next", threadId=1)
    assert here(client) == (7, "2")
    client.ask("continue", threadId=1)
    assert client.event("stopped")["text"] == "end of the recording"
    client.set_lines(recording.parent / "m.mod", 5, 7)
    client.ask("reverseContinue", threadId=1)
    assert here(client)[0] == 7
    client.value(":time 0.1", context="repl")
    assert here(client) == (5, "1")


def test_recorded_values_are_read_only(client, recording):
    opened(client, recording)
    client.ask("configurationDone")
    client.event("stopped")
    client.value(":time 1.2", context="repl")
    _, frame = client.stopped()
    scopes = client.scopes(frame)
    assert client.variables(scopes["Watched"])["n"]["value"] == "3"
    assert client.variables(scopes["Robots"])["rob1 rax_5"]["value"] == "30.000 deg"
    assert client.variables(scopes["System"])["state"]["value"] == "running"
    assert (
        client.ask("source", sourceReference=frame["source"]["sourceReference"])["content"]
        == PROGRAM
    )
    for command in ("setVariable", "goto", "restart", "setExpression"):
        with pytest.raises(Refused, match="read only"):
            client.ask(command)
    with pytest.raises(Refused, match="--watch"):
        client.value("n + 1")


@pytest.mark.parametrize("name", ["missing.mcap", "m.mod", ".", "\0"])
def test_file_that_is_no_recording_is_refused(client, recording, name):
    client.ask("initialize")
    with pytest.raises(Refused, match="RG9"):
        client.ask("attach", recording=str(recording.parent / name))
