"""Switches for behaviour without a conclusive public source.

Every field is a question that the kernel manual leaves open, or on which sources disagree. The
default follows a source (named) or, without one, memory of RobotWare 6 [mem].
docs/rapid/switches.md lists them.
"""

from dataclasses import dataclass, fields
from typing import Literal, get_args


@dataclass(frozen=True, slots=True)
class Switches:
    """Decisions of the virtual controller on open questions."""

    num_rounding: Literal["store", "operation"] = "store"
    """When a num is rounded to IEEE single: at a store, a parameter or a result, or after every
    operator. No source."""

    dnum_whole: Literal["52", "53"] = "52"
    """Power of 2 up to which a dnum counts whole numbers: as the manuals promise [mem], or as an
    IEEE double. Larger values lose their last bits."""

    for_loop: Literal["kernel", "tested"] = "kernel"
    """`kernel`: FOR does not test the first pass, and without STEP it counts down if the end is
    below the start [K §4.15]. `tested`: STEP is 1 and the first pass is tested."""

    unhandled_error: Literal["propagate", "stop"] = "stop"
    """An error in a routine without ERROR goes directly to the system error handler, as on
    controllers (the log of one with RobotWare 6.03; tests on a virtual one of 6.15; ABB's own
    modules for RobotWare 7 end each helper in RAISE), or to the caller [K §7.1, S4 overview]."""

    integer_division: Literal["truncate", "floor"] = "truncate"
    """DIV and MOD with a negative left operand. K is silent."""

    retry_raised: bool = True
    """RETRY is permitted for an error of RAISE. False: S4 datasys 2-RETRY-1."""

    raise_in_handler: Literal["caller", "error"] = "caller"
    """RAISE with a number in an ERROR handler passes the error to the caller (public modules on
    controllers do it), or stops the task (K §4.8 forbids it)."""

    negative_mod: Literal["allow", "error"] = "allow"
    """A negative left operand of MOD. `error`: S4 overview 4-26."""

    cycle_resets_interrupts: bool = False
    """True: the next cycle of main deletes ordered interrupts. False: it keeps them (S4 overview
    4-24)."""

    e_stop_routines: bool = True
    """An emergency stop runs the routines of QSTOP [mem]. False: it runs none."""

    e_stop_output: Literal["reset", "button"] = "reset"
    """The system output EmStop is high until the emergency stop is reset, or until its button is
    released. No source; the state of the controller lasts until the reset."""

    after_error: Literal["statement", "main"] = "statement"
    """Effect of an unhandled error: the program pointer is at the failed statement, which a start
    of a NORMAL task executes again [S4 overview 3-23], or the task starts from main only."""

    fault_routines: bool = False
    """A task stopped by an error runs its STOP routines [mem]. The NORMAL tasks stopped together
    with it always do."""

    wait_until: Literal["polled", "event"] = "polled"
    """WaitUntil evaluates every 0.1 s [S4 datasys 2-WaitUntil-1], or at each change of a persistent
    or signal in its condition (later RobotWare) [mem]."""

    dionum: Literal["strict", "nonzero"] = "strict"
    """A dionum other than 0 and 1 is an error (S4 datasys 1-dionum-1), or counts as 1."""

    open_default: Literal["write", "read"] = "write"
    """Open without a mode: \\Write (S4 datasys 2-Open-1), or \\Read."""

    refused_connect: Literal["timeout", "unreachable", "closed"] = "timeout"
    """What SocketConnect does if the partner rejects the connection: it repeats the request until
    its time (60 s by default) is over and raises ERR_SOCK_TIMEOUT, as with a partner that is
    switched off, or it raises another ERR_SOCK_ error at once. No source."""

    failed_connect: Literal["again", "create"] = "again"
    """After a failed SocketConnect the same socket may connect again, as a RETRY in public programs
    does (Keyence's CV-X modules), or must be closed and created first [mem]."""

    receive_timeout: Literal["keep", "drop"] = "keep"
    """Bytes received before a timeout of SocketReceive stay for the next one, or are lost. No
    source."""

    unpack_beyond: Literal["error", "zero"] = "error"
    """UnpackRawBytes beyond the valid length: ERR_OUTOFBND, or the bytes count as 0. No source."""

    pack_beyond: Literal["zero", "error"] = "zero"
    """PackRawBytes that leaves a gap after the valid length: the bytes in the gap are 0 (the new
    length of 3HAC16581-1 includes them), or ERR_OUTOFBND."""

    unpack_ulint: Literal["exact", "single", "error"] = "exact"
    """A ULINT read into a dnum: exact as far as a dnum counts (3HAC16581-1 lists the type and
    requires a dnum), rounded through a num, or ERR_ARGVALERR."""

    send_attends: bool = True
    """Traps run while SocketSend waits for buffer space, as in the waiting routines of [K §8.1].
    False: only after its end. No source."""

    alias_by_name: bool = True
    """AliasIO takes the name of a signal as a string [manual]. False: event 194214 and stop."""

    axis_limits_readable: bool = True
    """ReadCfgData finds the limits of the axes, MOC/ARM [code]. False: ERR_CFG_NOTFND."""

    calc_in_background: bool = True
    """CalcRobT and CalcJointT in a task without a robot use the robot of its unit group, as CRobT
    and CJointT do there in ABB's own module for RobotWare 7 [ABB]. False: ERR_NOT_MOVETASK
    [mem]."""

    installed_modules_exist: bool = True
    """ModExist reports every module of its task: loaded ones and installed ones [manual
    3HAC050917]. False: only those of Load."""

    data_of_tasks: bool = True
    """GetDataVal and SetDataVal with \\TaskName reach persistents of another task, for which the
    argument exists [manual 3HAC050917]; public programs for recovery read robtargets of T_ROB1 with
    it [code]. False: ERR_TASKNAME [mem]."""

    search_pattern: Literal["whole", "part"] = "whole"
    """\\Object of SetDataSearch matches a whole name, as ABB's programs for hands with cameras use
    it (a prefix and `.*`) [ABB], or a part of it [mem]."""

    next_symbol: Literal["level", "below"] = "level"
    """GetNextSym without \\Recursive stays on the level of SetDataSearch: in a module, or above all
    modules with the predefined data, as public programs search camera devices and units [code]
    (they use \\Recursive for their own data); or it searches all modules."""

    error_reach: Literal["all", "own"] = "all"
    """IError reports events of all tasks, as public loggers in separate tasks expect [code], or of
    its own task only."""

    find_past_end: Literal["none", "error"] = "none"
    """StrFind and StrMatch from the position just after the text have no match (Machina's driver
    ends every command with it), or raise an error (S4 datasys 3-StrFind)."""

    moves_back: bool = True
    """A backward step over a stepped move drives the robot back to its start (S4 datasys
    2-SearchL-6: "carries out the movement"), or is rejected."""

    whole_text: Literal["six", "all"] = "six"
    """A whole num in the standard format: 6 significant digits (S4 datasys 3-ValToStr-1), or all
    digits up to 16777215, which check sums of Keyence's CV-X modules require."""

    argument_error: Literal["recoverable", "fatal"] = "recoverable"
    """An invalid argument of a built-in raises ERR_ARGVALERR, which a handler receives: later
    manuals contain the name; which built-ins raise it is remembered [mem]. `fatal`: no handler
    receives it."""

    undo_error: Literal["stop", "ignore"] = "stop"
    """An error in an UNDO handler stops the task and skips the other UNDO handlers, or ends that
    handler only, with a message [mem]. K is silent."""

    event_stops: bool = False
    """A Stop in an event routine also runs the STOP routines [mem]."""

    interrupts_limited: bool = True
    """A task may have 100 connected interrupts, then ERR_INOMAX [mem]. False: any number [K §8]."""

    shortest_timer: Literal["limited", "any"] = "limited"
    """ITimer below 0.1 s, with \\Single below 0.01 s, is an error [mem], or permitted (S4 datasys
    2-ITimer names no limit)."""

    signal_times: Literal["irc5", "s4"] = "irc5"
    """\\SDelay and \\PLength: 0.001 to 2000 s [mem], or 0.1 to 32 s (S4 datasys 2-SetDO-1)."""

    bit_order: Literal["lowest", "highest"] = "lowest"
    """Meaning of the first number in the DeviceMap of a group signal: its lowest or highest bit
    [mem]."""

    list_number: Literal["zero", "one"] = "zero"
    """\\ListNo of ReadCfgData counts from 0, and -1 follows the last [mem], or from 1, and 0
    follows."""

    queue_timeout: bool = True
    """RMQSendWait without \\TimeOut ends after 60 s [mem]. False: it waits without limit, as
    RMQReadWait does."""

    egm_timeout: Literal["second", "explicit", "never"] = "second"
    """Time without an EGM partner after which EGMRunJoint raises ERR_UDPUC_COMM: \\CommTimeout, by
    default 1 s (an engineer of ABB recalls it; the manual is silent); only an explicit
    \\CommTimeout; or never (a GoFa with RobotWare 7.21 waited for 2 min with 5 s)."""

    egm_dead_time: Literal["typical", "none", "short", "long"] = "typical"
    """Time between an order of EGM and the motion: 16 ms (ABB: 10 to 20 ms), 0, 8, or 48 ms
    (users with level Raw, ros-industrial/abb_libegm, issue 111)."""

    egm_convergence: Literal["messages", "cycles"] = "messages"
    r"""What counts for \CondTime of EGMRun: cycles with a new message (a GoFa with RobotWare 7.21
    and a silent partner never ended), or all of them, as the manual reads."""

    egm_clock: Literal["start", "epoch"] = "start"
    """`time` in messages of EGM: since the controller's start, as RobotStudio sends it, or since
    1970, as egm.proto says."""

    sockets_limited: bool = True
    """32 sockets of a controller may be open [mem]. False: any number."""

    collision_error: Literal["stop", "error"] = "stop"
    """A detected collision stops the program, as on delivered controllers, or raises ERR_COLL_STOP
    in the move, as with the system parameter Collision Error Handling [code: handlers of public
    programs]."""

    stationary_zones: Literal["power_on", "anywhere"] = "power_on"
    """Stationary world zones may be defined in event routines of POWER ON [manual 3HAC050917], or
    in any routine, for programs tested without their event routines."""

    hands_calibrated: bool = False
    """True: the hands of a YuMi are calibrated at power-up, as after an earlier program. False:
    they are not [HandDriver.sys checks it]."""

    unreachable_target: Literal["stop", "handler"] = "stop"
    """A move to a place that the robot cannot reach: event 50050 stops the tasks, as in 9 of 9
    cases in saved event logs (RobotWare 5.61, 6.03), or a handler receives ERR_ROBLIMIT or
    ERR_OUTSIDE_REACH. These logs do not show whether a handler was there."""

    no_configuration: Literal["limit", "reach", "stop"] = "limit"
    """CalcJointT of a configuration that is impossible at the place: ERR_ROBLIMIT, because an axis
    would be outside its range [manual], ERR_OUTSIDE_REACH, or the task stops as with a move."""

    delimiters: Literal["added", "alone"] = "added"
    """\\Delim of ReadStr adds to the line feed, as in ReadNum [mem], or replaces it."""

    byte_to_str: Literal["character", "code"] = "character"
    """ByteToStr \\Char of a non-printable code: the character itself (open_abb's servers end their
    lines with it), or three characters such as `\\07` (S4 datasys 3-ByteToStr, literally)."""


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
        "egm_dead_time",
        "egm_convergence",
        "egm_clock",
        "sockets_limited",
        "stationary_zones",
        "hands_calibrated",
        "delimiters",
        "no_configuration",
    }
)
"""Switches without an effect on generated drivers."""


def parse_switches(text: str) -> Switches:
    """Parse `name=value,...`. ValueError: unknown switch or value."""
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
