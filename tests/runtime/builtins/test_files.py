"""Files. Sources: S4 reference, pages Open to ReadBin [manual]."""

import gc
import os
import tempfile
from multiprocessing import get_context

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.machine.files import Directory, FileSystem, IODevice
from rapidgen.proving.workers import in_a_fork
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import RawBytes
from rapidgen.runtime.values import Pos


@pytest.fixture
def disk(bench):
    """HOME: as a path of this machine."""
    return bench.controller.files.folder / "HOME"


def lines(bench, device, count, **options):
    return [bench("ReadStr", device, **options) for _ in range(count)]


def test_write_and_read_back(bench, disk):
    device = IODevice()
    bench("Open", "HOME:", device, File="log.txt", Write=True)
    bench("Write", device, "n=", Num=0.25)
    bench("Write", device, "p=", Pos=Pos(1, 2, 3), NoNewLine=True)
    bench("Write", device, "")
    bench("Close", device)
    assert (disk / "log.txt").read_bytes() == b"n=0.25\np=[1,2,3]\n"
    bench("Open", "HOME:/log.txt", device, Read=True)
    assert lines(bench, device, 3) == ["n=0.25", "p=[1,2,3]", "EOF"]


def test_open_without_a_mode_empties_the_file(bench, disk):
    """S4 Open: no switch means \\Write."""
    (disk / "a").write_text("old")
    bench("Open", "HOME:/a", IODevice())
    assert (disk / "a").read_text() == ""


def test_open_without_a_mode_reads_in_the_other_dialect(bench, disk):
    (disk / "a").write_text("old")
    bench.controller.dialect = Switches(open_default="read")
    device = IODevice()
    bench("Open", "a", device)
    assert bench("ReadStr", device) == "old"


def test_append(bench, disk):
    (disk / "a").write_text("old")
    device = IODevice()
    bench("Open", "a", device, Append=True)
    bench("Write", device, "new")
    assert (disk / "a").read_text() == "oldnew\n"


def test_bin_alone_reads_and_writes_from_the_end(bench, disk):
    (disk / "a").write_bytes(b"ab")
    device = IODevice()
    bench("Open", "HOME:/a", device, Bin=True)
    assert bench("ReadBin", device) == -1
    bench("WriteBin", device, {1: 99, 2: 100, 3: 7}, 2)
    bench("WriteStrBin", device, "e")
    bench("Rewind", device)
    assert [bench("ReadBin", device) for _ in range(6)] == [97, 98, 99, 100, 101, -1]


def test_a_long_line_comes_in_pieces(bench, disk):
    (disk / "a").write_text("x" * 100 + "\nshort\n")
    device = IODevice()
    bench("Open", "a", device, Read=True)
    assert lines(bench, device, 4) == ["x" * 80, "x" * 20, "short", "EOF"]


def test_delimiters_and_carriage_returns(bench, disk):
    (disk / "a").write_bytes(b";;a;b\r\nc")
    device = IODevice()
    bench("Open", "a", device, Read=True)
    assert bench("ReadStr", device, Delim=";", DiscardHeaders=True) == "a"
    assert bench("ReadStr", device, RemoveCR=True) == "b"
    assert bench("ReadStr", device) == "c"
    status = bench.box(0)
    assert bench("ReadStr", device, Line=2, Status=status) == "c"
    assert status.get() == 0
    assert bench("ReadStr", device, Line=9, Status=status) == "EOF"
    assert status.get() == -1


def test_numbers(bench, disk):
    (disk / "a").write_text("12.5\n abc\n")
    device = IODevice()
    bench("Open", "a", device, Read=True)
    assert bench("ReadNum", device) == 12.5
    with pytest.raises(RapidError) as caught:
        bench("ReadNum", device)
    assert caught.value.name == "ERR_RCVDATA"
    assert bench("ReadNum", device) > 9.998e36


def test_raw_bytes_and_strings_of_bytes(bench):
    device, raw = IODevice(), RawBytes()
    bench("Open", "a", device, Write=True, Bin=True)
    bench("WriteRawBytes", device, RawBytes(b"hello"), NoOfBytes=4)
    bench("Close", device)
    bench("Open", "a", device, Read=True, Bin=True)
    assert bench("ReadStrBin", device, 2) == "he"
    bench("ReadRawBytes", device, raw)
    assert raw.data == b"ll"
    assert bench("ReadStrBin", device, 2) == "EOF"


def test_any_value_reads_back_and_another_type_does_not(bench):
    device, target = IODevice(), bench.box(Pos(0, 0, 0), Pos.rapid_type)
    bench("Open", "a", device, Write=True, Bin=True)
    bench("WriteAnyBin", device, bench.box(Pos(1, 2.5, 3), Pos.rapid_type))
    bench("WriteAnyBin", device, bench.box("text"))
    bench("Close", device)
    bench("Open", "a", device, Read=True, Bin=True)
    bench("ReadAnyBin", device, target)
    assert target.get() == Pos(1, 2.5, 3)
    for wanted, error in ((bench.box(0), "ERR_RANYBIN_CHK"), (bench.box(0), "ERR_RANYBIN_EOF")):
        with pytest.raises(RapidError) as caught:
            bench("ReadAnyBin", device, wanted)
        assert caught.value.name == error


@pytest.mark.parametrize(
    ("name", "mode", "args"),
    [
        ("ReadStr", {"Write": True}, ()),
        ("Write", {"Read": True}, ("x",)),
        ("ReadBin", {"Read": True}, ()),
        ("WriteStrBin", {"Write": True}, ("x",)),
    ],
)
def test_the_wrong_mode(bench, disk, name, mode, args):
    (disk / "a").write_text("text")
    device = IODevice()
    bench("Open", "a", device, **mode)
    with pytest.raises(RapidError) as caught:
        bench(name, device, *args)
    assert caught.value.name == "ERR_FILEACC"


def test_what_is_not_there(bench):
    with pytest.raises(RapidError) as caught:
        bench("Open", "none", IODevice(), Read=True)
    assert caught.value.name == "ERR_FILEOPEN"
    for name in ("FileSize", "FileTime", "RemoveFile", "RemoveDir"):
        with pytest.raises(RapidError) as caught:
            bench(name, "none")
        assert caught.value.name == "ERR_FILEACC"
    with pytest.raises(RapidError):
        bench("ReadStr", IODevice())
    bench("Close", IODevice())


# -- no way out -----------------------------------------------------------------------------


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
def test_what_lies_nowhere_is_an_error_not_a_fault(bench, disk, name):
    os.symlink(disk / "loop", disk / "loop")
    for call in (
        lambda: bench("Open", name, IODevice(), Write=True),
        lambda: bench("IsFile", name),
        lambda: bench("RemoveFile", name),
    ):
        with pytest.raises(RapidError) as caught:
            call()
        assert caught.value.name == "ERR_FILEACC"


def test_what_is_no_regular_file_is_not_opened(bench, disk):
    """A pipe would hold the whole controller up."""
    os.mkfifo(disk / "pipe")
    (disk / "folder").mkdir()
    for name in ("pipe", "folder", "HOME:"):
        for mode in ("Read", "Write", "Append"):
            with pytest.raises(RapidError) as caught:
                bench("Open", name, IODevice(), **{mode: True})
            assert caught.value.name == "ERR_FILEOPEN"


def test_names_that_no_string_can_hold_are_shown_with_question_marks(bench, disk):
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
    bench.controller.files._room = 10
    device = IODevice()
    bench("Open", "a", device, Write=True)
    bench("Write", device, "12345")
    with pytest.raises(RapidError) as caught:
        bench("Write", device, "12345")
    assert caught.value.name == "ERR_FILEACC"


def test_opening_again_closes_what_was_open(bench):
    """A device that is opened 70 times in a row holds one file, not 70."""
    device = IODevice()
    for i in range(70):
        bench("Open", f"f{i}", device)
    bench("Write", device, "x")
    assert bench("FileSize", "f69") == 2


def test_too_many_open_files(bench):
    devices = [IODevice() for _ in range(65)]
    for i, device in enumerate(devices[:64]):
        bench("Open", f"f{i}", device)
    with pytest.raises(RapidError) as caught:
        bench("Open", "f64", devices[64])
    assert caught.value.name == "ERR_FILEOPEN"
    bench.controller.files.close_task("T1")
    bench("Open", "f64", devices[64])


# -- folders --------------------------------------------------------------------------------


def test_folders(bench):
    bench("MakeDir", "HOME:/d")
    bench("Open", "HOME:/d/one", IODevice())
    device, name = Directory(), bench.box("")
    bench("OpenDir", device, "HOME:/d")
    names = []
    while bench("ReadDir", device, name):
        names.append(name.get())
    assert names == [".", "..", "one"]
    bench("CloseDir", device)
    with pytest.raises(RapidError):
        bench("ReadDir", device, name)
    with pytest.raises(RapidError):
        bench("RemoveDir", "HOME:/d")
    bench("RemoveFile", "HOME:/d/one")
    bench("RemoveDir", "HOME:/d")
    assert bench("IsFile", "HOME:/d") is False
    with pytest.raises(RapidError):
        bench("RemoveDir", "HOME:")


def test_copy_and_rename_do_not_overwrite(bench, disk):
    (disk / "a").write_text("1")
    bench("CopyFile", "a", "TEMP:/b")
    assert bench("FileSize", "TEMP:/b") == 1
    bench("RenameFile", "a", "c")
    assert not (disk / "a").exists()
    (disk / "d").write_text("2")
    for name in ("CopyFile", "RenameFile"):
        with pytest.raises(RapidError) as caught:
            bench(name, "c", "d")
        assert caught.value.name == "ERR_FILEEXIST"


def test_times_are_the_controllers_own(bench):
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


def test_what_a_fork_made_goes_with_it(tmp_path, monkeypatch):
    """A copy that ends by `os._exit`, with files open and nothing closed."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    disks = FileSystem()
    disks.path("HOME:/parent").write_text("x")

    def work():
        left = FileSystem()
        left.path("HOME:/a").write_text("x")
        kept.append(left)
        return len(os.listdir(tmp_path))

    kept = []
    assert in_a_fork(work) == 2
    assert os.listdir(tmp_path) == [disks.folder.name]
    assert disks.path("HOME:/parent").is_file()
    disks.close()
    assert os.listdir(tmp_path) == []


def test_a_controller_that_touches_no_file_makes_no_folder(tmp_path, monkeypatch):
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
