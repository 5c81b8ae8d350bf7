"""Meshes of a small pyramid in each format, as files have them."""

import struct

from tests.docs.tree import ROOT

URDF = (ROOT / "robots" / "urdf" / "irb120.urdf").read_text()
CORNERS = ((0, 0, 0), (0.2, 0, 0), (0, 0.2, 0), (0, 0, 0.3))
FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))


def stl():
    """Binary STL."""
    rows = b""
    for face in FACES:
        numbers = [0.0, 0.0, 0.0, *(value for i in face for value in CORNERS[i])]
        rows += struct.pack("<12fH", *numbers, 0)
    return bytes(80) + struct.pack("<I", len(FACES)) + rows


def obj():
    """Wavefront OBJ; names a material file, which is not read."""
    lines = ["mtllib ../../secret.mtl", *(f"v {x} {y} {z}" for x, y, z in CORNERS)]
    return "\n".join([*lines, *("f " + " ".join(str(i + 1) for i in f) for f in FACES)]).encode()


def dae():
    """COLLADA, red; names a picture, which is not read."""
    numbers = " ".join(str(value) for corner in CORNERS for value in corner)
    indices = " ".join(str(i) for face in FACES for i in face)
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="i"><init_from>../../secret.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert>
<diffuse><color>1 0 0 1</color></diffuse>
</lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">{numbers}</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<p>{indices}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="m" target="#m"/></technique_common>
</bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>""".encode()


def description(folder, meshes):
    """A configuration whose links have these meshes besides their own shapes."""
    text = URDF
    for link, (name, data) in meshes.items():
        if data is not None:
            (folder / name).write_bytes(data)
        shape = name.replace("&", "&amp;").replace("<", "&lt;")
        visual = f'<visual><geometry><mesh filename="{shape}"/></geometry></visual>'
        text = text.replace(f'<link name="{link}">', f'<link name="{link}">{visual}')
    (folder / "arm.urdf").write_text(text)
    config = folder / "arm.yaml"
    config.write_text("model: irb120\nurdf: {file: arm.urdf}\n")
    return str(config)
