"""Debugger for RAPID: breakpoints, steps, stacks and values."""

from rapidgen.controller.debugger.breakpoints import Breakpoint, PlacedBreakpoint
from rapidgen.controller.debugger.debugger import Debugger, PauseReason
from rapidgen.controller.debugger.stack import StackFrame
from rapidgen.controller.debugger.values import DisplayedValue, NotPaused

__all__ = [
    "Breakpoint",
    "Debugger",
    "DisplayedValue",
    "NotPaused",
    "PauseReason",
    "PlacedBreakpoint",
    "StackFrame",
]
