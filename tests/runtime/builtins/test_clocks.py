"""Clocks, dates, system information.

Sources: S4 reference [manual], [K §15].
"""

from types import SimpleNamespace

import pytest

from rapidgen.machine.text_tables import TextTables
from rapidgen.runtime.builtins.system import StopWatch
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.system.model import System


def test_a_clock_runs_stops_and_goes_on(bench):
    clock = StopWatch()

    def body(task):
        seen = [bench.call(task, "ClkRead", clock)]
        bench.call(task, "ClkStart", clock)
        task.sleep(1.2345678)
        seen.append(bench.call(task, "ClkRead", clock))
        seen.append(bench.call(task, "ClkRead", clock, HighRes=True))
        bench.call(task, "ClkStop", clock)
        task.sleep(5)
        seen.append(bench.call(task, "ClkRead", clock))
        bench.call(task, "ClkStart", clock)
        task.sleep(1)
        seen.append(bench.call(task, "ClkRead", clock))
        bench.call(task, "ClkReset", clock)
        task.sleep(1)
        seen.append(bench.call(task, "ClkRead", clock))
        return seen

    assert bench.run(body)[0] == pytest.approx([0, 1.234, 1.234567, 1.234, 2.234, 0], abs=1e-6)


def test_a_clock_holds_49_days(bench):
    clock = StopWatch()

    def body(task):
        bench.call(task, "ClkStart", clock)
        task.sleep(4_294_968)
        with pytest.raises(RapidError) as caught:
            bench.call(task, "ClkRead", clock)
        return caught.value.name

    assert bench.run(body) == ["ERR_OVERFLOW"]


def test_dates_of_the_virtual_clock_are_the_same_every_time(bench):
    assert (bench("CDate"), bench("CTime")) == ("2026-01-01", "08:00:00")
    bench.run(lambda task: task.sleep(3723))
    assert bench("CTime") == "09:02:03"
    parts = ("WDay", "Hour", "Min", "Sec")
    assert [bench("GetTime", **{part: True}) for part in parts] == [4, 9, 2, 3]
    with pytest.raises(FatalError):
        bench("GetTime")


def test_system_information(bench):
    bench.controller.system = System("cell", (), robotware=(6, 8))
    group = SimpleNamespace(config=SimpleNamespace(model="IRB 120-3/0.6"))
    bench.controller.motion = SimpleNamespace(groups={"rob1": group})
    assert bench("GetSysInfo", LanIp=True) == "127.0.0.1"
    assert bench("GetSysInfo", SWVersion=True) == "ROBOTWARE_6.08.0000"
    assert bench("GetSysInfo", SWVersionName=True) == "6.08.00.00"
    assert bench("GetSysInfo", RobotType=True) == "IRB 120-3/0.6"
    assert bench("GetSysInfo", SystemName=True) == "cell"
    assert bench("IsSysId", bench("GetSysInfo", SerialNo=True)) is True
    assert bench("RobOS") is False
    with pytest.raises(FatalError):
        bench("GetSysInfo")


TABLE = """# texts of the cell
MY_TEXTS::
1:
first line\\nsecond
2:
another
"""


def test_text_tables(bench):
    """[K §15]"""
    bench.controller.texts = TextTables()
    (bench.controller.files.folder / "HOME" / "texts.eng").write_text(TABLE)
    assert bench("TextTabFreeToUse", "MY_TEXTS") is True
    bench("TextTabInstall", "HOME:/texts.eng")
    assert bench("TextTabFreeToUse", "MY_TEXTS") is False
    number = bench("TextTabGet", "MY_TEXTS")
    assert bench("TextGet", number, 1) == "first line\nsecond"
    assert bench("TextGet", number, 2) == "another"
    for name, args in (("TextTabGet", ("NONE",)), ("TextGet", (number, 3)), ("TextGet", (9, 1))):
        with pytest.raises(RapidError) as caught:
            bench(name, *args)
        assert caught.value.name == "ERR_TXTNOEXIST"
    (bench.controller.files.folder / "HOME" / "bad").write_text("what?\n")
    with pytest.raises(FatalError):
        bench("TextTabInstall", "HOME:/bad")
