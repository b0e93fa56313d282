#!/usr/bin/env python3
"""Writes the project's own models: models/pavilion.gltf (a garden temple) and models/chess.dae (the end of Anderssen's
Immortal Game, London 1851). Shapes are turned on a lathe, swept or cut from boxes; needs Python only.

    python3 scenes/make_models.py            # from anywhere: the products lie beside this file
"""

import base64
import json
import math
import pathlib
import struct

from model_shapes import Mesh, arc, arc_ring, box, lathe, smooth, sphere, sweep, unit, wedge

# ---- chess pieces, centimetres -----------------------------------------------------------------------------------------

TURN = 24


def foot(r):
    """Base of a piece, up to the beginning of its stem at height 0.62 r."""
    return [smooth([(0.95 * r, 0), (r, 0.06 * r), (r, 0.22 * r), (0.94 * r, 0.30 * r)], 2),
            [(0.94 * r, 0.30 * r), (0.80 * r, 0.36 * r), (0.72 * r, 0.46 * r)],
            [(0.72 * r, 0.46 * r), (0.77 * r, 0.53 * r), (0.70 * r, 0.62 * r)]]


def stem(r, waist, top):
    low = 0.62 * r
    return smooth([(0.70 * r, low), (0.46 * r, low + 0.12 * (top - low)), (1.12 * waist, low + 0.45 * (top - low)),
                   (waist, low + 0.8 * (top - low)), (1.08 * waist, top)], 2)


def collar(waist, y, wide, high):
    return [[(waist, y), (0.9 * wide, y + 0.2 * high), (wide, y + 0.45 * high)],
            [(wide, y + 0.45 * high), (0.92 * wide, y + 0.7 * high), (waist, y + high)]]


def pawn():
    return lathe([*foot(1.45), stem(1.45, 0.46, 2.9), *collar(0.5, 2.9, 0.92, 0.35), arc(0.8, 3.92, -55, 90, 10)], TURN)


def rook():
    mesh = lathe([*foot(1.7), stem(1.7, 0.86, 3.6), *collar(0.93, 3.6, 1.2, 0.3),
                  smooth([(0.93, 3.9), (1.0, 4.15), (1.36, 4.4)], 2), [(1.36, 4.4), (1.36, 4.95)],
                  [(1.36, 4.95), (0.98, 4.95)], [(0.98, 4.95), (0.98, 4.7)], [(0.98, 4.7), (0, 4.7)]], TURN)
    for k in range(6):
        mesh.add(wedge(0.98, 1.36, 4.95, 5.45, 60 * k, 20))
    return mesh


def bishop():
    mitre = smooth([(0.5, 4.75), (0.82, 5.1), (0.93, 5.6), (0.76, 6.2), (0.38, 6.75), (0.14, 6.95)], 2)
    return lathe([*foot(1.65), stem(1.65, 0.5, 4.2), *collar(0.54, 4.2, 1.02, 0.35), *collar(0.5, 4.5, 0.78, 0.25), mitre,
                  arc(0.21, 7.08, -50, 90, 6)], TURN)


def queen():
    head = smooth([(0.56, 6.0), (0.66, 6.5), (0.92, 7.0), (1.24, 7.4)], 2)
    mesh = lathe([*foot(1.85), stem(1.85, 0.56, 5.4), *collar(0.6, 5.4, 1.15, 0.4), *collar(0.56, 5.75, 0.88, 0.28), head,
                  smooth([(1.24, 7.4), (1.1, 7.44), (0.95, 7.36)], 2), smooth([(0.95, 7.36), (0.7, 7.6), (0.16, 7.78)], 2),
                  arc(0.27, 8.0, -55, 90, 7)], TURN)
    for k in range(9):
        a = 2 * math.pi * k / 9
        mesh.add(sphere(0.17, 6, (1.12 * math.cos(a), 7.5, 1.12 * math.sin(a))))
    return mesh


def king():
    head = smooth([(0.6, 6.6), (0.72, 7.1), (0.98, 7.7), (1.2, 8.1)], 2)
    mesh = lathe([*foot(1.95), stem(1.95, 0.6, 5.9), *collar(0.65, 5.9, 1.25, 0.42), *collar(0.6, 6.3, 0.95, 0.3), head,
                  smooth([(1.2, 8.1), (1.1, 8.2), (0.8, 8.32), (0.3, 8.42), (0.2, 8.5)], 2)], TURN)
    return mesh.add(box((0.26, 1.2, 0.22), (0, 9.05, 0))).add(box((0.8, 0.26, 0.22), (0, 9.2, 0)))


def knight():
    mesh = lathe([*foot(1.65), smooth([(1.15, 1.02), (0.95, 1.2), (0, 1.32)], 2)], TURN)
    # Neck, brow and muzzle; it looks along +x.
    spine = smooth([(-0.10, 1.10, 0.95, 0.86), (-0.30, 1.9, 0.98, 0.72), (-0.42, 2.8, 0.95, 0.6), (-0.32, 3.7, 0.86, 0.52),
                    (0.02, 4.45, 0.74, 0.5), (0.50, 4.72, 0.66, 0.5), (0.98, 4.35, 0.56, 0.42), (1.36, 3.85, 0.45, 0.34),
                    (1.58, 3.5, 0.36, 0.31), (1.66, 3.36, 0.2, 0.2), (1.69, 3.32, 0.0, 0.0)], 2)
    mesh.add(sweep([tuple(max(0.0, x) if k > 1 else x for k, x in enumerate(p)) for p in spine], 20))
    mane = smooth([(-0.75, 1.5, 0.2, 0.1), (-1.16, 2.4, 0.28, 0.15), (-1.22, 3.4, 0.3, 0.16), (-0.86, 4.4, 0.3, 0.16),
                   (-0.22, 5.1, 0.26, 0.15), (0.16, 5.3, 0.1, 0.08), (0.24, 5.32, 0.0, 0.0)], 2)
    mesh.add(sweep([tuple(max(0.0, x) if k > 1 else x for k, x in enumerate(p)) for p in mane], 10))
    for side in (-0.3, 0.3):
        mesh.add(sweep([(0.12, 4.9, 0.2, 0.15), (0.1, 5.2, 0.18, 0.12), (0.12, 5.5, 0.1, 0.06), (0.14, 5.72, 0.0, 0.0)], 8), (0, 0, side))
        mesh.add(sphere(0.12, 8, (0.72, 4.52, 1.45 * side)))
    return mesh


# ---- COLLADA -----------------------------------------------------------------------------------------------------------


def numbers(values, digits):
    def text(v):
        t = f"{v:.{digits}f}".rstrip("0").rstrip(".") 
        t = t.replace("0.", ".", 1) if t.startswith(("0.", "-0.")) else t
        return "0" if t in ("", "-0") else t
    return " ".join(text(v) for v in values)


def dae_source(name, triples, digits):
    flat = [x for t in triples for x in t]
    axes = "".join(f'<param name="{a}" type="float"/>' for a in "XYZ")
    return (f'<source id="{name}"><float_array id="{name}-array" count="{len(flat)}">{numbers(flat, digits)}</float_array>'
            f'<technique_common><accessor source="#{name}-array" count="{len(triples)}" stride="3">{axes}</accessor>'
            f'</technique_common></source>\n')


def dae_geometry(name, mesh):
    indices = " ".join(str(i) for t in mesh.triangles for i in t)
    return (f'<geometry id="{name}" name="{name}"><mesh>\n' + dae_source(name + "-p", mesh.positions, 2) +
            dae_source(name + "-n", mesh.normals, 3) +
            f'<vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/></vertices>\n'
            f'<triangles count="{len(mesh.triangles)}" material="wood"><input semantic="VERTEX" source="#{name}-v" offset="0"/>'
            f'<input semantic="NORMAL" source="#{name}-n" offset="0"/>\n<p>{indices}</p></triangles>\n</mesh></geometry>\n')


def dae_show(geometry, material):
    return (f'<instance_geometry url="#{geometry}"><bind_material><technique_common><instance_material symbol="wood" '
            f'target="#{material}"/></technique_common></bind_material></instance_geometry>')


def dae_material(name, diffuse, specular, shininess):
    return (f'<effect id="{name}-fx"><profile_COMMON><technique sid="common"><phong><diffuse><color>{numbers(diffuse, 3)} 1</color></diffuse>'
            f'<specular><color>{numbers([specular] * 3, 3)} 1</color></specular><shininess><float>{shininess}</float></shininess></phong>'
            f'</technique></profile_COMMON></effect>\n',
            f'<material id="{name}" name="{name}"><instance_effect url="#{name}-fx"/></material>\n')


def look(eye, target):
    """Column-vector matrix, row by row, of something at `eye` that looks down its -z at `target`, y up."""
    back = unit([e - t for e, t in zip(eye, target)])
    right = unit((back[2], 0, -back[0]))
    up = (back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0])
    rows = [[right[k], up[k], back[k], eye[k]] for k in range(3)] + [[0, 0, 0, 1]]
    return [x for row in rows for x in row]


def chess():
    square = 5.5
    geometries = {"pawn": pawn(), "rook": rook(), "knight": knight(), "bishop": bishop(), "queen": queen(), "king": king(),
                  "square": box((square, 0.6, square), (0, -0.3, 0)),
                  "table": lathe([[(300, -2.2), (0, -2.2)]], 64)}
    frame = Mesh()
    side = 8 * square
    for x, z, sx, sz in ((0, 1, side + 6, 3), (0, -1, side + 6, 3), (1, 0, 3, side), (-1, 0, 3, side)):
        frame.add(box((sx, 2.1, sz), (x * (side + 3) / 2, -0.95, z * (side + 3) / 2)))
    geometries["frame"] = frame
    materials = [dae_material(*m) for m in (
        ("ivory", (0.93, 0.87, 0.74), 0.4, 60), ("ebony", (0.25, 0.16, 0.13), 0.5, 80), ("maple", (0.86, 0.71, 0.50), 0.3, 40),
        ("walnut", (0.43, 0.27, 0.17), 0.3, 40), ("mahogany", (0.47, 0.18, 0.12), 0.4, 60))]
    baize = ('<effect id="baize-fx"><profile_COMMON><technique sid="common"><lambert><diffuse><color>0.17 0.34 0.31 1</color></diffuse>'
             '</lambert></technique></profile_COMMON></effect>\n', '<material id="baize" name="baize"><instance_effect url="#baize-fx"/></material>\n')
    materials.append(baize)

    nodes = []
    for piece in ("pawn", "rook", "knight", "bishop", "queen", "king"):
        for side_name, material in (("white", "ivory"), ("black", "ebony")):
            nodes.append(f'<node id="{side_name}-{piece}" name="{side_name} {piece}">{dae_show(piece, material)}</node>\n')
    for material in ("maple", "walnut"):
        nodes.append(f'<node id="{material}-square" name="{material} square">{dae_show("square", material)}</node>\n')
    row = "".join(f'<node name="file {"abcdefgh"[k]}"><translate>{numbers([(k - 3.5) * square, 0, 0], 3)}</translate>'
                  f'<instance_node url="#{("walnut", "maple")[k % 2]}-square"/></node>' for k in range(8))
    nodes.append(f'<node id="rank" name="rank">{row}</node>\n')

    # Rank 1 lies at +z, before White. A rank turned half round has its colours exchanged.
    ranks = "".join(f'<node name="rank {k + 1}"><translate>{numbers([0, 0, (3.5 - k) * square], 3)}</translate>'
                    f'<rotate>0 1 0 {180 * (k % 2)}</rotate><instance_node url="#rank"/></node>\n' for k in range(8))
    names = {"p": "pawn", "r": "rook", "n": "knight", "b": "bishop", "q": "queen", "k": "king"}
    men = ""
    for k, line in enumerate("r1bk3r/p2pBpNp/n4n2/1p1NP2P/6P1/3P4/P1P1K3/q5b1".split("/")):
        file = 0
        for letter in line:
            if letter.isdigit():
                file += int(letter)
                continue
            white = letter.isupper()
            piece = ("white-" if white else "black-") + names[letter.lower()]
            turn = {"n": 70 if white else -110}.get(letter.lower(), 17 * (file + 3 * k) % 40 - 20)
            men += (f'<node name="{"abcdefgh"[file]}{8 - k}"><translate>{numbers([(file - 3.5) * square, 0, (k - 3.5) * square], 3)}</translate>'
                    f'<rotate>0 1 0 {turn}</rotate><instance_node url="#{piece}"/></node>\n')
            file += 1

    def light(name, kind, colour, more=""):
        return f'<light id="{name}" name="{name}"><technique_common><{kind}><color>{numbers(colour, 3)}</color>{more}</{kind}></technique_common></light>\n'

    def placed(name, what, eye, target):
        return f'<node id="{name}-node" name="{name}"><matrix>{numbers(look(eye, target), 5)}</matrix><instance_{what} url="#{name}"/></node>\n'

    lights = (light("window", "directional", (1.0, 0.95, 0.86)) + light("lamp", "point", (0.9, 0.62, 0.36), "<quadratic_attenuation>1</quadratic_attenuation>") +
              light("room", "ambient", (0.17, 0.19, 0.23)))
    return ('<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n'
            '<asset><contributor><authoring_tool>scenes/make_models.py</authoring_tool></contributor><created>2024-01-01T00:00:00Z</created>'
            '<modified>2024-01-01T00:00:00Z</modified><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>\n'
            '<library_cameras><camera id="player" name="player"><optics><technique_common><perspective><yfov>30</yfov>'
            '<aspect_ratio>1.7777778</aspect_ratio><znear>1</znear><zfar>1000</zfar></perspective></technique_common></optics></camera></library_cameras>\n'
            f'<library_lights>\n{lights}</library_lights>\n<library_effects>\n{"".join(m[0] for m in materials)}</library_effects>\n'
            f'<library_materials>\n{"".join(m[1] for m in materials)}</library_materials>\n'
            f'<library_geometries>\n{"".join(dae_geometry(n, m) for n, m in geometries.items())}</library_geometries>\n'
            f'<library_nodes>\n{"".join(nodes)}</library_nodes>\n<library_visual_scenes><visual_scene id="game" name="Immortal Game">\n'
            f'<node name="board">\n<node name="frame">{dae_show("frame", "mahogany")}</node>\n{ranks}</node>\n<node name="men">\n{men}</node>\n'
            f'<node name="table">{dae_show("table", "baize")}</node>\n'
            + placed("player", "camera", (22, 41, 77), (0.4, 0.4, 2.6)) + placed("window", "light", (-50, 70, 30), (0, 0, 0)) +
            placed("lamp", "light", (38, 34, -30), (0, 0, 0)) + placed("room", "light", (0, 50, 1), (0, 0, 0)) +
            '</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url="#game"/></scene>\n</COLLADA>\n')


# ---- pavilion, metres ----------------------------------------------------------------------------------------------------


class Gltf:
    """Collects meshes into one buffer."""

    def __init__(self):
        self.bytes, self.views, self.accessors, self.meshes, self.nodes = bytearray(), [], [], [], []
        self.materials, self.lights = [], []

    def _accessor(self, data, component, count, kind, **bounds):
        while len(self.bytes) % 4:
            self.bytes.append(0)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component, "count": count, "type": kind, **bounds})
        return len(self.accessors) - 1

    def material(self, name, colour, roughness, metal=0.0):
        self.materials.append({"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*colour, 1.0], "metallicFactor": metal,
                                                                       "roughnessFactor": roughness}})
        return len(self.materials) - 1

    def mesh(self, name, *parts):
        """parts: (mesh, material) pairs."""
        primitives = []
        for mesh, material in parts:
            count = len(mesh.positions)
            low = [struct.unpack("f", struct.pack("f", min(p[k] for p in mesh.positions)))[0] for k in range(3)]
            high = [struct.unpack("f", struct.pack("f", max(p[k] for p in mesh.positions)))[0] for k in range(3)]
            pack = lambda rows: b"".join(struct.pack("<3f", *row) for row in rows)
            indices = b"".join(struct.pack("<3H", *t) for t in mesh.triangles)
            primitives.append({"attributes": {"POSITION": self._accessor(pack(mesh.positions), 5126, count, "VEC3", min=low, max=high),
                                              "NORMAL": self._accessor(pack(mesh.normals), 5126, count, "VEC3")},
                               "indices": self._accessor(indices, 5123, 3 * len(mesh.triangles), "SCALAR"), "material": material})
        self.meshes.append({"name": name, "primitives": primitives})
        return len(self.meshes) - 1

    def node(self, name, children=(), **what):
        self.nodes.append({"name": name, **({"children": list(children)} if children else {}), **what})
        return len(self.nodes) - 1

    def light(self, name, kind, colour, intensity, eye=(0, 0, 0), target=(0, 0, -1)):
        self.lights.append({"name": name, "type": kind, "color": list(colour), "intensity": intensity})
        return self.node(name, matrix=columns(look(eye, target)), extensions={"KHR_lights_punctual": {"light": len(self.lights) - 1}})

    def text(self, root, camera):
        uri = "data:application/octet-stream;base64," + base64.b64encode(bytes(self.bytes)).decode()
        return json.dumps({"asset": {"version": "2.0", "generator": "scenes/make_models.py"}, "extensionsUsed": ["KHR_lights_punctual"],
                           "extensions": {"KHR_lights_punctual": {"lights": self.lights}}, "scene": 0, "scenes": [{"nodes": [root]}],
                           "cameras": [camera], "nodes": self.nodes, "materials": self.materials, "meshes": self.meshes,
                           "accessors": self.accessors, "bufferViews": self.views,
                           "buffers": [{"byteLength": len(self.bytes), "uri": uri}]}, indent=None, separators=(",", ":")) + "\n"


def columns(rows):
    """glTF writes matrices column by column."""
    return [round(rows[4 * r + c], 6) for c in range(4) for r in range(4)]


def pavilion():
    g = Gltf()
    marble = g.material("marble", (0.80, 0.77, 0.71), 0.45)
    limestone = g.material("limestone", (0.56, 0.50, 0.41), 0.85)
    slate = g.material("slate", (0.16, 0.17, 0.19), 0.5)
    copper = g.material("verdigris", (0.22, 0.46, 0.38), 0.6)
    gold = g.material("gold", (1.0, 0.77, 0.34), 0.35, 1.0)
    bronze = g.material("bronze", (0.72, 0.45, 0.22), 0.4, 1.0)
    grass = g.material("grass", (0.10, 0.17, 0.045), 1.0)
    gravel = g.material("gravel", (0.46, 0.38, 0.28), 1.0)
    cypress = g.material("cypress", (0.035, 0.085, 0.03), 0.9)
    bark = g.material("bark", (0.15, 0.10, 0.07), 1.0)

    steps = lathe([[(4.4, 0), (4.4, 0.22)], [(4.4, 0.22), (4.0, 0.22)], [(4.0, 0.22), (4.0, 0.44)], [(4.0, 0.44), (3.6, 0.44)],
                   [(3.6, 0.44), (3.6, 0.66)], [(3.6, 0.66), (2.5, 0.66)]], 64)
    inlay = lathe([[(2.5, 0.66), (2.1, 0.66)]], 64)
    floor = lathe([[(2.1, 0.66), (0, 0.66)]], 64)
    base = g.mesh("crepidoma", (steps, limestone), (inlay, slate), (floor, marble))

    # A column 4 m high: Attic base, fluted shaft with entasis, echinus and abacus.
    shaft = [(0.30 - 0.045 * t ** 1.6, 0.30 + 3.28 * t) for t in (k / 8 for k in range(9))]
    trim = lathe([arc_ring(0.36, 0.12, 0.06, 5), [(0.34, 0.18), (0.34, 0.22)], arc_ring(0.325, 0.26, 0.04, 5),
                  smooth([(0.26, 3.58), (0.29, 3.66), (0.36, 3.76), (0.40, 3.80)], 2)], 24)
    trim.add(box((0.84, 0.08, 0.84), (0, 0.03, 0))).add(box((0.86, 0.16, 0.86), (0, 3.88, 0)))
    column = g.mesh("column", (lathe([shaft], 80, flutes=16, depth=0.025), marble), (trim, marble))

    ring = lathe([[(2.62, 0), (3.42, 0)], [(3.42, 0), (3.42, 0.30)], [(3.42, 0.30), (3.46, 0.30)], [(3.46, 0.30), (3.46, 0.62)],
                  smooth([(3.46, 0.62), (3.52, 0.70), (3.70, 0.78)], 2), [(3.70, 0.78), (3.70, 0.92)], [(3.70, 0.92), (2.9, 1.02)]], 64)
    inner = lathe([[(2.62, 0.62), (2.62, 0)]], 64)
    entablature = g.mesh("entablature", (ring.add(inner), marble))
    shell = lathe([arc(2.95, 0, 0, 84, 14)], 64)
    ceiling = lathe([arc(2.7, 0, 84, 0, 10)], 48)
    dome = g.mesh("dome", (shell, copper), (ceiling, marble))
    finial = g.mesh("finial", (lathe([smooth([(0.42, 0), (0.36, 0.1), (0.16, 0.22), (0.12, 0.36)], 2), arc(0.27, 0.6, -64, 64, 8),
                                      smooth([(0.118, 0.84), (0.07, 1.0), (0.02, 1.3), (0, 1.42)], 2)], 24), gold))
    plinth = lathe([[(0.52, 0), (0.52, 0.14)], [(0.52, 0.14), (0.42, 0.2)], [(0.42, 0.2), (0.40, 0.86)], [(0.40, 0.86), (0.52, 0.94)],
                    [(0.52, 0.94), (0.52, 1.04)], [(0.52, 1.04), (0, 1.04)]], 32)
    urn = lathe([smooth([(0.26, 1.04), (0.24, 1.1), (0.09, 1.2), (0.09, 1.28), (0.3, 1.45), (0.42, 1.75), (0.40, 2.0), (0.27, 2.16),
                         (0.26, 2.22), (0.38, 2.32)], 3), smooth([(0.38, 2.32), (0.3, 2.31), (0.2, 2.2), (0, 2.1)], 2)], 32)
    vase = g.mesh("urn", (plinth, limestone), (urn, bronze))
    tree = g.mesh("cypress", (lathe([smooth([(0.1, 0.7), (0.6, 1.1), (0.78, 1.9), (0.7, 3.2), (0.46, 4.8), (0.2, 6.1), (0, 6.8)], 3)],
                                    40, flutes=10, depth=0.09), cypress), (lathe([[(0.16, 0), (0.12, 0.9)]], 12), bark))
    meadow = g.mesh("lawn", (lathe([[(60, -0.02), (0, -0.02)]], 48), grass))
    walk = Mesh().add(box((2.2, 0.04, 26), (0, 0, 16.6))).add(lathe([[(5.6, 0.02), (4.3, 0.02)]], 64))
    path = g.mesh("path", (walk, gravel))

    columns_of = []
    for k in range(10):
        a = 2 * math.pi * (k + 0.5) / 10
        half = (math.pi / 2 - a) / 2
        columns_of.append(g.node(f"column {k + 1}", mesh=column, translation=[round(3.02 * math.cos(a), 6), 0.66, round(3.02 * math.sin(a), 6)],
                                 rotation=[0.0, round(math.sin(half), 6), 0.0, round(math.cos(half), 6)]))
    trees = []
    for k, (x, z, size) in enumerate(((-7.2, 4.5, 0.92), (7.2, 4.5, 0.95), (-8.2, -0.5, 1.08), (8.2, -0.5, 1.04), (-9.5, -6.5, 1.2),
                                      (9.5, -6.5, 1.16), (-4.6, -9.5, 1.15), (4.6, -9.5, 1.2))):
        trees.append(g.node(f"cypress {k + 1}", mesh=tree, translation=[x, 0, z], scale=[size, round(size * (0.95 + 0.05 * (k % 3)), 3), size]))
    temple = g.node("temple", [g.node("base", mesh=base), g.node("colonnade", columns_of),
                               g.node("roof", [g.node("dome", [g.node("finial", mesh=finial, translation=[0, 2.93, 0])], mesh=dome, translation=[0, 0.98, 0])],
                                      mesh=entablature, translation=[0, 4.62, 0]),
                               g.node("urn", mesh=vase, translation=[0, 0.66, 0])])
    garden = g.node("garden", [g.node("lawn", mesh=meadow), g.node("path", mesh=path), g.node("trees", trees)])
    root = g.node("park", [temple, garden,
                           g.node("visitor", camera=0, matrix=columns(look((4.6, 2.3, 19.5), (0, 3.75, 0)))),
                           g.light("sun", "directional", (1.0, 0.93, 0.82), 60000, (-9, 10, 9), (0, 0, 0)),
                           g.light("sky", "directional", (0.62, 0.78, 1.0), 14000, (8, 7, 9), (0, 0, 0)),
                           g.light("lawn's light", "directional", (0.92, 1.0, 0.62), 5000, (0.5, -5, 3), (0, 0, 0)),
                           g.light("lantern", "point", (1.0, 0.72, 0.42), 30000, (0, 4.6, 0), (0, 4.6, -1))])
    return g.text(root, {"type": "perspective", "name": "visitor",
                         "perspective": {"yfov": round(math.radians(34), 6), "aspectRatio": 1.777778, "znear": 0.1, "zfar": 500}})


if __name__ == "__main__":
    folder = pathlib.Path(__file__).resolve().parent / "models"
    folder.mkdir(exist_ok=True)
    for name, text in (("chess.dae", chess()), ("pavilion.gltf", pavilion())):
        (folder / name).write_text(text, encoding="utf-8")
        print(f"{name}: {len(text) / 1024:.0f} KiB")
