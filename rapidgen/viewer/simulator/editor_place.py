"""Link of the page to editors: their targets are drawn, and they open the page's lines."""

from collections.abc import Iterable, Mapping

from rapidgen.controller.editor_link import EditorCursor, targets_at
from rapidgen.controller.runner import ControllerRunner
from rapidgen.viewer.messages import EditorPlace, OpenInEditor, Request, SeenTarget, ToPage
from rapidgen.viewer.provider import Handler, RequestRejected
from rapidgen.viewer.simulator.targets import seen_target

_MOST = 50
"""Number of drawn targets of one place."""


class EditorPlaceProvider:
    """The place under an editor's cursor, and requests to open one there."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._link = runner.editor
        self._tasks = runner.controller.rapid_tasks
        self._groups = {g.config.task: g for g in runner.controller.motion.groups.values()}
        self._cursor: EditorCursor | None = None
        self._now = EditorPlace(attached=False)

    def whole(self) -> Iterable[ToPage]:
        """Return the place."""
        yield from self.changes()
        yield self._now

    def changes(self) -> Iterable[ToPage]:
        """Return the place after a change of the cursor or of the number of editors."""
        cursor, attached = self._link.cursor, self._link.is_attached
        if cursor is self._cursor and attached == self._now.attached:
            return
        self._cursor = cursor
        self._now = EditorPlace(attached=attached)
        if cursor is not None:
            targets = tuple(self._targets(cursor))[:_MOST]
            self._now = EditorPlace(
                attached=attached, module=cursor.module, line=cursor.line, targets=targets
            )
        yield self._now

    def handlers(self) -> Mapping[type, Handler]:
        """The handler of OpenInEditor."""
        return {OpenInEditor: self._open}

    def _targets(self, cursor: EditorCursor) -> Iterable[SeenTarget]:
        seen = set()
        for task, module, target in targets_at(self._tasks, cursor):
            group = self._groups.get(task)
            made = seen_target(group, module, target) if group is not None else None
            if made is not None and (made.group, made.pose) not in seen:
                seen.add((made.group, made.pose))
                yield made

    def _open(self, request: Request) -> str:
        assert isinstance(request, OpenInEditor)
        if not self._link.open(request.module, request.line):
            raise RequestRejected("no editor debugs this simulation")
        return ""
