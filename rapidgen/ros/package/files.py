"""Files of generated ROS packages, in memory; `write` writes them.

Templates are in `templates/ros2`, with a folder for each of its packages, and `templates/ros1`; all
of them see the same names.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import jinja2

from rapidgen._atomic_write import write_whole
from rapidgen._data import data_folder
from rapidgen.config.cell import load_cell
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.config.registry import is_path
from rapidgen.config.yaml_text import yaml_flow, yaml_text
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, error
from rapidgen.ros.package import ros2_control, scene, srdf, urdf
from rapidgen.ros.package.description import MeshFiles

JOINT_STATES_RATE = 50
"""Hz of joint_states of a package whose configuration has the default of 10.

MoveIt and TF are made for 50 Hz; the driver's own clients get their states at 10 Hz as well.
"""
_START_SHARE = 0.8
"""Ratio of allowed_start_tolerance to the driver's.

MoveIt reports a violation before the driver does.
"""


@dataclass(frozen=True, slots=True)
class CellMember:
    """A robot of a package."""

    config: RobotConfig
    source: str
    """The node's configuration: a file, or a shipped name."""
    at: tuple[float, ...] = (0.0,) * 6
    """Its base in the world: x, y, z in m; roll, pitch, yaw in rad."""
    overrides: tuple[str, ...] = ()
    """KEY=VALUE overrides of `config`.

    Node and simulator load `source` with them too.
    """

    @property
    def path(self) -> Path | None:
        """Return the configuration's file, None for a shipped model."""
        return self.config.path if is_path(self.source) else None


@dataclass(frozen=True, slots=True)
class PackageOptions:
    """Further data for packages."""

    cell: Path | None = None
    """Cell file: its objects are MoveIt's scene, its tools links, and goals are checked in it."""
    is_fitted: bool = False
    """Convex parts fitted to the meshes are the collision geometry."""
    report: Callable[[Diagnostic], None] = lambda finding: None
    """Gets warnings."""


Files = dict[str, str | bytes]


def ros2_packages(
    config: RobotConfig,
    source: str,
    base: str,
    overrides: Sequence[str] = (),
    options: PackageOptions | None = None,
) -> Files:
    """Return the files of three ROS 2 packages by path: BASE_description, _bringup, _moveit_config.

    They start the node, rviz and MoveIt for this robot. `base`, which may be the name of any
    folder, is reduced to what ament allows.
    """
    member = CellMember(config, source, overrides=tuple(overrides))
    return _ros2([member], config.name, base, [""], options or PackageOptions())


def ros2_cell(
    members: Sequence[CellMember], base: str, options: PackageOptions | None = None
) -> Files:
    """Return the same for several robots in one MoveIt.

    Each has a controller and a node. Names of joints, links and planning groups begin with the
    robot's. Raises DiagnosticError if two robots have the same name.
    """
    names = [_plain(member.config.name) for member in members]
    twice = sorted({one for one in names if names.count(one) > 1})
    if twice:
        raise DiagnosticError(
            error(
                "RG693",
                None,
                f"several robots are called {', '.join(twice)}",
                "give each configuration a different `name`",
            )
        )
    return _ros2(members, re.sub(r"[^\w .-]", "_", base), base, names, options or PackageOptions())


def _ros2(
    members: Sequence[CellMember],
    called: str,
    base: str,
    names: Sequence[str],
    options: PackageOptions,
) -> Files:
    base = _plain(base)
    cell = load_cell(options.cell) if options.cell is not None else None
    shapes = [
        scene.shapes_of(
            member.config, member.path, cell, is_fitted=options.is_fitted, report=options.report
        )
        for member in members
    ]
    placed = [
        urdf.PlacedRobot(member.config, f"{one}_" if one else "", member.at, own.described)
        for member, one, own in zip(members, names, shapes, strict=True)
    ]
    meshes = MeshFiles(f"{base}_description")
    drawn = urdf.draw_cell(placed, called, meshes)
    if drawn.without_collision:
        options.report(
            error(
                "RG699",
                None,
                f"links without <collision>: {', '.join(drawn.without_collision)}",
                "the meshes of <visual> are used; --fit-shapes makes convex parts of them",
                severity=Severity.WARNING,
            )
        )
    unchecked: list[tuple[str, str, str]] = []
    for robot, own in zip(placed, shapes, strict=True):
        if own.world is None:
            continue
        bodies = scene.link_names(robot.config, robot.prefix, drawn.names)
        for group in robot.config.groups:
            tip = drawn.arms[robot.prefix + group.name].tip
            known = own.described.get(group.name)
            bodies |= scene.add_tools(
                drawn.root, own.world, group, known, tip, robot.prefix, meshes
            )
        unchecked += scene.without_check(own.world, bodies, options.report)
    robots = [
        {
            "name": one,
            "source": member.source,
            "set": [word for one in member.overrides for word in ("--set", one)],
            "overrides": yaml_flow(member.overrides),
            "prefix": robot.prefix,
            "host": f"127.0.0.{number}",
            "groups": [
                _group(group, one)
                | {
                    "solved": _solved(group, robot.prefix, drawn),
                    "states": ros2_control.node_topics(robot, group) + "/joint_states",
                }
                for group in member.config.groups
            ],
        }
        for number, (one, member, robot) in enumerate(zip(names, members, placed, strict=True), 1)
    ]
    tolerance = min(member.config.trajectory.start_tolerance for member in members)
    files: Files = {}
    texts = _rendered(
        "ros2",
        {
            "called": called,
            "base": base,
            "robots": robots,
            "groups": [group for robot in robots for group in robot["groups"]],
            "start_tolerance": f"{tolerance * _START_SHARE:.4f}",
            "is_cell": any(names),
            "has_ros2_control": ros2_control.is_possible(placed),
            "has_meshes": bool(meshes.files),
            "is_described": all(robot.described for robot in placed),
            "cell": str(options.cell.resolve()) if options.cell is not None else "",
        },
    )
    files |= {f"{base}_{path}": text for path, text in texts.items()}
    files |= {f"{base}_description/{path}": data for path, data in meshes.files.items()}
    files[f"{base}_moveit_config/config/{base}.srdf"] = srdf.draw(placed, drawn, called, unchecked)
    world = next((own.world for own in shapes if own.world is not None), None)
    if cell is not None and world is not None:
        text = scene.scene_text(called, world.scene.bodies)
        files[f"{base}_moveit_config/config/{base}.scene"] = text
    # Last: its joints are not those of the tree.
    ros2_control.add_hardware(drawn.root, placed)
    files[f"{base}_description/urdf/{base}.urdf"] = drawn.text
    return files


def ros1_package(config: RobotConfig, source: str, name: str) -> Files:
    """Return the files for unmodified ROS-Industrial nodes by path.

    Launch file, parameters, a watcher. `name`, which may be that of any folder, is reduced to what
    catkin allows.
    """
    name = _plain(name)
    drawn = urdf.draw(config, config.name)
    context = {
        "config": config,
        "name": name,
        "groups": [_group(group) for group in config.groups],
        "several": len(config.groups) > 1,
    }
    files: Files = dict(_rendered("ros1", context))
    files[f"config/{name}.urdf"] = drawn.text
    return files


def _plain(called: str) -> str:
    plain = re.sub(r"[^a-z0-9]+", "_", called.lower()).strip("_")
    return plain if plain[:1].isalpha() else f"robot_{plain}"


def write(files: Files, folder: Path) -> None:
    """Write a package to a new or empty folder, or over an older version.

    Raises DiagnosticError if foreign files are there, OSError.
    """
    foreign = sorted(
        str(path.relative_to(folder))
        for path in folder.rglob("*")
        if path.is_file() and str(path.relative_to(folder)) not in files
    )
    if foreign:
        raise DiagnosticError(
            error(
                "RG692",
                None,
                f"{folder} has files that are not of this package: {', '.join(foreign[:3])}",
                "give another folder",
            ),
            exit_code=2,
        )
    folder.mkdir(parents=True, exist_ok=True)
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        data = text.encode() if isinstance(text, str) else text
        write_whole(folder / path, data)
        if data.startswith(b"#!"):
            (folder / path).chmod(0o755)


def _rendered(kind: str, context: Mapping[str, object]) -> dict[str, str]:
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
    environment.filters["text"] = yaml_text
    files = {}
    for template in sorted(environment.list_templates(extensions=["j2"])):
        text = environment.get_template(template).render(context)
        if text.strip():  # A template without text does not apply to this robot.
            files[template.removesuffix(".j2")] = text
    return files


def _solved(group: GroupConfig, prefix: str, drawn: urdf.UrdfDrawing) -> str:
    joints = [prefix + joint.name for joint in group.joints]
    return srdf.chain_group(prefix + group.name, joints, drawn)


def _group(group: GroupConfig, robot: str = "") -> dict[str, object]:
    prefix = f"{robot}_" if robot else ""
    return {
        "name": prefix + group.name,
        "controller": (f"{robot}/" if robot else "") + f"{group.name}_controller",
        "jtc": f"{prefix}{group.name}_controller",
        "forward": f"{prefix}{group.name}_forward_controller",
        "lag": f"{ros2_control.path_tolerance(group):.3f}",
        "joints": [
            {
                "name": prefix + joint.name,
                "speed": f"{joint.speed:.4f}",
                "acceleration": f"{joint.acceleration:.4f}",
                "unit": "rad" if joint.kind == "revolute" else "m",
            }
            for joint in group.joints
        ],
        "is_coupled": bool(group.coupling),
        "motion": group.ports.motion,
        "state": group.ports.state,
    }
