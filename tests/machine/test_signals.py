"""Signals: values, delays, pulses, shared bits, cross connections."""

import math

import pytest

from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem, SignalCondition, status_name
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.system.model import (
    CrossConnection,
    SignalSpec,
    System,
    SystemInput,
    SystemOutput,
)


class Board(IOSystem):
    def __init__(self, *signals, lowest_first=True, **system):
        self.scheduler = Scheduler()
        self.log = EventLog(self.scheduler)
        given = System("s", (), signals=signals, **system)
        super().__init__(self.scheduler, self.log, given, lowest_first=lowest_first)

    def put(self, name, value, **options):
        self.set(self[name], value, **options)

    def wait(self, seconds):
        self.scheduler.advance(self.scheduler.now + round(seconds * S) + 1)

    def values(self, *names):
        return [self[name].value for name in names]


def digital(*names, kind="DO", **more):
    return [SignalSpec(name, kind, **more) for name in names]


@pytest.mark.parametrize(
    ("spec", "good", "bad"),
    [
        (SignalSpec("s", "DI"), [0, 1, 1.0], [-1, 2, 0.5, math.nan, math.inf]),
        (SignalSpec("s", "GO", size=4), [0, 15], [-1, 16, 0.5, math.nan]),
        (SignalSpec("s", "AO"), [-1e9, 0.5], [math.nan, math.inf]),
        (SignalSpec("s", "AI", low=0, high=10), [0, 10], [-0.1, 10.1]),
        (SignalSpec("s", "AI", low=-5, high=0), [-5, 0], [-5.1, 0.1]),
    ],
)
def test_signal_accepts_fitting_values(spec, good, bad):
    board = Board(spec)
    for value in good:
        board.put("S", value)
        assert board["s"].value == value
        assert isinstance(board["s"].fit(value), float if spec.type[0] == "A" else int)
    for value in bad:
        with pytest.raises(ValueError, match="s"):
            board.put("s", value)
        assert board["s"].value == good[-1]


def test_the_largest_value():
    board = Board(
        SignalSpec("d", "DI"),
        SignalSpec("g", "GI", size=3),
        SignalSpec("a", "AO"),
        SignalSpec("low", "AO", low=-3, high=0),
        SignalSpec("high", "AI", high=4),
    )
    assert [board[n].largest for n in ("d", "g", "a", "low", "high")] == [1, 7, math.inf, 0, 4]
    assert board.get("x") is None
    assert board.get("D") is board["d"]


@pytest.mark.parametrize(
    ("relation", "held", "fulfilling"),
    [
        ("=", [False, True, False], 5),
        ("<>", [True, False, True], 6),
        ("<", [True, False, False], 4),
        (">", [False, False, True], 6),
        ("<=", [True, True, False], 5),
        (">=", [False, True, True], 5),
    ],
)
def test_awaited_condition_is_reported(relation, held, fulfilling):
    board = Board(SignalSpec("g", "GI", size=4))
    awaited = SignalCondition(board["g"], relation, 5)
    result = []
    for value in (4, 5, 6):
        board.put("g", value)
        result.append(awaited.holds())
    assert result == held
    assert awaited.fulfilling() == fulfilling
    assert str(awaited) == f"g {relation} 5; g is 6"


def test_impossible_condition_has_no_value():
    board = Board(SignalSpec("d", "DI"))
    assert SignalCondition(board["d"], ">", 1).fulfilling() is None
    assert SignalCondition(board["d"], "<", 0).fulfilling() is None
    assert SignalCondition(board["d"], "<>", 1).fulfilling() == 0
    assert SignalCondition(board["d"], "=", 2).fulfilling() is None


def test_input_source_receives_awaited_condition():
    board = Board(SignalSpec("d", "DI"))
    awaited = SignalCondition(board["d"], "=", 1)
    board.await_value(awaited)
    report = []
    board.on_awaited = report.append
    board.await_value(awaited)
    board.put("d", 1)
    board.await_value(awaited)
    assert report == [awaited]


def test_later_order_cancels_delayed_value():
    board = Board(*digital("d"))
    report = []
    board["d"].changed.add(lambda: report.append((board.scheduler.now, board["d"].value)))
    board.put("d", 1, delay=2)
    with pytest.raises(ValueError, match="does not fit"):
        board.put("d", 2, delay=1)
    board.wait(1.9)
    assert report == []
    board.wait(0.2)
    assert report == [(2 * S, 1)]
    assert not board["d"].pending
    board.put("d", 0, delay=1)
    board.put("d", 1)
    board.wait(2)
    assert board["d"].value == 1
    board.put("d", 0, delay=1)
    board.put("d", 1, delay=2)
    board.wait(1.5)
    assert board["d"].value == 1


@pytest.mark.parametrize(
    ("before", "high", "during", "after"),
    [(0, False, 1, 0), (1, False, 0, 1), (0, True, 1, 0), (1, True, 1, 0)],
)
def test_a_pulse(before, high, during, after):
    board = Board(*digital("d", default=before))
    board.put("d", 1 - before, delay=0.5)
    board.pulse(board["d"], 1, high=high)
    assert board["d"].value == during
    board.wait(0.9)
    assert board["d"].value == during
    board.wait(0.2)
    assert board["d"].value == after


def test_power_up():
    board = Board(
        *digital("out", "low"),
        *digital("high", default=1),
        *digital("in", kind="DI"),
        outputs=(SystemOutput("MotorOn", "low"),),
    )
    board.put("out", 1)
    board.put("high", 0)
    board.put("in", 1)
    board.put("out", 1, delay=1)
    board.report("MotorOn", 1)
    board.power_up()
    board.wait(2)
    assert board.values("out", "high", "in", "low") == [0, 1, 1, 1]


def test_signals_with_common_bits_change_together():
    shared = dict(device="d1")
    board = Board(
        SignalSpec("group", "GO", size=3, bits=(4, 5, 6), **shared),
        SignalSpec("one", "DO", bits=(5,), **shared),
        SignalSpec("other", "GO", size=2, bits=(6, 7), **shared),
        SignalSpec("input", "DI", bits=(5,), **shared),
        SignalSpec("elsewhere", "DO", bits=(5,), device="d2"),
        SignalSpec("analogue", "AO", bits=(5,), **shared),
    )
    report = []
    board["one"].changed.add(lambda: report.append(board["one"].value))
    names = ("group", "one", "other", "input", "elsewhere", "analogue")
    board.put("group", 7)
    assert board.values(*names) == [7, 1, 1, 0, 0, 0]
    board.put("one", 0)
    assert board.values(*names) == [5, 0, 1, 0, 0, 0]
    board.put("other", 2)
    assert board.values(*names) == [1, 0, 2, 0, 0, 0]
    assert report == [1, 0]


@pytest.mark.parametrize(("lowest_first", "value"), [(True, 1), (False, 4)])
def test_the_order_of_bits(lowest_first, value):
    board = Board(
        SignalSpec("group", "GO", size=3, bits=(4, 5, 6), device="d"),
        SignalSpec("first", "DO", bits=(4,), device="d"),
        lowest_first=lowest_first,
    )
    board.put("first", 1)
    assert board["group"].value == value


@pytest.mark.parametrize(
    ("operators", "a", "b", "c", "result"),
    [
        (("AND", "AND"), 1, 1, 0, 1),  # c is inverted
        (("AND", "AND"), 1, 0, 0, 0),
        (("AND", "AND"), 1, 1, 1, 0),
        (("OR", "AND"), 1, 0, 1, 0),
        (("OR", "AND"), 0, 1, 0, 1),
        (("AND", "OR"), 0, 1, 0, 1),
        (("AND", "OR"), 0, 1, 1, 0),
        (("OR", "OR"), 0, 0, 1, 0),
    ],
)
def test_a_cross_connection(operators, a, b, c, result):
    actors = (("a", False), ("B", False), ("c", True))
    board = Board(
        *digital("a", "b", "c", "r", "s"),
        cross=(
            CrossConnection("one", "R", actors, operators),
            CrossConnection("two", "s", (("r", True),)),
        ),
    )
    assert board["s"].value == 1 - board["r"].value
    board.put("r", 1 - result)
    for name, value in (("a", a), ("b", b), ("c", c)):
        board.put(name, 1 - value)
        board.put(name, value)
    assert board.values("r", "s") == [result, 1 - result]


def test_cross_connection_cancels_pending_changes():
    board = Board(*digital("a", "r"), cross=(CrossConnection("x", "r", (("a", False),)),))
    board.put("r", 1, delay=1)
    board.put("a", 1)
    board.put("a", 0)
    board.wait(2)
    assert board["r"].value == 0
    board.pulse(board["a"], 1)
    assert board.values("a", "r") == [1, 0]
    board.wait(2)
    assert board.values("a", "r") == [0, 0]


def test_invalid_cross_connections_are_rejected():
    board = Board(
        *digital("a", "b", "c", "d"),
        cross=(
            CrossConnection("one", "b", (("a", False),)),
            CrossConnection("two", "c", (("b", False),)),
            CrossConnection("back", "a", (("d", False), ("c", False)), ("OR",)),
            CrossConnection("itself", "d", (("d", True),)),
            CrossConnection("nothing", "d", (("gone", True),)),
            CrossConnection("fine", "d", (("a", False),)),
        ),
    )
    board.put("c", 1)
    assert board["a"].value == 0
    board.put("a", 1)
    assert board.values("b", "c", "d") == [1, 1, 1]
    assert [(e.code, *e.arguments) for e in board.log] == [
        (197_100, "back"),
        (197_100, "itself"),
        (197_102, "cross connection nothing", "'gone'"),
    ]


def test_defaults_are_there_at_first_and_travel():
    board = Board(
        *digital("a", default=1),
        *digital("r"),
        cross=(CrossConnection("x", "r", (("a", False),)),),
    )
    assert board.values("a", "r") == [1, 1]


def test_system_input_acts_on_both_edges():
    board = Board(
        *digital("di", kind="DI"),
        inputs=(SystemInput("Start", "DI", "CYCLE"), SystemInput("Stop", "gone")),
    )
    board.put("di", 1)  # no listener exists
    board.put("di", 0)
    report = []
    board.on_action = lambda *action: report.append(action)
    board.on_end = lambda action: report.append(action)
    board.put("di", 1)
    board.put("di", 1)
    board.put("di", 0)
    assert report == [("Start", "CYCLE"), "Start"]
    assert [(e.code, *e.arguments) for e in board.log] == [(197_102, "system input Stop", "'gone'")]


def test_a_status_drives_its_outputs():
    board = Board(
        *digital("any", "all", "mine", "whole"),
        SignalSpec("speed", "AO"),
        outputs=(
            SystemOutput("Task Executing", "any"),
            SystemOutput("TaskExecuting", "mine", task="T_ROB1"),
            SystemOutput("MechUnitNotMoving", "all"),
            SystemOutput("MechUnitActive", "whole", unit="ROB_1"),
            SystemOutput("TCPSpeed", "speed"),
            SystemOutput("Unknown", "any"),
            SystemOutput("AutoOn", "gone"),
        ),
    )
    assert [(e.code, *e.arguments) for e in board.log] == [
        (197_101, "Unknown", "any"),
        (197_102, "system output AutoOn", "'gone'"),
    ]
    board.report("TaskExecuting", 1, "T_ROB2")
    board.report("TaskExecuting", 0, "T_rob1")
    assert board.values("any", "mine") == [1, 0]
    board.report("TaskExecuting", 1, "T_ROB1")
    board.report("TaskExecuting", 0, "T_ROB2")
    assert board.values("any", "mine") == [1, 1]
    board.report("MechUnitNotMoving", 1, "ROB_1")
    assert board["all"].value == 1
    board.report("MechUnitNotMoving", 0, "ROB_2")
    assert board["all"].value == 0
    board.report("MechUnitActive", 1)
    assert board["whole"].value == 1
    board.report("TCPSpeed", 0.25)
    assert board["speed"].value == 0.25
    board.put("any", 0)
    board.report("TaskExecuting", 1, "T_ROB1")  # nothing new: nothing is shown
    assert board["any"].value == 0
    board.put("any", 1, delay=1)
    board.report("TaskExecuting", 0, "T_ROB1")
    board.wait(2)
    assert board["any"].value == 0


@pytest.mark.parametrize(
    ("spelling", "name"),
    [("Motors_On state", "MotorOn"), ("emstop", "EmStop"), ("cycleon", "CycleOn"), ("x", None)],
)
def test_statuses_have_several_spellings(spelling, name):
    assert status_name(spelling) == name


def test_inferred_cell_creates_signals():
    board = Board(*digital("d", device="Board1"))
    assert board.made_up("new", "DO") is None
    assert board.is_unit("BOARD1")
    assert not board.is_unit("other")
    assert not board.is_unit("")
    board.any_unit, board.divisors = True, frozenset({"per"})
    assert board.is_unit("other")
    assert board.made_up("", "DO") is None
    group, single = board.made_up("New", "GI"), board.made_up("Percent", "DO")
    assert board["new"] is group
    assert (group.largest, group.value) == (2**32 - 1, 0)
    assert (single.largest, single.value) == (1, 1)
    assert board.made_up("NEW", "GI") is group
