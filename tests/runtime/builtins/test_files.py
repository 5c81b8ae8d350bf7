"""Files: no access outside, limits, separate folders.

Programs that read files: conformance/.
"""

import gc
import os
import tempfile
from multiprocessing import get_context

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.machine.files import Directory, FileSystem, IODevice
from rapidgen.runtime.errors import RapidError
from rapidgen.verification.worker_pool import run_in_fork


@pytest.fixture
def disk(bench):
    """HOME: as a path of this machine."""
    return bench.controller.files.folder / "HOME"


def test_a_line_by_its_number(bench, disk):
    (disk / "a").write_bytes(b"b\nc")
    device = IODevice()
    bench("Open", "a", device, Read=True)
    for line, text in ((2, "c"), (9, "EOF"), (1, "b")):
        assert bench("ReadStr", device, Line=line) == text


@pytest.mark.parametrize(
    "path",
    [
        "HOME:/../../etc/passwd",
        "HOME:..",
        "../secret",
        "/etc/passwd",
        "\\etc\\passwd",
        "C:/secret",
        "HOME:/a/../../TEMP/x",
        "HOME:/a\0b",
        "TEMP:/../HOME/x",
        "nodisk:/x",
    ],
)
def test_no_path_leads_out(bench, path):
    with pytest.raises(RapidError) as caught:
        bench("Open", path, IODevice(), Write=True)
    assert caught.value.name == "ERR_FILEACC"


def test_no_link_leads_out(bench, disk, tmp_path):
    (tmp_path / "secret").write_text("x")
    os.symlink(tmp_path, disk / "out")
    with pytest.raises(RapidError) as caught:
        bench("Open", "HOME:/out/secret", IODevice(), Read=True)
    assert caught.value.name == "ERR_FILEACC"


@pytest.mark.parametrize("name", ["loop", "x" * 300])
def test_path_outside_disks_is_rapid_error(bench, disk, name):
    os.symlink(disk / "loop", disk / "loop")
    for call in (
        lambda: bench("Open", name, IODevice(), Write=True),
        lambda: bench("IsFile", name),
        lambda: bench("RemoveFile", name),
    ):
        with pytest.raises(RapidError) as caught:
            call()
        assert caught.value.name == "ERR_FILEACC"


def test_special_file_is_not_opened(bench, disk):
    """A pipe would hold the whole controller up."""
    os.mkfifo(disk / "pipe")
    (disk / "folder").mkdir()
    for name in ("pipe", "folder", "HOME:"):
        for mode in ("Read", "Write", "Append"):
            with pytest.raises(RapidError) as caught:
                bench("Open", name, IODevice(), **{mode: True})
            assert caught.value.name == "ERR_FILEOPEN"


def test_unrepresentable_names_have_question_marks(bench, disk):
    (disk / "\u65e5\u672c.txt").write_text("x")
    folder, name = Directory(), bench.box("")
    bench("OpenDir", folder, "HOME:")
    while bench("ReadDir", folder, name) and name.get() in (".", ".."):
        pass
    assert name.get() == "??.txt"


def test_home_is_a_copy_without_links(tmp_path):
    source = tmp_path / "home"
    source.mkdir()
    (source / "keep.txt").write_text("x")
    os.symlink(tmp_path, source / "link")
    files = FileSystem(home=source)
    files.path("HOME:/keep.txt").write_text("changed")
    assert not (files.folder / "HOME" / "link").exists()
    assert (source / "keep.txt").read_text() == "x"
    files.close()
    assert not files.folder.exists()


def test_dots_inside_a_disk_and_names_without_case(bench, disk):
    (disk / "Sub").mkdir()
    (disk / "Sub" / "File.TXT").write_text("x")
    assert bench("IsFile", "home:/sub/../SUB/./file.txt") is True


def test_a_full_disk(bench, monkeypatch):
    bench.controller.files._free = 10
    device = IODevice()
    bench("Open", "a", device, Write=True)
    bench("Write", device, "12345")
    with pytest.raises(RapidError) as caught:
        bench("Write", device, "12345")
    assert caught.value.name == "ERR_FILEACC"


def test_reopening_closes_device(bench):
    """A device that is opened 70 times in a row holds one file, not 70."""
    device = IODevice()
    for i in range(70):
        bench("Open", f"f{i}", device)
    bench("Write", device, "x")
    assert bench("FileSize", "f69") == 2


def test_too_many_open_files_raise_error(bench):
    devices = [IODevice() for _ in range(65)]
    for i, device in enumerate(devices[:64]):
        bench("Open", f"f{i}", device)
    with pytest.raises(RapidError) as caught:
        bench("Open", "f64", devices[64])
    assert caught.value.name == "ERR_FILEOPEN"
    bench.controller.files.close_task("T1")
    bench("Open", "f64", devices[64])


def test_file_times_are_controller_times(bench):
    device, digits = IODevice(), bench.box("")
    bench("Open", "a", device)
    bench("Close", device)
    bench("FileTime", "a", ModifyTime=True, StrDig=digits)
    first = int(digits.get())

    def later(task):
        task.sleep(100)
        bench.call(task, "Open", "a", device)
        bench.call(task, "Close", device)
        bench.call(task, "FileTime", "a", ModifyTime=True, StrDig=digits)

    bench.run(later)
    assert int(digits.get()) - first == pytest.approx(100, abs=1)


def test_scratch_folder_goes_with_its_controller():
    disks = FileSystem()
    folder = disks.folder
    assert folder.is_dir()
    del disks
    gc.collect()
    assert not folder.exists()


def test_scratch_folder_of_fork_is_removed(tmp_path, monkeypatch):
    """A copy that ends by `os._exit`, with files open and nothing closed."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    disks = FileSystem()
    disks.path("HOME:/parent").write_text("x")

    def work():
        left = FileSystem()
        left.path("HOME:/a").write_text("x")
        saved.append(left)
        return len(os.listdir(tmp_path))

    saved = []
    assert run_in_fork(work) == 2
    assert os.listdir(tmp_path) == [disks.folder.name]
    assert disks.path("HOME:/parent").is_file()
    disks.close()
    assert os.listdir(tmp_path) == []


def test_controller_without_files_creates_no_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with VirtualController.from_config("irb120") as controller:
        controller.run_for(1.0)
        assert controller.tasks["T_ROB1"].state == "running"
        assert os.listdir(tmp_path) == []


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_forked_copy_leaves_the_folder():
    disks = FileSystem()
    child = get_context("fork").Process(target=disks.close)
    child.start()
    child.join()
    assert child.exitcode == 0
    assert disks.folder.is_dir()
    disks.close()
    assert not disks.folder.exists()
