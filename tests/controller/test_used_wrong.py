"""The public face used wrong: it says so, and nothing hangs."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from rapidgen.controller import VirtualController
from rapidgen.machine.scheduler import S


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


def test_what_a_call_raises_comes_to_its_caller_and_the_controller_goes_on(files):
    with VirtualController.from_files(files, clock="real", speed=100) as controller:
        controller.start()
        with pytest.raises(KeyError, match="nowhere"):
            controller.call(lambda: controller.task("T_ROB1")["nowhere"])
        passed = threading.Event()
        controller.call(lambda: controller.scheduler.after(S, passed.set))
        assert passed.wait(60)


def test_a_stopped_controller_is_started_again(files):
    with VirtualController.from_files(files, clock="real", speed=100) as controller:
        for _ in range(3):
            passed = threading.Event()
            controller.call(lambda: controller.scheduler.after(2 * S, passed.set))  # noqa: B023
            controller.start()
            assert passed.wait(60)
            controller.stop()
            stands = controller.now
            assert controller.call(lambda: controller.now) == stands
        assert controller.task("T_ROB1").state == "running"


def test_what_was_stepped_here_does_not_go_on_in_a_thread(files):
    with VirtualController.from_files(files, clock="real", speed=100) as controller:
        controller.run_for(0.01)
        with pytest.raises(RuntimeError, match=r"before run_for"):
            controller.start()
        controller.run_for(0.01)


def test_one_thread_steps(files):
    controller = VirtualController.from_files(files)
    controller.run_for(0.5)
    with ThreadPoolExecutor(1) as others:
        with pytest.raises(RuntimeError, match="another thread"):
            others.submit(controller.run_for, 1).result()
        stood = controller.now
        controller.run_for(1)
        assert controller.now == pytest.approx(stood + 1)
        controller.close()


def test_a_controller_that_runs_by_itself_is_not_stepped(files):
    with VirtualController.from_files(files, clock="real") as controller:
        controller.start()
        controller.call(lambda: None)
        for step in (controller.run, lambda: controller.run_for(1)):
            with pytest.raises(RuntimeError, match=r"call\(\)"):
                step()
        controller.stop()
        with pytest.raises(RuntimeError, match="another thread"):
            controller.run_for(1)


def test_a_condition_only_looks(files):
    with VirtualController.from_files(files) as controller:

        def impatient():
            controller.run_for(0.1)
            return False

        with pytest.raises(RuntimeError, match="condition only looks"):
            controller.run_until(impatient, timeout=1)
        controller.run_for(1)
        assert controller.now == pytest.approx(1)


def test_a_closed_controller_says_so(files):
    for clock in ("virtual", "real"):
        controller = VirtualController.from_files(files, clock=clock)
        controller.close()
        controller.close()
        steps = [controller.run, lambda: controller.run_for(1)]  # noqa: B023
        steps += [controller.start] if clock == "real" else []
        for step in steps:
            with pytest.raises(RuntimeError, match="closed"):
                step()
