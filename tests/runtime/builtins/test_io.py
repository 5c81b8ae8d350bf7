"""Signals.

Sources: S4 user's guide and reference [manual]; abb_driver's system outputs [code].
"""

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.machine.io import STATUSES, status_name
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.signals import SignalAlias
from rapidgen.system.model import (
    CrossConnection,
    SignalSpec,
    System,
    SystemInput,
    SystemOutput,
)

SIGNALS = (
    *(SignalSpec(f"do{i}", "DO") for i in range(1, 6)),
    SignalSpec("doDefault", "DO", default=1),
    SignalSpec("doFixed", "DO", access="ReadOnly"),
    SignalSpec("di1", "DI"),
    SignalSpec("go1", "GO", size=4),
    SignalSpec("gi1", "GI", size=32),
    SignalSpec("ao1", "AO"),
    SignalSpec("ai1", "AI"),
)


@pytest.fixture
def plant(make_bench):
    """Makes a bench with the signals above."""

    def make(**more):
        bench = make_bench(System("plant", (), signals=SIGNALS, **more))
        return bench, bench.controller.io

    return make


def test_names_are_found_without_case_and_defaults_are_there(plant):
    _, io = plant()
    assert io["DODEFAULT"].value == 1
    assert io.get("nothing") is None


def test_limits_of_an_analogue_signal(make_bench):
    """MinLog and MaxLog of EIO_SIGNAL [mem]; ERR_AO_LIM [manual]."""
    limited = SignalSpec("aoSpeed", "AO", low=-2, high=10)
    bench = make_bench(System("plant", (), signals=(limited, SignalSpec("aoFree", "AO"))))
    signal = bench.controller.io["aoSpeed"]
    for value in (-2, 10, 0):
        bench("SetAO", signal, value)
        assert signal.value == value
    for name, value in (("aoSpeed", -2.1), ("aoSpeed", 10.1), ("aoFree", float("inf"))):
        with pytest.raises(RapidError) as raised:
            bench("SetAO", bench.controller.io[name], value)
        assert raised.value.name == "ERR_AO_LIM"
    assert signal.value == 0


def test_signals_with_common_device_bits_change_together(make_bench):
    """A group and single outputs on one device; equal input numbers differ."""
    specs = (
        SignalSpec("go1", "GO", device="d652", size=4, bits=(0, 1, 2, 3)),
        SignalSpec("do2", "DO", device="d652", bits=(2,)),
        SignalSpec("do3", "DO", device="d652", bits=(3,)),
        SignalSpec("di2", "DI", device="d652", bits=(2,)),
        SignalSpec("doOther", "DO", device="d653", bits=(2,)),
        SignalSpec("doRaised", "DO"),
    )
    raised = CrossConnection("", "doRaised", (("do2", False),))
    bench = make_bench(System("plant", (), signals=specs, cross=(raised,)))
    io = bench.controller.io
    bench("SetGO", io["go1"], 0b0101)
    assert [io[name].value for name in ("do2", "do3", "di2", "doOther")] == [1, 0, 0, 0]
    assert io["doRaised"].value == 1
    seen = []
    io["go1"].changed.add(lambda: seen.append(io["go1"].value))
    bench("Set", io["do3"])
    bench("Reset", io["do2"])
    assert seen == [0b1101, 0b1001]
    assert io["doRaised"].value == 0


@pytest.mark.parametrize(("lowest", "value"), [(True, 0b0100), (False, 0b0010)])
def test_bit_order_of_group_follows_switch(lowest, value):
    """[mem] switch `bit_order`"""
    specs = (
        SignalSpec("go1", "GO", device="d652", size=4, bits=(4, 5, 6, 7)),
        SignalSpec("do6", "DO", device="d652", bits=(6,)),
    )
    dialect = Switches(bit_order="lowest" if lowest else "highest")
    with VirtualController(System("plant", (), signals=specs), dialect=dialect) as controller:
        controller.signals["do6"] = 1
        assert controller.signals["go1"] == value
        controller.signals["go1"] = 0b1101
        assert controller.signals["do6"] == lowest


def test_a_read_only_signal_is_not_the_programs(plant):
    bench, io = plant()
    with pytest.raises(RapidError) as caught:
        bench("Set", io["doFixed"])
    assert caught.value.name == "ERR_SIG_NOT_VALID"


# -- aliases --------------------------------------------------------------------------------


def test_alias_io_by_name_in_the_other_dialect(plant):
    bench, io = plant()
    bench.controller.dialect = Switches(alias_by_name=False)
    alias = SignalAlias("DO")
    with pytest.raises(FatalError):
        bench("AliasIO", bench.box("do1"), alias)
    bench("AliasIO", io["do1"], alias)
    assert bench("ValidIO", alias) is True


# -- waiting --------------------------------------------------------------------------------


def test_wait_di_sees_a_short_pulse(plant):
    """The change wakes the task without polling [S4 WaitDI].

    A correct value continues at once.
    """
    bench, io = plant()

    def waiter(task):
        bench.call(task, "WaitDI", io["di1"], 1)
        first = bench.now
        bench.call(task, "WaitDI", io["di1"], 1)
        return first, bench.now

    def pulse(task):
        task.sleep(1)
        io.set(io["di1"], 1)
        task.sleep(0.001)

    first, second = bench.run(waiter, pulse)[0]
    assert first == pytest.approx(1, abs=1e-3)
    assert second == first


def test_wait_di_times_out(plant):
    bench, io = plant()

    def body(task):
        flag = bench.box(False)
        bench.call(task, "WaitDI", io["di1"], 1, MaxTime=2, TimeFlag=flag)
        seen = [flag.get(), round(bench.now, 3)]
        io.set(io["di1"], 1)
        bench.call(task, "WaitDI", io["di1"], 1, MaxTime=2, TimeFlag=flag)
        seen.append(flag.get())
        with pytest.raises(RapidError) as caught:
            bench.call(task, "WaitDI", io["di1"], 0, MaxTime=1)
        return [*seen, caught.value.name]

    assert bench.run(body) == [[True, 2, False, "ERR_WAIT_MAXTIME"]]


def test_wait_analogue_and_group(plant):
    bench, io = plant()

    def body(task):
        bench.call(task, "WaitAI", io["ai1"], 5, GT=True)
        above = bench.now
        at_end = bench.box(0)
        with pytest.raises(RapidError):
            bench.call(task, "WaitAI", io["ai1"], 5, LT=True, MaxTime=1, ValueAtTimeout=at_end)
        bench.call(task, "WaitGI", io["gi1"], 0, NOTEQ=True)
        changed = round(bench.now, 3)
        bench.call(task, "WaitGO", io["go1"], 3)
        bench.call(task, "WaitGO", io["go1"], 4, LT=True)
        bench.call(task, "WaitAO", io["ao1"], 1)
        return round(above, 3), at_end.get(), changed, round(bench.now, 3)

    def ramp(task):
        for i in range(1, 7):
            task.sleep(1)
            io.set(io["ai1"], i)
        task.sleep(2)
        io.set(io["gi1"], 3)
        task.sleep(1)
        io.set(io["go1"], 3)
        task.sleep(1)
        io.set(io["ao1"], 1)

    assert bench.run(body, ramp)[0] == (6, 6, 8, 10)


# -- the configuration ----------------------------------------------------------------------


def test_cross_connections_follow_chains(plant):
    bench, io = plant(
        cross=(
            CrossConnection("a", "do3", (("do1", False), ("do2", True)), ("AND",)),
            CrossConnection("b", "do4", (("do3", True),)),
        )
    )
    assert (io["do3"].value, io["do4"].value) == (0, 1)
    bench("Set", io["do1"])
    assert (io["do3"].value, io["do4"].value) == (1, 0)
    bench("Set", io["do2"])
    assert (io["do3"].value, io["do4"].value) == (0, 1)


def test_a_pulse_does_not_travel_over_a_cross_connection(plant):
    bench, io = plant(cross=(CrossConnection("a", "do2", (("do1", False),)),))
    bench("PulseDO", io["do1"])
    assert (io["do1"].value, io["do2"].value) == (1, 0)


def test_a_loop_of_cross_connections_is_refused(plant):
    bench, io = plant(
        cross=(
            CrossConnection("a", "do2", (("do1", False),)),
            CrossConnection("b", "do3", (("do2", False),)),
            CrossConnection("c", "do1", (("do3", False),)),
        )
    )
    assert [e.title for e in bench.controller.log] == ["Cross connection refused"]
    bench("Set", io["do1"])
    assert io["do3"].value == 1


def test_system_outputs(plant):
    _, io = plant(
        outputs=(
            SystemOutput("TaskExecuting", "do1", task="T_ROB1"),
            SystemOutput("TaskExecuting", "do2"),
            SystemOutput("Mechanical Unit Not Moving", "do3"),
            SystemOutput("Motors On State", "do4"),
        )
    )
    io.report("TaskExecuting", 1, "T_BACK")
    assert (io["do1"].value, io["do2"].value) == (0, 1)
    io.report("TaskExecuting", 1, "T_ROB1")
    io.report("TaskExecuting", 0, "T_BACK")
    assert (io["do1"].value, io["do2"].value) == (1, 1)
    io.report("MechUnitNotMoving", 1, "ROB_1")
    io.report("MechUnitNotMoving", 0, "ROB_2")
    assert io["do3"].value == 0
    io.report("MechUnitNotMoving", 1, "ROB_2")
    assert io["do3"].value == 1
    io.report("MotorOn", 1)
    assert io["do4"].value == 1
    io.power_up()
    assert (io["do1"].value, io["do4"].value) == (1, 1)


def test_the_words_of_abb_drivers_manual_are_understood():
    words = (
        "Execution Error", "Runchain OK", "Motors On State", "Mechanical Unit Active",
        "Emergency Stop", "Mechanical Unit Not Moving", "Task Executing",
    )  # fmt: skip
    assert all(status_name(word) in STATUSES.values() for word in words)


def test_unknown_system_output_is_reported(plant):
    bench, _ = plant(
        outputs=(SystemOutput("Levitating", "do1"), SystemOutput("MotorOn", "doMissing"))
    )
    assert [(e.title, *e.arguments) for e in bench.controller.log] == [
        ("System output not simulated", "Levitating", "do1"),
        ("Signal not defined", "system output MotorOn", "'doMissing'"),
    ]


def test_system_inputs_act_on_the_rising_edge(plant):
    _, io = plant(inputs=(SystemInput("Start", "di1", "CONT"),))
    seen = []
    io.on_action = lambda action, argument: seen.append((action, argument))
    io.set(io["di1"], 1)
    io.set(io["di1"], 1)
    io.set(io["di1"], 0)
    io.set(io["di1"], 1)
    assert seen == [("Start", "CONT"), ("Start", "CONT")]


def test_power_up_gives_outputs_their_defaults(plant):
    bench, io = plant()
    bench("Set", io["do1"])
    bench("Reset", io["doDefault"])
    io.set(io["di1"], 1)
    io.power_up()
    assert (io["do1"].value, io["doDefault"].value, io["di1"].value) == (0, 1, 1)


def test_units_are_switched_off_and_on(make_bench):
    """S4 datasys 2-IODisable, 3HAC16581-1 IOUnitState [manual]."""
    on_unit = SignalSpec("do1", "DO", device="board10")
    bench = make_bench(System("plant", (), signals=(on_unit,)))
    assert bench("IOUnitState", "BOARD10", Phys=True) == 21
    bench("IODisable", "board10", 5)
    assert bench("IOUnitState", "board10", Phys=True) == 20
    assert bench("IOUnitState", "board10", Logic=True) == 10
    assert bench("IOUnitState", "board10") == 3
    bench("IOEnable", "Board10", 5)
    assert bench("IOUnitState", "board10", Logic=True) == 11
    for name, time in (("IOEnable", (5,)), ("IODisable", (5,)), ("IOUnitState", ())):
        with pytest.raises(RapidError) as raised:
            bench(name, "board11", *time)
        assert raised.value.name == "ERR_NAME_INVALID"
