"""Small devices: log, texts, calendar, cameras, force, EGM, arc, costs."""

from datetime import datetime

import pytest

from rapidgen.machine.arc_equipment import REFERENCES, ArcEquipment
from rapidgen.machine.cost_model import Costs
from rapidgen.machine.event_log import Domain, EventLog, EventType
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import FIRST_DAY, S, Scheduler, SyncPoints, date_time
from rapidgen.machine.sensors import Camera, ForceSensors, Measured, Seen, cameras
from rapidgen.machine.text_tables import TextTables
from rapidgen.system.model import ArcSignals, SignalSpec, System


def test_events_have_numbers_domains_and_the_controllers_time():
    scheduler = Scheduler()
    log, report = EventLog(scheduler, capacity=3), []
    first = log.info(10_015, "one")
    end = log.subscribe(report.append)
    scheduler.at(3 * S, lambda: log.warning(50_024, "two", "a", "", "b", task="T_ROB1"))
    scheduler.advance()
    second, third = report[0], log.error(130_001, "three")
    end()
    fourth = log.write(197_101, EventType.WARNING, "four")
    events = [first, second, third, fourth]
    assert [e.sequence for e in events] == [1, 2, 3, 4]
    assert [e.code for e in events] == [10_015, 50_024, 130_001, 197_101]
    assert [e.type for e in events] == [1, 2, 3, 2]
    assert [e.domain for e in events] == [
        Domain.OPERATIONAL,
        Domain.MOTION,
        Domain.PAINT,
        Domain.IO,
    ]
    assert report == [second, third]
    assert list(log) == [second, third, fourth]
    assert len(log) == 3
    assert log.since(2) == [third, fourth]
    assert (second.time, second.task, second.texts) == (3.0, "T_ROB1", ("a", "", "b"))
    assert str(second) == "     3.000 warning 50024 [T_ROB1] two\n    a\n    b"
    assert str(first) == "     0.000 info    10015 one"
    log.clear()
    assert len(log) == 0
    assert log.info(10_015, "five").sequence == 5  # numbers go on


def test_domains_and_types_have_the_controllers_numbers():
    # No source was read for these numbers: they are those that this controller writes.
    assert {d.name: int(d) for d in Domain} == {
        "COMMON": 0,
        "OPERATIONAL": 1,
        "SYSTEM": 2,
        "HARDWARE": 3,
        "PROGRAM": 4,
        "MOTION": 5,
        "OPERATOR": 6,
        "IO": 7,
        "USER": 8,
        "SAFETY": 9,
        "INTERNAL": 10,
        "PROCESS": 11,
        "CONFIGURATION": 12,
        "PAINT": 13,
    }
    assert {t.name: int(t) for t in EventType} == {"INFO": 1, "WARNING": 2, "ERROR": 3}


def test_text_tables():
    tables = TextTables()
    tables.install("# comment\n\nparts::\n1:\nA \\n B\n12:\n# no comment here\nTOOLS::\n1:\ngun\n")
    assert [tables.number(n) for n in ("parts", "TOOLS", "none")] == [1, 2, None]
    assert tables.text(1, 1) == "A \n B"
    assert tables.text(1, 12) == "# no comment here"
    assert tables.text(2, 1) == "gun"
    assert [tables.text(*at) for at in ((0, 1), (3, 1), (1, 2))] == [None, None, None]
    tables.install("parts::\n2:\nmore\n")
    assert (tables.text(1, 2), tables.text(1, 12)) == ("more", "# no comment here")


@pytest.mark.parametrize(
    ("text", "line"), [("1:\nx", 1), ("a::\nx", 2), ("a::\n1:\nx\ny", 4), ("a b ::" + "x", 1)]
)
def test_invalid_text_table_is_rejected(text, line):
    with pytest.raises(ValueError, match=f"line {line}"):
        TextTables().install(text)


def test_a_name_of_a_table_has_80_characters_at_most():
    tables = TextTables()
    tables.install("x" * 80 + "::")
    assert tables.number("x" * 80) == 1
    with pytest.raises(ValueError, match="line 1"):
        tables.install("x" * 81 + "::")


def test_the_date_of_a_virtual_and_of_a_real_clock():
    scheduler = Scheduler()
    scheduler.at(90 * S, lambda: None)
    assert date_time(scheduler) == FIRST_DAY == datetime(2026, 1, 1, 8)
    scheduler.advance()
    assert date_time(scheduler) == datetime(2026, 1, 1, 8, 1, 30)
    real = Scheduler(clock="real")
    before = datetime.now()
    assert before <= date_time(real) <= datetime.now()
    real.close()


def test_a_camera_sees_its_images_in_turn():
    one, two = Seen("one"), Seen("two")
    camera = Camera("cam", images=[(one, two), (), (two,)])
    report = []
    camera.changed.add(lambda: report.append(camera.taken))
    camera.under_way = 4
    camera.look(1, keep=False)
    assert list(camera.results) == [(1, one), (1, two)]
    camera.look(2, keep=True)
    camera.look(3, keep=True)
    assert list(camera.results) == [(1, one), (1, two), (3, two)]
    camera.look(4, keep=False)
    assert list(camera.results) == [(4, one), (4, two)]
    assert (camera.taken, camera.under_way, report) == (4, 0, [1, 2, 3, 4])
    unmonitored = Camera("blind")
    unmonitored.look(1, keep=False)
    assert not unmonitored.results


def test_cameras_of_a_configuration_may_be_described():
    described = {"left": Camera("LEFT", job="a")}
    result = cameras(["Left", "Right"], described)
    assert list(result) == ["left", "right"]
    assert result["left"] is described["left"]
    assert result["right"].name == "Right"
    assert cameras(["Left"])["left"].name == "Left"


def test_force_sensors_read_in_turn_and_keep_the_last():
    rows = [(1.0, 0, 0, 0, 0, 0), (2.0, 0, 0, 0, 0, 0)]
    sensors = ForceSensors(Measured(rows))
    left, right = sensors.of("L"), sensors.of("R")
    assert sensors.of("L") is left
    assert [left.read()[0] for _ in range(3)] == [1.0, 2.0, 2.0]
    assert (right.read()[0], left.taken, right.taken) == (1.0, 3, 1)


class Welder(ArcEquipment):
    USES = ("GasOn", "WeldOn", "FeedOn", "ArcEst", "WeldInhib", *REFERENCES)

    def __init__(self):
        analogue = {*REFERENCES} - {"SchedulePort", "ModePort"}
        specs = tuple(
            SignalSpec(
                f"s{use}",
                "AO" if use in analogue else "GO" if use in REFERENCES else "DO",
                size=4,
            )
            for use in self.USES
        )
        self.io = IOSystem(Scheduler(), EventLog(Scheduler()), System("s", (), signals=specs))
        named = tuple((use, f"s{use}") for use in self.USES)
        mine, other = ArcSignals("std_T_ROB1", named), ArcSignals("std_T_ROB2", (("GasOn", "x"),))
        super().__init__(self.io, (mine, other), "t_rob1")

    def __getitem__(self, use):
        return self.io[f"s{use}"].value

    @property
    def all(self):
        return tuple(bool(self[use]) for use in self.USES[:4])


def test_an_arc_and_its_signals():
    arc = Welder()
    arc.set_gas(True)
    assert (arc.gas, arc.arc, arc.all) == (True, False, (True, False, False, False))
    arc.set_arc(True)
    assert (arc.arc, arc.feed, arc.all) == (True, True, (True,) * 4)
    arc.stop_feeding()
    assert (arc.feed, arc.arc, arc.all) == (False, True, (True, True, False, True))
    arc.put_out()
    assert (arc.gas, arc.arc, arc.feed, arc.all) == (False, False, False, (False,) * 4)


def test_stopped_arc_burns_again_after_start():
    arc = Welder()
    arc.hold()
    arc.go_on()
    assert not arc.gas
    arc.set_gas(True)
    arc.set_arc(True)
    arc.hold()
    assert arc.all == (False,) * 4
    arc.go_on()
    assert (arc.all, arc.gas, arc.arc) == ((True,) * 4, True, True)
    arc.put_out()
    arc.go_on()
    assert not arc.arc
    arc.set_arc(True)
    arc.hold()
    arc.reset()
    arc.go_on()
    assert arc.all == (False,) * 4
    arc.set_gas(True)
    arc.reset()
    assert not arc.gas


def test_welding_data_appear_in_signals():
    arc = Welder()
    data = dict(sched=3, mode=2, voltage=20.5, wirefeed=0.1, control=1.5, current=150)
    arc.refer(data)
    assert {use: arc[use] for use in REFERENCES} == {
        "SchedulePort": 3,
        "ModePort": 2,
        "VoltReference": 20.5,
        "FeedReference": 0.1,
        "ControlPort": 1.5,
        "CurrentReference": 150,
    }
    assert arc.data == data
    with pytest.raises(ValueError, match="does not fit"):
        arc.refer({**data, "sched": 16})


def test_welding_is_inhibited_by_a_signal():
    arc = Welder()
    assert not arc.inhibited
    arc.io.set(arc.io["sWeldInhib"], 1)
    assert arc.inhibited
    bare = ArcEquipment(arc.io, (), "T_ROB1")
    assert not bare.inhibited
    assert bare.signal("GasOn") is None
    bare.set_gas(True)
    assert bare.gas
    assert not arc.gas


def test_costs_are_scaled_in_their_built_in_part():
    # Figures of docs/rapid/virtual-controller.md.
    costs = Costs()
    assert (costs.statement, costs.operator, costs.call) == (5_000, 1_000, 5_000)
    assert (costs.quantum, costs.interrupt_delay) == (2_000_000, (2_000_000, 30_000_000))
    scaled = Costs(builtin_scale=2.0).scaled(3)
    assert scaled == Costs(builtin_scale=6.0)


def test_sync_points_are_empty_at_first():
    meetings = SyncPoints()
    assert (meetings.points, meetings.moves, meetings.any_task) == ({}, {}, False)
