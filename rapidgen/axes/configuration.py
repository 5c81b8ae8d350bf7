"""Configuration data of robtargets: one rule for each family of arms, and its evidence.

`configuration_data` is the one source of cf1, cf4, cf6, cfx and the arm angle for everything that
writes robtargets. The rule is `Kinematics.configuration`, which ConfJ, ConfL, CalcRobT and CRobT of
the virtual controller use too:

- cf1, cf4, cf6: the quarter turn of the axis, 0 from 0 to 90 degrees, -1 from -90 to 0, as often as
  the axis turns (S4 datasys 1-confdata). With seven axes the quarters are centred on their multiple
  of 90 degrees. A sliding axis counts metres.
- cfx: 4 wrist centre on the rear side of axis 1, 2 elbow turned over, 1 axis 5 negative. Arms whose
  lower arm is moved by a parallel rod cannot turn over and have 0.
- Palletisers have no axis 4 and SCARA robots no axis 6: the quarter of a missing axis is 0. Both
  have cfx 0, although a SCARA's arm reaches a place from two sides.

`FAMILIES` says how far public programs confirm the rule (`tools/configuration_pairs.py`). Without
evidence a robtarget may name another posture on the real controller: exported programs then begin
with MoveAbsJ and say so.
"""

from dataclasses import dataclass
from math import degrees

from rapidgen.axes.kinematics import ArmKind, AxisConfiguration, Kinematics, Posture


@dataclass(frozen=True, slots=True)
class ArmFamily:
    """A family of arms with one rule of configuration data."""

    name: ArmKind
    arms: str
    """Examples, for messages."""
    has_evidence: bool
    """True if at least 200 public pairs confirm the rule."""
    pairs: int
    """Public pairs that were compared."""
    agree: int
    """Pairs whose stored data are those of the rule."""
    source: str
    """Manual or public programs that give the rule."""


@dataclass(frozen=True, slots=True)
class TargetData:
    """Everything of a robtarget but its pose, in RAPID's units."""

    configuration: AxisConfiguration
    external: tuple[float, ...]
    """extax: deg or mm of eax_a to eax_f, 9E9 if not connected. With seven axes eax_a is the arm
    angle."""
    has_evidence: bool


FAMILIES = (
    ArmFamily(
        "serial",
        "IRB 120, IRB 4600, IRB 6640",
        has_evidence=True,
        pairs=466,
        agree=382,
        source="19 public backups; 82 more pass the controller's check, 2 differ",
    ),
    ArmFamily(
        "parallel rod",
        "IRB 1400, IRB 2400, IRB 4400",
        has_evidence=False,
        pairs=34,
        agree=34,
        source="S4 datasys 1-confdata; one public backup of an IRB 6660",
    ),
    ArmFamily(
        "seven axes",
        "IRB 14000, IRB 14050",
        has_evidence=False,
        pairs=60,
        agree=51,
        source="five public programs in wobj0; others store cfx 11, which no source explains",
    ),
    ArmFamily(
        "palletiser",
        "IRB 460, IRB 660",
        has_evidence=False,
        pairs=0,
        agree=0,
        source="S4 datasys 1-confdata, for IRB 540 and 640: cf6 only",
    ),
    ArmFamily("SCARA", "IRB 910SC", has_evidence=False, pairs=0, agree=0, source="none"),
    ArmFamily("other", "IRB 5400", has_evidence=False, pairs=0, agree=0, source="none"),
)


def family_of(kinematics: Kinematics) -> ArmFamily:
    """Return the family of an arm."""
    return next(family for family in FAMILIES if family.name == kinematics.kind)


def configuration_data(kinematics: Kinematics, posture: Posture) -> TargetData:
    """Return configuration, external axes and arm angle of a robtarget for a posture.

    `posture`: controller axis values in wire order, rad and m.
    """
    external = list(kinematics.map.to_rapid(posture)[1])
    if kinematics.seventh >= 0:
        external[0] = degrees(kinematics.arm.arm_angle(posture))
    return TargetData(
        kinematics.configuration(posture), tuple(external), family_of(kinematics).has_evidence
    )
