"""Operator window, FlexPendant dialogs and event log messages.

Sources: S4 reference, pages TPWrite, TPReadNum, TPReadFK, ErrWrite [manual]; names and errors of
the UI* dialogs from 3HAC16581-1. A dialog that a break condition ends raises its error, or stores
the number in \\BreakFlag and continues. A message box then returns \\DefaultBtn [mem].
"""

import math
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType

from rapidgen.machine.event_log import EventType
from rapidgen.machine.scheduler import WaitSet
from rapidgen.rapid.numbers import DNUM_DIGITS, MAX_STRING, number_text
from rapidgen.runtime.errors import RapidError, errnum
from rapidgen.runtime.registry import Arguments, builtin, builtins, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.text import value_text
from rapidgen.runtime.values import PersistentCell, Ref, Value

_RESULTS = {
    "OK": 1,
    "Abort": 2,
    "Retry": 3,
    "Ignore": 4,
    "Cancel": 5,
    "Yes": 6,
    "No": 7,
}
"""Values of btnres by button text."""
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


def appended(task: Task, text: str, *values: Value) -> str:
    """Return `text` followed by a value in the standard format."""
    num, boolean, pos, orient, dnum = values
    complete = task.controller.dialect.whole_text == "all"
    if num is not None:
        return text + number_text(num, complete=complete)
    if dnum is not None:
        return text + number_text(dnum, DNUM_DIGITS)
    for value in (boolean, pos, orient):
        if value is not None:
            return text + value_text(value, complete=complete)
    return text


@builtin("TPWrite", cost="string")
def tp_write(task: Task, text: str, *values: Value) -> None:
    """Show a text, followed by a value if present."""
    task.controller.operator.write(task.name, appended(task, text, *values))


# There is one window only, which TPShow need not choose.
_WINDOW: dict[str, Callable[..., Value]] = {
    "TPErase": lambda task: task.controller.operator.erase(),
    "TPShow": lambda _task, _window: None,
}
builtins(_WINDOW, cost="string")
builtin("UIClientExist")(lambda task: task.controller.operator.present)


# -- dialogs ----------------------------------------------------------------------------------


_BREAKS = (
    ("DIBreak", "DIPassive", "ERR_TP_DIBREAK"),
    ("DOBreak", "DOPassive", "ERR_TP_DOBREAK"),
    ("PersBoolBreak", "PersBoolPassive", "ERR_TP_PERSBOOLBREAK"),
)
"""Break conditions of a dialog: argument, inverting switch, error."""


def _reason(arguments: Arguments) -> str | None:
    """Return the error of a break condition that is true."""
    for name, passive, error in _BREAKS:
        source = arguments[name]
        if source is not None:
            value = source.get() if isinstance(source, Ref | PersistentCell) else source.value
            if bool(value) != bool(arguments[passive]):
                return error
    return None


def _sources(arguments: Arguments) -> list[WaitSet]:
    """Return the wait sets of the break conditions."""
    signals, flag = (arguments["DIBreak"], arguments["DOBreak"]), arguments["PersBoolBreak"]
    result: list[WaitSet] = [s.signal.changed for s in signals if s is not None]
    if flag is not None and flag.cell is not None:
        result.append(flag.cell)
    return result


def _ask(
    task: Task,
    dialog: str,
    text: str,
    arguments: Arguments,
    check: Callable[[str], object],
    choices: Mapping[str, float] = MappingProxyType({}),
    proposed: str = "",
) -> Value:
    """Return the answer to a dialog, None after a break with \\BreakFlag."""
    operator, active, flag = (
        task.controller.operator,
        arguments["UIActiveSignal"],
        arguments["BreakFlag"],
    )
    if not operator.present:
        _break_off(flag, "ERR_TP_NO_CLIENT")
        return None
    question = operator.ask(task.name, dialog, text, choices, check, proposed)
    if active is not None:
        task.controller.io.set(active.signal, 1)
    try:
        in_time = task.wait_for(
            lambda: question.answered or _reason(arguments) is not None,
            on=(question.changed, *_sources(arguments)),
            timeout=arguments["MaxTime"],
            why=lambda: operator.waits(task.name),
        )
    finally:
        operator.withdraw(question)
        if active is not None:
            task.controller.io.set(active.signal, 0)
    if not question.answered:
        _break_off(flag, (in_time and _reason(arguments)) or "ERR_TP_MAXTIME")
        return None
    if flag is not None:
        flag.set(0)
    return question.answer


def _break_off(flag: Ref | None, name: str) -> None:
    if flag is None:
        raise RapidError(name)
    flag.set(errnum(name))


def _choose(
    task: Task,
    dialog: str,
    text: str,
    arguments: Arguments,
    choices: Mapping[str, float],
    default: float | None = None,
) -> Value:
    proposed = next((text for text, number in choices.items() if number == default), "")
    return _ask(task, dialog, text, arguments, _one_of(choices), choices, proposed)


def _one_of(choices: Mapping[str, float]) -> Callable[[str], float]:
    """Return a function that accepts a choice by text or number."""

    def check(value: str) -> float:
        for text, number in choices.items():
            if value.strip().lower() in (text.strip().lower(), f"{number:g}"):
                return number
        raise ValueError(f"one of {', '.join(choices)} is wanted")

    return check


def _a_number(
    low: float | None = None, high: float | None = None, *, integer: bool = False
) -> Callable[[str], float]:
    bounds = "".join(
        f" {word} {bound:.15g}"
        for word, bound in (("from", low), ("up to", high))
        if bound is not None
    )
    expected = f"a {'whole ' if integer else ''}number{bounds} is wanted"

    def check(value: str) -> float:
        try:
            number = float(value)
        except ValueError as fault:
            raise ValueError(expected) from fault
        small = low is not None and number < low
        large = high is not None and number > high
        if small or large or not math.isfinite(number) or (integer and number != int(number)):
            raise ValueError(expected)
        return number

    return check


def _a_text(value: str) -> str:
    if len(value) > MAX_STRING:
        raise ValueError(f"at most {MAX_STRING} characters")
    return value


@by_name("TPReadNum", "TPReadDnum", cost="string")
def tp_read_num(task: Task, dialog: str, arguments: Arguments) -> None:
    """Ask for a number."""
    value = _ask(task, dialog, arguments["TPText"], arguments, _a_number())
    if value is not None:
        arguments["TPAnswer"].set(value)


@by_name("TPReadFK", cost="string")
def tp_read_fk(task: Task, dialog: str, arguments: Arguments) -> None:
    """Show five keys; one without a text has no effect."""
    texts = [arguments[f"TPFK{i}"] for i in range(1, 6)]
    keys = {text: float(i) for i, text in enumerate(texts, 1) if text.strip()}
    value = _choose(task, dialog, arguments["TPText"], arguments, keys)
    if value is not None:
        arguments["TPAnswer"].set(value)


def _text(arguments: Arguments) -> str:
    """Return header and message, line by line."""
    lines = arguments.get("MsgArray")
    parts = [
        arguments["Header"],
        arguments.get("Message"),
        *(lines.values() if lines is not None else ()),
    ]
    parts += [arguments.get(f"MsgLine{i}") for i in range(1, 6)]
    return "\n".join(part for part in parts if part)


def _buttons(buttons: float | None, array: Mapping[int, str] | None) -> dict[str, float]:
    if array is not None:
        return {text: float(i) for i, text in array.items() if text}
    kind = 0 if buttons is None else int(buttons)
    if kind not in _BUTTONS:
        raise RapidError("ERR_UI_BUTTONS", f"{buttons:g} is no buttondata")
    return {text: _RESULTS[text] for text in _BUTTONS[kind]}


@by_name("UIMsgBox", cost="string")
def ui_msg_box(task: Task, dialog: str, arguments: Arguments) -> None:
    """Show a message box with buttons and wait for one."""
    value = _choose(task, dialog, _text(arguments), arguments, _buttons(arguments["Buttons"], None))
    if arguments["Result"] is not None:
        arguments["Result"].set(0 if value is None else value)


@by_name("UIMessageBox", cost="string")
def ui_message_box(task: Task, dialog: str, arguments: Arguments) -> float:
    """Show a message box and return the pressed button."""
    choices = _buttons(arguments["Buttons"], arguments["BtnArray"])
    default = arguments["DefaultBtn"]
    return _else(_choose(task, dialog, _text(arguments), arguments, choices, default), default)


def _else(value: Value, default: float | None) -> float:
    """Return the entered number, or the default without an answer."""
    if isinstance(value, float | int):
        return value
    return 0 if default is None else default


@by_name("UINumEntry", "UIDnumEntry", "UINumTune", "UIDnumTune", cost="string")
def ui_num_entry(task: Task, dialog: str, arguments: Arguments) -> float:
    """Request a number, optionally starting from an initial value."""
    initial, low, high = arguments["InitValue"], arguments["MinValue"], arguments["MaxValue"]
    integer = bool(arguments.get("AsInteger"))
    if initial is not None and integer and initial != int(initial):
        raise RapidError("ERR_UI_NOTINT")
    if low is not None and high is not None and low > high:
        raise RapidError("ERR_UI_MAXMIN")
    too_low = initial is not None and low is not None and initial < low
    if too_low or (initial is not None and high is not None and initial > high):
        raise RapidError("ERR_UI_INITVALUE")
    check = _a_number(low, high, integer=integer)
    proposed = next((f"{value:.15g}" for value in (initial, low) if value is not None), "")
    answer = _ask(task, dialog, _text(arguments), arguments, check, proposed=proposed)
    return _else(answer, initial)


@by_name("UIAlphaEntry", cost="string")
def ui_alpha_entry(task: Task, dialog: str, arguments: Arguments) -> str:
    """Request a text."""
    initial = arguments["InitString"] or ""
    value = _ask(task, dialog, _text(arguments), arguments, _a_text, proposed=initial)
    return value if isinstance(value, str) else initial


@by_name("UIListView", cost="string")
def ui_list_view(task: Task, dialog: str, arguments: Arguments) -> float:
    """Request an item of a list."""
    items, buttons, array = arguments["ListItems"], arguments["Buttons"], arguments["BtnArray"]
    choices = {item.text: float(i) for i, item in items.items() if item.text}
    default = arguments["DefaultIndex"]
    chosen = _else(_choose(task, dialog, _text(arguments), arguments, choices, default), 0)
    if arguments["Result"] is not None:
        pressed = _buttons(buttons, array) if buttons is not None or array is not None else {}
        arguments["Result"].set(next(iter(pressed.values()), 0) if chosen else 0)
    return chosen or _else(default, 0)


@by_name("UIMsgWrite", cost="string")
def ui_msg_write(task: Task, _dialog: str, arguments: Arguments) -> None:
    """Show a message without waiting."""
    for line in _text(arguments).split("\n"):
        task.controller.operator.write(task.name, line)


@builtin("UIShow", cost="string")
def ui_show(task: Task, assembly: str, *_arguments: object) -> None:
    """Start a FlexPendant application; the virtual controller has none."""
    if not task.controller.operator.present:
        raise RapidError("ERR_TP_NO_CLIENT")
    raise RapidError("ERR_UISHOW_FATAL", f"{assembly} cannot run on a virtual controller")


# -- the event log ------------------------------------------------------------------------------


def _logged(
    task: Task,
    code: int | None,
    warning: bool | None,
    info: bool | None,
    title: str,
    texts: Iterable[str | None],
) -> None:
    kind = EventType.WARNING if warning else EventType.INFO if info else EventType.ERROR
    displayed = [text for text in texts if text]
    task.controller.log.write(code or _EVENTS[kind], kind, title, *displayed, task=task.name)


@builtin("ErrWrite", cost="string")
def err_write(
    task: Task, warning: bool | None, info: bool | None, header: str, *reasons: str | None
) -> None:
    """Write a message of the user: 80001 error, 80002 \\W, 80003 \\I."""
    _logged(task, None, warning, info, header, reasons)


@builtin("ErrLog", cost="string")
def err_log(
    task: Task, number: float, warning: bool | None, info: bool | None, *arguments: str
) -> None:
    """Write a message of an external text file by number and arguments."""
    if not (4800 <= number <= 4814 or 5000 <= number <= 9999):
        raise RapidError("ERR_ARGVALERR", f"{number:g} is no ErrorId")
    _logged(task, _PROCESS_DOMAIN + int(number), warning, info, "ErrLog", arguments)


@builtin("EventLog", cost="string")
def event_log(task: Task, domain: float, number: float, kind: float, *arguments: str) -> None:
    """Write a message of any domain and type.

    ABB's drivers call it with these arguments [code HandDriver.sys].
    """
    code = int(domain) * 10_000 + int(number)
    _logged(task, code, kind == EventType.WARNING, kind == EventType.INFO, "EventLog", arguments)
