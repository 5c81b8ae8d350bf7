"""The cfg of a delivered controller, as far as a driver's cfg needs it.

Written as controllers write it, each line with the backups and files that show it. The cell gives
the names of motion tasks and mechanical units.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rapidgen.system.base.releases import DOMAINS, Domain, header_digits
from rapidgen.system.cfg import parse_cfg
from rapidgen.system.controller_cfg import ControllerCfg


@dataclass(frozen=True, slots=True)
class Robot:
    """A motion task with its robot and additional mechanical units."""

    task: str
    unit: str
    external: tuple[str, ...] = ()
    group: str = ""
    """Name of its mechanical unit group, if not derived from the unit's."""


# RW 5.15-6.13 without 604-1: the motion task has these three and nothing more (PANIN, PAULA,
# KRAKER, JOSE, TETOV, FABIO, EDGAR, KEEN); RW 7.5.2 and 7.6.1 write the same.
_TASK = '-Name "{task}" -Type "NORMAL" -MotionTask'
# With 604-1 every task names its group (MCUBE 5.61/6.03, EBRUUN 6.04/6.06, HONG 6.06).
_GROUPED_TASK = '-Name "{task}" -Type "NORMAL" -UseMechanicalUnitGroup "{group}" -MotionTask'
# MCUBE: group, robot, planner; EBRUUN: a track as MechanicalUnit_1; HONG: ROB_R_7, ROB_L_7.
_GROUP = '-Name "{group}" -Robot "{unit}" {units} -UseMotionPlanner "motion_planner_{n}"'
# All backups 5.15-7.6.
_MISC = """
      -Name "NoOfRetry" -Value 4
      -Name "SimulateMenu" -Value 1
      -Name "ModalPayLoadMode" -Value 1
"""
# All backups name six planners and more, whatever they use.
_PLANNERS = "\n".join(f'      -name "motion_planner_{n}"' for n in range(1, 7))
# RW 7.5.2, 7.6.1: services of the firewall are instances of a delivered controller. The name alone
# means closed; a configured GoFa has some of them open.
_FIREWALL = """
FIREWALL_MANAGEMENT:
      -Name "RapidSockets"
      -Name "RobotWebServices" -EnableOnPrivateNet
      -Name "UDPUC"
"""
# HONG: of a YuMi the right arm has planner 1, the left one 2.
_PLANNER_ORDER = ("rob_r", "rob_l")


def base_system(
    robotware: tuple[int, int],
    robots: Sequence[Robot],
    *,
    multimove: bool = False,
    digits: Mapping[str, tuple[int, int]] | None = None,
) -> ControllerCfg:
    """Return the cfg of a delivered controller with these robots.

    Two robots and more mean MultiMove (604-1); `multimove` means so for one robot. `digits` are the
    header digits of domains where they are known better than from the release.
    """
    arms = {robot.unit.casefold(): robot for robot in robots}
    yumi = arms.keys() == set(_PLANNER_ORDER)
    grouped = multimove or len(robots) > 1
    rows: list[str] = []
    groups: list[str] = []
    units: list[str] = []
    ordered = [arms[unit] for unit in _PLANNER_ORDER] if yumi else list(robots)
    for n, robot in enumerate(ordered, 1):
        # HONG: the seventh axis of an arm is a mechanical unit of the arm's group.
        further = (f"{robot.unit}_7", *robot.external) if yumi else robot.external
        group = robot.group or unit_group(robot.unit)
        rows.append((_GROUPED_TASK if grouped else _TASK).format(task=robot.task, group=group))
        named = " ".join(f'-MechanicalUnit_{i} "{unit}"' for i, unit in enumerate(further, 1))
        groups.append(_GROUP.format(group=group, unit=robot.unit, units=named, n=n))
        units += further
    sys = f"CAB_TASKS:\n{_lines(rows)}\nSYS_MISC:{_MISC}"
    if grouped:
        sys += f"MECHANICAL_UNIT_GROUP:\n{_lines(groups)}\n"
    texts: dict[Domain, str] = {
        "SYS": sys,
        "SIO": _FIREWALL if robotware[0] >= 7 else "",
        "MOC": f"MOTION_PLANNER:\n{_PLANNERS}\n{_mechanics(ordered, units)}",
    }
    return ControllerCfg(
        robotware,
        tuple(
            parse_cfg(
                _header(domain, (digits or {}).get(domain) or header_digits(robotware, domain))
                + texts.get(domain, ""),
                path=f"{domain} of a delivered controller",
            )
            for domain in DOMAINS
        ),
    )


def unit_group(unit: str) -> str:
    """Return the name of a robot's mechanical unit group.

    rob1 of ROB_1 (MCUBE), rob_r of ROB_R (HONG).
    """
    head, _, tail = unit.lower().partition("_")
    return head + tail if tail.isdigit() else f"{head}_{tail}".rstrip("_")


def _mechanics(robots: Sequence[Robot], units: Sequence[str]) -> str:
    """Return ROBOT and SINGLE, which name the mechanical units.

    All backups; tracks: EBRUUN; YuMi: HONG.
    """
    named = "ROBOT:\n" + _lines([f'-name "{robot.unit}"' for robot in robots])
    if units:
        named += "\nSINGLE:\n" + _lines([f'-name "{unit}"' for unit in units])
    return named + "\n"


def _lines(rows: Sequence[str]) -> str:
    return "\n".join(f"      {row}" for row in rows)


def _header(domain: str, digits: tuple[int, int]) -> str:
    return f"{domain}:CFG_1.0:{digits[0]}:{digits[1]}::\n"
