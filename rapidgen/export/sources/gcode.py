"""G-code: lines and arcs of RS274 (LinuxCNC's and ISO 6983's common part) as toolpaths.

The interpreter knows the words of `_NO_EFFECT` and those of the tables below; every other word
stops the conversion with its line, because leaving one out could move the robot elsewhere. S and M
words mean what the user says (`words`), also if that is nothing.

Rules, with their source in RS274/NGC [NIST IR 6556 §3]:

- One block is executed in this order: F, S, M, plane, unit, work offset, distance mode, dwell,
  motion, end [§3.8].
- F is in units of length per minute and applies to G1, G2 and G3 [§3.5.4].
- An arc in the plane of G17, G18 or G19 turns clockwise (G2) or counter-clockwise (G3) as seen from
  the positive end of the third axis. Centres I, J, K are relative to its beginning, unless G90.1
  [§3.5.3]. With R, a negative radius selects the arc of more than 180 degrees.
- A position is unknown until the program has given all three coordinates: moves by G1, G2, G3 and
  relative ones are rejected before.

An arc becomes arcs of at most 120 degrees, which MoveC takes; helices and very short or flat arcs
become lines that deviate by at most 0.02 mm.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from math import acos, atan2, ceil, cos, hypot, pi, radians, sin, sqrt
from pathlib import Path
from typing import Literal

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose, Quaternion, Vector
from rapidgen.diagnostics import DiagnosticError, Span, error, refusal
from rapidgen.export.sources.toolpath import (
    PathStep,
    SourceOptions,
    Toolpath,
    WordAction,
    checked_steps,
    fixed_orientation,
    read_text,
    reject,
)

_WORD = re.compile(r"\s*([A-Za-z])\s*([-+]?(?:\d+\.?\d*|\.\d+))", re.ASCII)
_COMMENT = re.compile(r"\([^()]*\)|;.*")
_NO_EFFECT = frozenset(("G40", "G49", "G94", "G64", "G61"))
"""Cancellations and modes of a machine that change no path here."""
_MOTIONS = {"G0": "rapid", "G1": "line", "G2": "clockwise", "G3": "counter-clockwise"}
_PLANES = {"G17": (0, 1, 2), "G18": (2, 0, 1), "G19": (1, 2, 0)}
"""First, second and third axis of a plane, right-handed."""
_UNITS = {"G20": 0.0254, "G21": 0.001}
_OFFSETS = tuple(f"G{n}" for n in range(54, 60))
_ENDS = frozenset(("M2", "M30"))
_CENTRES = "IJK"
_PART = 2 * pi / 3
"""Largest arc of one MoveC, rad."""
_CHORD = 20e-6
"""Largest distance of the lines of a helix from it, m."""
_SHORT, _FLAT = 0.3e-3, radians(5)
"""Arcs that are shorter (m) or flatter become lines: the points of MoveC are at least 0.1 mm apart,
and 1 degree as seen from the first one, which is a quarter of the arc."""
_RADIUS = 20e-6, 0.001
"""Tolerance of an arc's two radii: m, and share of the radius."""


@dataclass(frozen=True, slots=True)
class _Block:
    """Words of one line, as (letter, number, spelling), and its place."""

    words: tuple[tuple[str, float, str], ...]
    span: Span


def read_gcode(path: Path, options: SourceOptions) -> Toolpath:
    """Read a program. Raises DiagnosticError: RG760, RG761, RG762 for an unsupported word."""
    interpreter = _Interpreter(str(path), options)
    for block in _blocks(read_text(path), str(path)):
        interpreter.execute(block)
        if interpreter.ended:
            break
    reject(checked_steps(interpreter.steps, str(path)))
    return Toolpath(tuple(interpreter.steps), ignored=tuple(interpreter.ignored))


def _blocks(text: str, path: str) -> Iterator[_Block]:
    for number, line in enumerate(text.splitlines(), 1):
        bare = _COMMENT.sub(" ", line).strip()
        if not bare or bare == "%":
            continue
        words = []
        at = 0
        while at < len(bare):
            match = _WORD.match(bare, at)
            if match is None:
                raise _unsupported(bare[at:].split()[0], Span(path, number, 1))
            letter, value = match[1].upper(), float(match[2])
            words.append((letter, value, _spelling(letter, value)))
            at = match.end()
            while at < len(bare) and bare[at].isspace():
                at += 1
        yield _Block(tuple(words), Span(path, number, 1, number, len(line) + 1))


def _spelling(letter: str, value: float) -> str:
    """Return a word in its shortest spelling: G01 is G1."""
    return f"{letter}{value:g}"


def _unsupported(word: str, span: Span) -> DiagnosticError:
    return refusal(
        "RG762",
        span,
        f"'{word}' is not supported",
        "remove it, or say what it means: --word M3=signal:spindle:1, M6=call:change_tool, "
        "T=ignore",
    )


class _Interpreter:
    """State of a program: modes, position, and the steps so far."""

    def __init__(self, path: str, options: SourceOptions) -> None:
        self.path, self.options = path, options
        self.steps: list[PathStep] = []
        self.ignored: list[str] = []
        self.ended = False
        self._motion: str = ""
        self._plane = _PLANES["G17"]
        self._unit = options.length
        self._absolute = True
        self._absolute_centres = False
        self._offset: Vector = options.offsets.get("G54", (0.0, 0.0, 0.0))
        self._feed = 0.0
        self._place: list[float | None] = [None, None, None]
        """Programmed position in m, in the current work offset."""
        self._orientation: Quaternion = fixed_orientation(options, path)

    def execute(self, block: _Block) -> None:
        """Execute one block. Raises DiagnosticError."""
        span = block.span
        axes: dict[str, float] = {}
        arc: dict[str, float] = {}
        dwell: float | None = None
        pauses = has_motion = False
        codes: list[str] = []
        actions: list[tuple[WordAction, float]] = []
        for letter, value, word in block.words:
            action = self.options.words.get(word) or self.options.words.get(letter)
            if letter == "N":
                continue
            if action is not None and letter not in "GXYZIJKRF":
                actions.append((action, value))
                if action.kind == "ignore":
                    self.ignored.append(word)
            elif letter in "XYZ":
                axes[letter] = value
            elif letter in "IJKR":
                arc[letter] = value
            elif letter == "F":
                self._feed = value
            elif letter == "P":
                dwell = value
            elif letter == "G" and self._is_known(word):
                codes.append(word)
            elif letter == "M" and word in _ENDS:
                self.ended = True
            else:
                raise _unsupported(word, span)
        for code in codes:
            if code == "G4":
                pauses = True
            elif code in _MOTIONS:
                if has_motion:
                    raise self._bad(span, "two motions in one block", "one in each line")
                self._motion, has_motion = code, True
            else:
                self._set_mode(code, span)
        for action, value in actions:
            self._act(action, value, span)
        if pauses:
            if dwell is None or dwell < 0:
                raise self._bad(span, "G4 without a time", "G4 P0.5: seconds")
            self.steps.append(PathStep("wait", span, value=dwell))
        elif dwell is not None:
            raise _unsupported(f"P{dwell:g}", span)
        if axes or (arc and self._motion in ("G2", "G3")):
            self._move(axes, arc, span)
        elif arc:
            raise _unsupported("".join(arc), span)

    def _is_known(self, word: str) -> bool:
        modes = ("G90", "G91", "G90.1", "G91.1", "G4", "G80")
        return (
            word in _MOTIONS
            or word in _PLANES
            or word in _UNITS
            or word in _OFFSETS
            or word in modes
            or word in _NO_EFFECT
        )

    def _set_mode(self, code: str, span: Span) -> None:
        if code in _PLANES:
            self._plane = _PLANES[code]
        elif code in _UNITS:
            self._unit = _UNITS[code]
        elif code in _OFFSETS:
            offset = self.options.offsets.get(code)
            if offset is None and code != "G54":
                raise refusal(
                    "RG761",
                    span,
                    f"the work offset of {code} is not given",
                    f"--offset {code}=0,0,0",
                )
            new = offset or (0.0, 0.0, 0.0)
            # The machine stays where it is: its coordinates change.
            self._place = [
                None if at is None else at + old - now
                for at, old, now in zip(self._place, self._offset, new, strict=True)
            ]
            self._offset = new
        elif code == "G80":
            self._motion = ""
        elif code in ("G90", "G91"):
            self._absolute = code == "G90"
        elif code in ("G90.1", "G91.1"):
            self._absolute_centres = code == "G90.1"

    def _act(self, action: WordAction, value: float, span: Span) -> None:
        if action.kind == "signal":
            level = value if action.value is None else action.value
            self.steps.append(PathStep("set", span, name=action.target, value=level))
        elif action.kind == "call":
            self.steps.append(PathStep("call", span, name=action.target))

    def _bad(self, span: Span, message: str, help: str = "") -> DiagnosticError:
        return DiagnosticError(error("RG760", span, message, help))

    # -- motions ----------------------------------------------------------------------------------

    def _move(self, axes: dict[str, float], arc: dict[str, float], span: Span) -> None:
        if not self._motion:
            raise self._bad(span, "coordinates without a motion", "begin with G0 or G1")
        if self._unit is None:
            raise refusal("RG761", span, "the unit of lengths is not given", "G21, or --units mm")
        begin = list(self._place)
        goal = list(self._place)
        for number, letter in enumerate("XYZ"):
            if letter in axes:
                value = axes[letter] * self._unit
                current = begin[number]
                if self._absolute:
                    goal[number] = value
                elif current is None:
                    raise self._bad(span, f"{letter} is relative to an unknown position", "G90")
                else:
                    goal[number] = current + value
        self._place = goal
        cutting = self._motion != "G0"
        if cutting and None in begin:
            raise self._bad(
                span, f"{self._motion} begins at an unknown position", "begin with G0 X.. Y.. Z.."
            )
        if None in goal:
            return
        end = _known(goal)
        if cutting and self._feed <= 0:
            raise self._bad(span, f"{self._motion} without a feed", "F, in units per minute")
        speed = self._feed * self._unit / 60 if cutting else self.options.rapid
        if arc and self._motion not in ("G2", "G3"):
            raise _unsupported("".join(arc), span)
        if self._motion in ("G2", "G3"):
            self._arc(_known(begin), end, arc, speed, span)
        elif goal != begin:
            self._line(end, speed, span)

    def _line(self, end: Vector, speed: float, span: Span) -> None:
        self.steps.append(PathStep("line", span, pose=self._pose(end), speed=speed))

    def _pose(self, place: Vector) -> Pose:
        x, y, z = (a + b for a, b in zip(place, self._offset, strict=True))
        return frames.compose(self.options.origin, ((x, y, z), self._orientation))

    def _arc(
        self, begin: Vector, end: Vector, arc: dict[str, float], speed: float, span: Span
    ) -> None:
        first, second, third = self._plane
        a, b = begin[first], begin[second]
        u, v = end[first] - a, end[second] - b
        sense: Literal[-1, 1] = -1 if self._motion == "G2" else 1
        centre = self._by_radius(u, v, arc["R"], sense, span) if "R" in arc else None
        if centre is None:
            centre = self._by_centre(begin, arc, span)
        radius = hypot(*centre)
        last = hypot(u - centre[0], v - centre[1])
        if radius == 0 or abs(radius - last) > max(_RADIUS[0], _RADIUS[1] * radius):
            raise self._bad(
                span,
                f"no arc: radius {1000 * radius:.4g} mm at its beginning, {1000 * last:.4g} mm at "
                "its end",
                "check I, J, K and the plane (G17, G18, G19)",
            )
        start = atan2(-centre[1], -centre[0])
        sweep = sense * (atan2(v - centre[1], u - centre[0]) - start) % (2 * pi)
        if sweep < 1e-9:
            sweep = 2 * pi
        rise = end[third] - begin[third]
        count = ceil(sweep / _PART)
        part = sweep / count
        is_round = abs(rise) <= 1e-9 and part >= _FLAT and radius * part > _SHORT
        if not is_round:
            step = 2 * acos(1 - _CHORD / radius) if radius > _CHORD else pi / 2
            count = max(1, ceil(sweep / step))

        def place(share: float) -> Vector:
            angle = start + sense * sweep * share
            result = [0.0, 0.0, 0.0]
            result[first] = a + centre[0] + radius * cos(angle)
            result[second] = b + centre[1] + radius * sin(angle)
            result[third] = begin[third] + rise * share
            return result[0], result[1], result[2]

        for number in range(1, count + 1):
            # The last point is the programmed one.
            goal = end if number == count else place(number / count)
            if is_round:
                via = self._pose(place((number - 0.5) / count))
                step_pose = self._pose(goal)
                self.steps.append(PathStep("arc", span, pose=step_pose, via=via, speed=speed))
            else:
                self._line(goal, speed, span)

    def _by_centre(self, begin: Vector, arc: dict[str, float], span: Span) -> tuple[float, float]:
        """Return the centre of an arc relative to its beginning, in the plane, m."""
        first, second, third = self._plane
        assert self._unit is not None, "checked by _move"
        if _CENTRES[third] in arc or not {_CENTRES[first], _CENTRES[second]} & set(arc):
            raise self._bad(
                span,
                "an arc without a centre in its plane",
                f"{_CENTRES[first]} and {_CENTRES[second]}, or R",
            )
        values = []
        for axis in (first, second):
            value = arc.get(_CENTRES[axis])
            if self._absolute_centres:
                if value is None:
                    raise self._bad(span, f"{_CENTRES[axis]} is missing", "both with G90.1")
                values.append(value * self._unit - begin[axis])
            else:
                values.append((value or 0.0) * self._unit)
        return values[0], values[1]

    def _by_radius(
        self, u: float, v: float, given: float, sense: int, span: Span
    ) -> tuple[float, float]:
        """Return the centre of an arc given by its radius."""
        assert self._unit is not None, "checked by _move"
        radius, chord = abs(given) * self._unit, hypot(u, v)
        if chord == 0:
            raise self._bad(span, "a full circle has no radius word", "its centre: I, J or K")
        if radius < chord / 2 * (1 - _RADIUS[1]):
            raise self._bad(span, "the radius is smaller than half of the distance", "a larger R")
        height = sqrt(max(0.0, radius * radius - chord * chord / 4))
        # The centre is left of the chord for a short counter-clockwise arc.
        side = sense * (1 if given > 0 else -1)
        return u / 2 - side * height * v / chord, v / 2 + side * height * u / chord


def _known(place: list[float | None]) -> Vector:
    x, y, z = (value for value in place if value is not None)
    return x, y, z
