"""Amounts of light and wavelengths at the extremes. A grey wall that fills the picture, under light along its normal: L = rho E / pi."""

import math

from harness import case, close, require, same

GLOW = '<emission spectrum="lamp" scale="1"/>'  # instead of a reflectance: L is the lamp's own number


def wall(lamp='300:2 900:2', material='<diffuse reflectance="constant:0.5"/>', bands='<wavelengths from="400" to="700" step="100"/>',
         light='', size='8x4', extra=''):
    """`lamp`: pairs of an irradiance, W.m^-2.nm^-1; `light`: other attributes instead of it."""
    source = light or 'type="directional" direction="0 0 -1" spectrum="lamp"'
    spectrum = '' if light else f'<spectrum name="lamp" quantity="{"radiance" if material == GLOW else "irradiance"}">{lamp}</spectrum>'
    return f'''<scene version="1">{bands}{spectrum}{extra}
  <material name="m">{material}</material>
  <plane size="8 8" material="m"/>
  {'' if material == GLOW else f'<light name="sun" {source}/>'}
  <camera type="orthographic" height="2" look-from="0 0 5" look-at="0 0 0" size="{size}"/>
</scene>'''


@case('radiances from 1e-30 to 1e30 come out as 0.5 E / pi, and a lamp 2^k times as bright makes the image exactly 2^k times')
def scaling(bench):
    reference = bench.render(wall())
    worst = 0
    for exponent in (-100, -67, -30, -1, 30, 67, 100, 124):
        value = repr(2.0 ** (exponent + 1))
        same(reference, bench.render(wall(f'300:{value} 900:{value}')), 2.0 ** exponent, f'2^{exponent}')
    for decade in range(-30, 31, 6):
        value = 10.0 ** decade
        worst = max(worst, close(bench.render(wall(f'300:{value} 900:{value}')).at(0, 0), 0.5 * value / math.pi, 3e-7, f'1e{decade}'))
    bench.remarks.append(f'largest relative error over 1e-30 to 1e30: {worst:.2g}')


@case('the same through amounts: 1e-30 to 1e30 W/m2, cd and cd/m2')
def amounts(bench):
    for value in (1e-30, 1e-15, 1e15, 1e30):
        sun = f'type="directional" direction="0 0 -1" spectrum="constant:1" irradiance="{value} W/m2 over 400:900"'
        close(bench.render(wall(light=sun)).at(3, 2), 0.5 * value / 500 / math.pi, 3e-7, f'{value} W/m2')
        dome = f'type="ambient" spectrum="constant:1" radiance="{value} W/m2/sr over 400:900"'
        close(bench.render(wall(light=dome)).at(3, 2), 0.5 * value / 500, 3e-7, f'{value} W/m2/sr')
        lamp = f'type="point" position="0 0 3" spectrum="constant:1" intensity="{value} W/sr over 400:900"'
        # At (-0.25, 0.25): I cos^3 / d^2 over 500 nm.
        square = 9 + 2 * 0.25 ** 2
        expected = 0.5 * value / 500 / math.pi * 3 / square ** 1.5
        close(bench.render(wall(light=lamp), '--samples', '1').at(3, 1), expected, 1e-6, f'{value} W/sr')


@case('a value beyond float is an error that names it, one lost below is counted in a warning, what is denormal comes out')
def float_range(bench):
    for value in ('1e40', '2e300'):
        bench.refuse(wall(f'300:{value} 900:{value}'), ['float'])
    near = 'type="point" position="0.25 0.25 0.01" spectrum="constant:1" intensity="1e38 W/sr over 400:401"'
    bench.refuse(wall(light=near), ['inf (allowed: finite values)'], '--samples', '1')  # neither factor is: I dominates at 1e38, 1/d^2 at 1e4
    for value in (1e-39, 3e-42):
        close(bench.render(wall(f'300:{value} 900:{value}', GLOW)).at(0, 0), value, 2e-3, f'{value}')
    close(bench.render(wall('300:3.4e38 900:3.4e38', GLOW)).at(0, 0), 3.4e38, 1e-7, '3.4e38, with a preview beyond float')
    said = []
    cube = bench.render(wall('300:1e-50 900:1e-50'), warnings=said)
    require(set(cube.values) == {0.0}, 'values below float are 0')
    require('below' in said[0], f'nothing is said of values lost below float: {said[0]!r}')


@case('half: 65504 is kept, 65520 refused, 1e-9 counted as lost')
def half_range(bench):
    bench.write('scene.xml', wall('300:65504 900:65504', GLOW))
    outcome = bench.run('render', 'scene.xml', '-o', 'image.exr', '--half')
    require(outcome.code == 0, str(outcome))
    bench.refuse(wall('300:65520 900:65520', GLOW), ['half', '65520'], '--half', output='image.exr')
    bench.write('scene.xml', wall('300:1e-9 900:1e-9', GLOW))
    outcome = bench.run('render', 'scene.xml', '-o', 'image.exr', '--half')
    require(outcome.code == 0 and 'half' in outcome.err, f'underflow is not said: {outcome}')


@case('no light, no lights at all, black and white materials: exactly 0, and E / pi')
def darkness(bench):
    said = []
    require(set(bench.render(wall('300:0 900:0')).values) == {0.0}, 'a lamp of 0')
    require(set(bench.render(wall(material='<diffuse reflectance="constant:0"/>')).values) == {0.0}, 'black')
    scene = wall().replace('<light name="sun" type="directional" direction="0 0 -1" spectrum="lamp"/>', '')
    require(set(bench.render(scene, warnings=said).values) == {0.0} and 'light' in said[0], 'no lights: black, and said')
    for value in bench.render(wall(material='<diffuse reflectance="constant:1"/>')).values:
        close(value, 2 / math.pi, 2e-7, 'white')
    for body in ('1.0000001', '-1e-9', 'nan', 'inf', '1e999'):
        bench.refuse(wall(material=f'<diffuse reflectance="constant:{body}"/>'), ['scene.xml:2'])
    for lamp in ('300:-1e-30 900:1', '300:nan 900:1', '300:1 300:1 300:2', '900:1 300:1', '300:1 900:1e999'):
        bench.refuse(wall(lamp), ['scene.xml:'])


@case('wavelengths from 1 nm to 1 mm; beyond, or not ascending, they are refused at their place')
def wide_bands(bench):
    for listed in ('1 10 100 1000 10000 100000 1000000', '1 1000000', '999999.9 1000000'):
        cube = bench.render(wall('0.1:2 1e7:2', bands=f'<wavelengths>{listed}</wavelengths>'))
        require(cube.nm == [float(word) for word in listed.split()], f'wavelengths {cube.nm}')
        for value in cube.values:
            close(value, 1 / math.pi, 3e-7, listed)
    for listed in ('0 500', '-1 500', '500 500', '600 500', 'nan 500', '500 inf', '500 1e400', '0.999 500', '500 1000001'):
        bench.refuse(wall(bands=f'<wavelengths>{listed}</wavelengths>'), ['scene.xml:1'])
    bench.refuse(wall(bands='<wavelengths>0.999 500</wavelengths>'), ['0.999', '1 … 1000000 nm'])


@case('one band and ten thousand; one more is refused with number and limit')
def band_count(bench):
    one = bench.render(wall('540:0 550:4 560:0', bands='<wavelengths>550</wavelengths>'))
    # A hat of half-width 5 nm over a triangle of half-width 10 nm: 4 (1 - 5/10/3).
    close(one.at(0, 0), 0.5 / math.pi * 4 * (1 - 5 / 30), 3e-7, 'one band')
    many = bench.render(wall('1:2 20000:2', bands='<wavelengths from="1000" to="10999" step="1"/>', size='5x3'))
    require(many.bands == 10000, f'{many.bands} bands')
    for value in many.values:
        close(value, 1 / math.pi, 3e-7, '10 000 bands')
    bench.refuse(wall(bands='<wavelengths from="1000" to="11000" step="1"/>'), ['10001', '10000'])
    bench.refuse(wall(bands='<wavelengths from="1" to="1e9" step="1e-9"/>'), ['10000'])


@case('an irregular grid with gaps of 1e-6 nm: values of a ramp at their wavelengths, names that differ')
def dense_bands(bench):
    listed = [500, 500.000001, 500.000002, 500.000005, 501, 600, 600.000001]
    text = ' '.join(repr(nm) for nm in listed)
    scene = wall('400:0 700:3', bands=f'<wavelengths projection="point">{text}</wavelengths>')
    cube = bench.render(scene)
    require(cube.nm == listed, f'wavelengths {cube.nm}')
    for nm, value in zip(listed, cube.spectrum(2, 2)):
        close(value, 0.5 / math.pi * (nm - 400) / 100, 3e-7, f'{nm} nm')
    slit = bench.render(wall('300:2 900:2', bands=f'<wavelengths>{text}</wavelengths>'))
    for value in slit.values:
        close(value, 1 / math.pi, 3e-7, 'slit')
    outcome = bench.run('render', 'scene.xml', '-o', 'image.exr')
    require(outcome.code == 0, str(outcome))
    names = bench.run('info', 'image.exr', '--json').json()['wavelengths_nm']
    require(len(set(names)) == len(listed), f'EXR bands {names}')


@case('a laser line 0.001 nm wide, or of none, anywhere between nodes: its power is all there (slit and box)')
def laser_lines(bench):
    for projection in ('slit', 'box'):
        for nm in (500, 500.0005, 503.3337, 509.9999999, 510):
            for width in ('', ',0.001', ',1e-6'):
                sun = f'type="directional" direction="0 0 -1" spectrum="line:{nm}{width}" irradiance="3 W/m2"'
                cube = bench.render(wall(light=sun, bands=f'<wavelengths from="480" to="530" step="10" projection="{projection}"/>'))
                # Bands of a regular grid are 10 nm wide each (half at the ends, where no light is).
                total = sum(cube.spectrum(1, 1)) * 10
                close(total, 0.5 * 3 / math.pi, 1e-6, f'{projection}, line:{nm}{width}')
    bench.refuse(wall(light='type="directional" direction="0 0 -1" spectrum="line:500,1e-9" irradiance="3 W/m2"'), ['1e-09', '1e-06'])
