"""Reads the CSV tables of a run (doc/analysis.md lists them) and the outlines of its rigid bodies."""
import csv
import json
import os

import numpy as np


class TableError(Exception):
    """A table is missing or has another layout; the message is one line."""


class Table:
    """The numeric columns of one file: table["blade fx"] is an array, table.units["blade fx"] is "N"."""

    def __init__(self, path):
        self._path = path
        self.units = {}
        self._values = {}
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = csv.reader(file)
                header = next(rows)
                first = next(rows, None)
            numeric = [i for i, cell in enumerate(first or []) if i < len(header) and _is_number(cell)]
            if not numeric:
                return
            values = np.loadtxt(path, delimiter=",", skiprows=1, usecols=numeric, ndmin=2, quotechar='"', comments=None)
        except (OSError, StopIteration, ValueError, csv.Error) as error:
            raise TableError(f"{path}: cannot be read; give a folder that bag_report --csv wrote") from error
        for column, i in enumerate(numeric):
            name, _, unit = header[i].partition(" [")
            self.units[name] = unit.rstrip("]")
            self._values[name] = values[:, column]

    def __contains__(self, name):
        return name in self._values

    def __getitem__(self, name):
        if name not in self._values:
            raise TableError(f"{self._path}: no numbers of '{name}'; give a folder that bag_report --csv wrote whole")
        return self._values[name]

    def names(self):
        return list(self._values)

    def vector(self, prefix):
        """Columns "<prefix>x", "<prefix>y", "<prefix>z" as an array of rows."""
        return np.column_stack([self[prefix + axis] for axis in "xyz"])


def file_stem(name):
    """The stem of a file name, from a body's or a field's name."""
    return "".join(c if c.isascii() and (c.isalnum() or c in ".-_") else "_" for c in name)


def reach_of(run, box, times, gap):
    """The lower and upper corner of the pictures. They show all particles (`box` around their centres, `gap` apart), and
    the tools at some times up to half the particles' size beyond them; an endless plate is cut off."""
    low, high = box[0] - gap, box[1] + gap
    most = 0.5 * (high - low).max()
    least, largest = low - most, high + most
    for body, (vertices, _) in run.outlines().items():
        for time in times:
            position, rotation = run.pose_at(body, time)
            moved = position + vertices @ rotation.T
            low = np.minimum(low, np.maximum(moved.min(axis=0) - gap, least))
            high = np.maximum(high, np.minimum(moved.max(axis=0) + gap, largest))
    return low, high


def _about(folder):
    path = os.path.join(folder, "run.json")
    if not os.path.exists(path):
        return {}
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except ValueError as error:
        raise TableError(f"{path}: not what bag_report --csv wrote; write the folder again") from error


def _table_if_there(folder, file):
    path = os.path.join(folder, file)
    return Table(path) if os.path.exists(path) else None


def _is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False


class Run:
    """All tables of a folder, and the figures that bag_report wrote to run.json there."""

    def __init__(self, folder, title=""):
        self.folder = folder
        self.about = _about(folder)
        self.label = self.about.get("label") or os.path.basename(os.path.abspath(folder))
        self.title = title or self.about.get("scene") or self.label
        self.audit_limit = self.about.get("audit", {}).get("limit", 1e-10)  # in double precision
        self.forces = Table(os.path.join(folder, "contact_forces.csv"))
        self.poses = Table(os.path.join(folder, "bodies.csv"))
        self.state = Table(os.path.join(folder, "solver_state.csv"))
        self.global_quantities = _table_if_there(folder, "global_quantities.csv")
        self.joints = _table_if_there(folder, "joints.csv")
        ending = " interval"
        self.bodies = [name[: -len(ending)] for name in self.forces.names() if name.endswith(ending)]
        self.snapshots = self._snapshots()

    def _snapshots(self):
        """(time [s], path), in order of time."""
        path = os.path.join(self.folder, "particles.csv")
        if not os.path.exists(path):
            return []
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return [(float(row["time [s]"]), os.path.join(self.folder, row["file"])) for row in rows]

    def caption(self):
        """How the run was made, in one line."""
        parts = [self.title, self.about.get("method"), f"{self.state['particles'][-1]:.0f} particles"]
        if self.about.get("version"):
            parts.append(f"mpm_ros {self.about['version']}")
        if self.about.get("bag"):
            parts.append(os.path.basename(self.about["bag"]))
        return "  ·  ".join(part for part in parts if part)

    def strongest(self):
        """The body with the largest force, and the time [s] and vector [N] of that force; None without any force."""
        best = None
        for body in self.bodies:
            force = self.forces.vector(body + " f")
            size = np.linalg.norm(force, axis=1)
            at = int(np.argmax(size))
            if size[at] > 0 and (best is None or size[at] > best[0]):
                best = (size[at], body, self.forces["time"][at], force[at])
        return None if best is None else best[1:]

    def force_at(self, body, time):
        """Mean force [N] of the interval that ends nearest to a time [s]."""
        row = int(np.argmin(np.abs(self.forces["time"] - time)))
        return np.array([self.forces[f"{body} f{axis}"][row] for axis in "xyz"])

    def pressed_at(self, body, time):
        """Centre of pressure [m] of the interval that ends nearest to a time [s]; else the body's origin."""
        row = int(np.argmin(np.abs(self.forces["time"] - time)))
        if f"{body} cop x" in self.forces:
            center = self.forces.vector(body + " cop ")[row]
            if np.all(np.isfinite(center)):
                return center
        return self.pose_at(body, time)[0]

    def pose_at(self, body, time):
        """Position [m] and rotation matrix (body to world) of the message nearest to a time [s]."""
        row = int(np.argmin(np.abs(self.poses["time"] - time)))
        x, y, z, w = (self.poses[f"{body} q{axis}"][row] for axis in "xyzw")
        rotation = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        )
        return self.poses.vector(body + " ")[row], rotation

    def outlines(self):
        """Vertices in the body's frame [m] and triangles (indices) of each body that has an outline."""
        found = {}
        for file in sorted(os.listdir(self.folder)):
            if not (file.startswith("outline_") and file.endswith(".obj")):
                continue
            name, vertices, faces = _read_obj(os.path.join(self.folder, file))
            if name in self.bodies and faces:
                found[name] = (np.array(vertices), np.array(faces))
        return found


def _read_obj(path):
    name, vertices, faces = "", [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            kind, _, rest = line.strip().partition(" ")
            if kind == "o":
                name = rest
            elif kind == "v":
                vertices.append([float(word) for word in rest.split()])
            elif kind == "f":
                faces.append([int(word) - 1 for word in rest.split()])
    return name, vertices, faces
