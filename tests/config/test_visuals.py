"""Files of a description that may be read for visuals: only its packages'."""

import pytest

from rapidgen.config.urdf.packages import Packages
from rapidgen.config.urdf.visual_trees import trees
from rapidgen.config.urdf.visuals import NoMesh, mesh_file
from tests.docs.tree import ROOT


@pytest.fixture
def home(tmp_path):
    """A package with a mesh, a secret beside it, and a configuration's folder elsewhere."""
    arm = tmp_path / "src" / "arm"
    for folder in ("urdf", "meshes"):
        (arm / folder).mkdir(parents=True)
    (arm / "package.xml").write_text("<package><name>arm</name></package>")
    (arm / "urdf" / "arm.urdf").write_text("<robot/>")
    (arm / "meshes" / "link.STL").write_bytes(b"solid")
    (arm / "meshes" / "link.txt").write_bytes(b"text")
    (tmp_path / "secret.stl").write_bytes(b"secret")
    (tmp_path / "project").mkdir()
    return tmp_path


def found(home, name, folder="project", description="src/arm/urdf/arm.urdf"):
    path = home / description
    packages = Packages({}, [], path.parent, {})
    return mesh_file(name, path, packages, home / folder).relative_to(home).as_posix()


@pytest.mark.parametrize(
    "name", ["package://arm/meshes/link.STL", "../meshes/link.STL", "file://{home}/meshes/link.STL"]
)
def test_a_mesh_is_found_as_ros_finds_it(home, name):
    name = name.replace("{home}", str(home / "src" / "arm"))
    assert found(home, name) == "src/arm/meshes/link.STL"


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("package://arm/../../secret.stl", "outside"),
        ("package://../secret.stl", "not found"),
        ("../../../secret.stl", "outside"),
        ("file://{root}/secret.stl", "outside"),
        ("{root}/secret.stl", "outside"),
        ("http://example.org/a.stl", "package://"),
        ("package://arm/meshes/gone.stl", "not there"),
        ("package://arm/meshes/link.txt", "no STL"),
        ("package://arm/meshes/\0.stl", "not there"),
        ("package://missing/a.stl", "not found"),
        ("package://arm/meshes/out.stl", "outside"),
        ("package://arm/meshes/away/secret.stl", "outside"),
        ("package://arm/meshes/%2e%2e/%2e%2e/%2e%2e/secret.stl", "not there"),
        ("package://arm//{root}/secret.stl", "outside"),
        ("package://arm/meshes/loop.stl", "not there"),
        ("package://arm/meshes/folder.stl", "no file"),
        ("package://arm/" + "m" * 5000 + ".stl", "not there"),
        ("file://{root}/src/arm/meshes/%2e%2e/%2e%2e/%2e%2e/secret.stl", "outside"),
        ("file://secret.stl", "not there"),
        ("file:{root}/secret.stl", "not there"),
        ("FILE://{root}/secret.stl", "package://"),
        ("", "no STL"),
    ],
)
def test_no_other_file_is_read(home, name, why):
    meshes = home / "src" / "arm" / "meshes"
    (meshes / "out.stl").symlink_to(home / "secret.stl")
    (meshes / "away").symlink_to(home)
    (meshes / "loop.stl").symlink_to(meshes / "loop.stl")
    (meshes / "folder.stl").mkdir()
    with pytest.raises(NoMesh, match=why):
        found(home, name.replace("{root}", str(home)))


def test_a_link_leads_to_the_sources_of_the_same_package(home):
    """As `colcon build --symlink-install` makes it."""
    share = home / "install" / "arm" / "share" / "arm"
    (share / "meshes").mkdir(parents=True)
    for name in ("package.xml", "meshes/link.STL"):
        (share / name).symlink_to(home / "src" / "arm" / name)
    packages = Packages({"arm": share}, [], home, {})
    path = mesh_file("package://arm/meshes/link.STL", home / "a.urdf", packages, home)
    assert path == home / "src" / "arm" / "meshes" / "link.STL"


def test_without_package_the_configuration_folder_is_home(home):
    own = home / "project" / "urdf"
    own.mkdir()
    (own / "arm.urdf").write_text("<robot/>")
    (home / "project" / "link.obj").write_bytes(b"v")
    at = {"description": "project/urdf/arm.urdf"}
    assert found(home, "../link.obj", **at) == "project/link.obj"
    with pytest.raises(NoMesh, match="outside"):
        found(home, "../link.obj", folder="src", **at)


def test_visuals_of_a_description_with_their_colours(tmp_path):
    text = (ROOT / "robots" / "urdf" / "irb120.urdf").read_text()
    drawn = """<link name="tool0"><visual><origin xyz="0 0 0.1" rpy="0 1 0"/>
      <geometry><box size="0.1 0.2 0.3"/></geometry><material name="warm"/></visual>
      <visual><geometry><sphere radius="big"/></geometry></visual>
      <visual><geometry><mesh filename="gone.stl" scale="1 1"/></geometry></visual></link>
      <material name="warm"><color rgba="1 0.5 7 1"/></material>"""
    (tmp_path / "arm.urdf").write_text(text.replace('<link name="tool0"/>', drawn))
    (tmp_path / "arm.yaml").write_text("model: irb120\nurdf: {file: arm.urdf}\n")
    (tree,) = trees(tmp_path / "arm.yaml").values()
    box, mesh = tree.visuals["tool0"]
    assert (box.kind, box.size, box.xyz, box.rpy) == (
        "box",
        (0.1, 0.2, 0.3),
        (0, 0, 0.1),
        (0, 1, 0),
    )
    assert box.colour == (1.0, 0.5, 1.0, 1.0)
    assert (mesh.kind, mesh.mesh, mesh.size) == ("mesh", None, (1.0, 1.0, 1.0))
    assert "not there" in mesh.fault
    assert [v.kind for v in tree.visuals["link_1"]] == ["sphere"]
