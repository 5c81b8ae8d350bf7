"""From an empty controller to a moved robot: deploy over FTP, boot what lies there, obey.

And what the fence is for, on the virtual controller: a set that was cut does not move.
"""

import json
import shutil
import threading

import pytest

from rapidgen.cli.driver_query import hello
from rapidgen.client import Robot, RobotError, Trajectory
from rapidgen.client.address import Address
from rapidgen.config import load_config
from rapidgen.controller import VirtualController
from rapidgen.deploy import Access, TransportFault, apply, connect, make_plan, parse_target
from rapidgen.deploy.command_run import desired_set
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.servers import serve_ftp, serve_sftp
from rapidgen.wire.simple_message.spec import TriState
from tests.refusal import refused


def booted(home, folder, **options):
    """A controller that starts with this HOME, its operator having loaded the cfg files.

    What a person does at the pendant is done here by putting the files where a start reads them.
    """
    state = home / "rapidgen_deploy"
    manifest = json.loads((state / "manifest.json").read_bytes())["generated"]
    folder.mkdir()
    shutil.copytree(home, folder / "HOME")
    for name in ("SYS.cfg", "EIO.cfg"):
        (folder / name).write_bytes((state / name).read_bytes())
    (folder / "manifest.json").write_text(json.dumps({**manifest, "lines": {}}))
    return VirtualController.from_folder(folder, **options)


@pytest.mark.parametrize("serve", [serve_ftp, serve_sftp])
def test_from_an_empty_controller_to_a_moved_robot(serve, home, tmp_path, monkeypatch):
    service = serve(home)
    monkeypatch.setenv("RAPIDGEN_PASSWORD", service.password)
    (tmp_path / "known").write_text(service.host_key + "\n")
    scheme = "ftp" if serve is serve_ftp else "sftp"
    target = parse_target(f"{scheme}://Default%20User@{service.host}:{service.port}")
    wanted = desired_set("irb120")
    transport = connect(target, Access(known_hosts=str(tmp_path / "known")))
    apply(transport, make_plan(transport, wanted))
    transport.close()
    service.close()
    with booted(home, tmp_path / "boot", clock="real", ports="auto") as controller:
        wanted_place, place = drive(controller)
        state = controller.network.listeners[11002][1]
        assert hello("127.0.0.1", state) == wanted.build_id
    assert place == pytest.approx(wanted_place, abs=1e-3)


def drive(controller, *, ready=True):
    """Move joint 1 by 0.2 rad: where it should be, and where it is."""
    model = load_config("irb120")
    group = model.groups[0]
    network, listening = controller.network, threading.Event()

    def look():
        if {group.ports.motion, group.ports.state} <= set(network.listeners):
            listening.set()

    network.listening.add(look)
    controller.start()
    assert listening.wait(60), controller.call(controller.where)
    motion, state = (network.listeners[p][1] for p in (group.ports.motion, group.ports.state))
    with Robot(model, address=Address("127.0.0.1", motion, state), group=group.name) as robot:
        start = robot.state.joints
        goal = [start[0] + 0.2, *start[1:]]
        if ready:
            robot.wait_until(lambda s: s.status.motion_possible is TriState.TRUE, 20)
        robot.execute(Trajectory([0.0, 1.0], [start, goal], robot.group.names)).result(20)
        reached = controller.call(controller.motion.group(group.name).positions)
    return goal[0], reached[0]


class Cut(FolderTransport):
    """A folder whose line is cut at the n-th rename."""

    def __init__(self, root, renames):
        super().__init__(root)
        self.left = renames

    def rename(self, old, new):
        if not new.endswith("probe.two"):
            self.left -= 1
        if self.left < 0:
            raise TransportFault("lost", "cut")
        super().rename(old, new)


@pytest.mark.parametrize("renames", [0, 1, 3])
def test_a_set_that_was_cut_refuses_to_move(home, tmp_path, renames):
    """0: the old set, which moves; 1: the fence alone; 3: the fence and two new modules."""
    old, new = desired_set("irb120"), desired_set("irb120", ["trajectory.capacity=500"])
    transport = FolderTransport(home)
    apply(transport, make_plan(transport, old))
    cut = Cut(home, renames)
    plan = make_plan(cut, new)
    assert "RG527" in refused(apply, cut, plan)
    with booted(home, tmp_path / "boot", clock="real", ports="auto") as controller:
        where = controller.motion.group("rob1").positions()
        if renames == 0:
            drive(controller)
        else:
            with pytest.raises(RobotError, match="motion is not possible"):
                drive(controller, ready=False)
            assert controller.call(controller.motion.group("rob1").positions) == where
        texts = " ".join(controller.call(lambda: [event.title for event in controller.log]))
    assert ("different builds" in texts) == (renames > 0)
    apply(transport, make_plan(transport, new))
    with booted(home, tmp_path / "again", clock="real", ports="auto") as controller:
        wanted_place, place = drive(controller)
    assert place == pytest.approx(wanted_place, abs=1e-3)
