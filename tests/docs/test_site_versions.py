"""Sites of several versions beside each other."""

import json
import subprocess
import sys

import pytest

from tests.docs.tree import ROOT

SCRIPT = ROOT / ".ci" / "site_versions"


def put(site, folder, version):
    words = [sys.executable, str(SCRIPT), str(site), str(folder), version]
    return subprocess.run(words, capture_output=True, text=True)


@pytest.fixture
def site(tmp_path):
    made = tmp_path / "site"
    (made / ".doctrees").mkdir(parents=True)
    (made / ".doctrees" / "pickle").write_text("not for readers")
    (made / "index.html").write_text("first")
    return made


def test_the_newest_release_is_the_first_page_whatever_came_last(site, tmp_path):
    folder = tmp_path / "published"
    for version in ("0.9.0", "0.10.0", "0.11.0rc1", "0.2.1"):
        done = put(site, folder, version)
        assert (done.returncode, done.stderr) == (0, "")
    assert json.loads((folder / "versions.json").read_text()) == [
        "0.11.0rc1", "0.10.0", "0.9.0", "0.2.1",
    ]  # fmt: skip
    assert 'url=0.10.0/"' in (folder / "index.html").read_text()
    assert not list(folder.rglob(".doctrees"))


def test_a_version_that_is_published_again_is_replaced_whole(site, tmp_path):
    folder = tmp_path / "published"
    (site / "gone.html").write_text("only in the first")
    put(site, folder, "1.0.0")
    (site / "gone.html").unlink()
    (site / "index.html").write_text("second")
    put(site, folder, "1.0.0")
    assert (folder / "1.0.0" / "index.html").read_text() == "second"
    assert not (folder / "1.0.0" / "gone.html").exists()


@pytest.mark.parametrize(
    ("version", "reason"),
    [("../1.0", "../1.0 is no version"), ("", " is no version"), ("1.0.0", "has no index.html")],
)
def test_what_is_no_site_or_no_version_changes_nothing(tmp_path, version, reason):
    empty = tmp_path / "empty"
    empty.mkdir()
    done = put(empty, tmp_path / "published", version)
    assert done.returncode == 1
    assert reason in done.stderr
    assert not (tmp_path / "published").exists()
