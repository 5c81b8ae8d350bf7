"""The ROS packages of ros/: their manifests, and one of them built by colcon (`.ci/colcon`)."""

import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

import rapidgen

ROOT = Path(__file__).parents[2]
COLCON = shutil.which("colcon", path=os.pathsep.join([str(ROOT / "build/colcon/bin"), os.defpath]))


@pytest.mark.parametrize("package", ["rapidgen_ros", "rapidgen_interfaces"])
def test_versions_are_the_wheels(package):
    """Releases change one place; colcon reads these."""
    folder = ROOT / "ros" / package
    assert ET.parse(folder / "package.xml").findtext("version") == rapidgen.__version__
    assert ET.parse(folder / "package.xml").findtext("name") == package
    setup = folder / "setup.py"
    if setup.exists():
        assert f'version="{rapidgen.__version__}"' in setup.read_text()


def test_the_node_depends_on_every_package_that_it_imports():
    text = (ROOT / "rapidgen/ros/node.py").read_text()
    imported = set(re.findall(r"^from (\w+?_\w+|rclpy)\.(?:msg|srv|action)", text, re.MULTILINE))
    manifest = ET.parse(ROOT / "ros/rapidgen_ros/package.xml")
    assert imported <= {element.text for element in manifest.iter("exec_depend")}


def test_every_interface_is_generated():
    folder = ROOT / "ros/rapidgen_interfaces"
    target = {f"{path.parent.name}/{path.name}" for path in folder.glob("*/*.[ms][sr][gv]")}
    listed = set(re.findall(r'"((?:msg|srv)/\w+\.\w+)"', (folder / "CMakeLists.txt").read_text()))
    assert target == listed


@pytest.mark.colcon
@pytest.mark.skipif(COLCON is None, reason="no colcon: .ci/colcon")
def test_colcon_builds_the_driver_and_its_executable_is_the_node(tmp_path):
    shutil.copytree(ROOT / "ros/rapidgen_ros", tmp_path / "src/rapidgen_ros")
    built = subprocess.run(
        [COLCON, "--log-base", "log", "build", "--base-paths", "src", "--executor", "sequential"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stdout + built.stderr
    installed = tmp_path / "install/rapidgen_ros"
    marker = installed / "share/ament_index/resource_index/packages/rapidgen_ros"
    assert marker.is_file()  # `ros2 run` finds packages by it.
    assert os.access(installed / "lib/rapidgen_ros/driver", os.X_OK)  # ... and executables here.
    library = next(installed.glob("lib/python*/site-packages"))
    ran = subprocess.run(
        [sys.executable, "-c", "from rapidgen_ros.driver import main; raise SystemExit(main())"],
        env={**os.environ, "PYTHONPATH": f"{library}{os.pathsep}{ROOT}"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (ran.returncode, "RG691" in ran.stderr) == (2, True), ran.stderr
