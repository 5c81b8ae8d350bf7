"""Configurations: all faults with places, layers, overrides, hostile input."""

import json
import math
import os

import pytest

from rapidgen.config import from_manifest, load_config, shipped_names, to_manifest
from rapidgen.diagnostics import DiagnosticError, Severity
from tests.refusal import refusal, refused

GROUP_MODEL = "name: a\ngroups:\n  rob1:\n    model: irb1200\n"


def load(tmp_path, text, **options):
    path = tmp_path / "cell.yaml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return load_config(path, **options)


def faults(tmp_path, text, **options):
    with pytest.raises(DiagnosticError) as caught:
        load(tmp_path, text, **options)
    assert caught.value.exit_code == 2
    return [d for d in caught.value.diagnostics if d.severity is Severity.ERROR]


def places(result):
    return [(d.code, d.span.line, d.span.column) for d in result]


def test_five_faults_are_five_findings_with_their_places(tmp_path):
    text = (
        "model: irb120\n"
        "controler: {type: irc5}\n"  # unknown key
        "trajectory: {capacity: lots}\n"  # wrong type
        "joints:\n"
        "  joint_1: {lower: 10, upper: 5}\n"  # contradiction that only the model shows
        "state: {rate: 10}\n"
        "state: {rate: 20}\n"  # duplicate
        "network: {bind: 300.1.1.1}\n"  # no address
    )
    result = faults(tmp_path, text)
    assert places(result) == [
        ("RG005", 2, 1),
        ("RG006", 3, 24),
        ("RG014", 5, 31),
        ("RG004", 7, 1),
        ("RG006", 8, 17),
    ]
    assert "did you mean 'controller'?" in result[0].help
    assert all(d.span.path.endswith("cell.yaml") for d in result)


@pytest.mark.parametrize(
    ("text", "fix"),
    [
        ("max_points: 500", "the limit of points is `capacity:` in `trajectory:`"),
        ("robotware: 6.15", "`robotware:` belongs in `controller:`"),
        ("state: {rate: 10, capacity: 5}", "`capacity:` belongs in `trajectory:`"),
        ("groups: {rob1: {profile: basic}}", "`profile:` belongs at the top of the file"),
        ("controller: {ports: {motion: 1}}", "`ports:` belongs in a group, or at the top"),
        # Of objects and of loads there are several.
        ("controller: {mass: 3}", "known here: type, robotware"),
    ],
)
def test_misplaced_key_gets_its_correct_place(tmp_path, text, fix):
    (result,) = faults(tmp_path, f"model: irb120\n{text}\n")
    assert result.code == "RG005"
    assert fix in result.help


@pytest.mark.parametrize(
    "text",
    [
        "model: 120\n",
        "model: irb120\ntool: {name: grüffzange, load: {mass: 1}}\n",
        "model: irb120\nwork_object: {name: a-b, held: true}\n",
    ],
)
def test_consequence_of_a_fault_is_not_reported(tmp_path, text):
    assert [d.code for d in faults(tmp_path, text)] == ["RG006"]


def test_a_fault_in_the_schema_does_not_hide_one_in_the_meaning(tmp_path):
    result = faults(tmp_path, "model: irb120\nports: {motion: x, state: 11001}\n")
    assert sorted(d.code for d in result) == ["RG006", "RG012"]


def test_four_lines_are_enough_for_a_shipped_model(tmp_path):
    config = load(tmp_path, "model: irb120\ncontroller:\n  robotware: 6.10\n")
    assert config.name == "cell"
    assert config.robotware == (6, 10)
    assert config.groups[0].model == "irb120"


@pytest.mark.parametrize(
    ("text", "version"),
    [("6", (6, 0)), ("6.1", (6, 1)), ("6.10", (6, 10)), ('"6.15.03"', (6, 15)), ("5.15", (5, 15))],
)
def test_a_version_is_read_as_written(tmp_path, text, version):
    assert load(tmp_path, f"model: irb120\ncontroller: {{robotware: {text}}}").robotware == version


@pytest.mark.parametrize("text", ["4", "5.14", "9", "yes", "[6]", "true", ".inf"])
def test_other_versions_are_refused(tmp_path, text):
    result = faults(tmp_path, f"model: irb120\ncontroller: {{robotware: {text}}}")
    assert [d.code for d in result] == ["RG006"]


@pytest.mark.parametrize(
    ("line", "wanted"),
    [
        ("name: 1 robot", "a name for a folder"),
        ("data: {count: {type: num}}", "MODULE:NAME"),
        ('routines: {grip: {call: "a-b:c"}}', "PROCEDURE or MODULE:PROCEDURE"),
        ("network: {bind: hier}", "lan, service or an IPv4 address"),
    ],
)
def test_text_of_wrong_form_gets_the_form_in_words(tmp_path, line, wanted):
    (result,) = [d for d in faults(tmp_path, f"{line}\nmodel: irb120\n") if d.code == "RG006"]
    assert result.message.endswith(f"must be {wanted}")
    assert "[A-Z" not in f"{result.message}{result.help}"


def test_irc5_does_not_run_robotware_7(tmp_path):
    text = "model: irb120\ncontroller: {type: irc5, robotware: 7.2}"
    assert [d.code for d in faults(tmp_path, text)] == ["RG011"]


def test_yaml_1_2_reads_yes_as_a_text_and_9e9_as_a_number(tmp_path):
    result = faults(tmp_path, "model: irb120\ncommissioning: yes\ntcp_speed_limit: 9E9\n")
    assert [d.message for d in result] == [
        "'commissioning': must be true or false (YAML 1.2: `yes` and `on` are texts), not 'yes'",
        "'tcp_speed_limit': must be at most 10000, not 9000000000.0",
    ]


@pytest.mark.parametrize("ceiling", ["0.5", "9.99"])
def test_a_ceiling_in_m_per_s_is_refused(tmp_path, ceiling):
    (result,) = faults(tmp_path, f"model: irb120\ntcp_speed_limit: {ceiling}\n")
    assert (result.code, result.span.line) == ("RG006", 2)
    assert f"{float(ceiling) * 1000:g}" in result.help
    assert load(tmp_path, "model: irb120\ntcp_speed_limit: 10\n").groups[0].tcp_speed_limit == 0.01


def test_octal_looking_numbers_are_decimal(tmp_path):
    config = load(tmp_path, "model: irb120\ntrajectory: {capacity: 0100}")
    assert config.trajectory.capacity == 100


@pytest.mark.parametrize(
    ("text", "place", "word"),
    [
        ("model: irb120\nports:\n#  motion: 12000\n", 2, "'ports' has no value"),
        ("model: irb120\ntrajectroy:\n", 2, "'trajectroy' has no value"),
        ("model: irb120\ntool: {name: t, load: {mass: 1,2}}\n", 2, "key without a value"),
        ("model: irb120\njoints:\n  joint_1: {lower: }\n", 3, "'lower' has no value"),
    ],
)
def test_a_key_without_a_value_is_refused(tmp_path, text, place, word):
    result = [d for d in faults(tmp_path, text) if d.code == "RG023"]
    assert [d.span.line for d in result] == [place]
    assert word in result[0].message


def test_decimal_comma_is_reported(tmp_path):
    result = faults(tmp_path, "model: irb120\ntool: {name: t, load: {mass: 1,2}}\n")
    assert "1.2" in result[0].help


@pytest.mark.parametrize("name", ["\\ud800", "\\e[31m", "\\x07", "\\0"])
def test_a_character_that_is_none_is_refused(tmp_path, name):
    for text in (f'joints: {{"{name}": {{axis: rax_1}}}}\n', f'name: "{name}"\n'):
        assert [d.code for d in faults(tmp_path, text)] == ["RG002"]


def test_overrides_as_text_and_as_mapping_do_the_same():
    one = load_config("irb120", overrides=["ports.motion=12000", "trajectory.capacity=5000"])
    two = load_config("irb120", overrides={"ports.motion": 12000, "trajectory.capacity": 5000})
    assert one == two
    assert one.groups[0].ports.motion == 12000
    assert one.groups[0].ports.state == 11002
    assert one.trajectory.capacity == 5000
    assert one.inputs[-2:] == (
        ("--set", b"ports.motion=12000"),
        ("--set", b"trajectory.capacity=5000"),
    )


def test_an_override_can_quote_a_key_and_name_a_group():
    config = load_config("irb14000", overrides=['groups.rob_l.joints."yumi_joint_1_l".upper=90'])
    assert math.degrees(config.groups[0].joints[0].upper) == pytest.approx(90)
    assert math.degrees(config.groups[1].joints[0].upper) == pytest.approx(168.5)


@pytest.mark.parametrize("text", ["ports.motion", "=3", "a..b=3", ".a=1", "a.=1"])
def test_a_bad_override_is_a_finding(text):
    assert refused(load_config, "irb120", overrides=[text]) == ["RG008"]


def test_a_fault_in_an_override_points_at_it():
    (fault,) = refusal(load_config, "irb120", overrides=["ports.motoin=3"]).diagnostics
    assert (fault.code, fault.span.path) == ("RG005", "--set ports.motoin=3")
    assert "motion" in fault.help


def test_group_keys_at_the_top_need_one_group(tmp_path):
    result = faults(tmp_path, "model: irb14000\nports: {motion: 12000}\n")
    assert places(result) == [("RG010", 2, 1)]
    assert "groups.rob_l.ports" in result[0].help


def test_two_groups_get_ports_and_tasks_of_their_own(tmp_path):
    config = load(tmp_path, "groups:\n  a: {model: irb120}\n  b: {model: irb2400}\n")
    a, b = config.groups
    assert (a.task, b.task) == ("T_ROB1", "T_ROB2")
    assert (a.mechanical_unit, b.mechanical_unit) == ("ROB_1", "ROB_2")
    assert (a.ports.motion, a.ports.state) == (11000, 11002)
    assert (b.ports.motion, b.ports.state) == (11010, 11012)
    assert (a.coupling, b.coupling) == (0, 1)


def test_groups_do_not_share_ports_or_tasks(tmp_path):
    text = (
        "groups:\n"
        "  a: {model: irb120, task: T_X}\n"
        "  b: {model: irb120, task: t_x, ports: {motion: 11002}}\n"
    )
    assert [d.code for d in faults(tmp_path, text)] == ["RG012", "RG012"]


@pytest.mark.parametrize(
    ("network", "text"),
    [
        # A controller binds to an address of its own, to no wildcard (a real one of 7.21).
        ("{bind: 0.0.0.0}", "`lan`"),
        ("{bind: 255.255.255.255}", "`lan`"),
        ("{bind: 224.0.0.1}", "`lan`"),
        ("{bind: 192.168.1.300}", "`lan`"),
        # The peer's address is compared as text.
        ("{allowed_clients: [192.168.010.5]}", "192.168.1.10"),
        ("{allowed_clients: [192.168.1.0/24]}", "192.168.1.10"),
        ("{allowed_clients: [0.0.0.0]}", "192.168.1.10"),
    ],
)
def test_an_address_that_no_machine_has_is_refused(tmp_path, network, text):
    (fault,) = faults(tmp_path, f"model: irb120\nnetwork: {network}\n")
    assert (fault.code, fault.span.line) == ("RG006", 2)
    assert text in fault.help


@pytest.mark.parametrize("address", ["10.0.0.7", "192.168.125.1", "127.0.0.1", "203.0.113.9"])
def test_an_address_that_a_machine_has_is_taken(tmp_path, address):
    text = f"model: irb120\nnetwork: {{bind: {address}, allowed_clients: [{address}]}}\n"
    assert load(tmp_path, text).bind == address


def test_limits_are_rounded_inwards_to_a_hundredth(tmp_path):
    text = "model: irb120\njoints: {joint_1: {lower: -90.004, upper: 90.009}}"
    joint = load(tmp_path, text).groups[0].joints[0]
    assert math.degrees(joint.lower) == pytest.approx(-90.0, abs=1e-9)
    assert math.degrees(joint.upper) == pytest.approx(90.0, abs=1e-9)


def test_limit_beyond_the_model_is_reported(tmp_path):
    config = load(tmp_path, "model: irb120\njoints: {joint_1: {upper: 170}}")
    (warning,) = config.diagnostics
    assert (warning.code, warning.severity) == ("RG049", Severity.WARNING)
    assert (warning.span.line, warning.span.column) == (2, 27)


def test_a_figure_of_ones_own_is_no_longer_unsure(tmp_path):
    assert [d.code for d in load_config("irb1200").diagnostics] == ["RG016"]
    own = (
        "model: irb1200\njoints:\n  joint_2: {speed: 200}\n  joint_3: {speed: 200}\n"
        "  joint_6: {lower: -350, upper: 350, source: mine}\n"
    )
    config = load(tmp_path, own)
    assert config.diagnostics == ()
    assert not config.groups[0].joints[5].unsure
    assert config.groups[0].joints[5].source == "mine"


def test_a_tool_speed_of_ones_own_is_no_longer_unsure(tmp_path):
    """The ceilings of collaborative robots are remembered only; a build says so."""
    (warning,) = load_config("crb15000").diagnostics
    assert warning.message.endswith("tcp_speed_limit")
    assert load(tmp_path, "model: crb15000\ntcp_speed_limit: 1000").diagnostics == ()
    for warning in load_config("irb14000").diagnostics:
        assert warning.message.endswith("tcp_speed_limit, max_payload")


def test_a_joint_of_another_name_on_a_known_axis_is_that_joint(tmp_path):
    group = load(tmp_path, "model: irb120\njoints: {shoulder: {axis: rax_2}}").groups[0]
    assert [j.name for j in group.joints][:3] == ["joint_1", "shoulder", "joint_3"]
    assert math.degrees(group.joints[1].upper) == pytest.approx(110)
    assert [link.joint for link in group.chain][:3] == ["joint_1", "shoulder", "joint_3"]


def test_rules_beyond_the_schema_are_checked(tmp_path):
    text = (
        "model: irb120\n"
        "tool: {name: gripper, frame: {orientation: [1, 1, 0, 0]}}\n"
        "signals: {di1: {kind: DI, access: write}}\n"
        "joints: {joint_2: {axis: rax_1}}\n"
    )
    codes = sorted(d.code for d in faults(tmp_path, text))
    assert codes == ["RG006", "RG013", "RG014", "RG014"]


@pytest.mark.parametrize(
    "text",
    [
        "model: irb120\nports: {motion: 11000, state: 11000}\n",
        "model: irb120\njoints: {joint_1: {lower: 10, upper: -10}}\n",
        "model: irb120\njoints: {joint_2: {axis: rax_1}}\n",
        "model: irb120\njoints: {joint_1: {axis: rax_2}, joint_2: {axis: rax_1}}\n",
        "model: irb120\nheld_axes: [eax_a]\n",
        "model: irb120\nsignals: {part: {kind: DI}, Part: {kind: DO}}\n",
        "model: irb120\npositioners: {TABLE: [{joint: joint_1}]}\n",
        "model: irb120\nchain: [{joint: joint_9}, {joint: joint_1, axis: [0, 0, 0]}]\n",
    ],
)
def test_faults_are_reported_with_a_fix(tmp_path, text):
    result = faults(tmp_path, text)
    assert result
    assert [d.message for d in result if not d.help] == []


@pytest.mark.parametrize("name", shipped_names())
def test_the_manifest_keeps_every_bit(name):
    config = load_config(name)
    again = from_manifest(json.loads(json.dumps(to_manifest(config))))
    assert again == config
    assert to_manifest(again) == to_manifest(config)


@pytest.mark.parametrize(
    "damage",
    [
        lambda d: d.pop("groups"),
        lambda d: d.update(extra=1),
        lambda d: d["groups"][0].update(ports=None),
        lambda d: d["groups"][0]["joints"][0].update(lower="x"),
        lambda d: d.update(controller="s4"),
        lambda d: d.update(robotware=[6]),
    ],
)
def test_a_damaged_manifest_is_one_finding(damage):
    data = to_manifest(load_config("irb120"))
    damage(data)
    assert refused(from_manifest, data) == ["RG019"]


HOSTILE = {
    "alias bomb": b"a: &a [x, x, x, x, x, x, x, x, x]\n"
    + b"".join(
        b"%c: &%c [*%c, *%c, *%c, *%c, *%c, *%c, *%c, *%c, *%c]\n"
        % (c + 1, c + 1, c, c, c, c, c, c, c, c, c)
        for c in range(ord("a"), ord("i"))
    ),
    "own alias": b"a: &a [*a]\n",
    "unknown alias": b"a: *b\n",
    "tag": b"a: !!python/object/apply:os.system [ls]\n",
    "tagged key": b"!!int 3: x\n",
    "complex key": b"? [a, b]\n: 1\n",
    "deep": b"[" * 5000,
    "deep blocks": b"\n".join(b" " * n + b"a:" for n in range(200)),
    "huge": b"a: 1\n" * 300_000,
    "many": b"[" + b"1," * 60_000 + b"1]",
    "not UTF-8": b"name: caf\xe9\n",
    "UTF-16": "name: x\n".encode("utf-16"),
    "NUL": b"name: a\x00b\n",
    "two documents": b"model: irb120\n---\nmodel: irb120\n",
    "YAML 1.1": b"%YAML 1.1\n---\nmodel: irb120\n",
    "long number": b"name: " + b"9" * 5000 + b"\n",
    "unfinished": b"a: [1, 2\n",
    "bad escape": b'a: "\\q"\n',
    "tab": b"a:\n\tb: 1\n",
    "list": b"- model: irb120\n",
    "text": b"irb120\n",
    "bad unicode escape": b'a: "\\UFFFFFFFF"\n',
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_input_is_one_finding(tmp_path, name):
    result = faults(tmp_path, HOSTILE[name])
    assert len(result) == 1
    assert result[0].code in ("RG002", "RG003", "RG006")


def test_nothing_and_nowhere(tmp_path):
    assert [d.code for d in faults(tmp_path, "")] == ["RG013"]
    for path in (tmp_path / "none.yaml", tmp_path, f"{os.sep}a\0b.yaml"):
        assert refused(load_config, path) == ["RG001"]


def test_an_unknown_model_suggests_one(tmp_path):
    assert refused(load_config, "irb12")[0] == "RG009"
    (fault,) = faults(tmp_path, "controller: {robotware: 6.15}\nmodel: irb1201\n")
    assert fault.code == "RG009"
    assert "did you mean" in fault.help
    assert (fault.span.line, fault.span.column) == (2, 8)
    (fault,) = faults(tmp_path, "model: irb120\n", overrides=["model=irb1201"])
    assert fault.span.path == "--set model=irb1201"


@pytest.mark.parametrize("name", ["kr10", "kr120", "ur10e", "m120"])
def test_another_makers_robot_suggests_none(name):
    assert "did you mean" not in refusal(load_config, name).diagnostics[0].help


@pytest.mark.parametrize("name", ["ibr120", "irb-120", "120", "RB1200"])
def test_a_slip_in_the_letters_suggests_the_robot(name):
    assert "did you mean 'irb120" in refusal(load_config, name).diagnostics[0].help


@pytest.mark.parametrize(
    ("text", "opened", "closing"),
    [
        ("a: {b: 1\nc: 2\n", "{", "}"),
        ("a: [1, 2\n", "[", "]"),
        ('a: "one\nb: 2\n', '"', '"'),
        ("a: 'one\nb: 2\n", "'", "'"),
    ],
)
def test_unclosed_text_is_reported_at_its_start(tmp_path, text, opened, closing):
    (fault,) = faults(tmp_path, text)
    assert places([fault]) == [("RG003", 1, 4)]
    assert f"`{opened}` is opened here but not closed" in fault.message
    assert f"close it with `{closing}`" in fault.help


def test_a_misspelt_joint_is_one_finding(tmp_path):
    result = faults(tmp_path, "model: irb120\njoints: {joint_22: {upper: 90}}")
    assert places(result) == [("RG015", 2, 10)]
    assert "did you mean 'joint_2'?" in result[0].help


def test_a_joint_of_ones_own_lacks_everything_in_one_finding(tmp_path):
    (result,) = faults(tmp_path, "joints: {swing: {upper: 90}}")
    assert (result.code, result.message) == ("RG007", "joint 'swing' lacks axis, lower, speed")


def test_radians_in_the_configuration_look_odd(tmp_path):
    lines = "".join(
        f"  j{n}: {{axis: rax_{n}, lower: -2.88, upper: 2.88, speed: 250}}\n" for n in range(1, 7)
    )
    config = load(tmp_path, "joints:\n" + lines)
    assert [(d.code, d.severity) for d in config.diagnostics] == [("RG037", Severity.WARNING)]


def test_an_axis_of_length_0_turns_nothing(tmp_path):
    text = (
        "joints: {j: {axis: rax_1, lower: -90, upper: 90, speed: 9}}\n"
        "held_axes: [rax_2, rax_3, rax_4, rax_5, rax_6]\n"
        "chain: [{joint: j, axis: [0, 0, 0]}, {joint: k}]\n"
    )
    assert places(faults(tmp_path, text)) == [("RG014", 3, 20), ("RG014", 3, 46)]


@pytest.mark.parametrize("joints", ["[{name: joint_1}]", "6"])
def test_joints_that_are_no_mapping_are_one_fault(tmp_path, joints):
    """Each step of the model's chain was one more, in a file that is not the user's."""
    (result,) = faults(tmp_path, f"model: irb120_track\njoints: {joints}\n")
    assert (result.code, result.message) == ("RG006", "'joints': must be a mapping")


def test_data_have_one_name_each_and_need_the_control_port(tmp_path):
    text = (
        "model: irb120\n"
        "ports: {control: 0}\n"
        "data:\n"
        '  "cell:count": {type: num}\n'
        '  "other:COUNT": {type: bool}\n'
    )
    result = places(faults(tmp_path, text))
    assert [(code, line) for code, line, _ in result] == [("RG014", 3), ("RG014", 5)]
    basic = "model: irb120\nprofile: basic\ndata: {'cell:count': {type: num}}\n"
    assert [p[0] for p in places(faults(tmp_path, basic))] == ["RG014"]
    for name in ("count", "cell:", "cell:a b"):
        wrong = f"model: irb120\ndata: {{'{name}': {{type: num}}}}\n"
        assert places(faults(tmp_path, wrong)), name


def test_positioner_requires_an_external_axis(tmp_path):
    text = (
        "model: irb120_track\n"
        "external_units: [TRACK_1, STN_1]\n"
        "positioners:\n"
        "  STN_2: [{joint: positioner}]\n"
        "  STN_1: [{joint: joint_1}]\n"
        "  TRACK_1: [{xyz: [1, 2, 3]}]\n"
    )
    assert sorted(places(faults(tmp_path, text))) == [
        ("RG014", 4, 3), ("RG014", 5, 19), ("RG014", 6, 3)
    ]  # fmt: skip
    without = load(tmp_path, "model: irb120_track\nexternal_units: [TRACK, TABLE]\n")
    assert without.groups[0].positioners == ()  # the model's unit is not in this cell
    other = "joints: {turntable: {axis: eax_b}}\n"
    config = load(tmp_path, "model: irb120_track\n" + other)
    assert config.groups[0].positioners[0].chain[0].joint == "turntable"


def test_a_faulty_figure_is_not_also_a_missing_one(tmp_path):
    text = "model: irb120\njoints: {joint_1: {lower: x}, joint_2: {axis: rax_9}}"
    assert places(faults(tmp_path, text)) == [("RG006", 2, 27), ("RG006", 2, 47)]


@pytest.mark.parametrize(("text", "line"), [("name: a\nmodel: irb1200\n", 2), (GROUP_MODEL, 4)])
def test_unsure_figures_are_reported_at_the_model_key(tmp_path, text, line):
    path = tmp_path / "cell.yaml"
    path.write_text(text)
    (result,) = load_config(path).diagnostics
    assert (result.code, result.span.path, result.span.line) == ("RG016", str(path), line)
