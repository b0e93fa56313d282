#!/usr/bin/env python3
"""Writes the animals of figures 2 and 3: make_animals.py [FOLDER]

Each animal is a smooth union of ellipsoids and tapered capsules (signed distances), meshed by surface nets, its vertices moved
onto the surface, and cut in two at a plane across its length: NAME-left.obj and NAME-right.obj wear the two reflectances of a
metameric pair. Extras (a beak, tusks, horns) are meshes of their own. Needs numpy. FOLDER is models/ beside this script unless
given. Lengths in metres, y up, feet on y = 0, the animal along x, symmetric in z.
"""

import math
import sys
from pathlib import Path

import numpy as np


def smooth_min(a, b, k):
    """Union with a fillet of about k (polynomial, C1)."""
    h = np.maximum(k - np.abs(a - b), 0) / k
    return np.minimum(a, b) - h * h * k / 4


def rotated(p, centre, axis, degrees):
    """Points turned back about `centre`, so that what is drawn turns forward."""
    c, s = math.cos(math.radians(-degrees)), math.sin(math.radians(-degrees))
    q = p - centre
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    out = q.copy()
    out[:, i], out[:, j] = c * q[:, i] - s * q[:, j], s * q[:, i] + c * q[:, j]
    return out


class Ball:
    """Ellipsoid about `centre` with semi-axes `radii`, turned about axes in order: [("z", 20), …]."""

    def __init__(self, centre, radii, turns=()):
        self.centre, self.radii, self.turns = np.array(centre, float), np.array(radii, float), turns

    def distance(self, p):
        q = p - self.centre
        for axis, degrees in self.turns:
            q = rotated(q, np.zeros(3), axis, degrees)
        outer, inner = np.linalg.norm(q / self.radii, axis=1), np.linalg.norm(q / self.radii**2, axis=1)
        return outer * (outer - 1) / np.maximum(inner, 1e-9)


class Limb:
    """Capsules that taper along a chain of (x, y, z, radius), rounded by a smooth curve through them."""

    def __init__(self, points, cuts=8):
        points = np.array(points, float)
        padded = np.vstack([points[0], points, points[-1]])
        curve = [points[0]]
        for k in range(1, len(points)):
            a, b, c, d = padded[k - 1:k + 3]
            for t in np.arange(1, cuts + 1) / cuts:
                curve.append(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2
                                    + (3 * b - a - 3 * c + d) * t**3))
        self.curve = np.array(curve)

    def distance(self, p):
        best = np.full(len(p), np.inf)
        for a, b in zip(self.curve, self.curve[1:]):
            axis = b[:3] - a[:3]
            t = np.clip((p - a[:3]) @ axis / (axis @ axis), 0, 1)
            far = np.linalg.norm(p - a[:3] - t[:, None] * axis, axis=1) - (a[3] + t * (b[3] - a[3]))
            best = np.minimum(best, far)
        return best


def both(shape, *arguments, **named):
    """A shape and its mirror image in z."""
    def mirror(a):
        return [(*p[:2], -p[2], *p[3:]) for p in a] if isinstance(a[0], (tuple, list)) else (a[0], a[1], -a[2])
    turns = named.get("turns", ())
    flipped = [(axis, -degrees if axis in "xy" else degrees) for axis, degrees in turns]
    other = dict(named, turns=flipped) if turns else named
    return [shape(*arguments, **named), shape(mirror(arguments[0]), *arguments[1:], **other)]


class Body:
    """Parts joined in order, each with the fillet that it wants."""

    def __init__(self, parts):
        self.parts = parts

    def distance(self, p):
        total = None
        for fillet, shapes in self.parts:
            for shape in shapes:
                d = shape.distance(p)
                total = d if total is None else smooth_min(total, d, fillet)
        return total

    def gradient(self, p):
        h = 1e-4
        return np.stack([(self.distance(p + h * e) - self.distance(p - h * e)) / (2 * h) for e in np.eye(3)], axis=1)


def surface_net(body, low, high, step):
    """Vertices on the surface and triangles, anticlockwise from outside."""
    axes = [np.arange(a - 2 * step, b + 2 * step, step) for a, b in zip(low, high)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    shape = grid.shape[:3]
    f = body.distance(grid.reshape(-1, 3)).reshape(shape)
    inside = f < 0
    corner = [inside[i:shape[0] - 1 + i, j:shape[1] - 1 + j, k:shape[2] - 1 + k]
              for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    filled = sum(c.astype(int) for c in corner)
    active = (filled > 0) & (filled < 8)
    number = np.full(active.shape, -1)
    number[active] = np.arange(active.sum())
    vertices = grid[:-1, :-1, :-1][active] + step / 2
    triangles = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        lower = np.take(inside, range(shape[axis] - 1), axis)
        upper = np.take(inside, range(1, shape[axis]), axis)
        for edges, outward in ((lower & ~upper, True), (~lower & upper, False)):
            at = np.argwhere(edges)
            at = at[(at[:, u] > 0) & (at[:, v] > 0)]
            cells = []
            for du, dv in ((-1, -1), (0, -1), (0, 0), (-1, 0)):
                c = at.copy()
                c[:, u] += du
                c[:, v] += dv
                cells.append(number[c[:, 0], c[:, 1], c[:, 2]])
            a, b, c, d = cells if outward else cells[::-1]
            triangles += [np.stack([a, b, c], 1), np.stack([a, c, d], 1)]
    triangles = np.vstack(triangles)
    for _ in range(6):  # Newton's steps onto the surface
        g = body.gradient(vertices)
        move = body.distance(vertices)[:, None] * g / np.maximum((g**2).sum(1, keepdims=True), 1e-6)
        vertices = vertices - np.clip(move, -step, step)
    return vertices, triangles


def cut(vertices, normals, triangles, x):
    """Triangles left and right of the plane at x; those across it are cut."""
    sides = ([], [])
    for triangle in triangles:
        corners = [(vertices[i], normals[i]) for i in triangle]
        for side, sign in ((0, -1), (1, 1)):
            piece = []
            for k in range(3):
                (p, n), (q, m) = corners[k], corners[(k + 1) % 3]
                a, b = sign * (p[0] - x), sign * (q[0] - x)
                if a >= 0:
                    piece.append((p, n))
                if (a > 0 and b < 0) or (a < 0 and b > 0):
                    t = a / (a - b)
                    piece.append((p + t * (q - p), n + t * (m - n)))
            for k in range(1, len(piece) - 1):
                sides[side].append((piece[0], piece[k], piece[k + 1]))
    return sides


def write(path, faces, comment):
    """A Wavefront OBJ: corners that agree to a tenth of a millimetre are shared."""
    known, lines, out = {}, [], []
    for face in faces:
        ids = []
        for p, n in face:
            n = n / np.linalg.norm(n)
            key = (*np.round(p, 4), *np.round(n, 2))
            if key not in known:
                known[key] = len(known) + 1
                out.append("v " + " ".join(f"{v + 0:.4g}" for v in np.round(p, 4)))
                lines.append("vn " + " ".join(f"{v + 0:.3g}" for v in np.round(n, 3)))
            ids.append(known[key])
        if len(set(ids)) == 3:
            out.append(None)
            lines.append("f " + " ".join(f"{i}//{i}" for i in ids))
    vertices = [line for line in out if line]
    path.write_text("\n".join([f"# {comment}; scenes/paper/make_animals.py", *vertices, *lines]) + "\n")
    print(f"{path.name}: {len(known)} vertices, {sum(line.startswith('f') for line in lines)} triangles")


def leg(x, z, top, thick, foot, bend=0.0):
    return [(x, top, z * 0.9, thick * 1.25), (x + bend, top * 0.5, z, thick), (x, foot * 0.9, z, foot)]


def elephant():
    trunk = [(-0.95, 1.42, 0, 0.25), (-1.22, 1.12, 0, 0.185), (-1.33, 0.74, 0, 0.135), (-1.42, 0.42, 0, 0.105),
             (-1.62, 0.3, 0, 0.085), (-1.78, 0.44, 0, 0.07)]
    body = Body([
        (0.1, [Ball((0.22, 1.12, 0), (0.86, 0.62, 0.54)), Ball((0.72, 1.08, 0), (0.46, 0.56, 0.48))]),
        (0.30, [Ball((-0.48, 1.24, 0), (0.45, 0.50, 0.42)), Ball((-0.80, 1.5, 0), (0.40, 0.42, 0.36))]),
        (0.12, [Limb(trunk, 6)]),
        (0.10, both(Limb, leg(-0.36, 0.27, 0.85, 0.19, 0.20)) + both(Limb, leg(0.84, 0.27, 0.85, 0.20, 0.205, 0.03))),
        (0.10, both(Ball, (-0.62, 1.45, 0.47), (0.31, 0.45, 0.1), turns=[("y", -28), ("x", 10)])),
        (0.06, [Limb([(1.14, 1.25, 0, 0.06), (1.27, 0.95, 0, 0.035), (1.29, 0.66, 0, 0.03)]), Ball((1.29, 0.6, 0), (0.05, 0.1, 0.05))]),
    ])
    tusks = Body([(0.01, both(Limb, [(-0.98, 1.14, 0.19, 0.062), (-1.2, 0.93, 0.24, 0.05), (-1.46, 0.9, 0.24, 0.016)], 6))])
    return body, 0.05, -0.10, {"tusks": (tusks, 0.03)}


def cow():
    body = Body([
        (0.1, [Ball((0.1, 1.08, 0), (0.86, 0.42, 0.38)), Ball((-0.42, 1.1, 0), (0.42, 0.46, 0.36)), Ball((0.66, 1.12, 0), (0.34, 0.42, 0.37))]),
        (0.22, [Limb([(-0.62, 1.18, 0, 0.31), (-0.98, 1.5, 0, 0.21)])]),
        (0.12, [Ball((-1.1, 1.58, 0), (0.22, 0.21, 0.19)), Limb([(-1.12, 1.56, 0, 0.18), (-1.42, 1.36, 0, 0.135)]),
                Ball((-1.48, 1.33, 0), (0.13, 0.14, 0.165))]),
        (0.05, both(Ball, (-0.99, 1.64, 0.27), (0.08, 0.095, 0.18), turns=[("x", 18), ("y", 18)])),
        (0.08, both(Limb, leg(-0.48, 0.22, 0.85, 0.105, 0.105)) + both(Limb, leg(0.74, 0.22, 0.9, 0.115, 0.105, 0.05))),
        (0.12, [Ball((0.48, 0.68, 0), (0.22, 0.15, 0.18))]),
        (0.03, both(Ball, (0.44, 0.52, 0.07), (0.03, 0.07, 0.03))),
        (0.05, [Limb([(0.94, 1.36, 0, 0.05), (1.1, 1.15, 0, 0.03), (1.1, 0.72, 0, 0.028)]), Ball((1.1, 0.6, 0), (0.065, 0.15, 0.065))]),
    ])
    horns = Body([(0.01, both(Limb, [(-1.06, 1.74, 0.12, 0.055), (-1.09, 1.84, 0.23, 0.042), (-1.16, 1.98, 0.24, 0.014)], 6))])
    return body, 0.048, -0.12, {"horns": (horns, 0.026)}


def rabbit():
    body = Body([
        (0.1, [Ball((0.26, 0.58, 0), (0.54, 0.5, 0.42), turns=[("z", -14)]), Ball((-0.16, 0.62, 0), (0.34, 0.42, 0.32))]),
        (0.14, both(Ball, (0.42, 0.4, 0.27), (0.34, 0.36, 0.2), turns=[("z", -20)])),
        (0.16, [Ball((-0.42, 1.12, 0), (0.31, 0.28, 0.26), turns=[("z", 12)]), Ball((-0.6, 1.02, 0), (0.17, 0.15, 0.17))]),
        (0.05, both(Ball, (-0.6, 0.98, 0.1), (0.11, 0.1, 0.1))),
        (0.06, both(Ball, (-0.22, 1.66, 0.15), (0.13, 0.47, 0.085), turns=[("z", -12), ("x", 12), ("y", -35)])),
        (0.08, both(Limb, [(-0.28, 0.55, 0.17, 0.15), (-0.42, 0.3, 0.18, 0.1), (-0.46, 0.09, 0.18, 0.09)])),
        (0.05, both(Ball, (-0.54, 0.07, 0.18), (0.15, 0.075, 0.095))),
        (0.06, both(Ball, (0.14, 0.09, 0.3), (0.34, 0.095, 0.12))),
        (0.04, [Ball((0.82, 0.42, 0), (0.17, 0.17, 0.17))]),
    ])
    nose = Body([(0.01, [Ball((-0.755, 1.06, 0), (0.04, 0.034, 0.05))])])
    return body, 0.05, 0.02, {"nose": (nose, 0.016)}


def duck():
    body = Body([
        (0.1, [Ball((0.12, 0.52, 0), (0.74, 0.42, 0.46)), Ball((-0.3, 0.58, 0), (0.4, 0.4, 0.4))]),
        (0.25, [Limb([(0.55, 0.62, 0, 0.28), (0.86, 0.84, 0, 0.14), (1.04, 1.06, 0, 0.045)], 6)]),
        (0.22, [Limb([(-0.42, 0.8, 0, 0.24), (-0.52, 1.1, 0, 0.19), (-0.6, 1.34, 0, 0.2)])]),
        (0.12, [Ball((-0.64, 1.42, 0), (0.31, 0.3, 0.28))]),
        (0.04, both(Ball, (0.2, 0.62, 0.41), (0.5, 0.25, 0.12), turns=[("z", 14), ("y", -8)])),
        (0.03, both(Ball, (0.55, 0.78, 0.36), (0.26, 0.1, 0.08), turns=[("z", 24)])),
    ])
    beak = Body([(0.04, [Ball((-0.94, 1.38, 0), (0.2, 0.05, 0.15), turns=[("z", -10)]), Ball((-0.92, 1.32, 0), (0.16, 0.035, 0.12))])])
    feet = Body([(0.02, both(Limb, [(0.05, 0.25, 0.2, 0.05), (0.02, 0.06, 0.22, 0.045)])
                  + both(Ball, (-0.1, 0.035, 0.23), (0.2, 0.035, 0.14)))])
    return body, 0.05, 0.0, {"beak": (beak, 0.03), "feet": (feet, 0.032)}


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent / "models"
    folder.mkdir(parents=True, exist_ok=True)
    box = ((-2.0, -0.1, -0.9), (1.5, 2.4, 0.9))
    for name, make in (("elephant", elephant), ("cow", cow), ("rabbit", rabbit), ("duck", duck)):
        body, step, plane, extras = make()
        vertices, triangles = surface_net(body, *box, step)
        left, right = cut(vertices, body.gradient(vertices), triangles, plane)
        write(folder / f"{name}-left.obj", left, f"{name}, left of x = {plane} m")
        write(folder / f"{name}-right.obj", right, f"{name}, right of it")
        for extra, (part, fine) in extras.items():
            vertices, triangles = surface_net(part, *box, fine)
            normals = part.gradient(vertices)
            faces = [[(vertices[i], normals[i]) for i in t] for t in triangles]
            write(folder / f"{name}-{extra}.obj", faces, f"{name}'s {extra}")


if __name__ == "__main__":
    main()
