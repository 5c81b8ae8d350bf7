"""Content of a plot, and its files."""

import json
import math

import numpy as np
import pytest

from rapidgen.client import Trajectory
from rapidgen.client.core.group import Group
from rapidgen.client.core.state_port import Sample
from rapidgen.client.recording import JointRecording
from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError
from rapidgen.motion.recorder import Mark, Recording
from rapidgen.viewer import plot, plotting

TIMES = np.arange(0, 4.01, 0.2)


@pytest.fixture
def built(tmp_path, monkeypatch):
    """A built page, whatever it holds."""
    (tmp_path / "assets").mkdir()
    for name in ("plot.js", "plot.css"):
        (tmp_path / "assets" / name).write_text(f"/* {name} */")
    monkeypatch.setattr(plotting, "ASSETS", tmp_path / "assets")


@pytest.fixture(scope="module")
def irb120():
    config = load_config("irb120")
    return Group.of(config, config.groups[0])


def wave(group):
    return np.stack([0.5 * np.sin(TIMES * (i + 1) / 2) for i in range(len(group.names))], axis=1)


def recorded(group, *, feedback, jitter=0.0, begins=1.0, off=0.0):
    """A recording at 10 Hz with a wave from `begins` s; `off` is an offset."""
    recording, random = JointRecording(group), np.random.default_rng(3)
    positions = wave(group)
    for n in range(60):
        now = n * 0.1
        joints = [float(np.interp(now - begins, TIMES, column)) + off for column in positions.T]
        axes = (*group.map.to_controller(joints), 0.0, 0.0, 0.0, 0.0)
        came = 100 + now + float(random.uniform(0, jitter)) if jitter else 100 + now
        if n == round(begins * 10):
            recording.accepted(came)
        recording.add(Sample(came, axes))
        if feedback:
            recording.add(Sample(came, axes, 7000 + now))
    return recording


def data_of(page):
    text = page.split('id="plot-data">')[1].split("</script>")[0]
    return json.loads(text)


def test_a_recording_by_the_controllers_clock_lies_on_what_was_commanded(irb120):
    commanded = Trajectory(TIMES, wave(irb120), irb120.names)
    late = recorded(irb120, feedback=True, jitter=0.4)
    assert late.by_controller
    assert late.times.tolist() == pytest.approx(np.arange(60) * 0.1)
    made = plot(commanded, late)
    difference = made.charts[-1]
    assert difference.title == "executed minus commanded"
    assert [curve.label for curve in difference.curves] == list(irb120.names)
    assert max(np.abs(curve.values).max() for curve in difference.curves) < 1.0
    # By the stamps of reception it is some degrees away.
    stamps = plot(commanded, recorded(irb120, feedback=False, jitter=0.4)).charts[-1]
    assert max(np.abs(curve.values).max() for curve in stamps.curves) > 5.0


def test_a_difference_is_not_fitted_away(irb120):
    commanded = Trajectory(TIMES, wave(irb120), irb120.names)
    made = plot(commanded, recorded(irb120, feedback=True, off=0.02))
    for curve in made.charts[-1].curves:
        assert np.median(curve.values) == pytest.approx(math.degrees(0.02), abs=0.2)


def test_limits_are_drawn_where_they_are_near(irb120):
    joint = irb120.joints[0]
    near = np.zeros((3, 6))
    near[:, 0] = [0, joint.upper * 0.9, 0]
    path = Trajectory([0, 1, 2], near, irb120.names)
    first, second, *_ = plot(path, group=irb120).charts
    (limit,) = [curve for curve in first.curves if curve.is_limit]
    assert limit.values.tolist() == pytest.approx([math.degrees(joint.upper)] * 2)
    assert not any(curve.is_limit for curve in second.curves)
    assert not any(curve.is_limit for chart in plot(path).charts for curve in chart.curves)


def test_metres_are_millimetres():
    path = Trajectory([0, 1], [[0.0, 0.0], [0.1, 0.1]], ("track", "turn"))
    track, turn = plot(path, linear=["track"]).charts
    assert (track.heading, turn.heading) == ("track [mm]", "turn [deg]")
    assert track.curves[0].values.tolist() == [0, 100]


def recorded_line(**more):
    """1 s at 100 mm/s, an hour at rest, 1 s back; a corner from 0.4 to 0.6 s."""
    times = np.concatenate([np.arange(0, 1.01, 0.1), np.arange(3601, 3602.01, 0.1)])
    way = np.where(times < 2, times, 3602 - times) * 0.1
    tcp = np.zeros((len(times), 7))
    tcp[:, 1] = way
    corner = tuple((times > 0.35) & (times < 0.65))
    pointers = ("",) * len(times)
    joints = way[:, None]
    given = {"actual": joints, "corner": corner, **more}
    return Recording(("a",), times + 5, joints, tcp=tcp, program_pointer=pointers,
                     motion_pointer=pointers, **given)  # fmt: skip


def test_a_simulation_shows_speed_path_corners_and_events():
    marks = (Mark(5.5, "m/main/7", "event"), Mark(6.0, "m/main/8", "stop"))
    made = plot(recorded_line(marks=marks))
    assert [chart.heading for chart in made.charts] == [
        "TCP speed [mm/s]", "a [deg]", "x [mm]", "y [mm]", "z [mm]"
    ]  # fmt: skip
    (speed,) = made.charts[0].curves
    assert speed.label == "commanded"
    moving = (speed.times > 0) & (speed.times < 1)
    assert speed.values[moving].tolist() == pytest.approx([100] * moving.sum())
    assert made.charts[0].spans == ((pytest.approx(0.4), pytest.approx(0.7)),)
    assert [note.time for note in made.charts[0].notes] == pytest.approx([0.5, 1.0])
    top, side = made.paths
    assert (top.horizontal, top.vertical, side.horizontal, side.vertical) == ("x", "y", "y", "z")
    assert side.points[:, 0].max() == pytest.approx(100)


def test_measured_joints_are_drawn_where_they_differ():
    late = recorded_line(actual=np.zeros((22, 1)))
    titles = [chart.title for chart in plot(late).charts]
    assert titles[-1] == "measured minus commanded"


def test_long_standstills_are_cut():
    made = plot(recorded_line())
    (cut,) = made.axis.cuts
    assert 1 < cut.begin < 1.1
    assert 3600.9 < cut.end < 3601
    shown = made.axis.displayed(np.array([0.0, 1.0, 3601.0, 3602.0]))
    assert shown[1] == 1
    assert shown[3] - shown[2] == pytest.approx(1)
    assert shown[2] - shown[1] == pytest.approx(0.1)
    for time in (0.5, 3601.5):
        assert made.axis.real(made.axis.displayed_one(time)) == pytest.approx(time)


@pytest.mark.parametrize("rest", [0.0, 0.9, 400.0])
def test_only_standstills_that_are_long_are_cut(rest):
    times = np.array([0.0, 1.0, 2.0, 2.0 + rest, 3.0 + rest])
    places = np.array([0.0, 1.0, 1.5, 1.5, 2.0])
    keep = np.concatenate([[True], np.diff(times) > 0])
    cuts = plot(Trajectory(times[keep], places[keep, None], ("a",))).axis.cuts
    assert len(cuts) == (1 if rest > 100 else 0)


def test_a_page_has_all_curves_on_one_time(built, tmp_path, irb120):
    commanded = Trajectory(TIMES, wave(irb120), irb120.names)
    made = plot(commanded, recorded(irb120, feedback=True))
    page = made.save(tmp_path / "p.html").read_text()
    assert "/* plot.js */" in page
    assert "http" not in page
    data = data_of(page)
    assert data["time"] == sorted(set(data["time"]))
    assert len(data["charts"]) == 7
    for chart in data["charts"]:
        for curve in chart["curves"]:
            assert len(curve["values"]) == len(data["time"])
    assert "srcdoc" in made._repr_html_()


def test_a_page_has_cut_times_paths_and_marks(built):
    page = plot(recorded_line(marks=(Mark(5.5, "</script>", "late"),))).html()
    data = data_of(page)
    assert data["time"][-1] == pytest.approx(2.1)
    assert data["cuts"] == [[pytest.approx(1.05), pytest.approx(3599.9)]]
    assert data["charts"][0]["marks"] == [[0.5, "</script>", "late"]]
    assert page.count("<svg") == 2
    assert "red: a corner became a stop (50024)" in page


def test_names_that_want_out_stay_in(built):
    path = Trajectory([0, 1], [[0.0], [1.0]], ("</script><b>",))
    page = plot(path, title="<i>").html()
    assert "</script><b>" not in page
    assert "<i>" not in page
    assert data_of(page)["charts"][0]["title"] == "</script><b>"


def test_long_recordings_are_thinned_and_keep_what_sticks_out(built):
    times = np.arange(200_000) * 0.01
    values = np.sin(times)[:, None]
    values[123_456] = 9.0
    values[5] = np.nan
    page = plot(Trajectory(times, values, ("a",))).html()
    assert len(page) < 200_000
    assert "515.662" in page


@pytest.mark.parametrize(
    ("kind", "head"), [("png", b"\x89PNG\r\n\x1a\n"), ("svg", b"<?xml")], ids=["png", "svg"]
)
@pytest.mark.parametrize("count", [0, 1, 3])
def test_pictures(tmp_path, kind, head, count):
    path = Trajectory(np.arange(count), np.zeros((count, 2)), ("$_a", "b"))
    drawn = plot(path).save(tmp_path / f"p.{kind}").read_bytes()
    assert drawn.startswith(head)


@pytest.mark.parametrize(
    ("name", "code"), [("p.pdf", "RG626"), ("p", "RG626"), ("p.png", "RG626"), ("p.html", "RG920")]
)
def test_what_cannot_be_written_is_refused(tmp_path, monkeypatch, name, code):
    monkeypatch.setattr(plotting, "ASSETS", tmp_path / "none")
    monkeypatch.setattr(plotting, "_has_matplotlib", lambda: False)
    with pytest.raises(DiagnosticError) as error:
        plot(Trajectory([0], [[0.0]])).save(tmp_path / name)
    assert error.value.diagnostics[0].code == code
    assert not list(tmp_path.iterdir())


def test_plot_of_other_type_is_rejected():
    with pytest.raises(TypeError, match="not str"):
        plot("path.csv")
