"""Deployment of drivers to controllers: plan, apply, verify, roll back."""

from rapidgen.deploy.apply import apply
from rapidgen.deploy.driver_set import DriverSet, from_files, from_folder
from rapidgen.deploy.plan import Plan, plan_json
from rapidgen.deploy.planner import make_plan
from rapidgen.deploy.retention import backup_set
from rapidgen.deploy.target import Access, connect, parse_target
from rapidgen.deploy.transports.registry import Target
from rapidgen.deploy.transports.transport import Transport, TransportFault

__all__ = [
    "Access",
    "DriverSet",
    "Plan",
    "Target",
    "Transport",
    "TransportFault",
    "apply",
    "backup_set",
    "connect",
    "from_files",
    "from_folder",
    "make_plan",
    "parse_target",
    "plan_json",
]
