"""Lengths at the extremes: scaling laws that hold bit for bit, depths from 1e-6 to 1e9 in one view, degenerate triangles."""

import math

from harness import case, close, require, same

BANDS = '<wavelengths from="500" to="600" step="100"/>'


def still_life(scale=1.0, power=1.0, shift=(0.0, 0.0, 0.0), unit='m', size='48x32'):
    """Shapes and lamps of all kinds, every length times `scale`, everything moved by `shift`."""
    place = lambda x, y, z: ' '.join(repr(scale * v + s) for v, s in zip((x, y, z), shift))
    s = lambda v: repr(scale * v)
    return f'''<scene version="1" unit="{unit}">{BANDS}
  <material name="paint"><diffuse reflectance="constant:0.5"/><gloss ior="1.5" roughness="0.5"/></material>
  <node translate="{place(0, 0, 0)}">
    <sphere radius="{s(0.5)}" material="paint"/>
    <node translate="{s(1)} {s(0.25)} {s(-0.5)}"><box size="{s(0.5)}"/></node>
    <node translate="0 {s(-0.5)} 0" rotate="1 0 0 -90"><plane size="{s(8)}"/></node>
    <node translate="{s(-1)} 0 {s(0.25)}"><torus radius="{s(0.375)}" tube="{s(0.125)}" material="paint"/></node>
  </node>
  <light type="point" position="{place(1, 2, 3)}" spectrum="constant:1" scale="{power!r}"/>
  <light type="spot" position="{place(-2, 3, 1)}" target="{place(0, 0, 0)}" angle="40" blend="0.5" spectrum="constant:1" scale="{power!r}"/>
  <light type="directional" direction="-1 -2 -1" spectrum="constant:1" scale="0.125"/>
  <camera fov="45" look-from="{place(0, 0, 4)}" look-at="{place(0, 0, 0)}" size="{size}"/>
</scene>'''


@case('a scene 2^k times as large (1e-9 to 1e9 m) under lamps 4^k times as strong is the same image, bit for bit')
def scaling(bench):
    reference = bench.render(still_life())
    for exponent in (-30, -20, -1, 1, 20, 30):
        factor = 2.0 ** exponent
        same(reference, bench.render(still_life(factor, factor * factor)), 1.0, f'2^{exponent}')


@case('a million millimetres are a kilometre: the unit scales lengths, not lamps')
def units(bench):
    reference = bench.render(still_life(1.0, 1.0, unit='m'))
    milli = bench.render(still_life(1000.0, 1.0, unit='mm'))
    kilo = bench.render(still_life(2.0 ** -10, 1.0, unit='m'))
    worst = max(abs(a - b) for a, b in zip(reference.values, milli.values))
    # 0.001 is no double: corners move by 1e-16, and with them the image by float's rounding.
    require(worst <= 4e-6 * max(reference.values), f'mm: {worst}')
    require(max(kilo.values) > 1e5 * max(reference.values), 'a lamp that is 1024 times as near is 2^20 times as bright')


@case('a scene moved by 2^20 m, 1e7 m and 2^30 m from the origin is the same image')
def translation(bench):
    reference = bench.render(still_life())
    # Every place of the scene is a multiple of 2^-2: these sums are exact in double.
    for shift in ((2.0 ** 20, 0.0, 0.0), (1e7, -1e7, 1e7), (2.0 ** 30, 2.0 ** 29, -2.0 ** 30)):
        same(reference, bench.render(still_life(shift=shift)), 1.0, f'{shift}')


def glowing(value, shapes):
    return (f'<material name="g{value}"><emission spectrum="constant:1" scale="{value}"/></material>', f'{shapes.replace("MATERIAL", f"g{value}")}')


def scene_of(parts, camera, background=0):
    materials = ''.join(part[0] for part in parts)
    shapes = ''.join(part[1] for part in parts)
    backdrop = f'<background spectrum="constant:1" scale="{background}"/>' if background else ''
    return f'<scene version="1">{BANDS}{materials}{shapes}{backdrop}{camera}</scene>'


@case('planes at depths from 1e-9 to 1e9 m in one view: each is seen where nothing nearer is, exactly')
def depths(bench):
    depth = [10.0 ** decade for decade in range(-9, 10)]
    parts = []
    for i, z in enumerate(depth):
        # From beyond the left edge to the end of column i (8 pixels, 2/19 of half the view, which is z tan 45 degrees).
        right, width = z * (2 * (i + 1) / len(depth) - 1), 4 * z
        parts.append(glowing(i + 1, f'<node translate="{right - width / 2!r} 0 {-z!r}"><plane size="{width!r} {width!r}" material="MATERIAL"/></node>'))
    camera = f'<camera fov="90" look-from="0 0 0" look-at="0 0 -1" size="{19 * 8}x{19 * 8}"/>'
    for given in (parts, parts[::-1]):
        cube = bench.render(scene_of(given, camera))
        for y in (0, 75, 151):
            for i, z in enumerate(depth):
                seen = set(cube.row(y)[8 * i + 1:8 * i + 7])
                require(seen == {float(i + 1)}, f'depth {z:g}, row {y}: {seen}')


@case('of two planes the nearer is seen, from 1e-6 to 1e9 m, down to 1e-6 of the distance between them')
def order(bench):
    camera = '<camera fov="40" look-from="0 0 0" look-at="0 0 -1" size="9x9"/>'
    for z in (1e-6, 1.0, 1e4, 1e9):
        for swap in (False, True):
            near, far = f'<node translate="0 0 {-z!r}"><plane size="{4 * z!r}" material="MATERIAL"/></node>', \
                        f'<node translate="0 0 {-z * (1 + 1e-6)!r}"><plane size="{4 * z!r}" material="MATERIAL"/></node>'
            parts = [glowing(1, near), glowing(2, far)]
            cube = bench.render(scene_of(parts[::-1] if swap else parts, camera))
            require(set(cube.values) == {1.0}, f'{z:g} m, order {swap}: {sorted(set(cube.values))}')


def obj(vertices, faces):
    return ''.join(f'v {x!r} {y!r} {z!r}\n' for x, y, z in vertices) + ''.join(f'f {" ".join(str(i + 1) for i in f)}\n' for f in faces)


MESH = '<mesh file="mesh.obj" material="MATERIAL" normals="flat"/>'
FRONT = '<camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="32x32"/>'


@case('triangles of no area (a point, a line, two corners equal), of less than a sample, behind the eye: nothing, and no complaint')
def nothing(bench):
    shapes = {'a point': [(0, 0, 0)] * 3, 'a line': [(-1, -1, 0), (0, 0, 0), (1, 1, 0)], 'two corners': [(0, 0, 0), (1, 1, 0), (1, 1, 0)],
              'edge-on': [(0, 0, 0), (0, 0, 1), (0, 0, -1)], 'behind': [(-1, -1, 6), (1, -1, 6), (0, 1, 6)],
              'below a sample': [(1e-9, 1e-9, 0), (2e-9, 1e-9, 0), (1e-9, 2e-9, 0)]}
    for name, corners in shapes.items():
        # One solid triangle far from the view keeps the file a mesh.
        bench.write('mesh.obj', obj(corners + [(90.0, 0.0, 0.0), (91.0, 0.0, 0.0), (90.0, 1.0, 0.0)], [(0, 1, 2), (3, 4, 5)]))
        cube = bench.render(scene_of([glowing(7, MESH)], FRONT, 3))
        require(set(cube.values) == {3.0}, f'{name}: {sorted(set(cube.values))}')


@case('a triangle much larger than the screen, duplicates, and one through the eye plane cover what they must, exactly')
def large(bench):
    big = [(-1e9, -1e9, 0.0), (1e9, -1e9, 0.0), (0.0, 1e9, 0.0)]
    bench.write('mesh.obj', obj(big, [(0, 1, 2)]))
    require(set(bench.render(scene_of([glowing(7, MESH)], FRONT, 3)).values) == {7.0}, '2e9 m wide')
    bench.write('mesh.obj', obj(big, [(0, 1, 2)] * 1000 + [(2, 1, 0)] * 1000))
    require(set(bench.render(scene_of([glowing(7, MESH)], FRONT, 3)).values) == {7.0}, 'two thousand duplicates')
    # A floor 1 m below the eye, from behind it to the horizon: it covers all below the middle of the picture.
    bench.write('mesh.obj', obj([(-1e9, -1.0, 1e9), (1e9, -1.0, 1e9), (1e9, -1.0, -1e9), (-1e9, -1.0, -1e9)], [(0, 1, 2), (0, 2, 3)]))
    camera = '<camera fov="60" look-from="0 0 0" look-at="0 0 -1" size="32x32"/>'
    cube = bench.render(scene_of([glowing(7, MESH)], camera, 3))
    for y in range(32):
        require(set(cube.row(y)) == {3.0 if y < 16 else 7.0}, f'floor, row {y}: {sorted(set(cube.row(y)))}')


@case('a square cut into slivers 1e-8 wide among wide strips has no crack and no double hit before a background 1e6 times as bright')
def slivers(bench):
    xs, x = [], -1.0
    while x < 1:
        xs += [x, x + 1e-8]
        x += 0.037
    xs.append(1.0)
    vertices = [(v, y, 0.0) for v in xs for y in (-1.0, 1.0)]
    faces = []
    for i in range(len(xs) - 1):
        a = 2 * i
        faces += [(a, a + 2, a + 3), (a, a + 3, a + 1)]
    bench.write('mesh.obj', obj(vertices, faces))
    require(set(bench.render(scene_of([glowing(1, MESH)], FRONT, 1000000), '--samples', '64').values) == {1.0}, 'a crack')
    # A fan of needles about a point that is no corner of a pixel.
    hub, rim = (0.0123456, -0.0654321, 0.0), []
    for i in range(2000):
        angle = 2 * math.pi * i / 2000
        rim.append((3 * math.cos(angle), 3 * math.sin(angle), 0.0))
    bench.write('mesh.obj', obj([hub] + rim, [(0, i + 1, (i + 1) % 2000 + 1) for i in range(2000)]))
    require(set(bench.render(scene_of([glowing(1, MESH)], FRONT, 1000000), '--samples', '64').values) == {1.0}, 'a crack in the fan')


@case('coordinates beyond float, NaN and infinity in a mesh: refused or seen, never a broken image')
def coordinates(bench):
    for word in ('1e39', 'nan', 'inf', '-1e308', '1e-320', '3e38'):
        bench.write('mesh.obj', f'v 0 0 0\nv {word} 0 0\nv 0 {word} 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 4 5\n')
        bench.write('scene.xml', scene_of([glowing(1, MESH)], FRONT, 3))
        outcome = bench.run('render', 'scene.xml', '-o', 'image.img')
        require(outcome.code in (0, 1), f'{word}: {outcome}')
        require(outcome.code == 0 or 'mesh.obj' in outcome.err, f'{word}: the file is not named: {outcome}')
        bench.refused += outcome.code == 1


@case('transforms of scale 1e-9 to 1e9 nested a hundred deep come out as their product; those without an inverse are refused')
def nesting(bench):
    for factor in (2.0 ** -30, 2.0 ** 30):
        opening = ''.join(f'<node scale="{factor if i % 2 else 1 / factor!r}">' for i in range(100))
        shape = glowing(7, opening + '<plane size="1 1" material="MATERIAL"/>' + '</node>' * 100)
        cube = bench.render(scene_of([shape], FRONT, 3))
        seen = [sum(value == 7.0 for value in cube.row(y)) for y in range(32)]
        require(seen == [0] * 8 + [16] * 16 + [0] * 8, f'{factor}: {seen}')
    for words in ('scale="0"', 'scale="1 0 1"', 'scale="1e-400"', 'matrix="1 0 0 0  0 1 0 0  1 1 0 0  0 0 0 1"', 'rotate="0 0 0 30"',
                  'translate="1e999 0 0"', 'translate="nan 0 0"'):
        bench.refuse(scene_of([glowing(7, f'<node {words}><plane material="MATERIAL"/></node>')], FRONT), ['scene.xml:1'])


@case('a camera at the place that it looks at, a view of 0 or 180 degrees, and a height of 0 are refused; 1e-4 and 179.99 degrees are not')
def cameras(bench):
    plane = glowing(7, '<plane size="1e7" material="MATERIAL"/>')
    for words in ('fov="0"', 'fov="180"', 'fov="-1"', 'fov="nan"', 'type="orthographic" height="0"', 'look-from="0 0 0" look-at="0 0 0"',
                  'size="0x5"', 'size="-1x5"', 'size="65537x1"', 'size="1x65537"', 'size="99999999999999999999x1"'):
        size = '' if 'size=' in words else ' size="4x4"'
        bench.refuse(scene_of([plane], f'<camera {words}{size}/>'), ['scene.xml:1'])
    for fov in ('1e-4', '179.99'):
        cube = bench.render(scene_of([plane], f'<camera fov="{fov}" look-from="0 0 5" look-at="0 0 0" size="8x8"/>', 3))
        require(cube.at(4, 4) == 7.0, f'fov {fov}')
