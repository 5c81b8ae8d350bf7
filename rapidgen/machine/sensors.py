"""Cameras and force sensors."""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rapidgen.machine.scheduler import WaitSet

# -- Cameras ---------------------------------------------------------------------------------------
#
# Cameras of integrated vision, as far as a file describes their results; no picture is processed.
#
# Each requested image is the next one of the description; after the last follows the first. A
# result is that of the camera's job.


@dataclass(frozen=True, slots=True)
class Seen:
    """A result: position (mm) and rotation about z (deg) in the camera's frame.

    The other values are those of the job.
    """

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
    """A camera; `images` None: no description."""

    name: str
    images: Sequence[Sequence[Seen]] | None = None
    parameters: dict[str, float] = field(default_factory=dict)
    """Numbers by lower-case name; programs write them, too."""
    is_guess: bool = False
    """True if undescribed parameters are 0."""
    running: bool = True
    """Run mode; in program mode jobs and parameters are changed."""
    job: str = ""
    changed: WaitSet = field(default_factory=WaitSet)
    results: deque[tuple[int, Seen]] = field(default_factory=deque)
    """Not fetched yet: scene, and what is in it."""
    taken: int = 0
    """Images so far."""
    under_way: int = 0
    """Requested images that have not arrived."""

    def look(self, scene: int, *, keep: bool) -> None:
        """Add the results of the next image for `scene`.

        Earlier results are discarded unless `keep`.
        """
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
    """Return configured and described cameras by lower-case name."""
    return {name.lower(): (described or {}).get(name.lower(), Camera(name)) for name in names}


# -- Force sensors ---------------------------------------------------------------------------------
#
# Force sensors at robots' hands, as far as a file describes their readings; no contact is
# simulated.
#
# Readings come in turn, and the last one stays. They exclude the load of the tool, which FCCalib
# requires.


Reading = tuple[float, ...]
"""Force x, y, z (N), torque about x, y, z (Nm)."""


@dataclass(frozen=True, slots=True)
class Measured:
    """The description of a sensor; `readings` None: no description."""

    readings: Sequence[Reading] | None = None
    mass: float = 0.0
    """Mass of the load at the hand, kg."""
    center: tuple[float, ...] = (0.0, 0.0, 0.0)
    """Where its centre is, mm."""


@dataclass(slots=True)
class ForceSensor:
    """The sensor of one robot."""

    measured: Measured
    calibrated: bool = False
    controls: bool = False
    """True if force control is active."""
    pressing: bool = False
    """True on a path with a process force."""
    taken: int = 0

    def read(self) -> Reading:
        """Return the next reading."""
        rows = self.measured.readings or ()
        result = rows[min(self.taken, len(rows) - 1)]
        self.taken += 1
        return result


@dataclass(slots=True)
class ForceSensors:
    """A sensor for each robot, all with the same description."""

    measured: Measured = field(default_factory=Measured)
    by_group: dict[str, ForceSensor] = field(default_factory=dict)

    def of(self, group: str) -> ForceSensor:
        """Return the sensor of a motion group."""
        return self.by_group.setdefault(group, ForceSensor(self.measured))
