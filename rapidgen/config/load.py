"""Load a file or a shipped model as a checked, frozen configuration.

All errors are reported at once.
"""

import logging
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from rapidgen.config import schema
from rapidgen.config.assemble import Assembly, ShippedBasis, assemble
from rapidgen.config.build import build
from rapidgen.config.consistency import contradictions
from rapidgen.config.draft import DraftFindings, GroupDraft, JointDraft
from rapidgen.config.layers import Overrides
from rapidgen.config.model import ChainLink, RobotConfig, WorldZone
from rapidgen.config.placeholders import extract_placeholders
from rapidgen.config.truncation import limit_findings
from rapidgen.config.validate import validate
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, suggest

_LOG = logging.getLogger("rapidgen.config")


def load_config(
    path_or_name: str | Path,
    *,
    overrides: Overrides = (),
    package_paths: Sequence[str | Path] = (),
    content: bytes | None = None,
) -> RobotConfig:
    """Read and check a configuration; `content` counts in place of the file's.

    An argument with a suffix or a separator is a path, else the name of a shipped model.
    `overrides` are "key.path=value" texts or a mapping of key paths to values; `package_paths` are
    folders for `$(find PACKAGE)` of a xacro file. Raises DiagnosticError with all errors; warnings
    and notes are in the result's `diagnostics`.
    """
    assembly = assemble(path_or_name, overrides, content)
    assembly.root, open_lines = extract_placeholders(assembly.root)
    valid = validate(assembly.root)
    if open_lines:
        faults = assembly.found + valid.found
        raise DiagnosticError(
            limit_findings(in_order(open_lines + faults)), exit_code=2 if faults else 1
        )
    report = DraftFindings(assembly.root, valid.removed)
    report.found = assembly.found + valid.found
    groups = valid.configuration.groups
    drafts = [_draft(name, keys, assembly.bases.get(name)) for name, keys in groups.items()]
    _report_unknown(drafts, groups, report)
    _report_wider(drafts, report)
    for draft in drafts:
        value = groups[draft.name].urdf
        if value:
            others = {j.name for other in drafts if other is not draft for j in other.joints}
            _read_urdf(draft, value, others, [Path(p) for p in package_paths], assembly, report)
        contradictions(draft, ("groups", draft.name), draft.names, report)
        _report_unsure(draft, groups[draft.name], report)
    config = build(valid.configuration, drafts, assembly.path, report)
    if config is not None:
        config = _with_world_zones(config, groups, assembly, report)
        config = None if report.failed else config
    result = tuple(in_order(report.found))
    if config is None:
        raise DiagnosticError(limit_findings(result))
    _LOG.info("%s: %s, read from %d files", path_or_name, config.name, len(assembly.inputs))
    return replace(config, inputs=tuple(assembly.inputs), diagnostics=tuple(limit_findings(result)))


def _with_world_zones(
    config: RobotConfig,
    groups: Mapping[str, schema.GroupKeys],
    assembly: Assembly,
    report: DraftFindings,
) -> RobotConfig:
    """Add the World Zones of cell files (RG839)."""
    if not any(keys.world_zones for keys in groups.values()):
        return config
    from rapidgen.config.world_zones import world_zones_of  # a cell file has many keys

    made = []
    for group in config.groups:
        file = groups[group.name].world_zones
        zones: tuple[WorldZone, ...] = ()
        if file:
            at = ("groups", group.name, "world_zones")
            folder = assembly.path.parent.resolve()
            path = (folder / file).resolve()
            if path.is_relative_to(folder):
                several = len(config.groups) > 1
                zones = world_zones_of(assembly.path.parent / file, group, several, at, report)
            else:
                report.error("RG839", f"{file} is not in the configuration's folder or below", at)
        made.append(replace(group, world_zones=zones))
    return replace(config, groups=tuple(made))


def drafts_of(name: str) -> list[tuple[GroupDraft, schema.GroupKeys]]:
    """Return the groups of a shipped model as its file has them."""
    assembly = assemble(name, ())
    valid = validate(assembly.root)
    return [
        (_draft(group, keys, assembly.bases.get(group)), keys)
        for group, keys in valid.configuration.groups.items()
    ]


def in_order(findings: list[Diagnostic]) -> list[Diagnostic]:
    """Return findings by place; those without one come first."""
    return sorted(
        dict.fromkeys(findings),
        key=lambda d: (d.span.path, d.span.line, d.span.column) if d.span else ("", 0, 0),
    )


def _read_urdf(
    draft: GroupDraft,
    value: schema.UrdfKeys,
    elsewhere: set[str],
    package_paths: list[Path],
    assembly: Assembly,
    report: DraftFindings,
) -> None:
    from rapidgen.config.urdf.group import complete  # slow import, only for URDF

    place = report.span(("groups", draft.name, "urdf", "file"))
    folder = assembly.path.parent
    result, inputs = complete(draft, value, folder, package_paths, frozenset(elsewhere), place)
    report.found += result
    assembly.inputs += inputs
    if any(d.severity is Severity.ERROR for d in result):
        report.mute(("groups", draft.name, "joints"))


def _draft(name: str, keys: schema.GroupKeys, basis: ShippedBasis | None) -> GroupDraft:
    limits, speeds = keys.source.get("limits", ""), keys.source.get("speeds", "")
    shared = "; ".join(dict.fromkeys(text for text in (limits, speeds) if text))
    joints = [
        JointDraft(
            joint,
            given.axis or "",
            given.unit or "",
            given.lower,
            given.upper,
            given.speed,
            given.acceleration,
            given.sign or 1,
            given.offset or 0.0,
            given.source or shared,
            tuple(given.unsure),
            acceleration_time=given.acceleration_time,
            brake_deceleration=given.brake_deceleration or 0.0,
            stop_deceleration=given.stop_deceleration or 0.0,
        )
        for joint, given in keys.joints.items()
    ]
    chain = [_link(step) for step in keys.chain]
    carriers = {unit: [_link(step) for step in steps] for unit, steps in keys.positioners.items()}
    model, known = (basis.model, basis.known) if basis else ("", {})
    units = tuple(keys.external_units)
    held_axes = tuple(math.radians(value or 0.0) for _, value in sorted(keys.held_axes.items()))
    return GroupDraft(
        name,
        model,
        joints,
        chain,
        carriers,
        keys.coupling,
        keys.max_payload or 0.0,
        known,
        units,
        held_axes=held_axes,
    )


def _link(step: schema.ChainStepKeys) -> ChainLink:
    x, y, z = (v / 1000 for v in step.xyz)
    roll, pitch, yaw = (math.radians(v) for v in step.rpy)
    norm = math.sqrt(sum(v * v for v in step.axis)) or 1.0
    a, b, c = (v / norm for v in step.axis)
    return ChainLink(
        step.joint, (x, y, z), (roll, pitch, yaw), (a, b, c), tuple(step.follows.items())
    )


def _report_unknown(
    drafts: list[GroupDraft], groups: dict[str, schema.GroupKeys], report: DraftFindings
) -> None:
    """Report a misspelt joint: not in the model, and without an axis."""
    for draft in drafts:
        if not draft.known or groups[draft.name].urdf:
            continue
        names = [joint.name for joint in draft.joints if joint.axis]
        for joint in draft.joints:
            path = ("groups", draft.name, "joints", joint.name)
            if not joint.axis and not report.is_faulty((*path, "axis")):
                report.error(
                    "RG015",
                    f"{draft.model} has no joint '{joint.name}'",
                    path,
                    "not one of the model's",
                    suggest(joint.name, names)
                    or f"it has {', '.join(names)}; a further joint "
                    "needs `axis:`, limits and `speed:`",
                    key=True,
                )
                report.mute(path)


def _report_wider(drafts: list[GroupDraft], report: DraftFindings) -> None:
    """Report limits beyond the shipped model's."""
    for draft in drafts:
        for joint in draft.joints:
            for figure, sign in (("lower", -1), ("upper", 1), ("speed", 1)):
                bound = draft.known.get((joint.axis, figure))
                value = getattr(joint, figure)
                if bound is not None and value is not None and (value - bound) * sign > 1e-9:
                    report.add(
                        "RG049",
                        Severity.WARNING,
                        f"'{joint.name}': {figure} {value:g} is beyond the {bound:g} known for "
                        f"{draft.model}",
                        ("groups", draft.name, "joints", joint.name, figure),
                        "",
                        "keep it only if the data sheet of your robot says so, and give `source:`",
                    )


def _report_unsure(draft: GroupDraft, keys: schema.GroupKeys, report: DraftFindings) -> None:
    """Report which figures of each group lack a reliable source."""
    parts = [f"{joint.name} {'/'.join(joint.unsure)}" for joint in draft.joints if joint.unsure]
    parts += keys.unsure
    if parts:
        joints = report.span(("groups", draft.name, "joints"), key=True)
        # Figures of a shipped model: the line of the user's file that names it.
        paths = [("groups", draft.name, "model"), ("model",)]
        named = [path for path in paths if report.span(path, key=True).path != joints.path]
        report.add(
            "RG016",
            Severity.WARNING,
            f"figures without a sure source: {', '.join(parts)}",
            named[0] if named else ("groups", draft.name, "joints"),
            "",
            "compare them with the data sheet of your robot before it moves, and write them "
            "into your configuration with their `source:`",
            key=True,
        )
