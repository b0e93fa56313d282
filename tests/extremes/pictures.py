"""Pictures, lamps and scene graphs of extreme size. The heavy ones run with --heavy."""

import math
import os
import resource

from harness import Cube, case, close, require, same

BANDS = '<wavelengths from="500" to="600" step="100"/>'
WALL = '<plane size="8 8" material="m"/>'
SUN = '<light type="directional" direction="0 0 -1" spectrum="constant:1" scale="2"/>'


def scene(content, size='8x8', light=SUN, bands=BANDS, height='2'):
    return f'''<scene version="1">{bands}<material name="m"><diffuse reflectance="constant:0.5"/></material>{content}{light}
  <camera type="orthographic" height="{height}" look-from="0 0 5" look-at="0 0 0" size="{size}"/></scene>'''


@case('pictures of 1x1, 1x65536 and 65536x1 pixels hold what a small one holds; 65537 is refused with the limit')
def thin(bench):
    expected = bench.render(scene(WALL)).at(0, 0)
    for size, height in (('1x1', '2'), ('1x65536', '2'), ('65536x1', '1e-4')):
        cube = bench.render(scene(WALL, size, height=height), '--samples', '1')
        require(set(cube.values) == {expected}, f'{size}: {sorted(set(cube.values))[:4]}')
    for size in ('65537x1', '1x65537'):
        bench.refuse(scene(WALL), ['65537', '65536'], '--size', size, code=2)


@case('a scene without anything is the background, or black; of nothing but lamps as well')
def empty(bench):
    require(set(bench.render(scene('', light='')).values) == {0.0}, 'nothing')
    require(set(bench.render(scene('')).values) == {0.0}, 'a lamp alone')
    require(set(bench.render(scene('<background spectrum="constant:1" scale="3"/>')).values) == {3.0}, 'a background')


@case('ten thousand lamps that share a light are as bright as the one, whether of one spectrum or of ten thousand')
def lamps(bench):
    one = scene(WALL, light='<light type="point" position="0 0 3" spectrum="constant:1" scale="1"/>')
    reference = bench.render(one, '--samples', '1')
    # Float sums of n equal parts: at most n / 2^24 off (docs/extremes.md).
    many = '<light type="point" position="0 0 3" spectrum="constant:1" scale="1e-4"/>'
    cube = bench.render(scene(WALL, light=many * 10000), '--samples', '1')
    worst = max(close(b, a, 10000 / 2 ** 24, 'one spectrum') for a, b in zip(reference.values, cube.values))
    bench.remarks.append(f'one spectrum, 10 000 lamps: largest relative error {worst:.2g}')
    different = ''.join(f'<light type="point" position="0 0 3" spectrum="400:1 {700 + i}:1" scale="1e-3"/>' for i in range(1000))
    cube = bench.render(scene(WALL, light=different), '--samples', '1')
    worst = max(close(b, a, 1000 / 2 ** 24, 'a thousand spectra') for a, b in zip(reference.values, cube.values))
    bench.remarks.append(f'1000 spectra: largest relative error {worst:.2g}')


@case('a scene graph 10 000 levels deep is rendered, one of 100 001 refused with number and limit')
def deep(bench):
    def nested(levels):
        return '<node>' * levels + WALL + '</node>' * levels
    expected = bench.render(scene(WALL))
    same(expected, bench.render(scene(nested(10000))), 1.0, '10 000 levels')
    bench.refuse(scene(nested(100001)), ['100000'])
    chain = ''.join(f'<node name="n{i}"><instance of="n{i + 1}"/></node>' for i in range(2000)) + f'<node name="n2000">{WALL}</node>'
    same(expected, bench.render(scene(chain)), 1.0, 'a chain of 2000 instances')


@case('instances that double thirty times over are refused with number and limit, in no time and little memory')
def doubling(bench):
    doubled = ''.join(f'<node name="n{i}"><instance of="n{i + 1}"/><instance of="n{i + 1}"/></node>' for i in range(30))
    bench.refuse(scene(doubled + f'<node name="n30">{WALL}</node>'), ['16777216'])


@case('declared sizes beyond the machine are refused with number and limit: bands x pixels, EXR chunks, a preview')
def declared(bench):
    many = '<wavelengths from="1000" to="10999" step="1"/>'
    for compression in ('none', 'zips', 'zip', 'piz'):
        outcome = bench.refuse(scene(WALL, '65536x65536', bands=many), ['2147483647'], '--compression', compression, '--samples', '1', output='image.exr')
        require('--format envi' in outcome.err, f'no way out is said: {outcome}')
    bench.refuse(scene(WALL), ['64'], '--samples', '65', code=2)
    bench.refuse(scene(WALL), ['1 to 64'], '--samples', '0', code=2)


def peak_of(bench, *arguments):
    outcome = bench.run('render', *arguments, '--json', timeout=3600)
    require(outcome.code == 0, str(outcome))
    return outcome.json()


@case('a picture of 8192 rows takes less than 1 GiB, however many bytes it has')
def bounded_memory(bench):
    bench.write('scene.xml', scene(WALL, bands='<wavelengths from="400" to="500" step="5"/>'))
    for name in ('image.img', 'image.exr'):
        peak = peak_of(bench, 'scene.xml', '-o', name, '--size', '1024x8192', '--samples', '4')['peak_rss_bytes']
        bench.remarks.append(f'{name}: peak {peak / 2 ** 20:.0f} MiB')
        require(peak < 1 << 30, f'{peak} bytes')


@case('16384 x 16384 x 81 bands in less than 2 GiB', heavy=True)
def large_cube(bench):
    bench.write('scene.xml', scene(WALL, bands='<wavelengths from="400" to="800" step="5"/>'))
    space = os.statvfs(bench.folder)
    for name, wanted in (('image.exr', 2), ('image.img', 88)):
        # A wall of one grey compresses to almost nothing; ENVI takes 87 GB.
        if space.f_bavail * space.f_frsize < wanted << 30:
            bench.remarks.append(f'{name} left out: {space.f_bavail * space.f_frsize >> 30} GiB free, {wanted} wanted')
            continue
        said = peak_of(bench, 'scene.xml', '-o', name, '--size', '16384x16384', '--samples', '1', *(['--compression', 'zips'] if name.endswith('exr') else []))
        bench.remarks.append(f'{name}: peak {said["peak_rss_bytes"] / 2 ** 20:.0f} MiB, {said["seconds"]["total"]:.0f} s')
        require(said['peak_rss_bytes'] < 2 << 30, f'{name}: {said["peak_rss_bytes"]} bytes')
        os.remove(bench.path(name))


@case('32768 x 32768 pixels', heavy=True)
def large_picture(bench):
    bench.write('scene.xml', scene(WALL, bands='<wavelengths>550</wavelengths>'))
    said = peak_of(bench, 'scene.xml', '-o', 'image.exr', '--size', '32768x32768', '--samples', '1')
    bench.remarks.append(f'peak {said["peak_rss_bytes"] / 2 ** 20:.0f} MiB, {said["seconds"]["total"]:.0f} s')
    require(said['peak_rss_bytes'] < 2 << 30, f'{said["peak_rss_bytes"]} bytes')


def grid_mesh(bench, side):
    """A flat square as a binary PLY of 2 side^2 triangles."""
    import array
    import struct
    with open(bench.path('grid.ply'), 'wb') as file:
        file.write((f'ply\nformat binary_little_endian 1.0\nelement vertex {(side + 1) ** 2}\nproperty float x\nproperty float y\nproperty float z\n'
                    f'element face {2 * side * side}\nproperty list uchar int vertex_indices\nend_header\n').encode())
        for y in range(side + 1):
            row = array.array('f')
            for x in range(side + 1):
                row.extend((2 * x / side - 1, 2 * y / side - 1, 0.0))
            file.write(row.tobytes())
        pack = struct.Struct('<BiiiBiii').pack
        for y in range(side):
            first = y * (side + 1)
            file.write(b''.join(pack(3, first + x, first + x + 1, first + x + side + 2, 3, first + x, first + x + side + 2, first + x + side + 1)
                                for x in range(side)))


def meshes(bench, side):
    grid_mesh(bench, side)
    content = '<mesh file="grid.ply" material="m" normals="flat"/>'
    bench.write('scene.xml', scene(content, '64x64'))
    said = peak_of(bench, 'scene.xml', '-o', 'image.img', '--samples', '4')
    require(said['triangles'] == 2 * side * side, f'{said["triangles"]} triangles')
    bench.remarks.append(f'{said["triangles"]} triangles: {said["seconds"]["total"]:.1f} s, {said["peak_rss_bytes"] / said["triangles"]:.0f} bytes a triangle')
    cube = Cube(bench.path('image.img'))
    for value in cube.values:
        close(value, 1 / math.pi, 1e-6, 'the same as one plane')


@case('a mesh of 0.5 million triangles, most smaller than a sample, looks like the one square it tiles')
def many_triangles(bench):
    meshes(bench, 500)


@case('50 million triangles', heavy=True)
def fifty_million(bench):
    meshes(bench, 5000)


def wide(bench, count):
    nodes = ''.join(f'<node translate="{(i % 997 - 498) / 499} {(i // 997 % 991 - 495) / 496} 0"><plane size="0.01" material="m"/></node>'
                    for i in range(count))
    bench.write('scene.xml', scene(nodes, '64x64'))
    said = peak_of(bench, 'scene.xml', '-o', 'image.img', '--samples', '1')
    require(said['triangles'] == 2 * count, f'{said["triangles"]} triangles')
    bench.remarks.append(f'{count} nodes: {said["seconds"]["total"]:.1f} s, {said["peak_rss_bytes"] / count:.0f} bytes a node')
    require(max(Cube(bench.path('image.img')).values) > 0, 'black')


@case('a graph twenty thousand nodes wide')
def twenty_thousand_nodes(bench):
    wide(bench, 20000)


@case('a graph a million nodes wide', heavy=True)
def million_nodes(bench):
    wide(bench, 1000000)
