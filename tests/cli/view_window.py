#!/usr/bin/python3
"""The viewer in a real window under Xvfb: view_window.py SPECTRAD. The illuminant is changed by keyboard and by mouse, with events
of the X server; what stands on the screen is compared with the same actions off screen. Then the window is closed; in another one
the scene changes on disk, and the server is taken away. Exit code 77 where Xvfb or xdotool is absent."""

import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

SCENE = """<scene version="1">
  <material name="red"><diffuse reflectance="charts/colorchecker/red"/></material>
  <node><sphere radius="1" material="red"/></node>
  <node translate="0 0 -2"><plane size="20 20"/></node>
  <light name="lamp" type="point" position="2 4 4" spectrum="illuminants/D65" intensity="300 cd"/>
  <camera fov="40" look-from="0 0 5" look-at="0 0 0" size="800x600"/>
</scene>
"""
WIDTH, HEIGHT = 800, 600
# Within the panel on the right, below "Lights": the light's tick, its spectrum's list, and the field that opens in it.
TICK, LIST = (563, 55), (650, 83)


def png(path):
    """Rows of RGB bytes of an 8-bit RGB picture."""
    data = path.read_bytes()
    at, packed, width, height = 8, b"", 0, 0
    while at < len(data):
        (size,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        if kind == b"IHDR":
            width, height = struct.unpack(">II", data[at + 8 : at + 16])
        if kind == b"IDAT":
            packed += data[at + 8 : at + 8 + size]
        at += size + 12
    raw, stride, rows, above = zlib.decompress(packed), 3 * width, [], bytes(3 * width)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for i in range(stride):
            left, up, corner = (row[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
            guess = left + up - corner
            paeth = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            row[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[kind]) & 255
        rows.append(bytes(row))
        above = row
    return rows


def screen(path):
    """Rows of RGB bytes of Xvfb's frame (-fbdir, X's own XWD, 24 bits in 32)."""
    data = path.read_bytes()
    head = struct.unpack(">25I", data[:100])
    size, width, height, line, colours = head[0], head[4], head[5], head[12], head[19]
    start, rows = size + 12 * colours, []
    for y in range(height):
        row = data[start + y * line : start + y * line + 4 * width]
        rgb = bytearray(3 * width)
        rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
        rows.append(bytes(rgb))
    return rows


def largest_difference(a, b):
    assert len(a) == len(b) and len(a[0]) == len(b[0]), "pictures of two sizes"
    return max(max(abs(p - q) for p, q in zip(x, y)) if x != y else 0 for x, y in zip(a, b))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.splitlines()[0])
    program = os.path.abspath(sys.argv[1])
    for tool in ("Xvfb", "xdotool"):
        if not shutil.which(tool):
            print(f"skipped: no {tool}")
            sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.xml").write_text(SCENE)
        reader, writer = os.pipe()
        server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", name, "-nolisten", "tcp"],
            pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        try:
            display = ":" + os.fdopen(reader).readline().strip()
            check(program, folder, display, server)
        finally:
            server.kill()
            server.wait()


def check(program, folder, display, server):
    environment = {**os.environ, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"}
    environment.pop("WAYLAND_DISPLAY", None)

    def xdo(*words):
        return subprocess.run(["xdotool", *map(str, words)], env=environment, check=True, capture_output=True, text=True).stdout

    def open_window():
        viewer = subprocess.Popen([program, "view", "scene.xml", "-q"], cwd=folder, env=environment, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 120
        while viewer.poll() is None and time.monotonic() < deadline:
            found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "Spectrad"], env=environment, capture_output=True, text=True).stdout
            if found.strip():
                time.sleep(0.3)
                xdo("windowfocus", found.split()[0])
                return viewer
            time.sleep(0.2)
        sys.exit("no window: " + (viewer.communicate()[0] or "") + (viewer.stderr.read() if viewer.stderr else ""))

    def expected(actions):
        (folder / "script.txt").write_text(actions)
        subprocess.run([program, "view", "scene.xml", "-q", "--offscreen", "expected.png", "--script", "script.txt"], cwd=folder, check=True)
        return png(folder / "expected.png")

    def same(what, actions):
        """The screen becomes what is drawn off screen, within a minute: a busy machine draws slowly."""
        wanted, deadline = expected(actions), time.monotonic() + 60
        while (difference := largest_difference(screen(folder / "Xvfb_screen0"), wanted)) > 1:
            if time.monotonic() > deadline:
                sys.exit(f"{what}: the window is not what is drawn off screen ({difference} codes)")
            time.sleep(0.2)
        print(f"{what}: largest difference {difference} codes")
        return wanted

    viewer = open_window()
    park = "move 400 590\n"
    xdo("mousemove", 400, 590)
    first = same("at first", park)
    xdo("key", "l")
    xdo("key", "l")
    by_keyboard = same("illuminant by keyboard", park + "key l\nkey l\n")
    if largest_difference(first, by_keyboard) < 2:
        sys.exit("the keyboard changes nothing")
    # By mouse: open the list, type a lamp's name, take it.
    xdo("mousemove", *LIST, "click", 1)
    time.sleep(1)
    xdo("type", "--delay", "150", "illuminants/FL11")
    xdo("key", "Return")
    time.sleep(0.5)
    xdo("mousemove", 400, 590)
    same("illuminant by mouse", park + "key l\nkey l\nset lamp.spectrum=illuminants/FL11\n")
    xdo("mousemove", *TICK)
    time.sleep(0.3)
    xdo("click", 1)
    time.sleep(0.3)
    xdo("mousemove", 400, 590)
    same("light off by mouse", park + "key l\nkey l\nset lamp.spectrum=illuminants/FL11\nset lamp.on=off\n")
    xdo("key", "q")
    if viewer.wait(60) != 0:
        sys.exit("closing ends with an error: " + viewer.stderr.read())

    # The scene changes on disk; exposure is measured again on both sides.
    viewer = open_window()
    xdo("mousemove", 400, 590)
    same("opened again", park)
    (folder / "scene.xml").write_text(SCENE.replace('radius="1"', 'radius="0.7"'))
    time.sleep(3)
    xdo("key", "e")
    same("changed on disk", park + "key e\n")
    server.send_signal(signal.SIGKILL)
    code, said = viewer.wait(60), viewer.stderr.read()
    lines = [line for line in said.splitlines() if "spectrad:" in line]
    if code != 3 or len(said.splitlines()) != 1 or not re.search("display", "".join(lines)):
        sys.exit(f"the display lost: exit code {code}, said {said!r}")
    print("display lost: " + lines[0])


if __name__ == "__main__":
    main()
