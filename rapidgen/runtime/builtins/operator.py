"""The operator window, the dialogs of the FlexPendant, and messages to the event log.

Sources: S4 reference, pages TPWrite, TPReadNum, TPReadFK, ErrWrite [manual]; the UI* dialogs by
the names and errors of 3HAC16581-1. A dialog that is broken off raises its error, or puts the
number into \\BreakFlag and goes on. \\DefaultBtn is what such a message box then returns [mem].
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from rapidgen.machine.log import EventType
from rapidgen.machine.scheduler import WaitSet
from rapidgen.rapid.number_text import DNUM_DIGITS, number_text
from rapidgen.rapid.numbers import MAX_STRING
from rapidgen.runtime.errors import RapidError, errnum
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.signals import AnySignal
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.text import value_text
from rapidgen.runtime.values import Ref, Value

_RESULTS = {
    "OK": 1,
    "Abort": 2,
    "Retry": 3,
    "Ignore": 4,
    "Cancel": 5,
    "Yes": 6,
    "No": 7,
}
"""btnres by what the button says."""
_BUTTONS: dict[int, tuple[str, ...]] = {
    -1: (),
    0: ("OK",),
    1: ("Abort", "Retry", "Ignore"),
    2: ("OK", "Cancel"),
    3: ("Retry", "Cancel"),
    4: ("Yes", "No"),
    5: ("Yes", "No", "Cancel"),
}
"""buttondata."""
_EVENTS = {
    EventType.ERROR: 80_001,
    EventType.WARNING: 80_002,
    EventType.INFO: 80_003,
}
_PROCESS_DOMAIN = 110_000


# -- the window -----------------------------------------------------------------------------


def appended(
    task: Task,
    text: str,
    num: float | None,
    boolean: bool | None,
    pos: object,
    orient: object,
    dnum: float | None,
) -> str:
    """`text` with a value in the standard format behind it (TPWrite, Write)."""
    whole = task.controller.dialect.whole_text == "all"
    if num is not None:
        return text + number_text(num, whole=whole)
    if dnum is not None:
        return text + number_text(dnum, DNUM_DIGITS)
    for value in (boolean, pos, orient):
        if value is not None:
            return text + value_text(value, whole=whole)
    return text


@builtin("TPWrite", cost="string")
def tp_write(
    task: Task,
    text: str,
    num: float | None,
    boolean: bool | None,
    pos: object,
    orient: object,
    dnum: float | None,
) -> None:
    """Show a text, with a value behind it if one is given."""
    task.controller.operator.write(task.name, appended(task, text, num, boolean, pos, orient, dnum))


@builtin("TPErase", cost="string")
def tp_erase(task: Task) -> None:
    """Clear the window."""
    task.controller.operator.erase()


@builtin("TPShow", cost="string")
def tp_show(_task: Task, _window: float) -> None:
    """Choose a window of the FlexPendant: there is only one here."""


@builtin("UIClientExist")
def ui_client_exist(task: Task) -> bool:
    """Whether anybody can answer a dialog."""
    return task.controller.operator.present


# -- dialogs ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Breaks:
    """The arguments that all dialogs end with."""

    max_time: float | None
    di: AnySignal | None
    di_passive: bool | None
    do: AnySignal | None
    do_passive: bool | None
    pers: Ref | None
    pers_passive: bool | None
    flag: Ref | None
    active: AnySignal | None

    def reason(self) -> str | None:
        """The error of a break that is there now."""
        if self.di is not None and bool(self.di.value) != bool(self.di_passive):
            return "ERR_TP_DIBREAK"
        if self.do is not None and bool(self.do.value) != bool(self.do_passive):
            return "ERR_TP_DOBREAK"
        if self.pers is not None and bool(self.pers.get()) != bool(self.pers_passive):
            return "ERR_TP_PERSBOOLBREAK"
        return None

    def sources(self) -> list[WaitSet]:
        """What can bring a break."""
        found = [s.signal.changed for s in (self.di, self.do) if s is not None]
        if self.pers is not None and self.pers.cell is not None:
            found.append(self.pers.cell)
        return found


def _ask(
    task: Task,
    dialog: str,
    text: str,
    choices: Mapping[str, float],
    check: Callable[[str], object],
    tail: tuple[Value, ...],
) -> object:
    """The answer to a dialog; None when it was broken off and \\BreakFlag tells."""
    breaks = _Breaks(*tail)
    operator = task.controller.operator
    if not operator.present:
        _break_off(breaks, "ERR_TP_NO_CLIENT")
        return None
    question = operator.ask(task.name, dialog, text, choices, check)
    if breaks.active is not None:
        task.controller.io.set(breaks.active.signal, 1)
    try:
        in_time = task.wait_for(
            lambda: question.answered or breaks.reason() is not None,
            on=(question.changed, *breaks.sources()),
            timeout=breaks.max_time,
        )
    finally:
        operator.withdraw(question)
        if breaks.active is not None:
            task.controller.io.set(breaks.active.signal, 0)
    if not question.answered:
        _break_off(breaks, (in_time and breaks.reason()) or "ERR_TP_MAXTIME")
        return None
    if breaks.flag is not None:
        breaks.flag.set(0)
    return question.answer


def _break_off(breaks: _Breaks, name: str) -> None:
    if breaks.flag is None:
        raise RapidError(name)
    breaks.flag.set(errnum(name))


def _one_of(choices: Mapping[str, float]) -> Callable[[str], float]:
    """Accept a choice by its text or by its number."""

    def check(value: str) -> float:
        for text, number in choices.items():
            if value.strip().lower() in (text.strip().lower(), f"{number:g}"):
                return number
        raise ValueError(f"one of {', '.join(choices)} is wanted")

    return check


def _a_number(
    low: float | None = None, high: float | None = None, *, integer: bool = False
) -> Callable[[str], float]:
    def check(value: str) -> float:
        number = float(value)
        if not (low is None or number >= low) or not (high is None or number <= high):
            raise ValueError(f"{value} is out of range")
        if number != number or (integer and number != int(number)):
            raise ValueError(f"{value} is not whole")
        return number

    return check


def _a_text(value: str) -> str:
    if len(value) > MAX_STRING:
        raise ValueError(f"at most {MAX_STRING} characters")
    return value


@builtin("TPReadNum", cost="string")
def tp_read_num(task: Task, answer: Ref, text: str, *tail: Value) -> None:
    """Ask for a number."""
    value = _ask(task, "TPReadNum", text, {}, _a_number(), tail)
    if value is not None:
        answer.set(value)


@builtin("TPReadDnum", cost="string")
def tp_read_dnum(task: Task, answer: Ref, text: str, *tail: Value) -> None:
    """Ask for a number, exactly."""
    value = _ask(task, "TPReadDnum", text, {}, _a_number(), tail)
    if value is not None:
        answer.set(value)


@builtin("TPReadFK", cost="string")
def tp_read_fk(
    task: Task,
    answer: Ref,
    text: str,
    fk1: str,
    fk2: str,
    fk3: str,
    fk4: str,
    fk5: str,
    *tail: Value,
) -> None:
    """Ask for one of five keys; one without a text is dead."""
    keys = {key: float(i) for i, key in enumerate((fk1, fk2, fk3, fk4, fk5), 1) if key.strip()}
    value = _ask(task, "TPReadFK", text, keys, _one_of(keys), tail)
    if value is not None:
        answer.set(value)


def _lines(
    header: str | None, message: str | None, lines: Mapping[int, str] | None, *more: str | None
) -> str:
    parts = [header, message, *(lines.values() if lines is not None else ()), *more]
    return "\n".join(part for part in parts if part)


def _buttons(buttons: float | None, array: Mapping[int, str] | None) -> dict[str, float]:
    if array is not None:
        return {text: float(i) for i, text in array.items() if text}
    kind = 0 if buttons is None else int(buttons)
    if kind not in _BUTTONS:
        raise RapidError("ERR_UI_BUTTONS", f"{buttons:g} is no buttondata")
    return {text: _RESULTS[text] for text in _BUTTONS[kind]}


@builtin("UIMsgBox", cost="string")
def ui_msg_box(
    task: Task,
    header: str | None,
    line1: str,
    line2: str | None,
    line3: str | None,
    line4: str | None,
    line5: str | None,
    _wrap: bool | None,
    buttons: float | None,
    _icon: float | None,
    _image: str | None,
    result: Ref | None,
    *tail: Value,
) -> None:
    """Show a box with buttons and wait for one."""
    choices = _buttons(buttons, None)
    text = _lines(header, line1, None, line2, line3, line4, line5)
    value = _ask(task, "UIMsgBox", text, choices, _one_of(choices), tail)
    if result is not None:
        result.set(0 if value is None else value)


@builtin("UIMessageBox", cost="string")
def ui_message_box(
    task: Task,
    header: str | None,
    message: str | None,
    lines: Mapping[int, str] | None,
    _wrap: bool | None,
    buttons: float | None,
    array: Mapping[int, str] | None,
    default: float | None,
    _icon: float | None,
    _image: str | None,
    *tail: Value,
) -> float:
    """Show a box with buttons; which one was pressed."""
    choices = _buttons(buttons, array)
    text = _lines(header, message, lines)
    value = _ask(task, "UIMessageBox", text, choices, _one_of(choices), tail)
    if isinstance(value, float | int):
        return value
    return 0 if default is None else default


def _number_entry(name: str) -> None:
    @builtin(name, cost="string")
    def enter(
        task: Task,
        header: str | None,
        message: str | None,
        lines: Mapping[int, str] | None,
        _wrap: bool | None,
        _icon: float | None,
        initial: float | None,
        low: float | None,
        high: float | None,
        integer: bool | None,
        *tail: Value,
    ) -> float:
        if initial is not None and integer and initial != int(initial):
            raise RapidError("ERR_UI_NOTINT")
        text = _lines(header, message, lines)
        return _entered(task, name, text, initial, low, high, bool(integer), tail)


_number_entry("UINumEntry")
_number_entry("UIDnumEntry")


def _entered(
    task: Task,
    dialog: str,
    text: str,
    initial: float | None,
    low: float | None,
    high: float | None,
    integer: bool,
    tail: tuple[Value, ...],
) -> float:
    if low is not None and high is not None and low > high:
        raise RapidError("ERR_UI_MAXMIN")
    too_low = initial is not None and low is not None and initial < low
    if too_low or (initial is not None and high is not None and initial > high):
        raise RapidError("ERR_UI_INITVALUE")
    value = _ask(task, dialog, text, {}, _a_number(low, high, integer=integer), tail)
    if isinstance(value, float | int):
        return value
    return 0 if initial is None else initial


@builtin("UINumTune", cost="string")
def ui_num_tune(
    task: Task,
    header: str | None,
    message: str | None,
    lines: Mapping[int, str] | None,
    _wrap: bool | None,
    _icon: float | None,
    initial: float,
    _step: float,
    low: float | None,
    high: float | None,
    *tail: Value,
) -> float:
    """Ask for a number that is tuned from an initial one."""
    return _entered(
        task, "UINumTune", _lines(header, message, lines), initial, low, high, False, tail
    )


@builtin("UIAlphaEntry", cost="string")
def ui_alpha_entry(
    task: Task,
    header: str | None,
    message: str | None,
    lines: Mapping[int, str] | None,
    _wrap: bool | None,
    _icon: float | None,
    initial: str | None,
    *tail: Value,
) -> str:
    """Ask for a text."""
    value = _ask(task, "UIAlphaEntry", _lines(header, message, lines), {}, _a_text, tail)
    return value if isinstance(value, str) else initial or ""


@builtin("UIListView", cost="string")
def ui_list_view(
    task: Task,
    result: Ref | None,
    header: str | None,
    items: Mapping[int, Value],
    buttons: float | None,
    array: Mapping[int, str] | None,
    _icon: float | None,
    default: float | None,
    *tail: Value,
) -> float:
    """Ask for one of a list's items."""
    choices = {item.text: float(i) for i, item in items.items() if item.text}
    value = _ask(task, "UIListView", header or "", choices, _one_of(choices), tail)
    chosen = value if isinstance(value, float | int) else 0
    if result is not None:
        pressed = _buttons(buttons, array) if buttons is not None or array is not None else {}
        result.set(next(iter(pressed.values()), 0) if chosen else 0)
    return chosen or (0 if default is None else default)


@builtin("UIMsgWrite", cost="string")
def ui_msg_write(
    task: Task,
    header: str | None,
    message: str | None,
    lines: Mapping[int, str] | None,
    *_look: object,
) -> None:
    """Show a message without waiting."""
    for line in _lines(header, message, lines).split("\n"):
        task.controller.operator.write(task.name, line)


@builtin("UIShow", cost="string")
def ui_show(task: Task, assembly: str, *_arguments: object) -> None:
    """Start an application on the FlexPendant: there is none here that could."""
    if not task.controller.operator.present:
        raise RapidError("ERR_TP_NO_CLIENT")
    raise RapidError("ERR_UISHOW_FATAL", f"{assembly} cannot run on a virtual controller")


# -- the event log ------------------------------------------------------------------------------


@builtin("ErrWrite", cost="string")
def err_write(
    task: Task,
    warning: bool | None,
    info: bool | None,
    header: str,
    reason: str,
    rl2: str | None,
    rl3: str | None,
    rl4: str | None,
) -> None:
    """Write a message of the user's own: 80001 error, 80002 \\W, 80003 \\I."""
    kind = EventType.WARNING if warning else EventType.INFO if info else EventType.ERROR
    log = task.controller.log
    texts = [text for text in (reason, rl2, rl3, rl4) if text]
    log.write(_EVENTS[kind], kind, header, *texts, task=task.name)


@builtin("ErrLog", cost="string")
def err_log(
    task: Task,
    number: float,
    warning: bool | None,
    info: bool | None,
    *arguments: str,
) -> None:
    """Write a message whose text is in a file: here its number and its arguments."""
    kind = EventType.WARNING if warning else EventType.INFO if info else EventType.ERROR
    if not (4800 <= number <= 4814 or 5000 <= number <= 9999):
        raise RapidError("ERR_ARGVALERR", f"{number:g} is no ErrorId")
    log = task.controller.log
    texts = [text for text in arguments if text]
    log.write(_PROCESS_DOMAIN + int(number), kind, "ErrLog", *texts, task=task.name)
