"""Parts of rclpy that the node uses, recorded in recorded.json.

Its own source declares them. python tests/ros/record.py DISTRIBUTION RCLPY QOS_HEADER

RCLPY is the folder of the package rclpy (github.com/ros2/rclpy, branch of the distribution),
QOS_HEADER is rmw's qos_profiles.h (github.com/ros2/rmw). test_standin.py compares the stand-in with
it, the trial `as_recorded` an installed rclpy.
"""

import ast
import inspect
import json
import re
import sys
from pathlib import Path

RECORDED = Path(__file__).with_name("recorded.json")
CALLS = {
    "Node.__init__": "node.py",
    "Node.add_on_set_parameters_callback": "node.py",
    "Node.create_publisher": "node.py",
    "Node.create_service": "node.py",
    "Node.create_subscription": "node.py",
    "Node.declare_parameter": "node.py",
    "Node.destroy_publisher": "node.py",
    "Node.destroy_service": "node.py",
    "Node.destroy_subscription": "node.py",
    "Node.get_parameter": "node.py",
    "Node.set_parameters": "node.py",
    "LifecycleNodeMixin.on_activate": "lifecycle/node.py",
    "LifecycleNodeMixin.on_cleanup": "lifecycle/node.py",
    "LifecycleNodeMixin.on_configure": "lifecycle/node.py",
    "LifecycleNodeMixin.on_deactivate": "lifecycle/node.py",
    "LifecycleNodeMixin.trigger_activate": "lifecycle/node.py",
    "LifecycleNodeMixin.trigger_cleanup": "lifecycle/node.py",
    "LifecycleNodeMixin.trigger_configure": "lifecycle/node.py",
    "LifecycleNodeMixin.trigger_deactivate": "lifecycle/node.py",
    "ActionServer.__init__": "action/server.py",
    "ActionServer.destroy": "action/server.py",
    "ServerGoalHandle.abort": "action/server.py",
    "ServerGoalHandle.canceled": "action/server.py",
    "ServerGoalHandle.publish_feedback": "action/server.py",
    "ServerGoalHandle.succeed": "action/server.py",
    "Parameter.__init__": "parameter.py",
    "QoSOverridingOptions.with_default_policies": "qos_overriding_options.py",
}
"""Method, and where its class is."""
_OWN = ("self", "cls")


def declared(function):
    """Parameters of a method's syntax, as one text: `node, *, result_timeout=`."""
    report = function.args
    places = [a.arg for a in (*report.posonlyargs, *report.args)][1:]
    first = len(places) - len(report.defaults)
    return _text(
        [(name, n >= first) for n, name in enumerate(places)],
        [
            (a.arg, d is not None)
            for a, d in zip(report.kwonlyargs, report.kw_defaults, strict=True)
        ],
    )


def signature(method):
    """The same of a method of a class that is there; whatever else it takes is left out."""
    report = [p for p in inspect.signature(method).parameters.values() if p.name not in _OWN]
    return _text(
        *(
            [(p.name, p.default is not p.empty) for p in report if p.kind is kind]
            for kind in (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
        )
    )


def _text(places, names):
    rows = [
        [f"{name}=" if optional else name for name, optional in some] for some in (places, names)
    ]
    return ", ".join([*rows[0], *(["*", *rows[1]] if rows[1] else [])])


def _methods(path):
    for node in ast.parse(path.read_text("utf-8")).body:
        if isinstance(node, ast.ClassDef):
            for method in node.body:
                if isinstance(method, ast.FunctionDef):
                    # The implementation follows its `@overload`s.
                    yield f"{node.name}.{method.name}", method


def main(distribution, folder, header):
    calls = {}
    for place in sorted(set(CALLS.values())):
        result = dict(_methods(Path(folder) / place))
        calls |= {name: declared(result[name]) for name, at in CALLS.items() if at == place}
    text = Path(header).read_text("utf-8")
    profile = re.search(r"rmw_qos_profile_default =\s*\{([^}]*)\}", text)[1]
    words = re.findall(r"RMW_QOS_POLICY_(HISTORY|RELIABILITY|DURABILITY)_(\w+)", profile)
    known = json.loads(RECORDED.read_text()) if RECORDED.exists() else {}
    known[distribution] = {
        "calls": dict(sorted(calls.items())),
        "qos": {name.lower(): value for name, value in words},
    }
    RECORDED.write_text(json.dumps(known, indent=1, sort_keys=True) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
