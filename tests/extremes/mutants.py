"""Hostile input through the program: scenes of this repository and spectra changed at random, every model of Debian's assimp-testmodels,
and tricks with entities, paths and links. No crash, no NaN, exit code 0 or 1 and one line of error."""

import glob
import os
import random
import re
import time

from harness import Cube, Failed, Skipped, case, require

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SEED = int(os.environ.get('SPECTRAD_SEED', '1'))
SECONDS = float(os.environ.get('SPECTRAD_SECONDS', '15'))
NUMBERS = ['0', '-0', '1', '-1', '0.5', '1e-30', '1e30', '1e-320', '1e308', '-1e308', '1e999', 'nan', 'inf', '1e-9', '1e9', '65536', '65537', '2147483648',
           '-2147483649', '99999999999999999999', '0x10', '1,5', '٣', '', '1 2', '1 2 3', '.', '+', '1e', '0.1.2', '1_000']
WORDS = NUMBERS + ['constant:0.5', 'constant:1e40', 'line:500,1e-9', 'gaussian:500,0', 'gaussian:500,1e-9', 'blackbody:0', 'blackbody:1e-9', 'blackbody:1e9',
                   'daylight:1', 'illuminants/D65', 'illuminants/nothing', 'metals/Au', 'srgb:#fff', 'srgb:#ffffff', 'rgb:9,9,9', '400:1 500:2', '500:1 400:2',
                   'scene.xml', '../scene.xml', '/etc/passwd', '/dev/zero', '/dev/full', '.', 'pass:main', 'pass:nothing', 'true', 'a' * 5000, '<', '&#0;', '%s%n',
                   '1 cd', '1 lx', '1 W/m2', '1e300 cd', '-1 cd', '1 W/m2 over 700:400', '8x8', '0x0', '1x65536', 'point', 'ambient']
ELEMENTS = ['<sphere/>', '<sphere radius="1e9"/>', '<plane size="1e-9"/>', '<node scale="1e-30"><teapot/></node>', '<light type="ambient" spectrum="constant:1" scale="1e38"/>',
            '<background spectrum="constant:1" scale="1e-38"/>', '<instance of="a"/>', '<camera/>', '<pass name="p"/>', '<import file="scene.xml"/>', '<mesh file="scene.xml"/>',
            '<torus radius="1" tube="0.999999"/>', '<material name="zz"><gloss ior="1e-6"/></material>', '<spectrum name="zz" value="zz"/>']


def mutated(text, chance):
    """A scene with a few attributes, elements or bytes changed; mostly well-formed, so that what lies behind the parser is reached."""
    for _ in range(chance.choice((1, 1, 1, 2, 3, 6))):
        values = list(re.finditer(r'="([^"]*)"', text))
        elements = list(re.finditer(r'<[a-z]+[^<>]*/>', text))
        numbers = list(re.finditer(r'(?<=[\s"])-?\d+(?:\.\d+)?(?:e-?\d+)?(?=[\s"])', text))
        kind = chance.randrange(10)
        if kind < 3 and numbers:
            hit = chance.choice(numbers)
            with_ = chance.choice(NUMBERS) if chance.random() < 0.2 else repr(float(hit.group()) * 10 ** chance.gauss(0, 3))
            text = text[:hit.start()] + with_ + text[hit.end():]
        elif kind < 5 and values:
            hit = chance.choice(values)
            with_ = chance.choice(WORDS) if chance.random() < 0.3 else chance.choice(values).group(1)
            text = text[:hit.start(1)] + with_.replace('<', '&lt;') + text[hit.end(1):]
        elif kind == 5 and elements:
            hit = chance.choice(elements)
            text = text[:hit.start()] + text[hit.end():]
        elif kind == 6 and elements:
            hit, to = chance.choice(elements), chance.choice(elements)
            text = text[:to.end()] + hit.group() * chance.choice((1, 2, 50)) + text[to.end():]
        elif kind == 7 and elements:
            to = chance.choice(elements)
            text = text[:to.end()] + chance.choice(ELEMENTS) + text[to.end():]
        elif kind == 8 and values:
            hit = chance.choice(values)
            text = text[:hit.start()] + text[hit.end() + 0:]
        elif text:
            at = chance.randrange(len(text))
            text = text[:at] + chance.choice(('', '\0', '<', '>', '"', '&', chr(chance.randrange(1, 0x300)))) + text[at + chance.choice((0, 1, 20)):]
    return text


def judged(bench, outcome, doing, image=None):
    """Exit code 0 or 1 (3 where the device's memory does not do), an error in one line of its own, no value that is none."""
    require(outcome.code in (0, 1, 3), f'{doing}: {outcome}')
    if outcome.code != 0:
        bench.refused += 1
        errors = [line for line in outcome.err.splitlines() if ' warning: ' not in line]
        require(errors and errors[-1].startswith('spectrad: '), f'{doing}: no line of error: {outcome}')
    elif image:
        Cube(image)  # throws at a NaN or infinity
    for name in ('image.img', 'image.hdr'):
        if os.path.exists(bench.path(name)):
            os.remove(bench.path(name))


@case('scenes of this repository, changed at random, are rendered without NaN or refused in a line')
def scenes(bench):
    chance = random.Random(SEED)
    # Planning scenes of many coats takes seconds each: mutants by the hundred come from the others.
    slow = ('metal-ladder', 'textured', 'figure2', 'pavilion', 'fluorescence', 'gloss-ladder') if SECONDS < 60 else ()
    files = [path for path in sorted(glob.glob(os.path.join(SOURCE, 'scenes', '**', '*.xml'), recursive=True))
             if os.path.basename(path)[:-4] not in slow]
    require(len(files) > 3, 'no scenes')
    for folder in ('models', 'paper', 'passes', 'spectra'):
        place = os.path.join(SOURCE, 'scenes', folder)
        if os.path.isdir(place):
            os.symlink(place, bench.path(folder))
    end = time.monotonic() + SECONDS
    rendered = 0
    while time.monotonic() < end:
        source = chance.choice(files)
        text = mutated(open(source, encoding='utf-8').read(), chance)
        bench.write('scene.xml', text.encode('utf-8', 'surrogatepass'))
        try:
            # Kernels of new combinations take seconds to compile: most mutants are only planned.
            outcome = bench.run('info', 'scene.xml', timeout=120)
            judged(bench, outcome, f'info of a mutant of {os.path.basename(source)}')
            if outcome.code == 0 and chance.random() < 0.15:
                outcome = bench.run('render', 'scene.xml', '-o', 'image.img', '--size', '12x8', '--samples', '1', '--wavelengths', '400:700:100', timeout=120)
                judged(bench, outcome, f'a mutant of {os.path.basename(source)}', bench.path('image.img'))
                rendered += 1
        except Failed as reason:
            kept = os.path.join(os.environ.get('SPECTRAD_KEEP', '/tmp'), f'spectrad-mutant-{SEED}-{bench.tried}.xml')
            with open(kept, 'w', encoding='utf-8') as file:
                file.write(text)
            raise Failed(f'{reason}\n    the scene is kept in {kept}') from None
    bench.remarks.append(f'{bench.tried} runs, {rendered} rendered, {bench.refused} refused')


@case('options with any value: exit code 0, 1, 2 or 3, never a crash')
def options(bench):
    chance = random.Random(SEED)
    bench.write('scene.xml', '<scene version="1"><sphere/><light type="ambient" spectrum="illuminants/E" luminance="1 cd/m2"/><camera size="4x4"/></scene>')
    bench.run('render', 'scene.xml', '-o', 'cube.exr', '-q', '--samples', '1')
    end = time.monotonic() + SECONDS / 2
    kinds = {'info': ['scene.xml', 'cube.exr', 'illuminants/A'], 'measure': ['cube.exr'], 'observe': ['cube.exr'], 'compare': ['cube.exr'], 'render': ['scene.xml'],
             'metamer': ['constant:0.5'], 'expose': ['cube.exr'], 'sweep': ['scene.xml'], 'bake': ['scene.xml']}
    listed = {command: re.findall(r'--[a-z][a-z-]+', bench.run(command, '--help').out) for command in kinds}
    while time.monotonic() < end:
        command = chance.choice(list(kinds))
        arguments = [command, chance.choice(kinds[command])]
        if command == 'compare':
            arguments.append('cube.exr')
        if command in ('render', 'observe', 'expose', 'bake', 'sweep'):
            arguments += ['-o', chance.choice(('out/x.exr', 'out/x.png', 'out/x.img', 'out', 'nowhere/x.exr', ''))]
        os.makedirs(bench.path('out'), exist_ok=True)
        for _ in range(chance.choice((1, 1, 2, 3))):
            option = chance.choice(listed[command])
            if option in ('--help', '--budget'):
                continue
            arguments.append(option)
            if chance.random() < 0.85:
                arguments.append(chance.choice(WORDS).replace('\0', '') if chance.random() < 0.8 else str(10 ** chance.uniform(-40, 40)))
        outcome = bench.run(*arguments, timeout=60)
        require(outcome.code in (0, 1, 2, 3), f'{arguments}: {outcome}')
        require(outcome.code == 0 or outcome.err.strip() or outcome.out.strip(), f'{arguments}: not a word')
        bench.refused += outcome.code != 0
    bench.remarks.append(f'{bench.tried} runs, {bench.refused} refused')


TESTMODELS = '/usr/share/assimp/models'


@case("Debian's assimp-testmodels through info, and those that load through render")
def models(bench):
    if not os.path.isdir(TESTMODELS):
        raise Skipped('assimp-testmodels is not installed')
    files = [path for path in sorted(glob.glob(TESTMODELS + '/**/*', recursive=True)) if os.path.isfile(path)]
    if SECONDS < 60:
        files = files[SEED % 24::24]  # all of them by `make extremes`
    loaded = 0
    for path in files:
        outcome = bench.run('info', path, timeout=120)
        judged(bench, outcome, path)
        if outcome.code == 0 and outcome.out.startswith('scene'):
            outcome = bench.run('render', path, '-o', 'image.img', '--size', '12x8', '--samples', '1', '--wavelengths', '500:600:100', timeout=180)
            judged(bench, outcome, path, bench.path('image.img'))
            loaded += outcome.code == 0
    bench.remarks.append(f'{len(files)} files, {loaded} rendered, the others refused')


@case('entities, folders, devices, links and paths out of the folder are refused where they must be')
def tricks(bench):
    scene = '<scene version="1">%s<camera size="4x4"/></scene>'
    bombs = ['<!DOCTYPE x [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]>' + scene % '', '<!DOCTYPE scene SYSTEM "file:///etc/passwd">' + scene % '',
             scene % '&a;', scene % '<node name="&#0;"/>', scene % '<node name="&#xD800;"/>', '\xff\xfe<scene/>', '<scene version="1"', '', '\0' * 100]
    for text in bombs:
        bench.refuse(text, ['scene.xml'])
    os.makedirs(bench.path('inner'))
    bench.write('secret.csv', '400,1\n700,1\n')
    os.symlink('../secret.csv', bench.path('inner/link.csv'))
    os.symlink('loop.csv', bench.path('inner/loop.csv'))
    os.mkfifo(bench.path('inner/pipe.csv'))
    for name in ('../secret.csv', 'link.csv', '/etc/passwd', 'loop.csv', '../inner/../secret.csv', '/dev/zero', '/proc/self/environ', '.'):
        bench.write('inner/scene.xml', scene % f'<spectrum name="s" file="{name}"/><material name="m"><diffuse reflectance="s"/></material><sphere material="m"/>')
        outcome = bench.run('render', 'inner/scene.xml', '-o', 'image.img', '--restrict', timeout=20)
        require(outcome.code == 1, f'{name}: {outcome}')
        require('root:' not in outcome.err, f'{name}: the file is shown: {outcome}')
        bench.refused += 1
    for element in ('<mesh file="../m.obj"/>', '<import file="/etc/passwd"/>', '<mesh file="pipe.csv"/>'):
        bench.write('inner/scene.xml', scene % element)
        outcome = bench.run('render', 'inner/scene.xml', '-o', 'image.img', '--restrict', timeout=20)
        require(outcome.code == 1, f'{element}: {outcome}')
        bench.refused += 1
    for device in ('/dev/zero', bench.path('inner/pipe.csv'), '/proc/self/mem', '/'):
        outcome = bench.run('info', device, timeout=20)
        require(outcome.code in (1, 2), f'{device}: {outcome}')
        bench.refused += 1


@case('files that grow in memory: a PNG, an EXR and an ENVI header that declare more than the machine has are refused with the number')
def declared(bench):
    import struct
    import zlib
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    bench.write('huge.png', b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 2000000000, 2000000000, 16, 6, 0, 0, 0)) + chunk(b'IDAT', zlib.compress(b'\0')) +
                chunk(b'IEND', b''))
    bench.write('huge.img', b'\0' * 16)
    bench.write('huge.hdr', 'ENVI\nsamples = 2000000000\nlines = 2000000000\nbands = 10000\nheader offset = 0\ndata type = 4\ninterleave = bil\nbyte order = 0\n'
                            'wavelength units = Nanometers\nwavelength = {' + ','.join(str(i + 1) for i in range(10000)) + '}\n')
    for name in ('huge.png', 'huge.img'):
        bench.write('scene.xml', f'<scene version="1"><material name="m"><diffuse texture="{name}"/></material><plane material="m"/>'
                                 f'<light type="ambient" spectrum="illuminants/E" luminance="1 cd/m2"/><camera size="4x4"/></scene>')
        outcome = bench.run('render', 'scene.xml', '-o', 'image.img', timeout=30)
        require(outcome.code == 1 and name.split('.')[0] in outcome.err, str(outcome))
        bench.refused += 1
    outcome = bench.run('info', 'huge.img', timeout=30)
    require(outcome.code == 1 and 'huge' in outcome.err, str(outcome))
