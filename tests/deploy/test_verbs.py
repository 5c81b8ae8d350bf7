"""plan, deploy, rollback, uninstall and doctor as commands."""

import io
import json
import re
import signal
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
import typer

from rapidgen.cli.deployment import deploy, doctor, plan, rollback, uninstall
from rapidgen.deploy import TransportFault, parse_target
from rapidgen.deploy.driver_set import NEW as STAGED
from rapidgen.deploy.fleet import Interruption, on_all, parse_targets
from rapidgen.deploy.secrets import Credentials, Secret, find_password, redact
from rapidgen.deploy.transports.folder import FolderTransport
from rapidgen.deploy.transports.transport import FILE_LIMIT
from rapidgen.diagnostics import DiagnosticError, render
from rapidgen.servers import serve_ftp, serve_sftp
from tests.generate.cell_backup import write_backup
from tests.ports import free_port
from tests.refusal import refusal, refused

OLD, NEW = "aaaaaaaaaaaa", "bbbbbbbbbbbb"
VERBS = (plan, deploy, rollback, uninstall, doctor)


@pytest.fixture
def run(capsys):
    """Run a verb: exit code, stdout, stderr with diagnostics as the command shows them."""
    app = typer.Typer(pretty_exceptions_enable=False)
    for verb in VERBS:
        app.command(verb.__name__)(verb)
    command = typer.main.get_command(app)

    def run_(*text):
        displayed = ""
        try:
            code = command.main(args=[str(w) for w in text], standalone_mode=False)
        except DiagnosticError as error:
            code, displayed = error.exit_code, render(error.diagnostics)
        message = capsys.readouterr()
        return code or 0, message.out, message.err + displayed

    return run_


@pytest.fixture
def built(kit, tmp_path):
    """Generated folders of two builds."""

    def write(build, **options):
        folder = tmp_path / f"out-{build}"
        for path, data in kit.driver_files(build, **options).items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(data)
        return folder

    return write


def test_plan_then_exactly_that_plan(run, built, home, tmp_path, kit):
    url, file = f"dir://{home}", tmp_path / "plan.json"
    code, out, _ = run("plan", built(OLD), "--to", url, "--detailed-exitcode", "--output", file)
    assert code == 2
    assert "  + HOME:/rapidgen: " in out
    assert "Plan: 6 to add, 0 to change, 0 to remove." in out
    assert run("plan", built(OLD), "--to", url)[0] == 0
    assert json.loads(file.read_text())["plans"][0]["name"] == "cell1"
    code, _, err = run("deploy", built(NEW), "--to", url, "--plan", file, "--yes")
    assert (code, "RG523" in err) == (1, True)
    code, out, _ = run("deploy", built(OLD), "--to", url, "--plan", file, "--yes")
    assert (code, out) == (0, f"{url}  done      6 files, build {OLD}\n")
    assert kit.verdict(home, kit.driver(OLD)) == "set 0"
    assert run("plan", built(OLD), "--to", url, "--detailed-exitcode")[0] == 0
    code, _, err = run("deploy", built(OLD), "--to", url, "--plan", file, "--yes")
    assert (code, "RG522" in err) == (1, True)
    code, _, err = run("plan", built(OLD), "--to", "dir:///nowhere", "--detailed-exitcode")
    assert (code, "RG506" in err) == (1, True)


def test_a_plan_is_short_and_tells_what_was_configured_otherwise(run, home):
    url = ("--to", f"dir://{home}")
    out = run("plan", "irb120", *url)[1]
    assert len(out.splitlines()) <= 25
    assert re.search(r"HOME:/rapidgen: \d+ files, new, ", out)
    assert "  + SYS: CAB_TASKS T_ROS_RECV, T_ROS_SUP, T_ROS_CONTROL, T_ROS_STATE\n" in out
    assert run("deploy", "irb120", *url, "--yes")[0] == 0
    out = run("plan", "irb120", *url, "--set", "state.rate=20")[1]
    assert len(out.splitlines()) <= 25
    assert "  ~ state.rate: 10 → 20\n" in out
    assert "  ~ HOME:/rapidgen/ROS_stateServer.mod   +3 -3\n" in out
    assert "files, only the build's id\n" in out


def test_changed_keys_use_units_of_the_configuration(run, home):
    url = ("--to", f"dir://{home}")
    assert run("deploy", "irb120", *url, "--yes")[0] == 0
    changed = ("joints.joint_2.upper=90", "trajectory.start_tolerance=0.3", "ports.motion=12000")
    out = run("plan", "irb120", *url, *(word for key in changed for word in ("--set", key)))[1]
    text = [line for line in out.splitlines() if "→" in line]
    assert text == [
        "  ~ joints.joint_2.upper: 110 → 90",
        "  ~ ports.motion: 11000 → 12000",
        "  ~ trajectory.start_tolerance: 0.5 → 0.3",
    ]


def test_lines_of_files_are_shown_where_more_than_the_builds_id_differs(run, home):
    url = ("--to", f"dir://{home}")
    assert run("deploy", "irb120", *url, "--yes")[0] == 0
    out = run("plan", "irb120", *url, "--set", "state.rate=20", "--diff")[1]
    files = re.findall(r"^\+\+\+ (.*)$", out, re.MULTILINE)
    assert files == ["HOME:/rapidgen/ROS_server.sys", "HOME:/rapidgen/ROS_stateServer.mod"]
    assert len(re.findall(r"^[-+] ", out, re.MULTILINE)) >= 2


def test_plan_of_fleet_shows_common_parts_once(run, tmp_path):
    homes = [tmp_path / f"c{n}" for n in range(6)]
    for home in homes:
        home.mkdir()
    assert run("deploy", "irb120", "--to", f"dir://{homes[0]}", "--yes")[0] == 0
    urls = [word for home in homes for word in ("--to", f"dir://{home}")]
    out = run("plan", "irb120", *urls)[1]
    assert len(out.splitlines()) <= 40
    assert f"dir://{homes[1]} and 4 more controllers, alike\n" in out
    assert out.count("  + SYS: CAB_TASKS ") == 1
    summary, first, second = out.splitlines()[-7:-4]
    assert summary == "6 controllers:"
    assert (first.split()[1:], second.split()[1:]) == (
        ["nothing", "to", "do."],
        ["12", "to", "add,", "0", "to", "change,", "0", "to", "remove."],
    )


def test_a_plan_is_json_where_that_was_asked_for(run, home):
    text = json.loads(run("plan", "irb120", "--to", f"dir://{home}", "--json")[1])
    assert [plan["target"] for plan in text] == [f"dir://{home}"]
    assert {file["action"] for file in text[0]["files"]} == {"add"}


def test_what_became_of_controllers_is_json_where_that_was_asked_for(run, built, home, monkeypatch):
    url = f"dir://{home}"
    words = ("deploy", built(OLD), "--to", url, "--yes", "--json")
    for result in ("done", "same"):
        code, out, _ = run(*words)
        text = json.loads(out)
        assert (code, text["errors"]) == (0, [])
        assert [(c["target"], c["result"]) for c in text["controllers"]] == [(url, result)]
    rows = json.loads(run("rollback", built(OLD), "--to", url, "--list", "--json")[1])
    assert rows == []

    def full(self, path, data):
        raise TransportFault("full", "no room")

    monkeypatch.setattr(FolderTransport, "write", full)
    code, out, _ = run("deploy", built(NEW), "--to", url, "--yes", "--json")
    text = json.loads(out)
    assert (code, text["controllers"][0]["result"]) == (1, "failed")
    assert [found["code"] for found in text["errors"]] == ["RG507"]
    assert text["controllers"][0]["errors"] == text["errors"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_ends_before_files_are_switched_and_tells_what_stands(
    run, built, kit, tmp_path, monkeypatch, number
):
    """The first controller is done, the second unchanged, the third waits."""
    homes = [tmp_path / f"c{n}" for n in range(3)]
    for home in homes:
        home.mkdir()
    received, complete, begin = threading.Event(), FolderTransport.write, Interruption.begin
    handled = []

    def write(self, path, data):
        complete(self, path, data)
        if path.endswith(STAGED) and self._root == homes[1] and not received.is_set():
            # What is raised anywhere in the main thread may be raised between two waits.
            handled.append(signal.getsignal(number))
            signal.pthread_kill(threading.main_thread().ident, number)
            assert received.wait(60)

    def text(self):
        begin(self)
        received.set()

    monkeypatch.setattr(FolderTransport, "write", write)
    monkeypatch.setattr(Interruption, "begin", text)
    urls = [word for home in homes for word in ("--to", f"dir://{home}")]
    code, out, err = run("deploy", built(OLD), *urls, "--yes", "--parallel", "1")
    assert code == 130
    assert kit.verdict(homes[0], kit.driver(OLD)) == "set 0"
    assert [list(home.iterdir()) for home in homes[1:]] == [[], []]
    words = [line.split()[1:3] for line in out.splitlines()]
    assert words == [["done", "6"], ["given", "up"], ["not", "begun"]]
    assert "interrupted: switching ends first" in err
    assert len(handled) == 1
    assert handled[0] not in (signal.default_int_handler, signal.SIG_DFL)


def test_an_interruption_begins_nothing_more_wherever_it_comes(monkeypatch):
    """Leaving a pool begins what was handed in."""
    started, text = [], threading.Event()
    hand_in, begin = ThreadPoolExecutor.submit, Interruption.begin

    def work(target):
        started.append(target)
        text.wait(30)

    def submit(pool, guarded, target):
        if target == "third":
            raise KeyboardInterrupt
        return hand_in(pool, guarded, target)

    def tells(self):
        begin(self)
        text.set()

    monkeypatch.setattr(Interruption, "begin", tells)
    monkeypatch.setattr(ThreadPoolExecutor, "submit", submit)
    with pytest.raises(KeyboardInterrupt):
        on_all(["first", "second", "third"], work, parallel=1)
    assert started == ["first"]


def test_confirmation_without_terminal_is_refused(run, built, home, monkeypatch):
    class NoTerminal:
        def isatty(self):
            return False

    monkeypatch.setattr("sys.stdin", NoTerminal())
    code, _, err = run("deploy", built(OLD), "--to", f"dir://{home}")
    assert (code, "RG533" in err) == (2, True)
    assert list(home.iterdir()) == []


def test_rollback_lists_and_restores_and_uninstall_saves_edits(
    run, built, home, kit, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    url = f"dir://{home}"
    run("deploy", built(OLD), "--to", url, "--yes")
    code, out, err = run("rollback", built(OLD), "--to", url, "--list")
    assert (code, out, err) == (0, "", f"{url}  no backup of cell1\n")
    code, _, err = run("rollback", built(OLD), "--to", url, "--yes")
    assert (code, "RG528" in err) == (1, True)
    run("deploy", built(NEW), "--to", url, "--yes")
    code, out, _ = run("rollback", built(NEW), "--to", url, "--list")
    assert code == 0
    assert out.startswith(f"{url}  2  20")
    assert out.endswith(f"build {OLD}\n")
    assert run("rollback", built(NEW), "--to", url, "--yes")[0] == 0
    assert kit.verdict(home, kit.driver(OLD)) == "set 0"
    assert run("rollback", built(NEW), "99", "--to", url, "--yes")[0] == 1
    (home / "rapidgen/ROS_motion.mod").write_text("mine")
    code, _, err = run("uninstall", built(NEW), "--to", url, "--yes")
    assert (code, "RG520" in err) == (1, True)
    code, _, err = run("uninstall", built(NEW), "--to", url, "--yes", "--overwrite")
    assert code == 0
    assert list(home.iterdir()) == []
    (retained,) = (tmp_path / ".rapidgen").rglob("ROS_motion.mod")
    assert retained.read_text() == "mine"


def test_several_controllers_stop_at_the_first_failure(run, built, tmp_path, kit):
    homes = [tmp_path / f"h{n}" for n in range(4)]
    for home in homes:
        home.mkdir()
    listed = tmp_path / "list.txt"
    listed.write_text("# cells\n" + "".join(f"dir://{home}\n" for home in homes))
    (homes[1] / "rapidgen_deploy").write_text("in the way")
    code, out, err = run("deploy", built(OLD), "--to", f"@{listed}", "--yes", "--parallel", "1")
    assert code == 1
    assert "RG506" in err
    assert [line.split()[1] for line in out.splitlines()] == ["done", "failed", "not", "not"]
    assert [list(h.iterdir()) for h in homes[2:]] == [[], []]
    (homes[1] / "rapidgen_deploy").unlink()
    code, out, _ = run("deploy", built(OLD), "--to", f"@{listed}", "--yes")
    assert code == 0
    assert [line.split()[1] for line in out.splitlines()] == ["same", "done", "done", "done"]
    code, _, err = run("deploy", built(NEW), "--to", "dir:///nowhere", "--to", f"@{listed}", "-y")
    assert (code, "RG506" in err) == (1, True)  # found while planning: nothing is changed anywhere
    assert [kit.verdict(h, kit.driver(OLD)) for h in homes] == ["set 0"] * 4


def test_doctor(run, built, home):
    (home / "theirs.mod").write_text("MODULE ROS_motion\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    code, out, _ = run("doctor", built(OLD), "--to", f"dir://{home}", "--json")
    checks = {c["area"]: c for c in json.loads(out)}
    assert code == 1
    assert checks["names"]["verdict"] == "fail"
    assert "theirs.mod holds a module ROS_motion too" in checks["names"]["found"]
    assert checks["reach"]["verdict"] == "ok"
    assert checks["RobotWare"]["verdict"] == "unknown"
    assert list(p.name for p in home.iterdir()) == ["theirs.mod"]


def test_doctor_goes_on_past_modules_that_it_cannot_read(run, built, home, tmp_path):
    with (home / "large.mod").open("wb") as file:
        file.truncate(FILE_LIMIT + 1)
    (tmp_path / "elsewhere.mod").write_text("MODULE x\nENDMODULE\n")
    (home / "link.mod").symlink_to(tmp_path / "elsewhere.mod")
    _, out, _ = run("doctor", built(OLD), "--to", f"dir://{home}", "--json")
    checks = json.loads(out)
    names = [c for c in checks if c["area"] == "names"]
    assert [c["verdict"] for c in names] == ["unknown", "unknown"]
    assert ["large.mod" in names[0]["found"], "link.mod" in names[1]["found"]] == [True, True]
    assert checks[-1]["area"] == "disk"


def test_doctor_warns_of_the_delivered_password_and_of_other_programs(
    run, built, home, monkeypatch
):
    service = serve_ftp(home, password="robotics")
    url = f"ftp://127.0.0.1:{service.port}"
    for password in ("robotics", "changed"):
        monkeypatch.setenv("RAPIDGEN_PASSWORD", password)
        _, out, _ = run("doctor", built(OLD), "--to", url, "--json")
        result = [c for c in json.loads(out) if c["area"] in ("passwords", "reach")]
        if password == "robotics":
            assert [c["verdict"] for c in result] == ["ok", "warn"]
            assert "robotics" not in out
        else:
            assert [c["verdict"] for c in result] == ["fail"]
    service.close()


@pytest.mark.parametrize(("option", "code"), [("--known-hosts", "RG503"), ("--identity", "RG502")])
def test_a_file_for_sftp_that_is_not_there_is_no_fault_of_the_line(
    run, built, tmp_path, option, code, monkeypatch
):
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "x")
    missing = tmp_path / "missing"
    url = f"sftp://127.0.0.1:{free_port()}"
    _, _, err = run("plan", built(OLD), "--to", url, option, missing)
    assert f"error[{code}]: {option} {missing}: No such file" in err
    assert "cable" not in err


@pytest.mark.parametrize(
    ("url", "code"),
    [
        ("192.168.125.1", "RG509"),
        ("ftpp://x/", "RG509"),
        ("ftp:///HOME", "RG509"),
        ("ftp://h:99999/", "RG509"),
        ("ftp://h/a/../../b", "RG509"),
        ("ftp://h/a%0d%0aDELE%20x", "RG509"),
        ("ftp://h/?x=1", "RG509"),
        ("ftp://user:s3cret@h/", "RG510"),
        ("ftp://user:s3cret@h:99999/", "RG510"),
        ("ftp://user:@h/", "RG510"),
        ("ftp:/user:s3cret@h/", "RG510"),
        ("ftpp://user:s3cret@h/", "RG510"),
        ("user:s3cret@h", "RG510"),
        ("sftp:user@h", "RG509"),
    ],
)
def test_bad_urls(url, code):
    (result,) = refusal(parse_target, url).diagnostics
    assert result.code == code
    assert "s3cret" not in str(result)


@pytest.mark.parametrize(
    ("url", "meant"),
    [("ftp:/h/HOME", "ftp://h/HOME"), ("sftp:me@h", "sftp://me@h"), ("dir:/x", "dir:///x")],
)
def test_a_url_with_too_few_slashes(url, meant):
    (result,) = refusal(parse_target, url).diagnostics
    assert (result.code, result.help) == ("RG509", f"write {meant}")


@pytest.mark.parametrize("others", [0o040, 0o020, 0o010, 0o004, 0o002, 0o001])
def test_a_secrets_file_that_others_may_use_in_any_way_is_not_used(tmp_path, others):
    file = tmp_path / "secrets.toml"
    file.write_text('[default]\npassword = "s3cret"\n')
    requested = (Credentials(""), "10.0.0.1", 21)
    for own in (0o600, 0o400):
        file.chmod(own | others)
        (result,) = refusal(find_password, *requested, secrets=file, ask=False).diagnostics
        assert (result.code, result.help) == ("RG511", f"chmod 600 {file}")
        file.chmod(own)
        assert find_password(*requested, secrets=file, ask=False).password.get() == "s3cret"


def test_secrets_come_from_a_tight_file_or_the_environment_and_are_not_shown(tmp_path, monkeypatch):
    file = tmp_path / "secrets.toml"
    file.write_text(
        '["10.0.0.1"]\nuser = "u"\npassword = "s3cret"\n[default]\npassword = "other"\n'
    )
    file.chmod(0o644)
    requested, given = (Credentials(""), "10.0.0.1", 21), {"secrets": file, "ask": False}
    assert refused(find_password, *requested, **given)[0] == "RG511"
    file.chmod(0o600)
    login = find_password(*requested, **given)
    assert (login.user, login.password.get()) == ("u", "s3cret")
    assert "s3cret" not in f"{login!r} {login.password} {login.password!r}"
    assert redact("530 no such pass s3cret", login) == "530 no such pass ***"
    other = find_password(Credentials("x"), "10.0.0.2", 21, **given)
    assert (other.user, other.password.get()) == ("x", "other")
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "from env")
    login = find_password(Credentials("x"), "h", 21, secrets=None, ask=False)
    assert login.password.get() == "from env"
    assert Credentials("Default User", Secret("robotics")).is_default
    file.write_text('password = "s3cret\n')
    assert "s3cret" not in render(refusal(find_password, *requested, **given).diagnostics)


def test_password_without_terminal_is_not_tried(run, home, built, monkeypatch):
    monkeypatch.delenv("RAPIDGEN_PASSWORD", raising=False)
    monkeypatch.setattr("sys.stdin", io.StringIO())
    server = serve_ftp(home)
    try:
        url = f"ftp://{server.user}@127.0.0.1:{server.port}/"
        code, _, err = run("plan", built(OLD), "--to", url)
        assert (code, "error[RG512]: 127.0.0.1 requires a password" in err) == (2, True)
        monkeypatch.setenv("RAPIDGEN_PASSWORD", "")
        assert "RG502" in run("plan", built(OLD), "--to", url)[2]
    finally:
        server.close()


def test_no_letter_of_a_password_is_shown(run, home, built, monkeypatch):
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "пароль")
    server = serve_ftp(home)
    try:
        url = f"ftp://{server.user}@127.0.0.1:{server.port}/"
        code, out, err = run("plan", built(OLD), "--to", url)
    finally:
        server.close()
    assert (code, "error[RG502]" in err) == (1, True)
    assert not set("пароль") & set(out + err)
    assert "043f" not in out + err


def test_a_login_without_password_and_key_says_so(run, home, built, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("SSH_AUTH_SOCK", raising=False)
    monkeypatch.delenv("RAPIDGEN_PASSWORD", raising=False)
    server = serve_sftp(home)
    try:
        known = tmp_path / "known"
        known.write_text(server.host_key + "\n")
        code, _, err = run(
            "plan", built(OLD), "--to", f"sftp://127.0.0.1:{server.port}", "--known-hosts", known
        )
    finally:
        server.close()
    assert code == 1
    assert "error[RG502]" in err
    assert "neither a password nor a key" in err


@pytest.mark.parametrize("url", ["http://robot", "ftq://robot", "@nowhere"])
def test_a_url_that_leads_nowhere_tells_what_there_is(run, built, url):
    code, _, err = run("plan", built(OLD), "--to", url)
    assert code == 2
    assert "error[RG509]" in err
    assert "help:" in err
    assert "Errno" not in err


def test_a_plan_with_a_backup_looks_for_data_of_the_users_program(run, home, tmp_path):
    backup = write_backup(tmp_path / "cell")
    cfg = backup / "SYSPAR/SYS.cfg"
    cfg.write_text(cfg.read_text().replace("T_MOVE", "T_ROB1"))
    text = ("irb120", "--to", f"dir://{home}", "--backup", backup, "--set", "payload.name=lPart")
    code, _, err = run("plan", *text)
    assert code == 2
    assert "RG113" in err
    assert "loaddata lPart" in err
    program = backup / "RAPID/TASK1/PROGMOD/theirs.mod"
    program.write_text(program.read_text().replace("  PROC", "  PERS loaddata lPart;\n  PROC", 1))
    assert run("plan", *text)[0] == 0


def test_a_mark_at_the_beginning_of_a_file_is_no_part_of_it(tmp_path):
    listed, secrets = tmp_path / "robots.txt", tmp_path / "secrets.toml"
    listed.write_bytes(b"\xef\xbb\xbfftp://10.0.0.1\r\nftp://10.0.0.2\r\n")
    assert [t.host for t in parse_targets([f"@{listed}"])] == ["10.0.0.1", "10.0.0.2"]
    secrets.write_bytes(b'\xef\xbb\xbf[default]\r\npassword = "s3cret"\r\n')
    secrets.chmod(0o600)
    login = find_password(Credentials("x"), "10.0.0.1", 21, secrets=secrets, ask=False)
    assert login.password.get() == "s3cret"


def test_a_file_without_the_password_that_is_asked_for_is_named(tmp_path, monkeypatch):
    monkeypatch.delenv("RAPIDGEN_PASSWORD", raising=False)
    monkeypatch.setattr("sys.stdin", io.StringIO())
    secrets = tmp_path / "secrets.toml"
    secrets.write_text('[10.0.0.1]\npassword = "s3cret"\n')  # tables in tables, to TOML
    secrets.chmod(0o600)
    requested = (Credentials(""), "10.0.0.1", 21)
    (result,) = refusal(find_password, *requested, secrets=secrets, ask=True).diagnostics
    assert (result.code, str(secrets) in result.help) == ("RG512", True)
    assert '["10.0.0.1"]' in result.help
    (result,) = refusal(find_password, *requested, secrets=None, ask=True).diagnostics
    assert result.help.startswith("--secrets FILE")
