"""Cameras and force sensors."""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rapidgen.machine.scheduler import WaitSet

# -- Cameras ---------------------------------------------------------------------------------------
#
# Cameras of integrated vision, as far as a file tells what they see: no picture is looked at.
#
# Each image that a program asks for is the next one of the description, and behind the last the
# first again. A result is what the camera's job would have found.


@dataclass(frozen=True, slots=True)
class Seen:
    """One result: place in the camera's frame (mm), turn about its z (deg), and what a job adds."""

    name: str = ""
    place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    angle: float = 0.0
    type: float = 0.0
    values: tuple[float, ...] = ()
    """Up to five."""
    texts: tuple[str, ...] = ()
    """Up to two."""


@dataclass(slots=True)
class Camera:
    """A camera; `images` None: nothing tells what it sees."""

    name: str
    images: Sequence[Sequence[Seen]] | None = None
    parameters: dict[str, float] = field(default_factory=dict)
    """Numbers by lower-case name; programs write them, too."""
    is_guess: bool = False
    """Whether parameters that nobody described are 0."""
    running: bool = True
    """Run mode; in program mode jobs and parameters are changed."""
    job: str = ""
    changed: WaitSet = field(default_factory=WaitSet)
    results: deque[tuple[int, Seen]] = field(default_factory=deque)
    """Not fetched yet: scene, and what is in it."""
    taken: int = 0
    """Images so far."""
    under_way: int = 0
    """Images that were asked for and are not there yet."""

    def look(self, scene: int, *, keep: bool) -> None:
        """The next image is there: its results are those of `scene`, before which others go
        unless they are kept."""
        if not keep:
            self.results.clear()
        result = self.images[self.taken % len(self.images)] if self.images else ()
        self.results.extend((scene, seen) for seen in result)
        self.taken += 1
        self.under_way -= 1
        self.changed.notify()


def cameras(
    names: Sequence[str], described: Mapping[str, Camera] | None = None
) -> dict[str, Camera]:
    """By lower-case name: those of a configuration, and those that are described."""
    return {name.lower(): (described or {}).get(name.lower(), Camera(name)) for name in names}


# -- Force sensors ---------------------------------------------------------------------------------
#
# Force sensors at robots' hands, as far as a file tells what they measure: nothing is touched.
#
# Readings come in turn, and the last one stays. They are what is left when the load of the tool is
# taken off, which has to be told first (FCCalib).


Reading = tuple[float, ...]
"""Force x, y, z (N), torque about x, y, z (Nm)."""


@dataclass(frozen=True, slots=True)
class Measured:
    """What is told of a sensor; `readings` None: nothing is."""

    readings: Sequence[Reading] | None = None
    mass: float = 0.0
    """Of the load that is found at the hand, kg."""
    center: tuple[float, ...] = (0.0, 0.0, 0.0)
    """Where its centre is, mm."""


@dataclass(slots=True)
class ForceSensor:
    """The sensor of one robot."""

    measured: Measured
    calibrated: bool = False
    controls: bool = False
    """Whether force control is active."""
    pressing: bool = False
    """Whether it is on a path with a process force."""
    taken: int = 0

    def read(self) -> Reading:
        """The next reading."""
        rows = self.measured.readings or ()
        result = rows[min(self.taken, len(rows) - 1)]
        self.taken += 1
        return result


@dataclass(slots=True)
class ForceSensors:
    """One for each robot, all with the same description."""

    measured: Measured = field(default_factory=Measured)
    by_group: dict[str, ForceSensor] = field(default_factory=dict)

    def of(self, group: str) -> ForceSensor:
        """That of a motion group."""
        return self.by_group.setdefault(group, ForceSensor(self.measured))
