#!/usr/bin/python3
"""stability_pages.py PAGES OUT: makes the chapters on where methods fail, from the pages (JSON) that the stability
tests left in PAGES. It writes OUT/stability.md and OUT/images/*.png; sections() returns the text for a larger page."""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402: the backend comes first

import make_verification  # noqa: E402
import plot_map  # noqa: E402

CHAPTERS = {
    "time_step": "The time step",
    "strain": "Large strain",
    "rotation": "Rotation",
    "ringing": "Ringing and cell crossing",
    "energy": "Energy by update and transfer",
    "locking": "Locking",
    "contact": "Contact",
}


def rows_of(panels):
    """Panels by rows of the picture: a map has a row of its own, curves lie side by side."""
    rows = []
    for panel in panels:
        if "map" in panel or not rows or "map" in rows[-1][0]:
            rows.append([panel])
        else:
            rows[-1].append(panel)
    return rows


def draw(page, path):
    rows = rows_of(page["figure"])
    legend = 1.9  # inches beside a map
    widths = [plot_map.width(row[0]) + legend if "map" in row[0] else 4.6 * len(row) + 0.4 for row in rows]
    heights = [plot_map.height(row[0]) if "map" in row[0] else 3.5 for row in rows]
    figure = plt.figure(figsize=(max(widths), sum(heights)), layout="constrained")
    for part, row, used in zip(figure.subfigures(len(rows), 1, height_ratios=heights, squeeze=False)[:, 0], rows, widths):
        axes = part.subplots(1, len(row), squeeze=False)[0]
        for one, panel in zip(axes, row):
            if "map" in panel:
                plot_map.draw_map(one, panel)
            else:
                make_verification.draw_panel(one, panel, part)
                if len(panel["series"]) > 5:
                    one.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)


def sections(folder, pictures, link=None):
    """The chapters as Markdown. Pictures go to the folder `pictures`; `link` is the text's path to that folder, by
    default images/<its name>."""
    folder, pictures = pathlib.Path(folder), pathlib.Path(pictures)
    link = link or f"images/{pictures.name}"
    pages = [json.loads(file.read_text()) for file in sorted(folder.glob("*/*.json"), key=lambda file: file.name)]
    if not pages:
        raise SystemExit(f"stability_pages: no page in {folder}; run stability_tests with MPM_PAGES set to it")
    unknown = sorted({page["chapter"] for page in pages} - set(CHAPTERS))
    if unknown:
        raise SystemExit(f"stability_pages: unknown chapters {', '.join(unknown)}; add them to CHAPTERS")
    pictures.mkdir(parents=True, exist_ok=True)
    lines = []
    for chapter, title in CHAPTERS.items():
        members = [page for page in pages if page["chapter"] == chapter]
        if members:
            lines += [f"## {title}", ""]
        for page in members:
            if page["figure"]:
                draw(page, pictures / f"{page['name']}.png")
            lines += make_verification.section(page, link)
    return "\n".join(lines).rstrip() + "\n"


def main():
    if len(sys.argv) != 3:
        raise SystemExit("usage: stability_pages.py PAGES OUT")
    out = pathlib.Path(sys.argv[2])
    text = sections(sys.argv[1], out / "images", "images")
    (out / "stability.md").write_text(text)
    print(out / "stability.md")


if __name__ == "__main__":
    main()
