#!/usr/bin/python3
"""make_verification.py PAGES DOC: writes DOC/verification.md and DOC/images/verification/*.png from the pages (JSON)
that the verification tests left in PAGES, after the hand-written head test/verification/head.md."""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402: the backend comes first

ROOT = pathlib.Path(__file__).resolve().parent.parent
CHAPTERS = {
    "waves": "Waves, weight and order of convergence",
    "conservation": "Conservation",
    "contact": "Contact with rigid bodies",
    "pairs": "Contact between deformable bodies",
    "axisymmetric": "Axisymmetric scenes",
    "soil": "Soil",
    "metal": "Metal",
    "fluid": "Fluid and gas",
    "viscoelastic": "Viscoelastic material",
    "transport": "Heat, diffusion and water in pores",
    "crack": "Explicit cracks",
}
# Okabe & Ito's colours, which colour-blind readers can distinguish too. Black is for exact solutions.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
MARKS = ["o", "s", "^", "D", "v", "P"]


def draw_series(axes, series, number, figure):
    kind, label = series["kind"], series["label"]
    x, y = series["x"], series["y"]
    colour = COLOURS[number % len(COLOURS)]
    if kind == "exact":
        axes.plot(x, y, color="black", lw=1.4, label=label, zorder=2)
    elif kind == "line":
        style = ["-", "--", ":"][number // len(COLOURS) % 3]
        axes.plot(x, y, style, color=colour, lw=1.4, label=label, zorder=3)
    elif kind == "points":
        mark = MARKS[(number + number // len(MARKS)) % len(MARKS)] if len(x) < 400 else "."
        axes.plot(x, y, mark, color=colour, ms=4 if len(x) < 400 else 1.5, label=label, zorder=3)
    elif kind == "published":
        axes.plot(x, y, MARKS[number % len(MARKS)], mfc="none", color="#666666", ms=6, label=label, zorder=4)
    elif kind == "particles":
        size = max(0.3, min(12.0, 9000.0 / len(x)))
        drawn = axes.scatter(x, y, c=series["c"], s=size, cmap="cividis", linewidths=0)
        axes.set_aspect("equal")
        figure.colorbar(drawn, ax=axes, label=label, shrink=0.8)
    else:
        raise SystemExit(f"make_verification: a series of unknown kind '{kind}'")


def draw_order(axes, order):
    """Draws a triangle with the slope of an order, below the lowest points."""
    xs = [v for line in axes.lines for v in line.get_xdata()]
    ys = [v for line in axes.lines for v in line.get_ydata()]
    left, right = min(xs), max(xs)
    a = left * (right / left) ** 0.55
    b = left * (right / left) ** 0.9
    bottom = min(ys) * 0.8
    axes.plot([a, b, b, a], [bottom, bottom, bottom * (b / a) ** order, bottom], color="#666666", lw=0.8)
    axes.text(b, bottom * (b / a) ** (order / 2), f" order {order:g}", fontsize=8, color="#666666", va="center")


def draw_panel(axes, panel, figure):
    number = 0
    for series in panel["series"]:
        draw_series(axes, series, number, figure)
        number += series["kind"] in ("line", "points", "published")
    if panel.get("log_x"):
        axes.set_xscale("log")
    if panel.get("log_y"):
        axes.set_yscale("log")
    if "order" in panel:
        draw_order(axes, panel["order"])
    axes.set_title(panel["title"], fontsize=10)
    axes.set_xlabel(panel["x"])
    axes.set_ylabel(panel["y"])
    axes.grid(alpha=0.25)
    if any(series["kind"] != "particles" for series in panel["series"]):
        axes.legend(fontsize=8, frameon=any(series["kind"] == "particles" for series in panel["series"]))


def draw(page, path):
    panels = page["figure"]
    figure, all_axes = plt.subplots(
        1, len(panels), figsize=(4.6 * len(panels) + 0.4, 3.5), squeeze=False, layout="constrained"
    )
    for axes, panel in zip(all_axes[0], panels):
        draw_panel(axes, panel, figure)
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)


def number(value):
    return "not finite" if value is None else f"{value:.5g}"  # JSON has no NaN: a test that failed wrote null


def deviation(row):
    exact, reached = row["exact"], row["reached"]
    if exact is None or reached is None:
        return ""
    if exact == 0:
        return f"{reached:+.2g}" + with_unit(row)
    part = 100 * (reached / exact - 1)
    if abs(part) < 1e-9:
        return "round-off"
    return f"{part:+.0f} %" if abs(part) >= 99.5 else f"{part:+.2g} %"


def with_unit(row):
    return "" if row["unit"] in ("", "1", "-") else " " + row["unit"]


def scene_path(name):
    """Path of a scene from the name, the file or the path that the test gave."""
    file = pathlib.PurePath(name).stem + ".yaml"
    for folder in ("test/verification/scenes", "config/scenes"):
        if (ROOT / folder / file).exists():
            return f"{folder}/{file}"
    raise SystemExit(f"make_verification: there is no scene '{name}'")


def section(page, pictures):
    lines = [f"### {page['title']}", "", page["problem"], ""]
    if "exact" in page:
        lines += [f"*Exact:* {page['exact']} *Source:* {page['source']}.", ""]
    if page["figure"]:
        lines += [f"![{page['title']}]({pictures}/{page['name']}.png)", ""]
    if page["rows"]:
        lines += ["| quantity | reached | exact or published | deviation | asked |", "|---|---|---|---|---|"]
        for row in page["rows"]:
            exact = "" if row["exact"] is None else number(row["exact"]) + with_unit(row)
            cells = [row["quantity"], number(row["reached"]) + with_unit(row), exact, deviation(row), row["criterion"]]
            lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
        lines.append("")
    if "meaning" in page:
        lines += [page["meaning"], ""]
    source = [f"Test `{page['test']}`"]
    if "scene" in page:
        source.append(f"scene `{scene_path(page['scene'])}`")
    lines += ["<sub>" + ", ".join(source) + ("" if page["passed"] else ", **failed in this run**") + "</sub>", ""]
    return lines


def main():
    if len(sys.argv) != 3:
        raise SystemExit("usage: make_verification.py PAGES DOC")
    pages_folder, doc = map(pathlib.Path, sys.argv[1:])
    pages = [json.loads(file.read_text()) for file in sorted(pages_folder.glob("*/*.json"), key=lambda file: file.name)]
    if not pages:
        raise SystemExit(f"make_verification: no page in {pages_folder}; run the tests with MPM_PAGES set to it")
    pictures = doc / "images" / "verification"
    pictures.mkdir(parents=True, exist_ok=True)
    for old in pictures.glob("*.png"):
        old.unlink()
    head = ROOT / "test" / "verification" / "head.md"
    lines = [head.read_text().rstrip(), ""]
    for chapter, title in CHAPTERS.items():
        members = [page for page in pages if page["chapter"] == chapter]
        if members:
            lines += [f"## {title}", ""]
        for page in members:
            if page["figure"]:
                draw(page, pictures / f"{page['name']}.png")
            lines += section(page, "images/verification")
    unknown = sorted({page["chapter"] for page in pages} - set(CHAPTERS))
    if unknown:
        raise SystemExit(f"make_verification: unknown chapters {', '.join(unknown)}; add them to CHAPTERS")
    (doc / "verification.md").write_text("\n".join(lines).rstrip() + "\n")
    print(f"{len(pages)} pages: {doc / 'verification.md'}")


if __name__ == "__main__":
    main()
