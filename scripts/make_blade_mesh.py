#!/usr/bin/python3
"""Writes config/meshes/blade.obj: a bulldozer's blade, 0.48 m wide and 0.31 m high, pushing along +x.

The origin is the middle of the cutting edge. Front: an upright cutting plate, and above it a mouldboard that is an arc,
leaning back by 20 degrees at the plate and forward by 15 degrees at the top. The back is the same line 0.12 m behind,
so that material in front does not meet material behind. The underside rises to the back by 5 degrees, to stay clear of
the ground that was cut.
"""
import math
import pathlib

WIDTH, THICKNESS, PLATE, RADIUS = 0.48, 0.12, 0.04, 0.45  # [m]
BOTTOM, TOP = math.radians(-20), math.radians(15)  # angles of the arc
CLEARANCE = math.radians(5)
SEGMENTS = 16

angles = [BOTTOM + (TOP - BOTTOM) * i / (SEGMENTS - 1) for i in range(SEGMENTS)]
arc = [(RADIUS * (math.cos(BOTTOM) - math.cos(a)), PLATE + RADIUS * (math.sin(a) - math.sin(BOTTOM))) for a in angles]
front = [(0.0, 0.0)] + arc
rise, height = THICKNESS * math.tan(CLEARANCE), front[-1][1]
back = [(x - THICKNESS, rise + z * (height - rise) / height) for x, z in front]

profile = front + back[::-1]  # counter-clockwise seen from -y, where x is to the right and z up
count = len(profile)
lines = ["# A bulldozer's blade [m]; made by scripts/make_blade_mesh.py"]
lines += [f"v {x:.6f} {y:.6f} {z:.6f}" for y in (-WIDTH / 2, WIDTH / 2) for x, z in profile]
for i in range(count):
    j = (i + 1) % count
    lines += [f"f {i + 1} {i + count + 1} {j + count + 1}", f"f {i + 1} {j + count + 1} {j + 1}"]
for i in range(SEGMENTS):
    quad = (i, i + 1, count - 2 - i, count - 1 - i)
    for a, b, c in ((0, 1, 2), (0, 2, 3)):
        right = [quad[a] + 1, quad[b] + 1, quad[c] + 1]
        lines.append("f {} {} {}".format(*right))
        lines.append("f {} {} {}".format(*(v + count for v in reversed(right))))
path = pathlib.Path(__file__).resolve().parent.parent / "config/meshes/blade.obj"
path.write_text("\n".join(lines) + "\n")
