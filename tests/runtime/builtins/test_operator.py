"""Operator window, dialogs, event log.

Sources: S4 reference, TPWrite to ErrWrite [manual].
"""

import pytest

from rapidgen.diagnostics import DiagnosticError
from rapidgen.machine.event_log import Domain, EventLog, EventType
from rapidgen.machine.operator import Answer, read_answers
from rapidgen.machine.scheduler import Scheduler
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import RapidError, errnum
from rapidgen.runtime.values import ListItem, Orient, PersistentCell, Pos
from rapidgen.system.model import SignalSpec, System


def test_tp_write_breaks_at_40_for_screen_only(bench):
    got = []
    bench.controller.operator.subscribe(lambda task, text: got.append((task, text)))
    bench("TPWrite", "x" * 45)
    bench("TPWrite", "n=", Num=single(3.14159265))
    assert list(bench.controller.operator.rows) == ["x" * 40, "x" * 5, "n=3.14159"]
    assert got == [("T1", "x" * 45), ("T1", "n=3.14159")]


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"Bool": True}, "v=TRUE"),
        ({"Pos": Pos(1, 2, 3.5)}, "v=[1,2,3.5]"),
        ({"Orient": Orient(1, 0, 0, 0)}, "v=[1,0,0,0]"),
        ({"Dnum": 4294967295}, "v=4294967295"),
        ({}, "v="),
    ],
)
def test_tp_write_appends_a_value_without_a_separator(bench, options, text):
    bench("TPWrite", "v=", **options)
    assert bench.controller.operator.rows[-1] == text


def test_tp_erase(bench):
    bench("TPWrite", "x")
    bench("TPErase")
    assert not bench.controller.operator.rows


# -- dialogs --------------------------------------------------------------------------------


def test_dialog_without_operator_fails(bench):
    with pytest.raises(RapidError) as caught:
        bench("TPReadNum", bench.box(0), "how many?")
    assert caught.value.name == "ERR_TP_NO_CLIENT"
    assert bench("UIClientExist") is False
    flag = bench.box(0)
    bench("TPReadNum", bench.box(0), "how many?", BreakFlag=flag)
    assert flag.get() == errnum("ERR_TP_NO_CLIENT")


def test_scripted_answers_are_used_once_and_in_order(make_bench):
    bench = make_bench(
        answers=[
            Answer("7", dialog="TPReadNum", text="second"),
            Answer("5"),
            Answer("Stop", after=2),
        ]
    )
    number, key = bench.box(0), bench.box(0)
    bench("TPReadNum", number, "first?")
    assert number.get() == 5
    bench("TPReadNum", number, "the second?")
    assert number.get() == 7
    bench("TPReadFK", key, "go on?", "", "Go", "", "Stop", "")
    assert key.get() == 4
    assert bench.now == pytest.approx(2, abs=0.01)


def test_invalid_answer_is_rejected_and_dialog_waits(make_bench):
    bench = make_bench(answers=[Answer("1")])
    key = bench.box(0)
    with pytest.raises(RapidError) as caught:
        bench("TPReadFK", key, "?", "", "Go", "", "", "", MaxTime=3)
    assert caught.value.name == "ERR_TP_MAXTIME"
    assert "refused" in bench.controller.operator.rows[-1]


def test_awaited_dialog_of_task_is_reported(make_bench):
    bench = make_bench(answers=[Answer("1")])
    operator = bench.controller.operator
    message = []

    def ask(task):
        bench.call(task, "TPReadFK", bench.box(0), "which?", "", "Go", "", "", "", MaxTime=3)

    def look(task):
        task.sleep(1)
        message.extend([operator.waits("T1"), operator.waits("T2")])

    with pytest.raises(RapidError):
        bench.run(ask, look)
    requested = "TPReadFK waits for an answer to 'which?'; answer '1' refused: one of Go is wanted"
    assert message == [requested, ""]
    assert operator.waits("T1") == ""


@pytest.fixture
def waiting(make_bench):
    """A bench with an operator who never answers, and signals."""
    signals = (SignalSpec("di1", "DI"), SignalSpec("do1", "DO"), SignalSpec("doUi", "DO"))
    return make_bench(System("x", (), signals=signals), answers=[])


def test_dialog_is_broken_off_by_high_signal(waiting):
    io = waiting.controller.io
    io.set(io["di1"], 1)
    with pytest.raises(RapidError) as caught:
        waiting("TPReadNum", waiting.box(0), "?", DIBreak=io["di1"])
    assert caught.value.name == "ERR_TP_DIBREAK"
    assert waiting.now < 0.01


def test_breaks_in_time(waiting):
    io = waiting.controller.io
    flag = waiting.box(0)
    cell = PersistentCell("stop", waiting.box(False).type, (), False)

    def body(task):
        seen = []
        for options in (
            {"DOBreak": io["do1"]},
            {"DIBreak": io["di1"], "DIPassive": True},
            {"PersBoolBreak": cell},
            {"MaxTime": 1},
        ):
            io.set(io["di1"], 1)
            waiting.call(
                task, "TPReadNum", waiting.box(0), "?", BreakFlag=flag,
                UIActiveSignal=io["doUi"], **options,
            )  # fmt: skip
            seen.append((round(waiting.now), flag.get()))
        return seen

    def breaker(task):
        task.sleep(1)
        assert io["doUi"].value == 1
        io.set(io["do1"], 1)
        task.sleep(1)
        io.set(io["di1"], 0)
        task.sleep(1)
        cell.set(True)

    names = ["ERR_TP_DOBREAK", "ERR_TP_DIBREAK", "ERR_TP_PERSBOOLBREAK", "ERR_TP_MAXTIME"]
    assert waiting.run(body, breaker)[0] == [
        (i, errnum(name)) for i, name in zip((1, 2, 3, 4), names, strict=True)
    ]
    assert io["doUi"].value == 0
    assert not waiting.controller.operator.questions


def test_message_boxes(make_bench):
    bench = make_bench(answers=[Answer("Yes"), Answer("2"), Answer("cancel"), Answer("OK")])
    every = ((0, "OK", 1), (1, "Abort", 2), (1, "Retry", 3), (1, "Ignore", 4), (3, "Retry", 3),
             (5, "No", 7), (5, "Cancel", 5))  # fmt: skip
    assert bench("UIMessageBox", Message="sure?", Buttons=4) == 6
    assert bench("UIMessageBox", BtnArray={1: "left", 2: "right"}) == 2
    result = bench.box(0)
    bench("UIMsgBox", "line", Buttons=2, Result=result)
    assert result.get() == 5
    bench("UIMsgBox", "line")
    for buttons, label, number in every:
        other = make_bench(answers=[Answer(label)])
        assert other("UIMessageBox", Buttons=buttons) == number


def test_broken_off_box_returns_default_button(waiting):
    flag = waiting.box(0)
    assert waiting("UIMessageBox", DefaultBtn=7, Buttons=4, MaxTime=1, BreakFlag=flag) == 7


def test_number_and_text_entry(make_bench):
    bench = make_bench(answers=[Answer("11"), Answer("2.5"), Answer("8"), Answer("name")])
    assert bench("UINumEntry", MinValue=1, MaxValue=10, AsInteger=True, MaxTime=9,
                 BreakFlag=bench.box(0), InitValue=3) == 3  # fmt: skip
    assert bench("UINumEntry", MinValue=1, MaxValue=10) == 2.5
    assert bench("UIDnumEntry", MinValue=1, MaxValue=10, AsInteger=True) == 8
    assert bench("UIAlphaEntry", Message="who?") == "name"
    flag = bench.box(0)
    assert bench("UIAlphaEntry", InitString="x", MaxTime=1, BreakFlag=flag) == "x"
    assert flag.get() == errnum("ERR_TP_MAXTIME")


@pytest.mark.parametrize("value", ["inf", "1e400", "nan", "many", "2.5", "11"])
def test_invalid_number_is_rejected_with_expectation(make_bench, value):
    bench = make_bench(answers=[Answer(value)])
    options = {"MinValue": 1, "MaxValue": 10} if value == "11" else {}
    flag = bench.box(0)
    bench("UINumEntry", AsInteger=True, InitValue=3, MaxTime=1, BreakFlag=flag, **options)
    assert flag.get() == errnum("ERR_TP_MAXTIME")
    within = " from 1 up to 10" if options else ""
    report = "".join(bench.controller.operator.rows)
    assert f"refused: a whole number{within} is wanted" in report


@pytest.mark.parametrize(
    ("options", "error"),
    [
        ({"MinValue": 2, "MaxValue": 1}, "ERR_UI_MAXMIN"),
        ({"MinValue": 2, "InitValue": 1}, "ERR_UI_INITVALUE"),
        ({"AsInteger": True, "InitValue": 1.5}, "ERR_UI_NOTINT"),
    ],
)
def test_contradictory_number_entry_raises_error(waiting, options, error):
    with pytest.raises(RapidError) as caught:
        waiting("UINumEntry", **options)
    assert caught.value.name == error


def test_list_view(make_bench):
    bench = make_bench(answers=[Answer("two")])
    items = {1: ListItem("", "one"), 2: ListItem("", "two")}
    assert bench("UIListView", items) == 2


def test_an_application_of_the_flexpendant_cannot_run(waiting):
    with pytest.raises(RapidError) as caught:
        waiting("UIShow", "My.dll", "My.View")
    assert caught.value.name == "ERR_UISHOW_FATAL"


def test_reading_a_script(tmp_path):
    path = tmp_path / "answers.yaml"
    path.write_text("- 12\n- true\n- {dialog: UIAlphaEntry, answer: Bob, after: 1.5}\n")
    assert read_answers(path) == [
        Answer("12"),
        Answer("Yes"),
        Answer("Bob", dialog="UIAlphaEntry", after=1.5),
    ]
    for text in ("a: 1", "- {text: x}", "- {answer: 1, sooner: 2}", "- {answer: 1, after: x}", "["):
        path.write_text(text)
        with pytest.raises(DiagnosticError) as caught:
            read_answers(path)
        assert caught.value.diagnostics[0].code == "RG420"


# -- the event log --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "code", "type_"),
    [
        ({}, 80001, EventType.ERROR),
        ({"W": True}, 80002, EventType.WARNING),
        ({"I": True}, 80003, EventType.INFO),
    ],
)
def test_err_write(bench, options, code, type_):
    bench("ErrWrite", "Header", "why", RL2="two", **options)
    (event,) = bench.controller.log
    assert (event.code, event.type, event.title) == (code, type_, "Header")
    assert (event.texts, event.task, event.domain) == (("why", "two"), "T1", Domain.USER)


def test_err_log_numbers(bench):
    bench("ErrLog", 5210, "a", "", "b", "", "", W=True)
    (event,) = bench.controller.log
    assert (event.code, event.texts) == (115210, ("a", "b"))
    with pytest.raises(RapidError):
        bench("ErrLog", 100, "", "", "", "", "")


def test_the_log_keeps_the_newest_and_tells_listeners():
    log = EventLog(Scheduler(), capacity=3)
    seen = []
    end = log.subscribe(seen.append)
    for i in range(5):
        log.info(10_000 + i, f"event {i}")
    end()
    log.error(20_000, "unread")
    assert [e.sequence for e in log] == [4, 5, 6]
    assert [e.code for e in seen] == [10_000, 10_001, 10_002, 10_003, 10_004]
    assert [e.sequence for e in log.since(5)] == [6]
    assert str(seen[0]).split() == ["0.000", "info", "10000", "event", "0"]
