#!/usr/bin/python3
"""Holds the sources to the house's plan: rooms.py SOURCE_FOLDER.

Which room may use which is read from the lines spectrad_room(...) of CMakeLists.txt, where the linker sees only part of it:
a header needs no linking. Tests of a room may use what the room may; tests share code in tests/support only. No file includes
itself by any way around, none is 500 lines long. Prints what is wrong; exit code 1 if anything is."""

import pathlib
import re
import sys

LONGEST = 499  # lines


def read_rooms(root):
    """Room -> the rooms that it may include from, itself among them."""
    text = re.sub(r"#.*", "", (root / "CMakeLists.txt").read_text())
    calls = [call.split() for call in re.findall(r"^spectrad_room\(([^)]*)\)", text, re.MULTILINE)]
    direct = {name: {word[9:] for word in links if word.startswith("spectrad_")} for name, *links in calls}
    direct["cli"] = set(direct)
    reach = {}
    for name in direct:  # a room is declared after those that it uses
        reach[name] = {name}.union(*(reach[used] for used in direct[name]))
    return reach


def room_of(path):
    """'colour' of src/colour/lab.cpp, 'tests/unit/colour' of tests/unit/colour/lab.cpp, 'kernels', 'bench', ..."""
    top, *rest = path.parts[:-1]
    if top == "src":
        return rest[0] if rest else "src"
    if top == "viewer":
        return top
    if top == "tests" and rest:
        return "/".join([top, *rest[: 2 if rest[0] == "unit" else 1]])
    return top


def may_use(user, used, rooms):
    if user == used:
        return True
    if user.startswith("tests"):
        own = user.removeprefix("tests/unit/")
        return used in (rooms[own] if own in rooms else {*rooms, "kernels"}) | {"tests/support"}
    if user == "bench":
        return used in {*rooms, "kernels"}
    return used in rooms.get(user, set()) or (user == "render" and used == "kernels")


def resolve(root, path, name):
    """The file that path includes by name: beside it in the same room, or from one of the build's include folders."""
    beside = (root / path).parent / name
    if beside.is_file() and ("/" not in name) and not str(path).startswith("src/"):
        return beside.relative_to(root)
    for folder in ("src", "kernels", "tests", "."):
        if (root / folder / name).is_file():
            return (root / folder / name).resolve().relative_to(root)
    return None


def cycle_through(start, graph):
    """A way of includes from start back to itself, or None."""
    ways, seen = [[start]], {start}
    while ways:
        way = ways.pop()
        for after in sorted(graph.get(way[-1], ())):
            if after == start:
                return [*way, start]
            if after not in seen:
                seen.add(after)
                ways.append([*way, after])
    return None


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.splitlines()[0])
    root = pathlib.Path(sys.argv[1]).resolve()
    rooms = read_rooms(root)
    faults = []
    graph = {}
    files = sorted(
        path.relative_to(root)
        for folder in ("src", "viewer", "kernels", "tests", "bench")
        for path in (root / folder).rglob("*")
        if path.suffix in {".cpp", ".h", ".cl", ".py", ".sh"}
    )
    for path in files:
        lines = (root / path).read_text(encoding="utf-8").splitlines()
        if len(lines) > LONGEST:
            faults.append(f"{path}: {len(lines)} lines (allowed: {LONGEST})")
        if path.suffix not in {".cpp", ".h", ".cl"}:
            continue
        if path.parts[0] in {"src", "viewer"} and room_of(path) not in rooms:
            faults.append(f"{path}: no room of CMakeLists.txt")
        for number, line in enumerate(lines, 1):
            found = re.match(r'\s*#\s*include\s*"([^"]+)"', line)
            if not found:
                continue
            included = resolve(root, path, found[1])
            if included is None:
                faults.append(f'{path}:{number}: "{found[1]}" is no file of ours (write it from src/ on: "room/file.h")')
                continue
            graph.setdefault(path, set()).add(included)
            if not may_use(room_of(path), room_of(included), rooms):
                faults.append(f"{path}:{number}: {room_of(path)} may not use {room_of(included)} ({included})")
    told = set()
    for path in files:
        cycle = cycle_through(path, graph)
        if cycle and not told & set(cycle):
            told |= set(cycle)
            faults.append("includes in a circle: " + " -> ".join(map(str, cycle)))
    print("\n".join([*faults, f"{len(files)} files, {len(faults)} faults"]))
    sys.exit(1 if faults or not graph or len(rooms) < 2 else 0)


if __name__ == "__main__":
    main()
