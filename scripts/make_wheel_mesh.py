#!/usr/bin/python3
"""Writes config/meshes/rover_wheel.obj: a rigid wheel with 12 lugs, 0.3 m over their tips and 0.15 m wide, its axle along y.

The origin is the wheel's middle. The lugs are 20 mm high, 28 mm wide at their feet and 18 mm at their tips, as those of
config/scenes/wheel_in_sand.yaml.
"""
import math
import pathlib

WIDTH, RIM, TIP, LUGS = 0.15, 0.13, 0.15, 12  # [m], [m], [m], number
FOOT, EDGE = 0.014, 0.009  # half the width of a lug at its foot and at its tip [m]

profile = []  # (x, z), counter-clockwise seen from -y, where x is to the right and z up
for lug in range(LUGS):
    middle = 2 * math.pi * lug / LUGS
    for radius, across in ((RIM, -FOOT), (TIP, -EDGE), (TIP, EDGE), (RIM, FOOT)):
        angle = middle + math.asin(across / radius)
        profile.append((radius * math.cos(angle), radius * math.sin(angle)))

count = len(profile)
lines = ["# A rover's wheel with lugs [m]; made by scripts/make_wheel_mesh.py"]
for y in (-WIDTH / 2, WIDTH / 2):
    lines += [f"v {x:.6f} {y:.6f} {z:.6f}" for x, z in profile] + [f"v 0.000000 {y:.6f} 0.000000"]
near, far = count + 1, 2 * count + 2  # the middles of both sides
for i in range(1, count + 1):
    j = i % count + 1
    lines += [f"f {i} {i + near} {j + near}", f"f {i} {j + near} {j}"]
    lines += [f"f {near} {i} {j}", f"f {far} {j + near} {i + near}"]
path = pathlib.Path(__file__).resolve().parent.parent / "config/meshes/rover_wheel.obj"
path.write_text("\n".join(lines) + "\n")
