"""Switches for behaviour that no public source settles.

Every field is a question that the kernel manual leaves open, or on which sources disagree; the
default is the answer that a source (named) or, failing that, memory of RobotWare 6 gives.
docs/rapid/virtual-controller.md lists them.
"""

from dataclasses import dataclass, fields
from typing import Literal, get_args


@dataclass(frozen=True, slots=True)
class Switches:
    """How the virtual controller decides what is not settled."""

    num_rounding: Literal["store", "operation"] = "store"
    """Where a num is rounded to IEEE single: when it is stored, passed or returned, or after
    every operator. No source."""

    dnum_whole: Literal["52", "53"] = "52"
    """Up to which power of 2 a dnum counts whole numbers: what the manuals promise [mem], or as far
    as an IEEE double does. What is larger loses its last bits."""

    for_loop: Literal["kernel", "tested"] = "kernel"
    """`kernel`: the first pass of FOR is never tested, and without STEP it counts down when
    the end lies below the start [K §4.15]. `tested`: STEP is 1 and the first pass is tested."""

    unhandled_error: Literal["propagate", "stop"] = "stop"
    """What happens to an error in a routine without ERROR: straight to the system error handler, as
    on controllers (the log of one with RobotWare 6.03; tests on a virtual one of 6.15; ABB's own
    modules for RobotWare 7 end each helper in RAISE), or to the caller [K §7.1, S4 overview]."""

    integer_division: Literal["truncate", "floor"] = "truncate"
    """DIV and MOD with a negative left operand. K is silent."""

    retry_raised: bool = True
    """RETRY is allowed for an error made by RAISE. False: S4 datasys 2-RETRY-1."""

    raise_in_handler: Literal["caller", "error"] = "caller"
    """RAISE with a number in an ERROR handler: the caller gets that error (public modules that
    run on controllers do it), or the task stops (K §4.8 forbids it)."""

    negative_mod: Literal["allow", "error"] = "allow"
    """A negative left operand of MOD. `error`: S4 overview 4-26."""

    cycle_resets_interrupts: bool = False
    """The next cycle of main keeps ordered interrupts (S4 overview 4-24); True deletes them."""

    e_stop_routines: bool = True
    """An emergency stop runs the routines of QSTOP [mem]. False: it runs none."""

    after_error: Literal["statement", "main"] = "statement"
    """After an error that nobody handled the program pointer is at the faulty statement, which a
    start of a NORMAL task tries again [S4 overview 3-23], or the task starts from main only."""

    fault_routines: bool = False
    """The task that an error stopped runs its STOP routines [mem]. The NORMAL tasks that are
    stopped with it always do."""

    wait_until: Literal["polled", "event"] = "polled"
    """WaitUntil looks every 0.1 s [S4 datasys 2-WaitUntil-1], or whenever a persistent or
    signal in its condition changes (later RobotWare) [mem]."""

    dionum: Literal["strict", "nonzero"] = "strict"
    """A dionum other than 0 and 1 is an error (S4 datasys 1-dionum-1), or counts as 1."""

    open_default: Literal["write", "read"] = "write"
    """Open without a mode: \\Write (S4 datasys 2-Open-1), or \\Read."""

    refused_connect: Literal["timeout", "unreachable", "closed"] = "timeout"
    """Which ERR_SOCK_ a connection that the partner refuses raises. No source."""

    failed_connect: Literal["again", "create"] = "again"
    """Behind a SocketConnect that failed the same socket may connect again, as a RETRY in public
    programs does (Keyence's CV-X modules), or it has to be closed and created first [mem]."""

    receive_timeout: Literal["keep", "drop"] = "keep"
    """Bytes that came before a SocketReceive timed out wait for the next one, or are gone. No
    source."""

    unpack_beyond: Literal["error", "zero"] = "error"
    """UnpackRawBytes behind the valid length: ERR_OUTOFBND, or the bytes count as 0. No source."""

    pack_beyond: Literal["zero", "error"] = "zero"
    """PackRawBytes that leaves a gap behind the valid length: the bytes between are 0 (the new
    length of 3HAC16581-1 covers them), or ERR_OUTOFBND."""

    unpack_ulint: Literal["exact", "single", "error"] = "exact"
    """A ULINT read into a dnum: exact as far as a dnum counts (3HAC16581-1 lists the type, and
    that it needs a dnum), rounded on a way through a num, or ERR_ARGVALERR."""

    send_attends: bool = True
    """Traps run while SocketSend waits for room, as in the waiting routines of [K §8.1]. False:
    not before it has ended. No source."""

    alias_by_name: bool = True
    """AliasIO takes the name of a signal as a string [mem]. False: event 40214 and stop."""

    axis_limits_readable: bool = True
    """ReadCfgData finds the limits of the axes, MOC/ARM [code]. False: ERR_CFG_NOTFND."""

    calc_in_background: bool = True
    """CalcRobT and CalcJointT in a task that moves no robot compute for the one that its unit group
    names, as CRobT and CJointT do there in ABB's own module for RobotWare 7 [ABB]. False:
    ERR_NOT_MOVETASK [mem]."""

    installed_modules_exist: bool = True
    """ModExist tells of every module of its task: it looks among loaded ones, then among installed
    ones [manual 3HAC050917]. False: of those alone that Load brought."""

    data_of_tasks: bool = True
    """GetDataVal and SetDataVal with \\TaskName reach persistents of another task: that is what the
    argument is for [manual 3HAC050917 lists it], and public programs for recovery read robtargets
    of T_ROB1 so [code]. False: ERR_TASKNAME [mem]."""

    search_pattern: Literal["whole", "part"] = "whole"
    """\\Object of SetDataSearch has to fit a whole name, as ABB's programs for hands with cameras
    write it (a prefix and `.*`) [ABB], or some part of it [mem]."""

    next_symbol: Literal["level", "below"] = "level"
    """GetNextSym without \\Recursive stays where SetDataSearch began: in a module, or above all of
    them, where only predefined data are, as public programs use it that seek camera devices and
    units so, and \\Recursive for their own data [code]; or it looks into all modules."""

    error_reach: Literal["all", "own"] = "all"
    """IError tells a task of everybody's events, as public loggers in tasks of their own expect
    [code], or of those of its own only."""

    find_past_end: Literal["none", "error"] = "none"
    """StrFind and StrMatch from the position right behind the text find nothing (Machina's driver
    ends every command so), or it is an error (S4 datasys 3-StrFind)."""

    moves_back: bool = True
    """A backward step over a move that was stepped takes the robot to where it began (S4 datasys
    2-SearchL-6: "carries out the movement"), or refuses."""

    whole_text: Literal["six", "all"] = "six"
    """A whole num in the standard format: 6 significant digits (S4 datasys 3-ValToStr-1), or all of
    them up to 16777215, as the check sums of Keyence's CV-X modules need it."""

    argument_error: Literal["recoverable", "fatal"] = "recoverable"
    """An argument that a built-in refuses is ERR_ARGVALERR, which a handler gets: the later manuals
    have the name, which built-ins raise it is remembered [mem]. `fatal`: no handler gets it."""

    undo_error: Literal["stop", "ignore"] = "stop"
    """An error in an UNDO handler stops the task and leaves out the other ones, or ends that
    handler only, with a message [mem]. K is silent."""

    event_stops: bool = False
    """Stop in an event routine brings the STOP routines, too [mem]."""

    interrupts_limited: bool = True
    """A task may have 100 connected interrupts, then ERR_INOMAX [mem]. False: any number [K §8]."""

    shortest_timer: Literal["limited", "any"] = "limited"
    """ITimer below 0.1 s, with \\Single below 0.01 s, is an error [mem], or is allowed (S4 datasys
    2-ITimer names no limit)."""

    signal_times: Literal["irc5", "s4"] = "irc5"
    """\\SDelay and \\PLength: 0.001 to 2000 s [mem], or 0.1 to 32 s (S4 datasys 2-SetDO-1)."""

    bit_order: Literal["lowest", "highest"] = "lowest"
    """Which bit of a group signal the first number of its DeviceMap is [mem]."""

    list_number: Literal["zero", "one"] = "zero"
    """\\ListNo of ReadCfgData counts from 0, and -1 follows the last [mem], or from 1, and 0
    follows."""

    queue_timeout: bool = True
    """RMQSendWait without \\TimeOut gives up after 60 s [mem]. False: it waits for ever, as
    RMQReadWait does."""

    egm_timeout: Literal["second", "explicit", "never"] = "second"
    """After which silence of an EGM partner EGMRunJoint raises ERR_UDPUC_COMM: after \\CommTimeout
    and, without it, after 1 s (as one of ABB's engineers recalls; the manual is silent), after
    \\CommTimeout alone, or never (a GoFa with RobotWare 7.21 stayed for 2 min with 5 s told)."""

    sockets_limited: bool = True
    """32 sockets of a controller may be open [mem]. False: any number."""

    stationary_zones: Literal["power_on", "anywhere"] = "power_on"
    """Where stationary world zones may be defined: in event routines of POWER ON [manual
    3HAC050917], or in any routine, for programs that are tried without their event routines."""

    hands_calibrated: bool = False
    """Whether the hands of a YuMi are calibrated when the controller is switched on [HandDriver.sys
    asks for it]. True: as if a program before had done it."""

    no_configuration: Literal["limit", "reach", "stop"] = "limit"
    """CalcJointT of a configuration that the place has not: ERR_ROBLIMIT, as an axis would have to
    be where it cannot be [manual], ERR_OUTSIDE_REACH, or the task stops as with a move."""

    delimiters: Literal["added", "alone"] = "added"
    """The \\Delim of ReadStr comes in addition to the line feed, as with ReadNum [mem], or in its
    place."""

    byte_to_str: Literal["character", "code"] = "character"
    """ByteToStr \\Char of a code that cannot be shown: the character itself (open_abb's servers
    end their lines so), or three characters such as `\\07` (S4 datasys 3-ByteToStr by its word)."""


NOT_THE_DRIVERS = frozenset(
    {
        "unpack_ulint",
        "moves_back",
        "whole_text",
        "event_stops",
        "interrupts_limited",
        "shortest_timer",
        "signal_times",
        "bit_order",
        "list_number",
        "queue_timeout",
        "egm_timeout",
        "sockets_limited",
        "stationary_zones",
        "hands_calibrated",
        "delimiters",
        "no_configuration",
    }
)
"""Switches that no generated driver can notice: it does nothing that they are about."""


def parse_switches(text: str) -> Switches:
    """Switches from `name=value,...`. ValueError: unknown switch or value."""
    chosen: dict[str, object] = {}
    known = {f.name: f for f in fields(Switches)}
    for part in filter(None, (p.strip() for p in text.split(","))):
        name, _, value = part.partition("=")
        if name not in known:
            raise ValueError(f"there is no switch {name!r}")
        default = known[name].default
        if isinstance(default, bool):
            if value not in ("true", "false"):
                raise ValueError(f"{name} is true or false")
            chosen[name] = value == "true"
        else:
            allowed = get_args(known[name].type)
            if value not in allowed:
                raise ValueError(f"{name} is one of {', '.join(allowed)}")
            chosen[name] = value
    return Switches(**chosen)  # type: ignore[arg-type]
