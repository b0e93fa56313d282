#!/usr/bin/python3
"""The extreme cases: run.py PROGRAM [--suite numbers|faults|mutants|…] [--heavy] [--report FILE.json] [--only TEXT]. Exit code 77
where they cannot run. mutants: SPECTRAD_SECONDS says for how long, SPECTRAD_SEED where chance begins."""

import importlib
import sys

import harness

SUITES = {'numbers': ['light_and_bands', 'surfaces', 'lengths', 'pictures', 'growth'], 'faults': ['faults'], 'mutants': ['mutants']}

if __name__ == '__main__':
    chosen = 'numbers'
    if '--suite' in sys.argv:
        at = sys.argv.index('--suite')
        chosen = sys.argv[at + 1]
        del sys.argv[at:at + 2]
    for name in SUITES[chosen]:
        importlib.import_module(name)
    sys.exit(harness.main(chosen))
