"""The public face used wrong: it says so, and nothing hangs."""

import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from rapidgen.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.scheduler import S
from rapidgen.runtime.values import Pos, copy_value


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


def test_unknown_clock_is_rejected(files):
    with pytest.raises(ValueError, match="virtual, real"):
        VirtualController.from_files(files, clock="fast")


def test_unknown_mode_is_rejected(files):
    with VirtualController.from_files(files) as controller:
        with pytest.raises(ValueError, match="manual_reduced"):
            controller.set_mode("manual")
        assert controller.mode == "auto"


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_thread_ended_by_fault_blocks_no_caller(files):
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


def test_exception_of_call_reaches_caller(files):
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
            stopped_at = controller.now
            assert controller.call(lambda: controller.now) == stopped_at
        assert controller.task("T_ROB1").state == "running"


def test_stepped_controller_does_not_start_thread(files):
    with VirtualController.from_files(files, clock="real", speed=100) as controller:
        controller.run_for(0.01)
        with pytest.raises(RuntimeError, match=r"before run_for"):
            controller.start()
        controller.run_for(0.01)


def test_second_thread_cannot_step(files):
    controller = VirtualController.from_files(files)
    controller.run_for(0.5)
    with ThreadPoolExecutor(1) as others:
        with pytest.raises(RuntimeError, match="another thread"):
            others.submit(controller.run_for, 1).result()
        stood = controller.now
        controller.run_for(1)
        assert controller.now == pytest.approx(stood + 1)
        controller.close()


def test_threaded_controller_cannot_be_stepped(files):
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


def test_closed_controller_raises(files):
    for clock in ("virtual", "real"):
        controller = VirtualController.from_files(files, clock=clock)
        controller.close()
        controller.close()
        steps = [controller.run, lambda: controller.run_for(1)]  # noqa: B023
        steps += [controller.start] if clock == "real" else []
        for step in steps:
            with pytest.raises(RuntimeError, match="closed"):
                step()


DATA = """MODULE data
  RECORD part
    num id;
    string name;
  ENDRECORD
  CONST num most := 5;
  VAR clock watch;
  PERS num n := 0;
  PERS dnum big := 0;
  PERS bool go := FALSE;
  PERS string word := "";
  PERS num row{3} := [1, 2, 3];
  PERS num grid{1, 2} := [[1, 2]];
  PERS pos p := [1, 2, 3];
  PERS part pp := [1, "a"];
  PROC main()
    WaitTime 1;
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def data(tmp_path):
    (tmp_path / "data.mod").write_text(DATA)
    with VirtualController.from_files([tmp_path / "data.mod"]) as controller:
        yield controller.task("T_ROB1")


@pytest.mark.parametrize(
    ("name", "value", "wanted"),
    [
        ("n", "abc", "n takes a number up to 3.4E\\+38, not 'abc'"),
        ("n", None, "not None"),
        ("n", 1e39, "not 1e\\+39"),
        ("big", "1", "a number, not '1'"),
        ("go", "yes", "True or False, not 'yes'"),
        ("go", 2, "not 2"),
        ("word", 5, "at most 80 characters of Latin-1, not 5"),
        ("word", "x" * 81, "not 'xxx"),
        ("word", "€", "not '€'"),
        ("row", [1, 2, 3], "an array of 3, {1: ..., 3: ...}, not"),
        ("row", {1: 1, 2: 2}, "array of 3"),
        ("row", {1: 1, 2: 2, 3: "c"}, "a number"),
        ("grid", {1: {1: 0}}, "array of 2"),
        ("p", [1, 2, 3], r"a pos \(x, y, z\), not \[1, 2, 3\]: change a copy\(\)"),
        ("p", Pos(1, 2, "c"), "a number"),
        ("pp", Pos(1, 2, 3), r"a part \(id, name\)"),
        ("watch", 1, "the program alone handles a clock"),
    ],
)
def test_unfitting_value_changes_nothing(data, name, value, wanted):
    before = copy_value(data[f"data:{name}"])
    with pytest.raises(TypeError, match=wanted):
        data[f"data:{name}"] = value
    assert name == "watch" or data[f"data:{name}"] == before


def test_fitting_values_are_accepted(data):
    changed = data["data:pp"].copy()
    changed.name = "b"
    given = {"n": 0.5, "big": 2**40, "go": 1, "word": "é", "row": {1: 4, 2: 5, 3: 6}}
    given |= {"grid": {1: {1: 7, 2: 8}}, "p": Pos(1, 2, 4), "pp": changed}
    for name, value in given.items():
        data[f"data:{name}"] = value
        assert data[f"data:{name}"] == value
    assert data["data:go"] is True


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("data:m", "there is no data in T_ROB1 called 'data:m'"),
        ("data:wrd", "did you mean 'data:word'"),
        ("dta:n", "no module in T_ROB1 called 'dta': did you mean 'data'"),
        ("zzz", "there are data:most, data:watch"),
    ],
)
def test_unknown_data_raise_key_error(data, name, wanted):
    with pytest.raises(KeyError, match=wanted):
        data[name]
    with pytest.raises(KeyError, match=wanted):
        data[name] = 1


def test_unknown_names_raise_key_error():
    with VirtualController.from_config("irb120") as controller:
        for use, wanted in (
            (lambda: controller.task("T_ROB2"), "no task 'T_ROB2': did you mean 'T_ROB1'"),
            (lambda: controller.task("zzz"), "there are T_ROB1, T_ROS_"),
            (lambda: controller.signals["doX"], "no signal 'doX': there are "),
            (lambda: controller.signals.__setitem__("doX", 1), "no signal 'doX'"),
            (lambda: controller.positions("rob2"), "no motion group 'rob2': did you mean 'rob1'"),
        ):
            with pytest.raises(KeyError, match=wanted):
                use()


@pytest.mark.parametrize(
    ("options", "wanted"),
    [
        ({"cycle": "onec"}, "cycle='onec' is none of once, forever"),
        ({"accounting": "lines"}, "block, statement, none"),
        ({"schedule": "robin"}, "schedule='robin' is none of round-robin, random"),
        ({"ports": "any"}, "ports='any' is neither"),
        ({"speed": -1}, "speed=-1: 1 is real time"),
    ],
)
def test_unknown_option_is_rejected(files, options, wanted):
    with pytest.raises(ValueError, match=wanted):
        VirtualController.from_files(files, **options)


def test_invalid_files_are_rejected(files):
    with pytest.raises(TypeError, match=r"T_ROB1 are a list: \['.*idle.mod'\]"):
        VirtualController.from_files({"T_ROB1": files[0]})
    for nothing in ([], {}, {"T_ROB1": []}):
        with pytest.raises(DiagnosticError, match="nothing to run"):
            VirtualController.from_files(nothing)


def test_overrides_must_be_a_list():
    with pytest.raises(TypeError, match=r"a list, or a mapping .*: \['ports.motion=5000'\]"):
        VirtualController.from_config("irb120", overrides="ports.motion=5000")


LEFT_OPEN = """\
import atexit
import threading

# What is registered first comes last.
atexit.register(lambda: print("threads", [t.name for t in threading.enumerate()][1:]))
from rapidgen.controller import VirtualController

controller = VirtualController.from_config("irb120", clock="real", ports="auto")
controller.start()
raise SystemExit(3)
"""


def test_unclosed_controller_ends_with_program():
    """Without a close, greenlets ran in a thread at interpreter exit.

    One of twenty runs crashed.
    """
    done = subprocess.run([sys.executable, "-c", LEFT_OPEN], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (3, "threads []\n"), done.stderr


def test_endless_callback_does_not_block_exit(files, monkeypatch):
    monkeypatch.setattr("rapidgen.controller.thread._LEAVING", 0.05)
    held, finished = threading.Event(), threading.Event()

    def hold():
        held.set()
        finished.wait(60)

    with VirtualController.from_files(files, clock="real") as controller:
        controller.start()
        holder = threading.Thread(target=controller.call, args=(hold,))
        holder.start()
        try:
            assert held.wait(60)
            controller._thread._leave()
            assert not controller._thread._stopped.is_set()
        finally:
            finished.set()
            holder.join()
