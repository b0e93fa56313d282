#!/usr/bin/env python3
"""The page of a study in a real browser without a window: its plots are there once it is loaded, and it asks nobody for
anything.

usage: study_page.py build/spectrad

Needs chromium (Debian's package); skipped where there is none. Every request of the browser goes to a proxy of ours that
answers nothing and keeps a list. A page of our own that does ask for a picture shows that the list would tell."""
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading

SCENE = """<scene version="1"><wavelengths from="400" to="700" step="20"/>
<material name="m"><diffuse reflectance="charts/colorchecker/blue"/></material>
<node><plane size="2 2" material="m"/></node>
<light type="directional" direction="0 0 -1" spectrum="illuminants/FL11" illuminance="1000 lx"/>
<camera name="c" type="orthographic" height="4" look-from="0 0 5" look-at="0 0 0" size="12x8"/></scene>
"""
# What chromium asks for on its own account, whatever it shows.
SERVICES = ('google.com', 'googleapis.com', 'gvt1.com', 'gstatic.com')
ASKING = '<!doctype html><body><svg></svg><img src="http://study-page-test.example/spy.png"></body>'


class Proxy:
    """Takes connections, keeps their first line, closes them."""

    def __init__(self):
        self.asked = []
        self.socket = socket.create_server(('127.0.0.1', 0))
        self.port = self.socket.getsockname()[1]
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        while True:
            connection, _ = self.socket.accept()
            connection.settimeout(2)
            try:
                self.asked.append(connection.recv(4096).split(b'\r\n')[0].decode('latin-1'))
            except OSError:
                self.asked.append('a connection without a request')
            connection.close()


def load(browser, page, folder):
    """The page's DOM after loading, and what was asked for meanwhile."""
    proxy = Proxy()
    command = [browser, '--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
               '--disable-background-networking', '--disable-component-update', '--disable-sync', '--disable-extensions',
               '--disable-default-apps', '--user-data-dir=' + os.path.join(folder, 'profile-%d' % proxy.port),
               '--proxy-server=http://127.0.0.1:%d' % proxy.port, '--virtual-time-budget=3000', '--dump-dom', 'file://' + page]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    if done.returncode != 0:
        sys.exit('%s ended with %d: %s' % (browser, done.returncode, done.stderr[-500:]))
    return done.stdout, proxy.asked


def main():
    browser = shutil.which('chromium')
    if not browser:
        print('skipped: no chromium (apt-get install chromium)')
        sys.exit(77)
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        path = lambda name: os.path.join(folder, name)
        with open(path('asking.html'), 'w', encoding='utf-8') as file:
            file.write(ASKING)
        with open(path('wall.xml'), 'w', encoding='utf-8') as file:
            file.write(SCENE)
        _, asked = load(browser, path('asking.html'), folder)
        if not any('study-page-test.example' in line for line in asked):
            sys.exit('the proxy does not see what a page asks for: %s' % asked)
        run = subprocess.run([program, 'study', 'wall.xml', '-o', 'out', '-q'], cwd=folder)
        if run.returncode != 0:
            sys.exit('study ended with %d' % run.returncode)
        dom, asked = load(browser, path('out/index.html'), folder)
        with open(path('out/index.html'), encoding='utf-8') as file:
            source = file.read()
        for service in SERVICES:
            if service in source:
                sys.exit('the page names %s' % service)
        foreign = [line for line in asked if not any(service in line for service in SERVICES)]
        if foreign:
            sys.exit('the page asks for something: %s' % foreign)
        plots = re.findall(r'<svg.*?</svg>', dom, re.S)
        points = [plot.count('<circle') for plot in plots]
        # Time against error, bands, samples, spectra; and three maps.
        if len(plots) < 4 or min(points) < 3:
            sys.exit('plots are missing: points in each: %s' % points)
        maps = len(re.findall(r'<img[^>]*src="data:image/png;base64,', dom))
        if maps < 3:
            sys.exit('maps are missing: %d' % maps)
        print('%d plots with %s points, %d maps, no request' % (len(plots), points, maps))


if __name__ == '__main__':
    main()
