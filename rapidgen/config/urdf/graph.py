"""Joint tree of a description, and its structural errors."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from rapidgen.config.urdf.robot import UrdfJoint, UrdfRobot
from rapidgen.diagnostics import Diagnostic, Severity, Span, error, suggest


@dataclass(frozen=True, slots=True)
class Graph:
    """A checked tree: at most one joint above each link."""

    robot: UrdfRobot
    above: dict[str, UrdfJoint]
    """link: its parent joint"""

    def path_to(self, link: str) -> tuple[UrdfJoint, ...]:
        """Return all joints from the root to a link."""
        path: list[UrdfJoint] = []
        while link in self.above:
            path.append(self.above[link])
            link = self.above[link].parent
        return tuple(reversed(path))

    def ancestors(self, joint: UrdfJoint) -> tuple[UrdfJoint, ...]:
        """Return the joints between the root and a joint, without it."""
        return self.path_to(joint.parent)

    def below(self, link: str) -> tuple[UrdfJoint, ...]:
        """Return the joints attached to a link."""
        return tuple(j for j in self.robot.joints if j.parent == link)

    def chains(self, among: Iterable[UrdfJoint]) -> tuple[tuple[UrdfJoint, ...], ...]:
        """Return the joints of `among` as maximal paths from the root."""
        expected = {joint.name: joint for joint in among}
        inner = {a.name for joint in expected.values() for a in self.ancestors(joint)}
        ends = [joint for joint in expected.values() if joint.name not in inner]
        return tuple(
            tuple(j for j in (*self.ancestors(end), end) if j.name in expected) for end in ends
        )

    def tip_link(self, joint: UrdfJoint) -> str:
        """Return the flange after a joint: `tool0`, `flange`, or its link.

        Only fixed joints lead there.
        """
        result, queue = [joint.child], [joint.child]
        while queue:
            for fixed in self.below(queue.pop()):
                if (fixed.kind == "fixed" or fixed.has_empty_range) and fixed.child not in result:
                    result.append(fixed.child)
                    queue.append(fixed.child)
        for ending in ("tool0", "flange"):
            hits = [link for link in result if ending in link]
            if hits:
                return hits[0]
        return joint.child


def build_graph(robot: UrdfRobot, place: Span | None) -> tuple[Graph, list[Diagnostic]]:
    """Return the graph and its faults (RG042, RG051, RG053).

    Errors among them mean that it is not a tree.
    """
    findings: list[Diagnostic] = []
    links, names = set(robot.links), {joint.name for joint in robot.joints}
    above: dict[str, UrdfJoint] = {}
    for joint in robot.joints:
        for role, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in links:
                findings.append(
                    error(
                        "RG051",
                        joint.span,
                        f"joint '{joint.name}': its {role} link '{link}' does not exist",
                        suggest(link, robot.links)
                        or f'add <link name="{link}"/> to the description',
                    )
                )
        if joint.child in above:
            first = above[joint.child].name
            findings.append(
                error(
                    "RG051",
                    joint.span,
                    f"link '{joint.child}' has two parents, by '{first}' and '{joint.name}'",
                    "a controller needs a tree: export the open chain, without rods and cylinders",
                    label="closes a loop",
                )
            )
        above.setdefault(joint.child, joint)
        if joint.mimic and joint.mimic not in names:
            findings.append(
                error(
                    "RG042",
                    joint.span,
                    f"joint '{joint.name}' mimics '{joint.mimic}', which does not exist",
                    suggest(joint.mimic, sorted(names))
                    or "name a joint of the description in its <mimic>",
                )
            )
    findings += _loops(robot, above)
    roots = [link for link in robot.links if link not in above]
    if len(roots) > 1 and not findings:
        findings.append(
            error(
                "RG051",
                place,
                f"{len(roots)} links have no parent: {', '.join(roots[:6])}",
                "only links below the robot's root are used",
                severity=Severity.WARNING,
            )
        )
    return Graph(robot, above), findings


def _loops(robot: UrdfRobot, above: dict[str, UrdfJoint]) -> Iterator[Diagnostic]:
    for joint in robot.joints:
        seen: set[str] = set()
        link = joint.child
        while link in above:
            if link in seen:
                yield error(
                    "RG051",
                    above[link].span,
                    f"the joints run in a circle through link '{link}'",
                    "a controller needs a tree: attach the first joint to the fixed link",
                    label="closes a loop",
                )
                return
            seen.add(link)
            link = above[link].parent


def check_axis(joint: UrdfJoint, place: Span | None) -> Diagnostic:
    """Return RG053 for a joint with an axis of length 0."""
    return error(
        "RG053",
        joint.span or place,
        f"joint '{joint.name}' has an axis of length 0",
        "write the direction that it turns about or slides along, such as "
        '<axis xyz="0 0 1"/>; if no axis of the controller drives it, ignore it',
    )
