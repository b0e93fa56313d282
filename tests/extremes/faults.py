"""Faults: full disks, signals, lost devices, damaged caches. Each time a clear message, the right exit code, the previous output intact,
and nothing left behind."""

import os
import random
import resource
import shutil
import signal
import subprocess
import time

from harness import Failed, Skipped, case, require

SCENE = '''<scene version="1"><wavelengths from="400" to="700" step="25"/>
  <material name="m"><diffuse reflectance="constant:0.5"/></material>
  <sphere radius="1" material="m"/>
  <light name="lamp" type="directional" direction="0 -1 -1" spectrum="{lamp}" irradiance="3 W/m2"/>
  <camera fov="40" look-from="0 0 5" look-at="0 0 0" size="40x30"/></scene>'''
# Two passes: the second shows the first, which stays on the device, beside a picture of the host's.
PASSES = '''<scene version="1"><wavelengths from="400" to="700" step="25"/>
  <material name="paint"><diffuse reflectance="constant:0.5"/><gloss ior="1.5" roughness="0.3 0.1"/></material>
  <material name="shown"><emission texture="pass:inner"/></material>
  <material name="print"><diffuse texture="pass:chart" filter="mip"/></material>
  <node name="ball"><sphere radius="1" material="paint"/></node>
  <node name="flat"><plane size="8 8" material="paint"/></node>
  <node name="wall"><plane size="3 3" material="shown"/><node translate="1 0 1"><plane size="3 3" material="print"/></node></node>
  <light name="lamp" type="directional" direction="0 -1 -1" spectrum="illuminants/D65" irradiance="3 W/m2"/>
  <camera fov="40" look-from="0 0 5" look-at="0 0 0" size="40x30"/>
  <pass name="inner" of="ball" lights="lamp"/><pass name="chart" of="flat" lights="lamp" as="reflectance"/><pass name="main" of="wall"/></scene>'''
LAMP = 'illuminants/D65'
PRECIOUS = b'precious'
ENVI = {'image.img', 'image.hdr'}


def prepared(bench, lamp=LAMP):
    bench.write('scene.xml', SCENE.format(lamp=lamp))


def precious(bench, outputs):
    for name in outputs:
        bench.write(name, PRECIOUS)


def intact(bench, outputs, files, doing):
    """The previous outputs are there, byte for byte, and no other file than `files`."""
    for name in outputs:
        require(open(bench.path(name), 'rb').read() == PRECIOUS, f'{doing}: {name} was changed')
    require(set(bench.names()) == set(files) | set(outputs), f'{doing}: files {bench.names()}')


def one_line(outcome, doing):
    lines = [line for line in outcome.err.splitlines() if 'warning:' not in line]
    require(len(lines) == 1 and lines[0].startswith('spectrad: '), f'{doing}: not one line: {outcome}')


def read(bench, name):
    with open(bench.path(name), 'rb') as file:
        return file.read()


@case('a disk that is full at any byte: exit 3, the old files are there, nothing else')
def full_disk(bench):
    prepared(bench)
    bench.run('render', 'scene.xml', '-o', 'cube.exr')
    bench.write('chart.csv', '400,0.1\n700,0.9\n')
    commands = [(('render', 'scene.xml', '-o', 'image.exr', '-q'), {'image.exr'}),
                (('render', 'scene.xml', '-o', 'image.exr', '--compression', 'none', '--preview', 'image.png', '-q'), {'image.exr', 'image.png'}),
                (('render', 'scene.xml', '-o', 'image.img', '-q'), ENVI),
                (('observe', 'cube.exr', '-o', 'image.png', '-q'), {'image.png'}),
                (('observe', 'cube.exr', '-o', 'image.exr', '-q'), {'image.exr'}),
                (('metamer', 'chart.csv', '--count', '1', '-o', 'image.csv'), {'image.csv'})]
    chance = random.Random(7)
    survived = 0
    for arguments, outputs in commands:
        files = set(bench.names()) - outputs
        require(bench.run(*arguments).code == 0, f'{arguments}')
        size = max(os.path.getsize(bench.path(name)) for name in outputs)
        for limit in sorted({0, 1, 2, 8, size - 1} | {chance.randrange(size) for _ in range(8)}):
            precious(bench, outputs)
            def limited(bytes_=limit):
                resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_, bytes_))
            outcome = bench.run(*arguments, preexec=limited)
            doing = f'{" ".join(arguments)}, {limit} of {size} bytes'
            require(outcome.code == 3, f'{doing}: {outcome}')
            one_line(outcome, doing)
            require('cannot' in outcome.err, f'{doing}: {outcome}')
            intact(bench, outputs, files, doing)
            survived += 1
        for name in outputs:
            os.remove(bench.path(name))
    bench.remarks.append(f'{survived} full disks survived')


@case('a real file system of 256 KiB that fills up: exit 3, the old files are there')
def tiny_disk(bench):
    prepared(bench)
    small = bench.path('small')
    os.mkdir(small)
    # In a name space of its own, so that the mount ends with the script.
    script = f'''mount -t tmpfs -o size=256k none {small} || exit 77
echo -n precious > {small}/image.exr
{bench.program} render scene.xml -o {small}/image.exr --size 400x300 --compression none -q; code=$?
[ "$(cat {small}/image.exr)" = precious ] || exit 50
[ "$(ls -A {small} | wc -l)" = 1 ] || exit 51
exit $code'''
    done = subprocess.run(['unshare', '-rm', 'sh', '-c', script], cwd=bench.folder, capture_output=True, check=False)
    if done.returncode in (1, 77, 127) and b'spectrad' not in done.stderr:
        raise Skipped('no name spaces: ' + done.stderr.decode().strip()[:80])
    bench.tried += 1
    require(done.returncode == 3, f'exit {done.returncode}: {done.stderr.decode()}')
    require(b'No space left' in done.stderr, done.stderr.decode())


@case('a folder that cannot be written: exit 3 before anything is rendered')
def read_only(bench):
    prepared(bench)
    bench.write('image.exr', PRECIOUS)
    def humble():  # root may write anywhere
        if os.geteuid() == 0:
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)
    for path in (bench.workspace, bench.folder):
        os.chmod(path, 0o755)
    os.chmod(bench.folder, 0o555)
    try:
        outcome = bench.run('render', 'scene.xml', '-o', 'image.exr', '-q', preexec=humble)
    except PermissionError as reason:
        raise Skipped(f'another user cannot run the program: {reason}') from None
    finally:
        os.chmod(bench.folder, 0o755)
    require(outcome.code == 3 and 'image.exr' in outcome.err, str(outcome))
    one_line(outcome, 'read-only')
    intact(bench, {'image.exr'}, {'scene.xml'}, 'read-only')
    outcome = bench.run('render', 'scene.xml', '-o', 'nowhere/image.exr', '-q')
    require(outcome.code == 3, str(outcome))


@case('ended by SIGINT, SIGTERM or SIGKILL at random moments: the old file or the new one, whole; what SIGKILL leaves the next run removes')
def signals(bench):
    prepared(bench)
    arguments = ('render', 'scene.xml', '-o', 'image.exr', '-q', '--size', '640x480', '--compression', 'zip')
    began = time.monotonic()
    require(bench.run(*arguments).code == 0, 'render')
    whole, complete = time.monotonic() - began, read(bench, 'image.exr')
    chance = random.Random(3)
    ended = finished = 0
    for i in range(24):
        which = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)[i % 3]
        precious(bench, {'image.exr'})
        running = bench.start(*arguments)
        bench.tried += 1
        time.sleep(whole * chance.uniform(0, 1.1))
        running.process.send_signal(which)
        outcome = running.finish()
        require(outcome.code in (0, -which), f'{which.name}: {outcome}')
        content = read(bench, 'image.exr')
        if outcome.code == 0:
            finished += 1
            require(content == complete, f'{which.name}: ended well, but the file is not whole')
        else:
            ended += 1
            require(content in (PRECIOUS, complete), f'{which.name}: neither the old file nor the new one')
        if which != signal.SIGKILL:
            require(bench.names() == ['image.exr', 'scene.xml'], f'{which.name}: files {bench.names()}')
    require(bench.run(*arguments).code == 0, 'render')
    require(bench.names() == ['image.exr', 'scene.xml'], f'left behind: {bench.names()}')
    bench.remarks.append(f'{ended} runs ended by signals, {finished} had finished before')


@case('a spectrum deleted or cut short while the program runs: an error that names it, or the whole image')
def deleted_spectrum(bench):
    prepared(bench, 'lamp.csv')
    lamp = ''.join(f'{nm},{nm % 7 + 1}\n' for nm in range(300, 900))
    bench.write('lamp.csv', lamp)
    arguments = ('render', 'scene.xml', '-o', 'image.img', '-q')
    began = time.monotonic()
    require(bench.run(*arguments).code == 0, 'render')
    # The raster alone: its header has the files' hashes as they are when all is read.
    whole, complete = time.monotonic() - began, read(bench, 'image.img')
    chance = random.Random(5)
    for i in range(16):
        bench.write('lamp.csv', lamp)
        precious(bench, ENVI)
        running = bench.start(*arguments)
        bench.tried += 1
        time.sleep(whole * chance.uniform(0, 0.7))
        if i % 2:
            os.truncate(bench.path('lamp.csv'), 0)
        else:
            os.remove(bench.path('lamp.csv'))
        outcome = running.finish()
        if outcome.code == 0:
            require(read(bench, 'image.img') == complete, 'another image')
        else:
            require(outcome.code == 1 and 'lamp.csv' in outcome.err, str(outcome))
            one_line(outcome, 'deleted')
            intact(bench, ENVI, {'scene.xml'} | ({'lamp.csv'} if i % 2 else set()), 'deleted')


@case('no OpenCL, no display: exit 3 in one line, and what needs neither goes on')
def nothing_there(bench):
    prepared(bench)
    bench.run('render', 'scene.xml', '-o', 'cube.exr')
    none = {'OCL_ICD_VENDORS': '/nonexistent', 'OCL_ICD_FILENAMES': ''}
    for arguments in (('render', 'scene.xml', '-o', 'image.exr'), ('view', 'scene.xml', '--offscreen', 'image.png', '--frames', '1'),
                      ('bake', 'scene.xml', '--node', 'ball', '-o', 'image.exr'), ('study', 'scene.xml', '-o', 'folder')):
        outcome = bench.run(*arguments, environment=none)
        require(outcome.code in (1, 3), f'{arguments}: {outcome}')
        require(outcome.code == 1 or 'no OpenCL device' in outcome.err, f'{arguments}: {outcome}')
        one_line(outcome, 'no OpenCL')
        require(not {'image.exr', 'image.png'} & set(bench.names()), f'files {bench.names()}')
    for arguments in (('info', 'scene.xml'), ('measure', 'cube.exr', '--at', '20,15'), ('observe', 'cube.exr', '-o', 'x.png'), ('devices',)):
        outcome = bench.run(*arguments, environment=none)
        require(outcome.code == (3 if arguments[0] == 'devices' else 0), f'{arguments}: {outcome}')
    outcome = bench.run('view', 'scene.xml', environment={'DISPLAY': '', 'WAYLAND_DISPLAY': ''})
    require(outcome.code == 3 and 'isplay' in outcome.err, str(outcome))
    one_line(outcome, 'no display')


@case('a kernel cache that cannot be written or is damaged: the same image; two processes may share a fresh one')
def caches(bench):
    prepared(bench)
    arguments = ('render', 'scene.xml', '-q', '--samples', '1')
    require(bench.run(*arguments, '-o', 'a.exr').code == 0, 'render')
    expected = read(bench, 'a.exr')
    pocl = bench.path('pocl')  # PoCL's own cache, where it may write
    for place in ('/proc/nonexistent', '/dev/null', bench.path('scene.xml')):
        outcome = bench.run(*arguments, '-o', 'b.exr', environment={'XDG_CACHE_HOME': place, 'POCL_CACHE_DIR': pocl})
        require(outcome.code == 0, f'{place}: {outcome}')
        require(read(bench, 'b.exr') == expected, f'{place}: another image')
        outcome = bench.run(*arguments, '-o', 'x.exr', environment={'XDG_CACHE_HOME': place, 'POCL_CACHE_DIR': None})
        # PoCL does not start then; another driver may.
        require(outcome.code == 0 or (outcome.code == 3 and 'XDG_CACHE_HOME' in outcome.err), f'{place}: {outcome}')
    fresh = {'XDG_CACHE_HOME': bench.path('cache')}
    both = [bench.start(*arguments, '-o', f'{name}.exr', environment=fresh) for name in 'cd']
    for running, name in zip(both, 'cd'):
        outcome = running.finish()
        bench.tried += 1
        require(outcome.code == 0, str(outcome))
        require(read(bench, f'{name}.exr') == expected, 'two processes: another image')
    folder = bench.path('cache/spectrad')
    binaries = sorted(os.listdir(folder))
    require(binaries and all(name.endswith('.clbin') for name in binaries), f'left in the cache: {binaries}')
    def damage(name, how):
        path = os.path.join(folder, name)
        content = open(path, 'rb').read()
        if how == 'flipped':
            middle = len(content) // 2
            content = content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1:]
        elif how == 'short':
            content = content[:len(content) // 3]
        elif how == 'empty':
            content = b''
        os.remove(path)
        if how == 'folder':
            os.mkdir(path)
        else:
            open(path, 'wb').write(content)
    for how in ('flipped', 'short', 'empty', 'folder'):
        for name in binaries:
            damage(name, how)
        outcome = bench.run(*arguments, '-o', 'e.exr', environment=fresh)
        require(outcome.code == 0, f'{how}: {outcome}')
        require(read(bench, 'e.exr') == expected, f'{how}: another image')
        require(sorted(os.listdir(folder)) == binaries, f'{how}: left in the cache: {os.listdir(folder)}')


def layer(bench):
    """The library that fails OpenCL calls, compiled here."""
    compiler = shutil.which('cc') or shutil.which('gcc')
    if not compiler:
        raise Skipped('no C compiler')
    library = os.path.join(bench.workspace, 'opencl_faults.so')
    if not os.path.exists(library):
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'opencl_faults.c')
        done = subprocess.run([compiler, '-shared', '-fPIC', '-O1', '-o', library, source, '-ldl', '-lpthread'], capture_output=True, check=False)
        if done.returncode != 0:
            raise Failed(done.stderr.decode())
    return library


# Names from CL/cl.h: device not available, allocation failure, out of resources, out of host memory, invalid command queue.
CODES = (-2, -4, -5, -6, -36)


def opencl_faults(bench, arguments, output, each, lost):
    """Fails up to `each` calls of every function (0: all) of the command; then `lost` times all calls from one on."""
    environment = {'LD_PRELOAD': layer(bench), 'SPECTRAD_FAULT_LOG': bench.path('log')}
    require(bench.run(*arguments).code == 0, f'{arguments}')  # kernels are cached now
    files = set(bench.names()) - {output}
    expected = read(bench, output)
    outcome = bench.run(*arguments, environment=environment)
    if not os.path.exists(bench.path('log')):
        raise Skipped('LD_PRELOAD has no effect')
    require(outcome.code == 0 and read(bench, output) == expected, f'counting alone changes something: {outcome}')
    calls = open(bench.path('log'), encoding='utf-8').read().split()
    os.remove(bench.path('log'))
    places = {}
    for number, function in enumerate(calls, 1):
        places.setdefault(function, []).append(number)
    chosen = []
    for numbers in places.values():
        step = max(1, (len(numbers) - 1) // (each - 1)) if each > 1 else 1
        chosen += numbers if not each else sorted(set(numbers[::step][:each] + [numbers[-1]]))
    chance = random.Random(11)
    trials = [(number, 0) for number in chosen] + [(chance.randrange(1, len(calls)), 1) for _ in range(lost)]
    harmless = 0
    for i, (number, on) in enumerate(trials):
        precious(bench, {output})
        fault = {'LD_PRELOAD': environment['LD_PRELOAD'], 'SPECTRAD_FAULT_AT': str(number), 'SPECTRAD_FAULT_CODE': str(CODES[i % len(CODES)]),
                 'SPECTRAD_FAULT_ON': '1' if on else '0', 'POCL_MAX_PTHREAD_COUNT': '2'}
        outcome = bench.run(*arguments, environment=fault, timeout=120)
        doing = f'{calls[number - 1]} (call {number} of {len(calls)}) failing with {CODES[i % len(CODES)]}{" from here on" if on else ""}'
        if outcome.code == 0:
            # Clean-up that fails, or a cached binary that is compiled anew.
            harmless += 1
            require(read(bench, output) == expected, f'{doing}: another result without an error')
            require(set(bench.names()) == files | {output}, f'{doing}: files {bench.names()}')
        else:
            require(outcome.code == 3, f'{doing}: {outcome}')
            one_line(outcome, doing)
            require('OpenCL' in outcome.err, f'{doing}: OpenCL is not named: {outcome}')
            intact(bench, {output}, files, doing)
    bench.remarks.append(f'{len(calls)} calls of {len(places)} functions; {len(trials)} failed in turn: {len(trials) - harmless} ended in one line with '
                         f'exit 3, {harmless} did no harm')


@case('an OpenCL call that fails, of every function the first, the last and one between; a device lost from a random call on')
def some_calls(bench):
    prepared(bench)
    opencl_faults(bench, ('render', 'scene.xml', '-o', 'image.exr', '-q', '--samples', '1'), 'image.exr', 2, 10)


@case('the same where passes stay on the device')
def calls_of_passes(bench):
    bench.write('scene.xml', PASSES)
    opencl_faults(bench, ('render', 'scene.xml', '-o', 'image.exr', '-q', '--samples', '1'), 'image.exr', 1, 6)


@case('every OpenCL call of a render failing in turn', heavy=True)
def every_call(bench):
    prepared(bench)
    opencl_faults(bench, ('render', 'scene.xml', '-o', 'image.exr', '-q', '--samples', '1'), 'image.exr', 0, 100)


@case('every OpenCL call of three passes failing in turn', heavy=True)
def every_call_of_passes(bench):
    bench.write('scene.xml', PASSES)
    opencl_faults(bench, ('render', 'scene.xml', '-o', 'image.exr', '-q', '--samples', '1'), 'image.exr', 0, 100)


@case('OpenCL calls of the viewer off screen failing in turn', heavy=True)
def viewer_calls(bench):
    prepared(bench)
    opencl_faults(bench, ('view', 'scene.xml', '--offscreen', 'image.png', '--frames', '2'), 'image.png', 6, 20)
