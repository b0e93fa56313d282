#!/usr/bin/python3
"""The extreme cases: run.py PROGRAM [--heavy] [--report FILE.json] [--only TEXT] [--suite NAME,NAME…]. Exit code 77 without OpenCL."""

import importlib
import sys

import harness

SUITES = ['light_and_bands', 'surfaces', 'lengths', 'pictures']

if __name__ == '__main__':
    chosen = SUITES
    if '--suite' in sys.argv:
        at = sys.argv.index('--suite')
        chosen = sys.argv[at + 1].split(',')
        del sys.argv[at:at + 2]
    for suite in chosen:
        importlib.import_module(suite)
    sys.exit(harness.main())
