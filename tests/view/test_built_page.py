"""A release has the page, or there is no release."""

import importlib.util

import pytest

from tests.docs.tree import PACKAGE


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


def test_a_wheel_without_the_page_is_not_built(hook, tmp_path):
    with pytest.raises(SystemExit, match="needs Node"):
        initialized(hook, "standard")
    initialized(hook, "editable")
    (tmp_path / "index.html").write_text("built before")
    initialized(hook, "standard")
