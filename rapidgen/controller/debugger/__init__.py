"""Debugging the RAPID of a controller: breakpoints, steps, stacks and values, the clock at rest."""

from rapidgen.controller.debugger.breakpoints import Breakpoint, Placed
from rapidgen.controller.debugger.debugger import Debugger, Halt
from rapidgen.controller.debugger.stack import StackFrame
from rapidgen.controller.debugger.values import NotNow, Shown

__all__ = ["Breakpoint", "Debugger", "Halt", "NotNow", "Placed", "Shown", "StackFrame"]
