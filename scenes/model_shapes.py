"""Shapes for make_models.py: turned on a lathe, swept along a curve, or cut from boxes. Python only."""

import math


class Mesh:
    """Positions, a normal for each, and triangles of their indices, anticlockwise from outside."""

    def __init__(self):
        self.positions, self.normals, self.triangles = [], [], []

    def add(self, other, move=(0, 0, 0)):
        first = len(self.positions)
        self.positions += [tuple(p[k] + move[k] for k in range(3)) for p in other.positions]
        self.normals += other.normals
        self.triangles += [tuple(first + i for i in t) for t in other.triangles]
        return self

    def grid(self, rows, closed):
        """Rows of (position, normal), one row above the other, seen from outside running anticlockwise from above."""
        width, first = len(rows[0]), len(self.positions)
        for row in rows:
            for position, normal in row:
                self.positions.append(position)
                self.normals.append(normal)
        for j in range(len(rows) - 1):
            for i in range(width if closed else width - 1):
                a, b = first + j * width + i, first + j * width + (i + 1) % width
                c, d = a + width, b + width
                for t in ((a, b, d), (a, d, c)):
                    if len({self.positions[v] for v in t}) == 3:  # none of no area at poles
                        self.triangles.append((t[0], t[2], t[1]))
        return self


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def smooth(points, cuts=3):
    """Catmull-Rom curve through points, `cuts` pieces a span."""
    padded = [points[0], *points, points[-1]]
    curve = [points[0]]
    for k in range(1, len(points)):
        p = padded[k - 1:k + 3]
        for step in range(1, cuts + 1):
            t = step / cuts
            curve.append(tuple(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t ** 3)
                               for a, b, c, d in zip(*p)))
    return curve


def arc(radius, centre_y, start, end, cuts):
    """Part of a circle about the axis point at centre_y; degrees, -90 is its lowest point."""
    angles = [math.radians(start + (end - start) * k / cuts) for k in range(cuts + 1)]
    return [(max(0.0, radius * math.cos(a)), centre_y + radius * math.sin(a)) for a in angles]


def arc_ring(r, y, tube, cuts):
    """Profile of a torus moulding: half a circle of radius `tube` around (r, y), facing outwards."""
    angles = [math.radians(-90 + 180 * k / cuts) for k in range(cuts + 1)]
    return [(r + tube * math.cos(a), y + tube * math.sin(a)) for a in angles]


def lathe(pieces, segments, flutes=0, depth=0.0):
    """Turns pieces of an (r, y) profile, written from below upwards. Smooth within a piece, an edge between two."""
    mesh = Mesh()
    for piece in pieces:
        rows = []
        for k, (r, y) in enumerate(piece):
            before, after = piece[max(k - 1, 0)], piece[min(k + 1, len(piece) - 1)]
            out, up = unit((after[1] - before[1], before[0] - after[0]))
            row = []
            for i in range(segments):
                a = 2 * math.pi * i / segments
                # Flutes: the radius swings between r and r - depth; their slope turns the normal.
                wave = 0.5 - 0.5 * math.cos(flutes * a)
                deep = min(depth, 0.2 * r)
                local, slope = r - deep * wave, -deep * flutes / 2 * math.sin(flutes * a) / max(r, 1e-9)
                c, s = math.cos(a), math.sin(a)
                normal = unit((out * (c + slope * s), up, out * (s - slope * c)))
                row.append(((local * c, y, local * s), normal))
            rows.append(row)
        mesh.grid(rows, closed=True)
    return mesh


def box(size, centre=(0, 0, 0)):
    mesh = Mesh()
    for axis in range(3):
        for sign in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(mesh.positions)
            for du, dv in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [0.0, 0.0, 0.0]
                p[axis], p[u], p[v] = sign * size[axis] / 2, du * size[u] / 2, dv * size[v] / 2
                mesh.positions.append(tuple(p[k] + centre[k] for k in range(3)))
                mesh.normals.append(tuple(float(sign) if k == axis else 0.0 for k in range(3)))
            order = ((0, 1, 2), (0, 2, 3)) if sign > 0 else ((0, 2, 1), (0, 3, 2))
            mesh.triangles += [tuple(first + i for i in t) for t in order]
    return mesh


def sphere(radius, segments, centre=(0, 0, 0)):
    return Mesh().add(lathe([arc(radius, 0, -90, 90, segments // 2)], segments), centre)


def wedge(inner, outer, low, high, middle, half, cuts=4):
    """A block of a ring: battlements."""
    mesh = Mesh()
    angles = [math.radians(middle - half + 2 * half * k / cuts) for k in range(cuts + 1)]
    at = lambda r, y, a: (r * math.cos(a), y, r * math.sin(a))
    mesh.grid([[(at(outer, y, a), at(1, 0, a)) for a in angles] for y in (low, high)], closed=False)
    mesh.grid([[(at(inner, y, a), at(-1, 0, a)) for a in angles] for y in (high, low)], closed=False)
    mesh.grid([[(at(r, high, a), (0, 1, 0)) for a in angles] for r in (outer, inner)], closed=False)
    for a, sign in ((angles[0], -1), (angles[-1], 1)):
        normal = (-sign * math.sin(a), 0, sign * math.cos(a))
        rows = [[(at(r, y, a), normal) for r in ((inner, outer) if sign < 0 else (outer, inner))] for y in (low, high)]
        mesh.grid(rows, closed=False)
    return mesh


def sweep(spine, segments):
    """A limb along a curve in the x-y plane: points (x, y, half thickness in the plane, half thickness along z)."""
    rows = []
    frames = []
    for k in range(len(spine)):
        a, b = spine[max(k - 1, 0)], spine[min(k + 1, len(spine) - 1)]
        along = unit((b[0] - a[0], b[1] - a[1]))
        frames.append((along[1], -along[0]))
    for (x, y, thick, wide), (sx, sy) in zip(spine, frames):
        row = []
        for i in range(segments):
            a = 2 * math.pi * i / segments
            c, s = math.cos(a), math.sin(a)
            row.append((x + thick * c * sx, y + thick * c * sy, wide * s))
        rows.append(row)
    mesh = Mesh().grid([[(p, (0.0, 0.0, 0.0)) for p in row] for row in rows], closed=True)
    return averaged(mesh)


def averaged(mesh):
    """Normals from the triangles around each place, weighted by area."""
    sums = {}
    for t in mesh.triangles:
        a, b, c = (mesh.positions[i] for i in t)
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for p in (a, b, c):
            key = tuple(round(x, 6) for x in p)
            sums[key] = tuple(x + y for x, y in zip(sums.get(key, (0, 0, 0)), n))
    mesh.normals = [unit(sums.get(tuple(round(x, 6) for x in p), (0, 1, 0))) for p in mesh.positions]
    return mesh
