"""A release has the page, or there is no release; a clone without Node.js does without."""

import importlib.util

import pytest

from tests.docs.tree import PACKAGE, ROOT


@pytest.fixture
def hook(tmp_path, monkeypatch):
    path = PACKAGE / "view" / "page" / "build_page.py"
    spec = importlib.util.spec_from_file_location("build_page", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "ASSETS", tmp_path)
    monkeypatch.setattr(module, "find_spec", lambda name: None)
    monkeypatch.setattr(module.shutil, "which", lambda name: None)
    return module


def initialized(hook, version):
    own = hook.PageHook(str(PACKAGE), {}, None, None, str(PACKAGE), "wheel")
    own.initialize(version, {})


def test_without_node_the_page_is_left_out_and_a_page_that_is_there_is_kept(hook, tmp_path, capsys):
    initialized(hook, "editable")
    assert capsys.readouterr().err == ""
    initialized(hook, "standard")
    assert "the page of `rapidgen view` is left out" in capsys.readouterr().err
    (tmp_path / "index.html").write_text("built before")
    initialized(hook, "standard")
    assert capsys.readouterr().err == ""


def test_a_release_without_the_page_is_none():
    told = (ROOT / ".ci" / "release").read_text(encoding="utf-8")
    assert "grep -q rapidgen/view/assets/page.js || {" in told
    assert (PACKAGE / "view" / "assets" / "page.js").is_file()
