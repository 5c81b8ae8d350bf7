"""The files of a generated ROS package, in memory; `write` brings them to a folder.

Templates are in `templates/ros2` and `templates/ros1`; all of them see the same names.
"""

import re
from pathlib import Path

import jinja2

from rapidgen._data import data_folder
from rapidgen._writing import write_whole
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import DiagnosticError, error
from rapidgen.ros.package import srdf, urdf

_START_SHARE = 0.8
"""allowed_start_tolerance as a share of the driver's: MoveIt is to complain before it does."""
_ROS1_PORTS = (11000, 11002)
"""The old nodes' defaults for motion and state."""


def ros2_package(config: RobotConfig, source: str) -> dict[str, str]:
    """Files by path of a ROS 2 package that starts the node, rviz and MoveIt for this robot.

    `source` is the configuration as the node is to read it: a file, or a shipped name.
    """
    name = package_name(config)
    drawn = urdf.draw(config, config.name)
    files = _rendered("ros2", name, _context(config, name, drawn, source))
    files[f"config/{name}.urdf"] = drawn.text
    files[f"config/{name}.srdf"] = srdf.draw(config, drawn, config.name)
    return files


def ros1_package(config: RobotConfig, source: str) -> dict[str, str]:
    """Files by path for the unmodified ROS-Industrial nodes: launch, parameters, a watcher."""
    name = package_name(config)
    drawn = urdf.draw(config, config.name)
    files = _rendered("ros1", name, _context(config, name, drawn, source))
    files[f"config/{name}.urdf"] = drawn.text
    return files


def package_name(config: RobotConfig) -> str:
    """A name that ament and catkin take: small letters, digits, single underscores."""
    plain = re.sub(r"[^a-z0-9]+", "_", config.name.lower()).strip("_")
    return f"{plain if plain[:1].isalpha() else f'robot_{plain}'}_rapidgen"


def write(files: dict[str, str], folder: Path) -> None:
    """Bring a package to a folder, which is new, empty or an older one of this package.

    Raises DiagnosticError where files of somebody else lie there, OSError.
    """
    strangers = sorted(
        str(path.relative_to(folder))
        for path in folder.rglob("*")
        if path.is_file() and str(path.relative_to(folder)) not in files
    )
    if strangers:
        raise DiagnosticError(
            error(
                "RG692",
                None,
                f"{folder} has files that are not of this package: {', '.join(strangers[:3])}",
                "give a folder of its own",
            ),
            exit_code=2,
        )
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        write_whole(folder / path, text.encode())


def _rendered(kind: str, name: str, context: dict[str, object]) -> dict[str, str]:
    folder = data_folder("templates") / kind
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        undefined=jinja2.StrictUndefined,
        autoescape=False,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["quoted"] = repr
    files = {}
    for template in sorted(environment.list_templates(extensions=["j2"])):
        path = template.removesuffix(".j2").replace("NAME", name)
        files[path] = environment.get_template(template).render(context)
    return files


def _context(config: RobotConfig, name: str, drawn: urdf.Drawn, source: str) -> dict[str, object]:
    tolerance = config.trajectory.start_tolerance
    return {
        "config": config,
        "name": name,
        "source": source,
        "groups": [_group(group, drawn) for group in config.groups],
        "start_tolerance": f"{tolerance * _START_SHARE:.4f}",
        "several": len(config.groups) > 1,
        "state_rate": round(1 / config.state_period),
    }


def _group(group: GroupConfig, drawn: urdf.Drawn) -> dict[str, object]:
    return {
        "name": group.name,
        "controller": f"{group.name}_controller",
        "joints": [
            {
                "name": joint.name,
                "speed": f"{joint.speed:.4f}",
                "acceleration": f"{joint.acceleration:.4f}",
                "unit": "rad" if joint.kind == "revolute" else "m",
            }
            for joint in group.joints
        ],
        "base": drawn.arms[group.name].links[0],
        "tool": drawn.arms[group.name].tip,
        "is_coupled": bool(group.coupling),
        "motion": group.ports.motion,
        "state": group.ports.state,
        "has_old_ports": (group.ports.motion, group.ports.state) == _ROS1_PORTS,
    }
