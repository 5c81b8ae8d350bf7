"""The public face used wrong: it says so, and nothing hangs."""

import pytest

from rapidgen.controller import VirtualController


@pytest.fixture
def files(tmp_path):
    path = tmp_path / "idle.mod"
    path.write_text("MODULE idle\n  PROC main()\n    WaitTime 1;\n  ENDPROC\nENDMODULE\n")
    return [path]


def test_the_virtual_clock_does_not_run_by_itself(files):
    with (
        VirtualController.from_files(files) as controller,
        pytest.raises(ValueError, match="run_for"),
    ):
        controller.start()


def test_a_clock_that_there_is_not(files):
    with pytest.raises(ValueError, match="virtual, real"):
        VirtualController.from_files(files, clock="fast")


def test_a_mode_that_there_is_not(files):
    with VirtualController.from_files(files) as controller:
        with pytest.raises(ValueError, match="manual_reduced"):
            controller.set_mode("manual")
        assert controller.mode == "auto"


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_thread_that_a_fault_has_ended_holds_up_nobody(files):
    with VirtualController.from_files(files, clock="real") as controller:
        controller.start()

        def fault():
            raise ArithmeticError("a fault of the program itself")

        controller.scheduler.post(fault)
        assert controller.call(lambda: "answered") == "answered"


def test_the_address_tells_every_port():
    with VirtualController.from_config("irb120", clock="real", ports="auto") as controller:
        controller.start()
        host, _, ports = controller.address().partition(":")
        assert host == "127.0.0.1"
        listeners = controller.network.listeners
        assert ports == ",".join(str(listeners[p][1]) for p in (11000, 11002, 11001))
