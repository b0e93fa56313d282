"""Running the built `spectrad` at the extremes: a folder a case, cubes read bit for bit, a tally for the report. Python's library only."""

import array
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

CASES = []


def case(promise, heavy=False):
    """Registers a function of one argument (a Bench) under the promise that it keeps."""
    def register(function):
        CASES.append((promise, function, heavy))
        return function
    return register


class Failed(Exception):
    """A promise was not kept."""


class Skipped(Exception):
    """The case cannot run here (a missing tool, data set or device)."""


class Outcome:
    def __init__(self, process, out, err):
        self.code = process.returncode
        self.out, self.err = out.decode('utf-8', 'replace'), err.decode('utf-8', 'replace')

    def json(self):
        return json.loads(self.out)

    def __str__(self):
        return f'exit {self.code}; {self.err.strip()[-1500:] or "(nothing on standard error)"}'


class Cube:
    """A plain ENVI cube of ours: float32 in the order [row][band][column]. Pixel (0,0) is the top left."""

    def __init__(self, path):
        header = open(str(path)[:-4] + '.hdr', encoding='utf-8').read()
        number = lambda key: int(re.search(rf'^{key} = (\d+)', header, re.M).group(1))
        self.width, self.height, self.bands = number('samples'), number('lines'), number('bands')
        listed = re.search(r'^wavelength = \{([^}]*)\}', header, re.M).group(1)
        self.nm = [float(word) for word in listed.split(',')]
        self.values = array.array('f')
        with open(path, 'rb') as file:
            self.values.fromfile(file, self.width * self.height * self.bands)
        for value in self.values:
            if value != value or value in (float('inf'), float('-inf')):
                raise Failed(f'{path} holds {value}')

    def at(self, x, y, band=0):
        return self.values[(y * self.bands + band) * self.width + x]

    def spectrum(self, x, y):
        return [self.at(x, y, band) for band in range(self.bands)]

    def row(self, y, band=0):
        start = (y * self.bands + band) * self.width
        return self.values[start:start + self.width]


class Bench:
    """A fresh folder and the program; counts what was tried for the report."""

    def __init__(self, program, workspace):
        self.program = program
        self.workspace = workspace
        self.tried = self.refused = 0
        self.remarks = []  # figures for the report
        self.folder = tempfile.mkdtemp(prefix='spectrad-extremes-', dir=workspace)

    def close(self):
        subprocess.run(['chmod', '-R', 'u+rwx', self.folder], check=False)
        shutil.rmtree(self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), 'wb') as file:
            file.write(text if isinstance(text, bytes) else text.encode())

    def names(self):
        return sorted(os.listdir(self.folder))

    def run(self, *arguments, environment=None, timeout=300, preexec=None):
        """Runs the program in the folder. Ending by a signal that nobody sent is a failure always."""
        self.tried += 1
        outcome = self.start(*arguments, environment=environment, preexec=preexec).finish(timeout)
        if outcome.code < 0 or outcome.code in (126, 127) or 'internal error' in outcome.err:
            faults = {name: value for name, value in (environment or {}).items() if name.startswith('SPECTRAD_')}
            raise Failed(f'{" ".join(arguments)}: {outcome} {faults or ""}')
        if 'AddressSanitizer' in outcome.err or 'runtime error:' in outcome.err:
            raise Failed(f'{" ".join(arguments)}: {outcome}')
        return outcome

    def start(self, *arguments, environment=None, preexec=None):
        full = dict(os.environ)
        full.update(environment or {})
        full = {name: value for name, value in full.items() if value is not None}
        process = subprocess.Popen([self.program, *arguments], cwd=self.folder, env=full, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=preexec)
        return Running(process)

    def render(self, scene, *options, warnings=None):
        """The cube of a scene given as text."""
        self.write('scene.xml', scene)
        outcome = self.run('render', 'scene.xml', '-o', 'image.img', *options)
        require(outcome.code == 0, f'render {" ".join(options)}: {outcome}\n{scene[:1500]}')
        if warnings is not None:
            warnings.append(outcome.err)
        return Cube(self.path('image.img'))

    def refuse(self, scene, mentions, *options, code=1, output='image.img'):
        """The scene is refused in one line that has all the mentions, and no file appears."""
        self.write('scene.xml', scene)
        for name in ('image.img', 'image.hdr', 'image.exr'):
            if os.path.exists(self.path(name)):
                os.remove(self.path(name))
        before = self.names()
        outcome = self.run('render', 'scene.xml', '-o', output, '--quiet', *options)
        require(outcome.code == code, f'expected exit {code}: {outcome}')
        require(outcome.err.count('\n') == 1, f'not one line: {outcome}')
        for mention in mentions:
            require(mention in outcome.err, f'"{mention}" is not said: {outcome}')
        require(self.names() == before, f'files {self.names()} instead of {before}')
        self.refused += 1
        return outcome


class Running:
    def __init__(self, process):
        self.process = process

    def finish(self, timeout=300):
        try:
            out, err = self.process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            self.process.kill()
            out, err = self.process.communicate()
            raise Failed(f'no end after {timeout} s: {err.decode("utf-8", "replace")[-500:]}') from None
        return Outcome(self.process, out, err)


def require(held, what):
    if not held:
        raise Failed(what)


def close(value, expected, relative, what=''):
    """|value − expected| ≤ relative × |expected|."""
    if not abs(value - expected) <= relative * abs(expected):
        error = abs(value - expected) / abs(expected) if expected else float('inf')
        raise Failed(f'{what}: {value!r} instead of {expected!r}, {error:.3g} off where {relative:.3g} is allowed')
    return abs(value - expected) / abs(expected) if expected else 0.0


def same(a, b, factor=1.0, what=''):
    """Cube b is cube a times the factor, bit for bit."""
    require((a.width, a.height, a.bands) == (b.width, b.height, b.bands), f'{what}: sizes differ')
    if factor == 1.0:
        if a.values == b.values:
            return
    for i, (left, right) in enumerate(zip(a.values, b.values)):
        if left * factor != right:
            x, y = i % a.width, i // (a.width * a.bands)
            raise Failed(f'{what}: pixel {x},{y}: {right!r} instead of {left * factor!r}')


def have_device(program):
    listing = subprocess.run([program, 'devices', '--json'], capture_output=True, check=False)
    try:
        return bool(json.loads(listing.stdout))
    except ValueError:
        return False


def main(suite):
    """Runs the registered cases by the command line of run.py."""
    arguments = sys.argv[1:]
    def option(name):
        if name not in arguments:
            return None
        at = arguments.index(name)
        value = arguments[at + 1]
        del arguments[at:at + 2]
        return value
    report, only = option('--report'), option('--only')
    heavy = '--heavy' in arguments
    arguments = [word for word in arguments if word != '--heavy']
    program = os.path.abspath(arguments[0])
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    if not have_device(program):
        print('skipped: no OpenCL device')
        return 77
    rows, failures = [], 0
    with tempfile.TemporaryDirectory(prefix='spectrad-extremes-') as workspace:
        for promise, function, is_heavy in CASES:
            if (is_heavy and not heavy) or (only and only not in promise):
                continue
            bench = Bench(program, workspace)
            began = time.monotonic()
            try:
                function(bench)
                result, detail = 'kept', ''
            except Skipped as reason:
                result, detail = 'skipped', str(reason)
            except Failed as reason:
                result, detail = 'BROKEN', str(reason)
                failures += 1
            finally:
                bench.close()
            seconds = time.monotonic() - began
            rows.append({'promise': promise, 'result': result, 'detail': detail, 'tried': bench.tried, 'refused': bench.refused,
                         'remarks': bench.remarks, 'seconds': round(seconds, 1)})
            print(f'{result:8} {seconds:6.1f} s  {promise}' + (f'\n    {detail}' if detail else ''), flush=True)
            for remark in bench.remarks:
                print('    ' + remark, flush=True)
    if report:
        with open(report, 'w', encoding='utf-8') as file:
            json.dump({'suite': suite, 'cases': rows}, file, indent=1)
    print(f'{sum(row["tried"] for row in rows)} runs, {failures} of {len(rows)} promises broken')
    return 1 if failures else 0
