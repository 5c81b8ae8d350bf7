"""World Zones of a configuration, from the zones of a cell file [manual 3HAC050917]."""

import pytest

from rapidgen.config import from_manifest, load_config, to_manifest
from rapidgen.diagnostics import DiagnosticError, Severity

ARM = "model: irb120\ncontroller: {robotware: 6.15}\nworld_zones: zones.yaml\n"
BOX = "{keep: out, box: {low: [300, -200, 0], high: [700, 200, 50]}, of: [tcp]}"
AREA = "{keep: inside, cylinder: {base: [0, 0, -10], radius: 600, height: 900}, of: [tcp]}"
BALL = "{keep: out, sphere: {centre: [0, 400, 300], radius: 90}, of: [tcp]}"


@pytest.fixture
def load(tmp_path):
    def load(zones, base="", arm=ARM):
        (tmp_path / "robot.yaml").write_text(arm)
        robots = f"robots: {{T_ROB1: {{model: irb120{base}}}}}\n"
        (tmp_path / "zones.yaml").write_text(f"{robots}zones:\n  one: {zones}\n")
        return load_config(tmp_path / "robot.yaml")

    return load


@pytest.mark.parametrize(
    ("zone", "kind", "values"),
    [
        (BOX, "box", (0.3, -0.2, 0.0, 0.7, 0.2, 0.05)),
        (AREA, "cylinder", (0.0, 0.0, -0.01, 0.6, 0.9)),
        (BALL, "sphere", (0.0, 0.4, 0.3, 0.09)),
    ],
)
def test_zones_are_in_metres_and_survive_the_manifest(load, zone, kind, values):
    config = load(zone)
    (made,) = config.groups[0].world_zones
    assert (made.name, made.kind) == ("one", kind)
    assert made.values == pytest.approx(values)
    assert not config.diagnostics
    assert from_manifest(to_manifest(config)).groups == config.groups


def test_manifest_without_zones_has_no_entry(load):
    (group,) = to_manifest(load(BOX, arm=ARM.split("world_zones")[0]))["groups"]
    assert "world_zones" not in group


@pytest.mark.parametrize(
    ("base", "values"),
    [
        # The base of the robot is its world: a box in front of it, turned by a quarter.
        (", base: {position: [100, 0, 20]}", (0.2, -0.2, -0.02, 0.6, 0.2, 0.03)),
        (
            ", base: {orientation: [0.70710678, 0, 0, 0.70710678]}",
            (-0.2, -0.7, 0.0, 0.2, -0.3, 0.05),
        ),
    ],
)
def test_zones_are_in_the_world_of_the_controller(load, base, values):
    (made,) = load(BOX, base).groups[0].world_zones
    assert made.values == pytest.approx(values, abs=1e-6)


TURNED = ", base: {orientation: [0.9238795, 0, 0, 0.3826834]}"
LEANING = ", base: {orientation: [0.9238795, 0.3826834, 0, 0]}"


@pytest.mark.parametrize(
    ("zone", "base", "message"),
    [
        (BOX, TURNED, "turned"),
        (AREA, LEANING, "vertical"),
        (BOX.replace("50]", "9]"), "", "9 mm"),
        (AREA.replace("radius: 600", "radius: 4"), "", "radius"),
        (BALL.replace("radius: 90", "radius: 4"), "", "radius"),
    ],
)
def test_zone_that_abb_has_not_is_rejected(load, zone, base, message):
    with pytest.raises(DiagnosticError) as caught:
        load(zone, base)
    (found,) = caught.value.diagnostics
    assert found.code == "RG839"
    assert message in found.message
    assert found.span.line == 3


def test_cylinder_and_sphere_may_be_turned_about_z(load):
    assert load(AREA, TURNED).groups[0].world_zones
    assert load(BALL, LEANING).groups[0].world_zones


@pytest.mark.parametrize(("of", "count"), [("[all]", 1), ("[link_5]", 0), ("[tcp, link_5]", 1)])
def test_what_a_world_zone_does_not_supervise_is_reported(load, of, count):
    config = load(BOX.replace("[tcp]", of))
    assert len(config.groups[0].world_zones) == count
    assert [(d.code, d.severity) for d in config.diagnostics] == [("RG839", Severity.WARNING)]


@pytest.mark.parametrize(
    ("file", "code"), [("../zones.yaml", "RG839"), ("/etc/passwd", "RG839"), ("none.yaml", "RG001")]
)
def test_cell_file_is_in_the_folder_of_the_configuration(load, file, code):
    with pytest.raises(DiagnosticError) as caught:
        load(BOX, arm=ARM.replace("zones.yaml", file))
    assert caught.value.diagnostics[0].code == code


def test_more_zones_than_a_controller_has_are_rejected(load):
    many = BOX + "".join(f"\n  zone_{n}: {BOX}" for n in range(20))
    with pytest.raises(DiagnosticError, match="21 World Zones"):
        load(many)


@pytest.mark.parametrize(
    "zone",
    [
        "{keep: out}",
        BOX.replace("of:", "sphere: {centre: [0, 0, 0], radius: 9}, of:"),
        BOX.replace("50]", "-5]"),
    ],
)
def test_zone_with_a_faulty_volume_is_rejected(load, zone):
    with pytest.raises(DiagnosticError, match="RG832"):
        load(zone)
