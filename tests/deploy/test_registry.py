"""A transport is a file and a line in the registry: URL, login, opening and errors follow."""

import pytest

from rapidgen.deploy import Access, connect, parse_target
from rapidgen.deploy.secrets import Credentials
from rapidgen.deploy.target import credentials
from rapidgen.deploy.transports import folder
from rapidgen.deploy.transports.registry import SCHEMES, Scheme
from tests.refusal import refusal


def message(url):
    (result,) = refusal(parse_target, url).diagnostics
    return result.code, result.message, result.help


def test_a_line_in_the_registry_is_enough(monkeypatch, tmp_path):
    opened = []

    def open_usb(target, login, timeout):
        opened.append((target, login, timeout))
        return folder.FolderTransport(tmp_path)

    monkeypatch.setattr(folder, "open_usb", open_usb, raising=False)
    monkeypatch.setitem(SCHEMES, "usb", Scheme("folder:open_usb", 4711))
    monkeypatch.setenv("RAPIDGEN_PASSWORD", "word")
    target = parse_target("usb://me@cell/HOME")
    assert (target.port, target.shown) == (4711, "usb://cell/HOME")
    assert parse_target("usb://[::1]:80/HOME").shown == "usb://[::1]:80/HOME"
    assert connect(target, Access(timeout=3)).entries("") == ()
    ((requested, login, timeout),) = opened
    assert (requested, login.user, login.password.get(), timeout) == (target, "me", "word", 3)
    assert message("usp://cell") == (
        "RG509",
        "--to usp://cell: unknown scheme 'usp'",
        "did you mean 'usb'?",
    )


def test_unknown_scheme_error_lists_schemes():
    assert message("gopher://cell") == (
        "RG509",
        "--to gopher://cell: unknown scheme 'gopher'",
        "there are dir://, ftp://, rws://, rwss://, sftp://",
    )


def test_a_folder_of_this_machine_needs_no_login(monkeypatch, tmp_path):
    monkeypatch.setattr("rapidgen.deploy.target.credentials", lambda *_: pytest.fail("asked"))
    assert connect(parse_target(f"dir://{tmp_path}"), Access(ask=True)).entries("") == ()


def test_only_where_keys_are_taken_one_stands_for_a_password(monkeypatch):
    requested = []

    def find(login, host, port, *, secrets, ask, needed):
        requested.append((ask, needed))
        return Credentials("u")

    monkeypatch.setattr("rapidgen.deploy.target.find_password", find)
    for url in ("sftp://h/", "ftp://h/"):
        credentials(parse_target(url), Access(identity="key", ask=True))
    assert requested == [(False, False), (True, True)]
