"""What programs have set for a robot and its planner need not know, in RAPID's own values."""

from dataclasses import dataclass, field

from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.values import Record

NO_OFFSETS = (0.0,) * 6


@dataclass(slots=True)
class RobotData:
    """Of one robot. Tool and work object outlive PP to main, the rest does not."""

    tool: Record | None = None
    """tooldata of the last move, None before the first."""
    work_object: Record | None = None
    """wobjdata of the last move, None before the first or when it had none."""
    external_offset: tuple[float, ...] = NO_OFFSETS
    """Offsets of eax_a to eax_f (EOffsOn), deg and mm."""
    partners: frozenset[str] = frozenset()
    """Tasks that move synchronously with this one, itself included (SyncMoveOn); lower case."""
    suspended: bool = False
    """SyncMoveSuspend"""
    carried: float = 0.0
    """kg of the last move, tool and payload."""
    extra: dict[str, object] = field(default_factory=dict)
    """Settings that change no motion here: a program can set them and read them."""

    @classmethod
    def of(cls, group: MotionGroup) -> "RobotData":
        """Those of a robot, which its reset resets."""
        data = cls()
        group.on_reset.append(data.reset)
        return data

    def use(self, tool: Record | None, work_object: Record | None) -> None:
        """Tool and work object of the move that follows are the active ones from now on."""
        self.tool = tool.copy() if tool is not None else None
        self.work_object = work_object.copy() if work_object is not None else None

    def reset(self) -> None:
        """PP to main."""
        self.external_offset = NO_OFFSETS
        self.partners = frozenset()
        self.suspended = False
        self.carried = 0.0
        self.extra.clear()
