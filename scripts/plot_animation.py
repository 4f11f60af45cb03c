"""Makes a film of a run. bag_report writes to standard input: a line of JSON (frames, field, unit, low, high, min,
max), then for each snapshot its time [s] (float64), the number of particles (uint64) and x, y, z from min, and the
value, of each (float32). Each frame is drawn and forgotten before the next is read."""
import json
import os
import shutil
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np

from plot_particles import Coloring, spacing
from plot_section import Section
from plot_style import BLACK, BLUE, GREY, SKY, ORANGE, RED, caption
from plot_tables import TableError
from plot_view import View

FRAMES_A_SECOND = 20
LAST = 1.0  # time that the last frame stays before a GIF begins again [s]
DPI = 100


def read_exactly(stream, count):
    data = stream.read(count)
    if len(data) != count:
        raise TableError("--animate: the snapshots ended early; bag_report writes them to standard input")
    return data


def snapshots_of(stream, head):
    corner = np.array(head["min"])
    for _ in range(head["frames"]):
        time = np.frombuffer(read_exactly(stream, 8), "<f8")[0]
        size = int(np.frombuffer(read_exactly(stream, 8), "<u8")[0])
        rows = np.frombuffer(read_exactly(stream, 16 * size), "<f4").reshape(size, 4)
        yield float(time), corner + rows[:, :3].astype(float), rows[:, 3]


class Film:
    """Draws the frames in order of time."""

    def __init__(self, run, head, gap):
        self.run = run
        self.coloring = Coloring(head["field"], head["unit"], head["low"], head["high"])
        box = np.array([head["min"], head["max"]])
        time = run.poses["time"]
        times = time[np.linspace(0, len(time) - 1, min(40, len(time))).astype(int)] if len(time) else []
        flat = np.ptp(box[:, 1]) == 0
        self.scene = Section(run, box, gap, times) if flat else View(run, box, gap, times, width=900)
        self.figure, (self.panel, self.forces) = self._layout()
        self.now = self._draw_forces()
        caption(self.figure, f"{run.title}: {self.coloring.name}", run.caption())
        self.coloring.bar(self.figure, self.panel, shrink=0.9, aspect=25, pad=0.02)

    def _layout(self):
        """Even numbers of pixels, which video needs; a strip of forces only if there are tools."""
        wide = 9.0
        high = float(np.clip(7.6 / self.scene.aspect, 2.5, 6.5))
        if self.run.strongest() is None:
            figure, panel = plt.subplots(figsize=(wide, round(50 * (high + 1.2)) / 50), dpi=DPI,
                                         constrained_layout=True)
            return figure, (panel, None)
        return plt.subplots(2, 1, figsize=(wide, round(50 * (high + 2.5)) / 50), dpi=DPI, height_ratios=[high, 1.1],
                            constrained_layout=True)

    def _draw_forces(self):
        if self.forces is None:
            return None
        time = self.run.forces["time"]
        colors = [BLUE, ORANGE, RED, SKY, GREY]
        for i, body in enumerate(self.run.bodies):
            size = np.linalg.norm(self.run.forces.vector(body + " f"), axis=1)
            self.forces.plot(time, size, color=colors[i % len(colors)], linewidth=1.3, label=body,
                             drawstyle="steps-pre")
        self.forces.set_ylabel("|force| [N]")
        self.forces.set_xlabel("simulated time [s]")
        self.forces.margins(x=0.01)
        self.forces.set_ylim(bottom=0)
        self.forces.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.2)
        return self.forces.axvline(0, color=BLACK, linewidth=1.2)

    def frame(self, time, positions, values):
        """One frame as an array of rows of red, green, blue."""
        self.panel.cla()
        self.scene.draw(self.panel, time, positions, self.coloring.map.to_rgba(values))
        self.panel.set_title(f"t = {time:.3f} s")
        if self.now:
            self.now.set_xdata([time, time])
        self.figure.canvas.draw()
        if self.figure.get_layout_engine() is not None:
            self.figure.set_layout_engine("none")  # laid out once, so that nothing jumps from frame to frame
        return np.asarray(self.figure.canvas.buffer_rgba())[..., :3]


class Mp4:
    def __init__(self, path):
        self.path, self.process = path, None

    def add(self, pixels):
        if self.process is None:
            height, width = pixels.shape[:2]
            self.process = subprocess.Popen(
                ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
                 f"{width}x{height}", "-r", str(FRAMES_A_SECOND), "-i", "-", "-an", "-c:v", "libx264", "-crf", "20",
                 "-pix_fmt", "yuv420p", "-movflags", "+faststart", self.path], stdin=subprocess.PIPE)
        try:
            self.process.stdin.write(np.ascontiguousarray(pixels).tobytes())
        except BrokenPipeError as error:
            raise TableError(f"{self.path}: ffmpeg stopped; its own message is above; try .gif") from error

    def close(self):
        self.process.stdin.close()
        if self.process.wait() != 0:
            raise TableError(f"{self.path}: ffmpeg failed; its own message is above; try .gif")


class Gif:
    def __init__(self, path):
        self.path, self.frames = path, []

    def add(self, pixels):
        from PIL import Image  # needed only for this kind of file

        self.frames.append(Image.fromarray(pixels).quantize(256, dither=Image.Dither.NONE))  # one byte for each pixel

    def close(self):
        lengths = [1000 // FRAMES_A_SECOND] * (len(self.frames) - 1) + [int(1000 * LAST)]
        self.frames[0].save(self.path, save_all=True, append_images=self.frames[1:], duration=lengths, loop=0)


def writer_of(path):
    """A writer of mp4 by ffmpeg, or of a GIF of the same name where there is no ffmpeg."""
    stem, ending = os.path.splitext(path)
    if ending == ".mp4" and shutil.which("ffmpeg"):
        return Mp4(path), ""
    if ending == ".mp4":
        return Gif(stem + ".gif"), " (a GIF, since ffmpeg is not on PATH; install ffmpeg for .mp4)"
    return Gif(path), ""


def animate(run, path):
    head = json.loads(sys.stdin.buffer.readline() or b"{}")
    if not head.get("frames"):
        raise TableError("--animate: no snapshots; bag_report writes them to standard input")
    writer, why = writer_of(path)
    film = None
    for time, positions, values in snapshots_of(sys.stdin.buffer, head):
        if film is None:
            film = Film(run, head, spacing(positions))
        writer.add(film.frame(time, positions, values))
    writer.close()
    print(f"animation {writer.path}{why}", file=sys.stderr)
