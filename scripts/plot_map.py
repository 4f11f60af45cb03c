"""A map of where methods work: methods across, a parameter up. A cell is blue where the run held, and red with a cross
where it broke. Marks show where each method was measured to break, and where it does by theory."""
import bisect
import textwrap

import matplotlib
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from plot_style import BLACK, GREY

FAILS, STABLE, IMPOSSIBLE, NOT_TRIED = range(4)  # as test/pages/map.hpp has them
COLOURS = {FAILS: "#E8A27C", STABLE: "#BBD9EE", IMPOSSIBLE: "#EEEEEE", NOT_TRIED: "#FFFFFF"}
WORDS = {FAILS: "breaks", STABLE: "holds", IMPOSSIBLE: "the solver has no such method", NOT_TRIED: "not tried"}
THEORY = "#D55E00"


def width(panel):
    """Width that a map needs [inches]."""
    return 1.9 + 0.44 * len(panel["map"]["columns"])


def height(panel):
    drawn = panel["map"]
    longest = max(len(column["method"]) for column in drawn["columns"])
    return 1.5 + 0.26 * len(drawn["rows"]) + 0.075 * longest


def place(value, rows):
    """Position of a value among rows that are drawn at 0, 1, 2, …, and whether it is beyond them (-1, 0, 1)."""
    if value <= rows[0]:
        return -0.42, -1 if value < rows[0] else 0
    if value >= rows[-1]:
        return len(rows) - 0.58, 1 if value > rows[-1] else 0
    after = bisect.bisect_right(rows, value)
    low, high = rows[after - 1], rows[after]
    return after - 1 + (value - low) / (high - low), 0


def draw_mark(axes, x, value, rows, colour, style, half):
    y, beyond = place(value, rows)
    axes.plot([x - half, x + half], [y, y], color=colour, lw=2.2, ls=style, solid_capstyle="butt", zorder=4)
    if beyond:
        axes.plot([x], [y], marker="^" if beyond > 0 else "v", color=colour, ms=5, zorder=5)


def draw_map(axes, panel):
    drawn = panel["map"]
    rows, columns = drawn["rows"], drawn["columns"]
    seen = set()
    for x, column in enumerate(columns):
        for y, cell in enumerate(column["cells"]):
            seen.add(cell)
            axes.add_patch(
                matplotlib.patches.Rectangle(
                    (x - 0.46, y - 0.46), 0.92, 0.92, facecolor=COLOURS[cell], edgecolor="white", linewidth=0.5
                )
            )
            if cell == FAILS:
                axes.plot([x], [y], "x", color="#7A3B1A", ms=4.5, mew=1.0, zorder=3)
        if column["theory"] is not None:
            draw_mark(axes, x, column["theory"], rows, THEORY, (0, (2, 1)), 0.48)
        if column["breaks"] is not None:
            draw_mark(axes, x, column["breaks"], rows, BLACK, "-", 0.3)
        if "note" in column:
            axes.text(x, len(rows) - 0.45, column["note"], fontsize=7, ha="center", va="bottom", color="#444444")
    axes.set_xlim(-0.6, len(columns) - 0.4)
    axes.set_ylim(-0.6, len(rows) - 0.4)
    axes.set_xticks(range(len(columns)), [column["method"] for column in columns], rotation=90, fontsize=8)
    axes.set_yticks(range(len(rows)), [f"{row:g}" for row in rows], fontsize=8)
    axes.set_ylabel("\n".join(textwrap.wrap(drawn["parameter"], 34)), fontsize=9)
    notes = any("note" in column for column in columns)
    axes.set_title(panel["title"], fontsize=10, pad=16 if notes else 6)
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)
    handles = [Patch(facecolor=COLOURS[cell], edgecolor=GREY, linewidth=0.4, label=WORDS[cell]) for cell in sorted(seen)]
    if any(column["breaks"] is not None for column in columns):
        handles.append(Line2D([], [], color=BLACK, lw=2.2, label="measured limit"))
    if any(column["theory"] is not None for column in columns):
        handles.append(Line2D([], [], color=THEORY, lw=2.2, ls=(0, (2, 1)), label="theory"))
    axes.legend(handles=handles, fontsize=7.5, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
