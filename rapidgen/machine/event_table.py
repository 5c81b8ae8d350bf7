"""Events of the controller's log, as data: number, type, text, causes, remedy and source.

The log, `rapidgen explain`, `rapidgen log`, IError and the web services read this table. Numbers,
types, the order of arguments and the releases are those of saved event logs of real controllers
(`SOURCE`); all texts are rapidgen's own. `{1}` in a text is the first argument.

Events that only rapidgen writes, and RAPID errors whose number on a controller is not known, have
numbers from 190000 on: 19DNNN belongs to domain D, so that `IError` sees it in that domain.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Final, Literal

SOURCE: Final = "saved event logs of IRB 120 (5.15), 5.61 and IRB 4600 MultiMove (6.03) controllers"
OWN_FIRST: Final = 190_000
OWN_LAST: Final = 199_999


class Domain(IntEnum):
    """Event log domains; the number is the ten-thousands of an event's code."""

    COMMON = 0
    OPERATIONAL = 1
    SYSTEM = 2
    HARDWARE = 3
    PROGRAM = 4
    MOTION = 5
    OPERATOR = 6
    IO = 7
    USER = 8
    SAFETY = 9
    INTERNAL = 10
    PROCESS = 11
    CONFIGURATION = 12
    PAINT = 13


def domain_of(code: int) -> Domain:
    """Return the domain that a number belongs to.

    Raises ValueError for a number that belongs to none.
    """
    if OWN_FIRST <= code <= OWN_LAST:
        return Domain(code // 1000 % 10)
    return Domain(code // 10_000)


@dataclass(frozen=True, slots=True)
class EventKind:
    """What is known about one number. `types` are the letters E, W and I that logs have for it."""

    code: int
    types: str
    title: str
    text: str
    causes: str = ""
    remedy: str = ""
    releases: tuple[str, ...] = ()
    """RobotWare releases whose logs have it; empty: no log, see `source`."""
    source: str = field(default=SOURCE)

    @property
    def is_own(self) -> bool:
        """True if no controller writes this number."""
        return OWN_FIRST <= self.code <= OWN_LAST

    def filled(self, arguments: tuple[str, ...]) -> str:
        """Return the text with the arguments of an event; those that are missing become `?`."""
        result = self.text
        for number in range(1, 7):
            value = arguments[number - 1] if number <= len(arguments) else "?"
            result = result.replace(f"{{{number}}}", value)
        return result


_Row = tuple[int, Literal["E", "W", "I", "EW"], str, str, str, str, str]
_FROM_LOGS: Final[tuple[_Row, ...]] = (
    # Number, types, title, text, usual causes, remedy, releases.
    (10002, "I", "Program pointer at main",
     "Task {3}: the program pointer was set to main.",
     "PP to main, a restart, or a program that was loaded.", "", "5.15 5.61 6.03"),
    (10010, "I", "Motors off",
     "The motors are off.",
     "The mode was changed from manual to automatic, or the motors-on circuit was opened.",
     "Switch the motors on.", "5.15 5.61 6.03"),
    (10011, "I", "Motors on", "The motors are on.", "", "", "5.15 5.61 6.03"),
    (10012, "I", "Guard stop",
     "The motors-on circuit is open: the motors are off and brakes hold the robot.",
     "A change from automatic to manual mode, an emergency stop, or a general, automatic or "
     "superior stop.",
     "Close the circuit, and switch the motors on.", "5.15 5.61 6.03"),
    (10013, "I", "Emergency stop",
     "An emergency stop device opened the motors-on circuit.",
     "An emergency stop button was pressed.",
     "Release the button, acknowledge the emergency stop, and switch the motors on.",
     "5.15 5.61 6.03"),
    (10014, "I", "System failure",
     "All NORMAL tasks were stopped because of a failure.",
     "A background task with trust level SysFail stopped (10082).",
     "Correct the cause, and restart the controller.", "5.15 6.03"),
    (10015, "I", "Manual mode selected", "The controller is in manual mode.",
     "", "", "5.15 5.61 6.03"),
    (10016, "I", "Automatic mode requested", "A change to automatic mode was requested.",
     "", "Confirm the change on the pendant.", "5.15 5.61 6.03"),
    (10017, "I", "Automatic mode confirmed", "The controller is in automatic mode.",
     "", "", "5.15 5.61 6.03"),
    (10020, "I", "Execution error",
     "Task {2} was stopped by an error; the events before this one name it.",
     "", "Correct the error, and start the program again.", "5.15 5.61 6.03"),
    (10021, "I", "Execution error reset", "Task {2}: the state after an error was reset.",
     "The program was started after an error.", "", "5.15 5.61 6.03"),
    (10024, "I", "Collision detected", "A part of the robot touched something.",
     "", "Find out what the robot touched before it moves again.", "5.61"),
    (10025, "I", "Collision confirmed", "The collision was acknowledged.", "", "", "5.61"),
    (10026, "I", "Back on the path",
     "After a collision the robot moved back along its path.", "", "", "5.61"),
    (10045, "I", "System restarted", "An installed system was started again.",
     "", "", "5.15 5.61 6.03"),
    (10048, "E", "Background task stopped",
     "Background task {1} stopped although nothing asked it to.",
     "An error that the task does not handle.",
     "Look at the error before this event, and correct the task.", "5.15"),
    (10052, "I", "Return to path started", "The robot returns to its path ({1}).",
     "The program was started after a stop.", "", "5.15 5.61 6.03"),
    (10053, "I", "Return to path finished", "The robot is on its path again ({1}).",
     "", "", "5.15 5.61 6.03"),
    (10068, "W", "Start of a program failed", "The program of task {1} cannot be started.",
     "", "Look at the events before this one.", "5.61"),
    (10082, "E", "Supervised task is not running",
     "Task {1} is not running; the system goes to failure, and motors on is refused.",
     "A background task with trust level SysFail stopped.",
     "Correct the task, and restart the controller.", "5.15"),
    (10095, "W", "A task is not selected",
     "The program was started with at least one NORMAL task deselected.",
     "A task is deselected in the task selection of the pendant.",
     "Select all tasks that must run.", "6.03"),
    (10097, "E", "Restart is not possible",
     "Task {1} is blocked and cannot continue from where it stands.",
     "An error of the motion system (such as 50050) stopped it there.",
     "Move the program pointer, for instance to main.", "5.61"),
    (10106, "I", "Service interval", "Last service of {2}: {1} days ago.",
     "", "Have the robot serviced.", "5.15 6.03"),
    (10121, "I", "Program stopped: EXIT", "Task {2} executed EXIT.", "", "", "5.61"),
    (10123, "I", "Program stopped: step done", "Task {2} finished a step.", "", "", "5.61"),
    (10125, "I", "Program stopped", "Task {2} was stopped from outside.",
     "Stop on the pendant, a system input, a stop over the network, or another task.",
     "", "5.15 5.61 6.03"),
    (10126, "I", "Program stopped: error", "Task {2} was stopped by an error.",
     "The events before this one name it.", "Correct the error.", "5.15 5.61"),
    (10128, "W", "Step backwards is not possible",
     "Task {2} cannot be executed backwards past this instruction.", "", "", "5.15"),
    (10129, "I", "Program stopped: event routine done",
     "Task {2} finished the routines of RESET or POWER_ON.", "", "", "5.15 5.61 6.03"),
    (10133, "I", "Program stopped: UNDO done", "Task {2} finished its UNDO handlers.",
     "", "", "6.03"),
    (10150, "I", "Program started",
     "Task {2} started at the first instruction of its entry routine.", "", "", "5.15 5.61 6.03"),
    (10151, "I", "Program started",
     "Task {2} started at the first instruction of its entry routine, by an external client.",
     "", "", "5.15 5.61 6.03"),
    (10152, "I", "Program started",
     "Task {2} started at its entry routine to execute UNDO handlers.", "", "", "6.03"),
    (10155, "I", "Program continues", "Task {2} continues where it stopped.", "", "", "5.15 6.03"),
    (10156, "I", "Program continues",
     "Task {2} continues where it stopped, by an external client.", "", "", "5.15 5.61 6.03"),
    (10230, "I", "Backup: preparation done", "Step {1} of a backup is done.", "", "", "5.61"),
    (10231, "I", "Backup: configuration done", "Step {1} of a backup is done.", "", "", "5.61"),
    (10232, "I", "Backup: tasks done", "Step {1} of a backup is done.", "", "", "5.61"),
    (10250, "I", "Restore: preparation done", "Step {1} of a restore is done.", "", "", "5.61"),
    (10251, "I", "Restore: configuration done", "Step {1} of a restore is done.", "", "", "5.61"),
    (10252, "I", "Restore: tasks done", "Step {1} of a restore is done.", "", "", "5.61"),
    (10253, "I", "Restore: user tasks done", "Step {1} of a restore is done.", "", "", "5.61"),
    (20010, "E", "Emergency stop circuit open",
     "The robot was to be operated while the emergency stop is active or not acknowledged.",
     "", "Release and acknowledge the emergency stop.", "5.15"),
    (20051, "E", "Refused: client has no mastership",
     "The command needs mastership of program or motion (command {1}).",
     "Another client, or the pendant in manual mode, holds it.",
     "Request mastership first.", "5.61"),
    (20054, "E", "Refused: program runs",
     "The command is refused while the program runs (command {1}).",
     "", "Stop the program.", "5.15 5.61"),
    (20072, "E", "Refused: motors off",
     "The command is refused while the motors are off (command {1}).",
     "", "Switch the motors on.", "5.15 6.03"),
    (20074, "E", "Refused: guard stop",
     "The command is refused during a guard stop (command {1}).",
     "The motors-on circuit is open.", "Close it, and switch the motors on.", "5.15 6.03"),
    (20075, "E", "Refused: emergency stop",
     "The command is refused during an emergency stop (command {1}).",
     "", "Release and acknowledge the emergency stop, and switch the motors on.", "5.15"),
    (20133, "W", "Blocked signals in automatic mode",
     "Signals are blocked at a start in automatic mode.", "", "Unblock the signals.", "5.15"),
    (20139, "W", "Disabled tasks in automatic mode",
     "At least one NORMAL task is disabled at a start in automatic mode.",
     "", "Enable all tasks.", "6.03"),
    (20140, "W", "System input refused: motors on",
     "Motors on by a system input was refused ({1}).", "", "Look at the state of the robot.",
     "6.03"),
    (20148, "W", "System input refused: reset of the emergency stop",
     "The reset of an emergency stop by a system input was refused ({1}).",
     "The emergency stop button is still pressed.", "Release it first.", "5.15"),
    (20153, "W", "System input refused: motors on and start",
     "Motors on and start by a system input was refused ({1}).",
     "", "Look at the state of the robot.", "5.15"),
    (20202, "E", "Emergency stop open",
     "The robot was to be operated while the emergency stop circuit is open.",
     "", "Release and acknowledge the emergency stop.", "5.15 5.61 6.03"),
    (20205, "E", "Automatic stop open", "The circuit of the automatic mode stop is open.",
     "A door or a light curtain of the cell.", "Close it.", "5.61 6.03"),
    (20216, "E", "Enabling device in automatic mode",
     "The enabling device was pressed for more than 3 s in automatic mode.", "", "Release it.",
     "5.61"),
    (20240, "E", "Conflict of the enable signals",
     "Only one of the two enable chains was switched.", "", "Check the wiring.", "6.03"),
    (20293, "E", "System input is blocked by another",
     "{1} is blocked by {2} on signal {3}.", "The signal of a stop input is still active.",
     "Reset the signal.", "5.15"),
    (20312, "E", "Enable 2 open", "The second enable circuit of the axis computer is open.",
     "", "Check the wiring.", "6.03"),
    (37001, "E", "Motor contactor did not close",
     "Contactor {1} of drive module {2} did not follow its command.", "", "Check the contactors.",
     "5.15 5.61 6.03"),
    (37108, "E", "No communication with the power supply",
     "The computer lost its power supply's data.", "", "Check the cables.", "5.15"),
    (38104, "E", "Too fast in manual mode",
     "Joint {1} was faster than manual mode allows.", "The robot was jogged near a singularity.",
     "", "5.15"),
    (39505, "E", "Mains voltage lost", "Drive module {1} has no mains voltage.",
     "", "Check the supply.", "6.03"),
    (39520, "E", "No communication with a drive module",
     "The computer lost drive module {1}.", "The drive module is off, or a cable is loose.",
     "Check the cables.", "5.15 6.03"),
    (39526, "E", "Axis computer not found", "The axis computer of drive module {1} is missing.",
     "", "Check the cables.", "6.03"),
    (40165, "EW", "Unknown data", "Task {1}: {2} is not declared.",
     "A module that declares it is not loaded.", "Load the module, or correct the name.", "5.61"),
    (40168, "EW", "Unknown procedure", "Task {1}: procedure {2} is not declared.",
     "A module that declares it is not loaded.", "Load the module, or correct the name.", "5.61"),
    (40210, "W", "Interrupts removed",
     "Task {1}: interrupts that were waiting have been removed.", "A restart of the controller.",
     "", "5.15"),
    (40223, "E", "Execution stopped by an error", "Task {1} was stopped by a runtime error.",
     "The event before this one names it.", "Correct the error.", "5.15"),
    (40228, "E", "Execution stopped by an error",
     "Task {1} was stopped by runtime error {2}.", "", "Correct the error.", "5.61"),
    (40322, "E", "Load error: syntax", "Task {1}: {2} has syntax errors.", "",
     "Correct the module; `rapidgen check` lists its errors.", "5.61"),
    (40502, "W", "Dialog ended by a digital input",
     "Task {1}: a digital input ended the dialog at {2}.", "", "", "6.03"),
    (40706, "W", "Load error: already loaded", "Task {1}: {3} is already loaded, at {2}.",
     "", "Unload the module first, or handle ERR_LOADED.", "6.03"),
    (41449, "E", "Value error", "Task {1}: argument {2} has a value that is not allowed, at {3}.",
     "", "Check the value.", "5.15"),
    (41578, "E", "Socket error: connection failed",
     "Task {1}: SocketConnect failed at {2}.", "The address is wrong, or no server listens.",
     "Check address and port.", "5.15"),
    (41581, "W", "Socket error: time-out",
     "Task {1}: the instruction at {2} did not end in its time.", "The partner sent nothing.",
     "Give \\Time, or handle ERR_SOCK_TIMEOUT.", "5.15"),
    (41595, "W", "Socket error: closed by the partner",
     "Task {1}: the partner closed the connection, seen at {2}.", "",
     "Handle ERR_SOCK_CLOSED.", "5.15"),
    (41617, "W", "Too many texts for the operator",
     "TPWrite and similar instructions come too often; the program waits for them.",
     "", "Write less.", "6.03"),
    (41630, "W", "Unsafe synchronisation",
     "Task {1}: {2} is used by more than one synchronisation, at {5}.", "",
     "Use one variable for each synchronisation point.", "6.03"),
    (41739, "W", "StorePath is missing",
     "Task {1}: {2} in a trap or error handler without StorePath, at {4}.", "",
     "Call StorePath before the move, and RestoPath after it.", "5.15"),
    (50024, "W", "Corner path executed as a stop point",
     "Task {1}: the corner at {2} became a stop.",
     "The next move came too late, points are closer than their zones, or the computer is busy.",
     "Use smaller zones, larger distances, or \\Conc before slow instructions.", "5.15 6.03"),
    (50050, "E", "Position out of reach", "Axis {1} of {2} cannot reach the position.",
     "The target, its work object or its configuration is wrong.",
     "Correct the target; move the program pointer before the next start.", "5.61 6.03"),
    (50052, "E", "Joint speed error", "Joint {1} is not as fast as ordered.", "", "", "5.15"),
    (50056, "E", "Joint collision", "The torque of joint {1} is higher than ordered.",
     "A collision, or a defect.", "Look at the robot before it moves again.", "5.61"),
    (50204, "E", "Motion supervision", "Supervision of axis {1} of {2} tripped.",
     "A collision, or wrong load data.", "Look at the robot; check load and tool data.", "5.61"),
    (50240, "W", "Emergency stop changed", "The emergency stop used electric braking.",
     "", "", "5.61"),
    (50430, "E", "Underrun of the axis computer",
     "Drive module {1} received no data from the computer in time.", "", "", "6.03"),
    (71058, "E", "I/O device lost",
     "Device {1} with address {2} on {3} does not answer.", "", "Check cable and device.", "6.03"),
    (71156, "E", "Message queue is full", "Messages for a trap are lost: queue {1} is full.",
     "", "Read the queue faster, or enlarge it.", "5.15"),
    (71276, "I", "I/O device connected", "Device {1} with address {2} on {3} answers.",
     "", "", "6.03"),
    (71367, "E", "I/O device missing",
     "Device {1} with address {2} on {3} does not answer at start.", "",
     "Check cable and device.", "6.03"),
    (71391, "E", "System signal cannot be configured", "System signal {1} is not valid.",
     "", "Correct its configuration in EIO.cfg.", "6.03"),
    (71405, "W", "Signals share a mapping", "Signals {1} and {2} have the same mapping.",
     "", "Give each signal its own mapping.", "5.15 5.61"),
    (80003, "I", "Message of the program", "{1}: {2}", "ErrWrite of the program.", "", "6.03"),
    (100000, "E", "Internal error", "{1}", "", "Ask ABB if it comes again.", "5.15 5.61 6.03"),
    (120006, "E", "Configuration: name is used twice",
     "Line {1} of {2} has a name that is already used.", "", "Rename the instance.", "6.03"),
    (120014, "E", "Configuration file has errors",
     "Loading the configuration found errors.", "",
     "Look at the configuration events before this one.", "6.03"),
)  # fmt: skip

REMEMBERED: Final = "remembered; no log or document at hand"
_GITHUB_41438: Final = "ros-industrial/abb_libegm, issue 73"
_OTHERS: Final[tuple[tuple[int, str, str, str, str, str, str], ...]] = (
    # Number, types, title, text, usual causes, remedy, source.
    (10067, "W", "Program pointer cannot be moved to main", "Task {2}: PP to main was refused.",
     "The program has errors (40160).", "Correct the modules.", "a real controller with 6.03"),
    (10122, "I", "Program stopped: Stop", "Task {2} executed Stop or Break.", "", "", REMEMBERED),
    (40160, "E", "Errors in the program", "Task {1}: the program has errors.",
     "A name that is not declared, or a PERS that two modules declare.",
     "`rapidgen check` lists them.", "a real controller with 6.03, a virtual one with 6.15"),
    (41438, "E", "Undefined load", "Task {1}: {2}.", "A load without mass.",
     "Set mass and centre of gravity of tool and payload.", _GITHUB_41438),
    (41822, "E", "EGM: no data", "Task {1}: no data came from {2}.",
     "The partner does not send, or to another port.", "Check the address of the UdpUc device.",
     "forum and issue reports of EGM users"),
    (41826, "E", "EGM: mode mismatch", "Task {1}: {2}.",
     "EGMSetup and EGMAct or EGMRun are of different kinds.", "Use matching instructions.",
     "forum and issue reports of EGM users"),
    (41830, "E", "EGM: message not sent", "Task {1}: {2}.",
     "Nothing listens at the address of the UdpUc device, or the unit cannot be guided.",
     "Start the partner first; guide a robot with a TCP.", "a GoFa with 7.20"),
    (50026, "E", "Close to singularity", "{1}: an axis would have to turn at once.",
     "The path passes a wrist or shoulder singularity.",
     "Move the path, use MoveJ, or SingArea \\Wrist.", REMEMBERED),
    (50027, "E", "Joint out of range", "{1}.", "A target outside an axis range.",
     "Move the joint back, or correct the target.", REMEMBERED),
    (50453, "E", "Move not allowed", "{1}: {2}.",
     "A move between EGMRun with NoWaitCond and EGMWaitCond.", "Wait for the end of the run.",
     "ros-industrial/abb_libegm, issue 110"),
    (50063, "E", "Circle uncertain", "{1}: the points make no circle.",
     "Circle point and end are too close, or the arc is longer than 240 degrees.",
     "Move the circle point, or use two MoveC.", REMEMBERED),
    (50080, "E", "Position not compatible", "{1}: the path ends in another configuration.",
     "confdata of the target does not fit the path.", "Correct confdata, or use ConfL \\Off.",
     REMEMBERED),
    (50323, "E", "Force sensor not calibrated", "{1}.", "FCCalib was not executed.",
     "Execute FCCalib first.", REMEMBERED),
    (80001, "E", "Message of the program", "{1}", "ErrWrite of the program.", "", REMEMBERED),
    (80002, "W", "Message of the program", "{1}", "ErrWrite \\W of the program.", "", REMEMBERED),
    (120003, "E", "Configuration file not loaded", "{1}", "The header belongs to another release.",
     "Give the file the controller's header.", "a real controller with 6.03"),
)  # fmt: skip
_OWN: Final[tuple[tuple[int, str, str, str], ...]] = (
    # Number, types, title, text.
    (191910, "I", "Inferred input", "{1} becomes {2}."),
    (191911, "W", "Gripped part out of reach", "{1}"),
    (192095, "E", "Start refused: system failure", "{1}"),
    (192096, "E", "Start refused: off the path", "{1}"),
    (192097, "E", "Start refused", "{1}"),
    (192140, "E", "Power failure", "Power was lost and came back."),
    (192800, "W", "Recording ended", "{1}"),
    (194001, "E", "Statement cannot be executed", "{1}"),
    (194027, "E", "Stack overflow", "Routines call each other too deeply."),
    (194165, "E", "Module not loaded", "{1}"),
    (194199, "EW", "RAPID error", "Task {1}: {3} at {2}."),
    (194214, "E", "Interrupt or alias refused", "{1}"),
    (194224, "E", "Too many interrupts wait", "{1}"),
    (194303, "E", "IPers takes a whole persistent", "{1}"),
    (194304, "E", "GetTrapData outside a trap", "{1}"),
    (194305, "E", "No error in the trap data", "{1}"),
    (194659, "E", "Format missing", "{1}"),
    (194660, "E", "Data to send or receive missing", "{1}"),
    (194661, "E", "GetTime needs a part", "{1}"),
    (194662, "E", "GetSysInfo needs a part", "{1}"),
    (194663, "E", "Text table not installed", "{1}"),
    (194800, "E", "SystemStopAction", "{1}"),
    (194900, "E", "No mechanical unit", "{1}"),
    (194901, "E", "Not a motion task", "{1}"),
    (194902, "E", "Not allowed", "{1}"),
    (194904, "E", "Tool and work object contradict", "{1}"),
    (194905, "EI", "Not simulated", "{1}"),
    (194906, "E", "Search without hit", "{1}"),
    (194907, "E", "World zone reached", "{1}"),
    (194910, "E", "Synchronised movement refused", "{1}"),
    (194911, "E", "Robot is guided", "{1}"),
    (194915, "W", "EGM before the first Move instruction since the start", "{1}"),
    (194912, "W", "Datagram of the EGM partner rejected", "{1}"),
    (194914, "W", "EGM needs the real clock at speed 1", "{1} gets no datagrams."),
    (194913, "E", "EGM input out of bounds", "{1}"),
    (195900, "E", "No geometry", "{1}"),
    (195901, "W", "Programmed time not met", "{1}"),
    (195902, "W", "Load above the payload", "{1}"),
    (197100, "E", "Cross connection refused", "{1}: it closes a loop."),
    (197101, "W", "System output not simulated", "{1} on signal {2}."),
    (197102, "E", "Signal not defined", "{1} names {2}."),
    (197103, "W", "System input not simulated", "{1} with argument '{2}'."),
)
_OWN_SOURCE: Final = "rapidgen's virtual controller; the number of a real controller is not known"

KINDS: Final[Mapping[int, EventKind]] = {
    kind.code: kind
    for kind in (
        *(EventKind(*row[:6], tuple(row[6].split())) for row in _FROM_LOGS),
        *(EventKind(*row[:6], source=row[6]) for row in _OTHERS),
        *(EventKind(*row, source=_OWN_SOURCE) for row in _OWN),
    )
}
"""Every number that the table knows."""
OUT_OF_REACH: Final = 50_050
RAPID_ERROR: Final = 194_199
ERROR_CODES: Final[Mapping[str, int]] = {
    "ERR_REFUNKDAT": 40165,
    "ERR_REFUNKPRC": 40168,
    "ERR_TP_DIBREAK": 40502,
    "ERR_LOADED": 40706,
    "ERR_SOCK_TIMEOUT": 41581,
    "ERR_SOCK_CLOSED": 41595,
}
"""Event of an error of RAPID, where logs show it; `RAPID_ERROR` for all others."""
