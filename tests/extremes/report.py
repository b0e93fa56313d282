#!/usr/bin/python3
"""Everything extreme, into one report: report.py PROGRAM OUT.md [--fuzz-folder FOLDER] [--seconds N] [--heavy]. Runs the suites of run.py,
each libFuzzer program fuzz_* of FOLDER for N seconds on its corpus (a copy in OUT's folder that grows and is used again), and writes
what was tried, refused, injected and survived. Exit code 1 if any promise was broken."""

import argparse
import datetime
import glob
import json
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def suite(name, arguments, work):
    file = os.path.join(work, f'{name}.json')
    command = [sys.executable, os.path.join(HERE, 'run.py'), os.path.abspath(arguments.program), '--suite', name, '--report', file]
    environment = dict(os.environ, SPECTRAD_SEED=str(arguments.seed), SPECTRAD_SECONDS=str(arguments.seconds))
    done = subprocess.run(command + (['--heavy'] if arguments.heavy else []), env=environment, check=False)
    if not os.path.exists(file):
        return {'suite': name, 'cases': [], 'skipped': done.returncode == 77}
    with open(file, encoding='utf-8') as text:
        return json.load(text)


def fuzzed(program, arguments, work):
    """Runs one parser's fuzzer; its last line of statistics says executions, edges and features reached."""
    name = os.path.basename(program)[len('fuzz_'):]
    grown = os.path.join(work, 'corpus', name)
    os.makedirs(grown, exist_ok=True)
    shipped = os.path.join(HERE, '..', 'fuzz', 'corpus', name)
    log = os.path.join(work, f'fuzz_{name}.log')
    command = [os.path.abspath(program), f'-max_total_time={arguments.seconds}', '-timeout=30', '-rss_limit_mb=4096', '-print_final_stats=1',
               f'-artifact_prefix={work}/{name}-', grown, shipped]
    with open(log, 'w', encoding='utf-8') as out:
        code = subprocess.run(command, stdout=out, stderr=subprocess.STDOUT, check=False, cwd=work,
                              env=dict(os.environ, ASAN_OPTIONS='detect_leaks=0:allocator_may_return_null=1')).returncode
    text = open(log, encoding='utf-8', errors='replace').read()
    lines = re.findall(r'#(\d+)\s+\S+\s+cov: (\d+) ft: (\d+)', text)
    runs = re.search(r'stat::number_of_executed_units: (\d+)', text)
    counters = re.search(r'INFO: Loaded \d+ modules?\s+\((\d+) ', text)
    return {'parser': name, 'executions': int(runs.group(1)) if runs else 0, 'edges': int(lines[-1][1]) if lines else 0,
            'features': int(lines[-1][2]) if lines else 0, 'of': int(counters.group(1)) if counters else 0, 'code': code, 'log': log}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('program')
    parser.add_argument('out')
    parser.add_argument('--fuzz-folder')
    parser.add_argument('--seconds', type=int, default=120, help='for each fuzzer, and for mutants of scenes')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--heavy', action='store_true', help='50 M triangles, 32768 x 32768 pixels, every OpenCL call, …')
    arguments = parser.parse_args()
    work = os.path.join(os.path.dirname(os.path.abspath(arguments.out)), 'extremes')
    os.makedirs(work, exist_ok=True)
    suites = [suite(name, arguments, work) for name in ('numbers', 'faults', 'mutants')]
    programs = sorted(path for path in glob.glob(os.path.join(arguments.fuzz_folder or '', 'fuzz_*')) if os.access(path, os.X_OK)) if arguments.fuzz_folder else []
    fuzzers = [fuzzed(program, arguments, work) for program in programs]
    cases = [case for s in suites for case in s['cases']]
    broken = [case for case in cases if case['result'] == 'BROKEN']
    crashed = [fuzzer for fuzzer in fuzzers if fuzzer['code'] != 0]
    text = [f'# At the extremes: {datetime.date.today()}', '',
            f'{sum(case["tried"] for case in cases)} runs of the program in {len(cases)} cases: {len(cases) - len(broken) - sum(case["result"] == "skipped" for case in cases)} promises kept, '
            f'{len(broken)} broken, {sum(case["result"] == "skipped" for case in cases)} skipped; {sum(case["refused"] for case in cases)} inputs refused with a clear error.',
            f'{sum(fuzzer["executions"] for fuzzer in fuzzers)} executions of {len(fuzzers)} parsers under AddressSanitizer and UndefinedBehaviorSanitizer, {len(crashed)} crashed.', '']
    for s in suites:
        text += [f'## {s["suite"].capitalize()}', '']
        if not s['cases']:
            text += ['Skipped: no OpenCL device.', '']
            continue
        text += ['| promise | result | runs | refused | seconds | found |', '|---|---|---|---|---|---|']
        for case in s['cases']:
            found = '; '.join(case['remarks'] + ([case['detail'].splitlines()[0]] if case['detail'] else []))
            text.append(f'| {case["promise"]} | {case["result"]} | {case["tried"]} | {case["refused"]} | {case["seconds"]:g} | {found} |'.replace('\n', ' '))
        text.append('')
    text += ['## Parsers', '']
    if fuzzers:
        text += [f'libFuzzer, {arguments.seconds} s each. Edges are branches reached, of those in the program.', '', '| parser | executions | edges | of | features | result |', '|---|---|---|---|---|---|']
        text += [f'| {f["parser"]} | {f["executions"]} | {f["edges"]} | {f["of"]} | {f["features"]} | {"no crash" if f["code"] == 0 else "CRASHED: " + f["log"]} |' for f in fuzzers]
    else:
        text.append('Not fuzzed: no fuzz_* programs (they need clang: cmake --preset fuzz).')
    with open(arguments.out, 'w', encoding='utf-8') as file:
        file.write('\n'.join(text) + '\n')
    print(f'{arguments.out}: {len(broken)} promises broken, {len(crashed)} parsers crashed')
    return 1 if broken or crashed else 0


if __name__ == '__main__':
    sys.exit(main())
