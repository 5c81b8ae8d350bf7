"""The operator's screen, dialogs and scripted answers, without a program."""

import pytest

from rapidgen.machine.operator import ROW, ROWS, Answer, Operator, read_answers
from rapidgen.machine.scheduler import S, Scheduler
from tests.refusal import refusal


def number(text):
    value = int(text)
    if value > 9:
        raise ValueError("too large")
    return value


def asked(operator, text="How many parts?", task="T_ROB1", dialog="TPReadNum"):
    return operator.ask(task, dialog, text, ("OK",), number, "3")


def test_texts_are_split_on_screen_and_reported_whole():
    operator, texts = Operator(Scheduler()), []
    end = operator.subscribe(lambda *text: texts.append(text))
    operator.write("T_ROB1", "x" * ROW + "y")
    operator.write("T_ROB1", "")
    assert list(operator.rows) == ["x" * ROW, "y", ""]
    end()
    operator.write("T_ROB1", "more")
    assert texts == [("T_ROB1", "x" * ROW + "y"), ("T_ROB1", "")]
    for _ in range(ROWS + 1):
        operator.show("z")
    assert list(operator.rows) == ["z"] * ROWS
    operator.erase()
    assert not operator.rows


def test_attached_source_is_present():
    assert not Operator(Scheduler()).present
    assert Operator(Scheduler(), []).present
    operator = Operator(Scheduler())
    ends = [operator.attach(), operator.attach()]
    assert operator.present
    ends[0]()
    assert operator.present
    ends[1]()
    assert not operator.present


def test_question_waits_for_answer_or_withdrawal():
    operator, report = Operator(Scheduler()), []
    operator.asked.add(lambda: report.append(len(operator.questions)))
    first, second = asked(operator, "one\ntwo"), asked(operator, task="T_ROB2")
    assert (first.number, second.number, first.proposed, first.choices) == (1, 2, "3", ("OK",))
    assert list(operator.rows) == ["one", "two", "How many parts?"]
    assert operator.waits("T_ROB1") == "TPReadNum waits for an answer to 'one two'"
    assert operator.waits("T_ROB3") == ""
    noticed = []
    second.changed.add(lambda: noticed.append(second.answer))
    operator.answer(2, "5")
    assert (second.answered, noticed, first.answered) == (True, [5], False)
    with pytest.raises(ValueError, match="too large"):
        operator.answer(1, "10")
    assert not first.answered
    with pytest.raises(KeyError):
        operator.answer(3, "5")
    operator.withdraw(first)
    operator.withdraw(first)
    assert report == [1, 2, 1]
    with pytest.raises(KeyError):
        operator.answer(1, "5")


@pytest.mark.parametrize(
    ("answer", "fits"),
    [
        (Answer("1"), True),
        (Answer("1", task="t_rob1", dialog="tpreadnum", text="HOW MANY"), True),
        (Answer("1", task="T_ROB2"), False),
        (Answer("1", task="T_ROB"), False),
        (Answer("1", dialog="TPReadFK"), False),
        (Answer("1", dialog="TPRead"), False),
        (Answer("1", text="how few"), False),
    ],
)
def test_conditions_of_an_answer(answer, fits):
    assert answer.fits(asked(Operator(Scheduler()))) is fits


def test_script_uses_first_matching_answer_once():
    scheduler = Scheduler()
    operator = Operator(scheduler, [Answer("7", text="other"), Answer("5", after=2), Answer("6")])
    first, second, third = (asked(operator) for _ in range(3))
    scheduler.advance(2 * S - 1)
    assert (first.answered, second.answer, third.answered) == (False, 6, False)
    scheduler.advance(2 * S)
    assert first.answer == 5


def test_unfitting_scripted_answer_is_reported():
    scheduler = Scheduler()
    operator = Operator(scheduler, [Answer("10"), Answer("11")])
    question, gone = asked(operator), asked(operator)
    operator.withdraw(gone)
    scheduler.advance()
    assert not question.answered
    assert question.refused == "answer '10' refused: too large"
    assert operator.rows[-1] == question.refused
    assert operator.waits("T_ROB1").endswith("; answer '10' refused: too large")
    assert gone.refused == ""


def test_a_file_of_answers(tmp_path):
    file = tmp_path / "answers.yaml"
    file.write_text(
        "- 2\n- yes\n- true\n- false\n"
        "- {answer: 3, task: T, dialog: D, text: x, after: 1.5}\n- {answer: 4, after: 0}\n"
    )
    assert read_answers(file) == [
        Answer("2"),
        Answer("yes"),
        Answer("Yes"),
        Answer("No"),
        Answer("3", "T", "D", "x", 1.5),
        Answer("4"),
    ]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("answer: 1", "it holds no list"),
        ("- 1\n- {answer: 1, more: 2}", "entry 2: unknown key 'more'"),
        ("- {task: T}", "entry 1: no 'answer'"),
        ("- {answer: 1, after: -1}", "entry 1: 'after' is no time"),
        ("- {answer: 1, after: soon}", "entry 1: 'after' is no time"),
        ("- [", "not YAML"),
        ("\udcff", "not UTF-8"),
        (None, "No such file"),
    ],
)
def test_invalid_answer_file_is_rejected(tmp_path, text, message):
    file = tmp_path / "answers.yaml"
    if text is not None:
        file.write_bytes(text.encode("utf-8", "surrogateescape"))
    (result,) = refusal(read_answers, file).diagnostics
    assert result.code == "RG420"
    assert message in result.message
    assert result.span.path == str(file)
