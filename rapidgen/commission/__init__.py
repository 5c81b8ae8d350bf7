"""Commissioning: the first moves of a real robot, measured, and reports of users.

`procedure` asks the operator before each move, moves one joint at a time, and compares what the
driver, the controller itself (`controller_view`) and the operator say about it. A disagreement ends
the procedure: `map_faults` names the joint whose sign, zero or axis is wrong. `stop_measurement`
measures STOP, a lost connection and the emergency stop. The result is a `Checklist`, printed by
`checklist_text` and anonymised by `report`.
"""

from rapidgen.commission.checklist import Checklist, Step
from rapidgen.commission.operator import Operator, PreparedAnswers, Question
from rapidgen.commission.procedure import Commissioning, Settings, run

__all__ = [
    "Checklist",
    "Commissioning",
    "Operator",
    "PreparedAnswers",
    "Question",
    "Settings",
    "Step",
    "run",
]
