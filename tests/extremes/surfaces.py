"""Surfaces at the extremes: indices, roughnesses, grazing angles, fluorescence; each against its closed form."""

import cmath
import math

from harness import case, close, require

BANDS = '<wavelengths from="400" to="700" step="100"/>'


def tilted(material, degrees, light, size='5x5', extra='', bands=BANDS, shape='<plane size="1e8" material="m"/>'):
    """A plane whose normal is tilted by so many degrees from the view, seen by an orthographic camera."""
    return f'''<scene version="1">{bands}{extra}
  <material name="m">{material}</material>
  <node rotate="0 1 0 {degrees!r}">{shape}</node>
  {light}
  <camera type="orthographic" height="1" look-from="0 0 1000" look-at="0 0 0" size="{size}"/>
</scene>'''


DOME = '<light type="ambient" spectrum="constant:1" scale="3"/>'


def fresnel(n, k, cos_theta):
    """Reflectance of unpolarised light at an interface from air to n + ik."""
    m = complex(n, k)
    inner = cmath.sqrt(m * m - (1 - cos_theta ** 2))
    rs = (cos_theta - inner) / (cos_theta + inner)
    rp = (m * m * cos_theta - inner) / (m * m * cos_theta + inner)
    return (abs(rs) ** 2 + abs(rp) ** 2) / 2


@case('a metal of n and k from 1e-6 to 1e3 mirrors what Fresnel says, head on and up to 89.9999 degrees')
def metals(bench):
    worst = 0
    for n in (1e-6, 0.5, 1, 1e3):
        for k in (0, 1e-6, 1, 1e3):
            bench.write('i.csv', f'wavelength_nm,n,k\n300,{n},{k}\n900,{n},{k}\n')
            for degrees in (0.0, 60.0, 89.0, 89.9999):
                scene = tilted('<conductor ior="i.csv"/>', degrees, DOME)
                value = bench.render(scene, '--samples', '1').at(2, 2)
                expected = 3 * fresnel(n, k, math.cos(math.radians(degrees)))
                error = abs(value - expected) / 3
                worst = max(worst, error)
                require(error < 3e-5, f'n {n}, k {k}, {degrees} degrees: {value} instead of {expected}')
    bench.remarks.append(f'largest error in reflectance: {worst:.2g}')


@case('a coat over black of index 1e-6 to 1e3 mirrors what Fresnel says up to 89.9999 degrees, all of it beyond the critical angle')
def coats(bench):
    worst = 0
    for n in (1e-6, 0.5, 0.999, 1, 1.000001, 1.5, 10, 1e3):
        for degrees in (0.0, 60.0, 89.0, 89.9999):
            material = f'<diffuse reflectance="constant:0"/><gloss ior="{n}"/>'
            value = bench.render(tilted(material, degrees, DOME), '--samples', '1').at(2, 2)
            expected = 3 * fresnel(n, 0, math.cos(math.radians(degrees)))
            error = abs(value - expected) / 3
            worst = max(worst, error)
            require(error < 3e-5, f'index {n}, {degrees} degrees: {value} instead of {expected}')
    bench.remarks.append(f'largest error in reflectance: {worst:.2g}')
    for n in ('0', '-1', 'nan', '1e400'):
        bench.refuse(tilted(f'<gloss ior="{n}"/>', 0.0, DOME), ['scene.xml:2'])


@case('white under any coat, and perfect metal, at roughness 0, 1e-8 … 1: a furnace of 3 gives back 3 at every angle')
def furnace(bench):
    worst = 0
    for roughness in ('0', '1e-8', '0.001', '0.5', '1'):
        coat = f'<diffuse reflectance="constant:1"/><gloss ior="1.5" roughness="{roughness}"/>'
        metal = f'<specular reflectance="constant:1" roughness="{roughness}"/>'
        for material in (coat, metal):
            for degrees in (0.0, 80.0, 89.9999):
                value = bench.render(tilted(material, degrees, DOME), '--samples', '1').at(2, 2)
                worst = max(worst, close(value, 3, 3e-5, f'{material}, {degrees} degrees'))
    bench.remarks.append(f'largest loss or gain: {worst:.2g}')


@case('a lobe of roughness 1e-9 … 1 seen and lit head-on is as bright as 1 / pi alpha^2 says, up to 3e35 times a facet')
def peaks(bench):
    sun = '<light type="directional" direction="0 0 -1" spectrum="constant:1" scale="2"/>'
    for roughness in (1e-9, 1e-8, 1e-4, 0.01, 0.3):
        material = f'<diffuse reflectance="constant:0"/><gloss ior="1.5" roughness="{roughness!r}"/>'
        value = bench.render(tilted(material, 0.0, sun)).at(2, 2)
        close(value, 2 * 0.04 / (4 * math.pi * roughness ** 4), 2e-2 if roughness > 0.1 else 2e-6, f'roughness {roughness}')


@case('roughness beyond 0 … 1 is refused at its place')
def roughness_range(bench):
    for roughness in ('-1e-9', '1.0000001', 'nan', 'inf', '1e-400 -1', '0.1 0.6', '9.99e-10', '1e-300'):
        bench.refuse(tilted(f'<gloss ior="1.5" roughness="{roughness}"/>', 0.0, DOME), ['scene.xml:2'])


@case('light that grazes at up to 89.9999 degrees, and a view that does: Lambert cosine within float, beyond 90 degrees black')
def grazing(bench):
    worst = 0
    for degrees in (60.0, 89.0, 89.99, 89.9999):
        angle = math.radians(degrees)
        sun = (f'<light type="directional" direction="{-math.sin(angle)!r} 0 {-math.cos(angle)!r}" spectrum="constant:1" scale="2"/>')
        value = bench.render(tilted('<diffuse reflectance="constant:0.5"/>', 0.0, sun)).at(2, 2)
        worst = max(worst, close(value, math.cos(angle) / math.pi, 1e-6, f'light at {degrees} degrees'))
        down = '<light type="directional" direction="0 0 -1" spectrum="constant:1" scale="2"/>'
        value = bench.render(tilted('<diffuse reflectance="constant:0.5"/>', degrees, down), '--samples', '1').at(2, 2)
        # The normal is float: its component along the view has an error of half an ulp of itself, the rotation one of 1e-16.
        worst = max(worst, close(value, math.cos(angle) / math.pi, 1e-6, f'seen at {degrees} degrees'))
    bench.remarks.append(f'largest relative error: {worst:.2g}')
    sun = '<light type="directional" direction="-1 0 1e-9" spectrum="constant:1" scale="2"/>'
    require(set(bench.render(tilted('<diffuse reflectance="constant:0.5"/>', 0.0, sun)).values) == {0.0}, 'light from behind')


@case('gloss at roughness 1e-8 … 1 under grazing light is finite, never negative, and the same from both sides of the plane of symmetry')
def glossy_grazing(bench):
    for roughness in ('0', '1e-8', '1e-3', '0.03', '1'):
        for degrees in (0.0, 89.9999):
            angle = math.radians(degrees)
            sun = f'<light type="directional" direction="{-math.sin(angle)!r} 0 {-math.cos(angle)!r}" spectrum="constant:1" scale="2"/>'
            for material in ('<diffuse reflectance="constant:0.5"/><gloss ior="1.5" roughness="%s"/>', '<conductor ior="metals/Au" roughness="%s"/>'):
                cube = bench.render(tilted(material % roughness, 0.0, sun), '--samples', '1')
                require(min(cube.values) >= 0, 'negative light')
                for y in range(5):
                    require(list(cube.row(y)) == list(cube.row(4 - y)), 'upper and lower half differ')


def fluorescent(excitation, emission, extra, lamp, bands):
    sun = '<light type="directional" direction="0 0 -1" spectrum="lamp"/>'
    spectra = (f'<spectrum name="lamp" quantity="irradiance">{lamp}</spectrum><spectrum name="x" relative="true">{excitation}</spectrum>'
               f'<spectrum name="e" relative="true">{emission}</spectrum>')
    material = f'<diffuse reflectance="constant:0"/><fluorescence excitation="x" emission="e" {extra}/>'
    return tilted(material, 0.0, sun, extra=spectra, bands=bands)


def integral(nm, values, weight=lambda x: 1.0):
    """Of a curve linear between nm, times a weight that is linear (Simpson's rule is exact)."""
    total = 0.0
    for a, b, p, q in zip(nm, nm[1:], values, values[1:]):
        total += (b - a) / 6 * (p * weight(a) + 4 * (p + q) / 2 * weight((a + b) / 2) + q * weight(b))
    return total


@case('fluorescence of yield 1 and strength 1: as many photons leave as arrive; of energy, what the Stokes shift leaves')
def fluorescence(bench):
    # A rectangular lamp from 400 to 410 nm that is absorbed whole; emission a triangle at 500 … 600 nm.
    bands = '<wavelengths from="380" to="700" step="2" projection="box"/>'
    cube = bench.render(fluorescent('300:1 450:1 450.0001:0', '500:0 550:1 600:0', 'yield="1" strength="1"', '400:3 410:3', bands), '--samples', '1')
    # Boxes partition the range: sums are integrals; of λ times a curve linear on each box, within its width squared.
    values = cube.spectrum(2, 2)
    photons_in = 3 * (410 ** 2 - 400 ** 2) / 2
    photons_out = sum(value * nm * 2 for nm, value in zip(cube.nm, values)) * math.pi
    close(photons_out, photons_in, 1e-5, 'photons')
    energy_out = sum(value * 2 for value in values) * math.pi
    mean = integral([500, 550, 600], [0, 1, 0], lambda x: x) / integral([500, 550, 600], [0, 1, 0])
    close(energy_out, photons_in / mean, 1e-6, 'energy')
    for words in ('yield="1.0000001"', 'strength="1.0000001"', 'yield="-1e-9"', 'yield="nan"'):
        bench.refuse(fluorescent('300:1 450:1', '500:0 550:1 600:0', words, '400:3 410:3', bands), ['scene.xml:2'])


@case('emission at the very edge of the excitation: nothing below the light that excites, never more energy or photons than arrive')
def fluorescence_edge(bench):
    bands = '<wavelengths from="380" to="700" step="2" projection="box"/>'
    for emission in ('449.9999:0 450:1 460:0', '440:0 450:1 460:0', '300:1 460:1', '449.999999:0 450:1 450.0001:0'):
        for lamp in ('449.9:30 450.1:30', '440:3 450:3', '300:3 460:3'):
            cube = bench.render(fluorescent('300:1 450:1 450.0001:0', emission, '', lamp, bands), '--samples', '1')
            values = cube.spectrum(2, 2)
            require(min(values) >= 0, 'negative light')
            start = float(lamp.split(':')[0])
            for nm, value in zip(cube.nm, values):
                require(value == 0 or nm + 1 >= start, f'{value} at {nm} nm, below the light')
            a, b = (float(pair.split(':')[0]) for pair in lamp.split())
            e = float(lamp.split(':')[-1])
            out = sum(value * 2 for value in values) * math.pi
            require(out <= e * (b - a) * (1 + 1e-6), f'{emission}, {lamp}: {out} W from {e * (b - a)} W')
            photons = sum(value * 2 * nm for nm, value in zip(cube.nm, values)) * math.pi
            require(photons <= e * (b * b - a * a) / 2 * (1 + 1e-4), f'{emission}, {lamp}: more photons than arrive')
