"""One process for a long time: a viewer's session that sees many scenes and many changes does not grow. Heavy (--heavy); SPECTRAD_HOUR says
for how many seconds (60 if not said)."""

import glob
import os
import random
import re
import signal
import statistics
import time

from harness import Failed, case, require
from mutants import SOURCE, mutated

SECONDS = float(os.environ.get('SPECTRAD_HOUR', '60'))
SETTLED = '''<scene version="1"><material name="m"><diffuse reflectance="constant:0.5"/><gloss ior="1.5" roughness="0.4"/></material>
<sphere material="m"/><light name="lamp" type="point" position="2 3 4" spectrum="illuminants/D65" intensity="100 cd"/>
<camera fov="40" look-from="0 0 5" look-at="0 0 0" size="96x64"/></scene>'''


def resident(process):
    """Resident bytes of a process that runs."""
    with open(f'/proc/{process.pid}/status', encoding='utf-8') as file:
        return int(re.search(r'^VmRSS:\s+(\d+)', file.read(), re.M).group(1)) << 10


def shown(running, shot, patience=300):
    """Waits for two pictures written after now: the second is begun after now as well."""
    for _ in range(2):
        began, end = time.time(), time.monotonic() + patience
        while not (os.path.exists(shot) and os.path.getmtime(shot) > began):
            if running.process.poll() is not None:
                raise Failed(f'ended by itself: {running.finish()}')
            if time.monotonic() > end:
                raise Failed(f'no picture for {patience} s')
            time.sleep(0.1)


def session(bench, lines, change):
    """A viewer off screen for SECONDS, which plays the lines. change() is called twice a second; in between the settled scene stands until
    shot.png, which the lines write, shows it, and memory is read. Returns (calls of change, list of resident bytes)."""
    def place(text):
        bench.write('next.xml', text)
        os.replace(bench.path('next.xml'), bench.path('scene.xml'))  # never half a file
    place(SETTLED)
    bench.write('script', lines)
    bench.tried += 1
    running = bench.start('view', 'scene.xml', '--offscreen', 'view.png', '--script', 'script', '--size', '96x64')
    seen, changes, end = [], 0, time.monotonic() + SECONDS
    try:
        while time.monotonic() < end:
            place(SETTLED)
            shown(running, bench.path('shot.png'))
            seen.append(resident(running.process))
            for _ in range(20):
                text = change()
                if text is not None:
                    place(text)
                changes += 1
                time.sleep(0.5)
        running.process.send_signal(signal.SIGTERM)
        outcome = running.finish()
    finally:
        running.process.kill()
    require(outcome.code in (-signal.SIGTERM, 128 + signal.SIGTERM), str(outcome))
    return changes, seen


def steady(bench, what, seen):
    """The last third of the readings is, in the middle, no higher than the second, but for 5 % and 32 MiB: the first third still meets new
    kernels, and a reading may find another scene's memory not given back yet."""
    third = len(seen) // 3
    middle, last = statistics.median(seen[third:2 * third] or seen), statistics.median(seen[2 * third:])
    bench.remarks.append(f'{what} in {SECONDS:.0f} s: {seen[0] >> 20} MiB at first, {int(middle) >> 20} MiB in the second third (median), '
                         f'{int(last) >> 20} MiB in the last; {max(seen) >> 20} MiB at most')
    require(last <= 1.05 * middle + (32 << 20), f'{middle} bytes grew to {last}: {[b >> 20 for b in seen]} MiB')


@case('an hour (SPECTRAD_HOUR seconds) of random scenes, right and wrong, in one session does not grow', heavy=True)
def random_scenes(bench):
    chance = random.Random(1)
    files = sorted(glob.glob(os.path.join(SOURCE, 'scenes', '*.xml')))
    require(len(files) > 3, 'no scenes')
    for folder in ('models', 'paper', 'passes', 'spectra'):
        if os.path.isdir(os.path.join(SOURCE, 'scenes', folder)):
            os.symlink(os.path.join(SOURCE, 'scenes', folder), bench.path(folder))
    def change():
        with open(chance.choice(files), encoding='utf-8') as file:
            text = file.read()
        return (mutated(text, chance) if chance.random() < 0.7 else text).encode('utf-8', 'surrogatepass')
    changes, seen = session(bench, 'wait 5\nscreenshot shot.png\n' * 500000, change)
    steady(bench, f'{changes} scenes', seen)


@case('an hour (SPECTRAD_HOUR seconds) of changes of lamp, paint and camera in one session does not grow', heavy=True)
def random_changes(bench):
    chance = random.Random(1)
    lines = []
    for _ in range(20000):
        lines.append(chance.choice((f'set lamp.times={10 ** chance.uniform(-3, 3):.4g}', f'set lamp.spectrum=blackbody:{chance.randrange(1500, 20000)}',
                                    f'set m.reflectance=constant:{chance.random():.3f}', f'camera orbit {chance.randrange(-90, 90)} {chance.randrange(-30, 30)}',
                                    'camera reset')))
        lines.append('wait 1\nscreenshot shot.png')
    _, seen = session(bench, ('\n'.join(lines) + '\n') * 50, lambda: None)
    steady(bench, 'changes', seen)
