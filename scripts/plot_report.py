#!/usr/bin/python3
"""Pictures of runs from the CSV tables that bag_report and run_scene write.

    plot_report.py CSV_DIR PLOTS_DIR [--title T] [--field F]       one run
    plot_report.py CSV_DIR CSV_DIR... PLOTS_DIR                     several runs in the same pictures
    plot_report.py CSV_DIR --animate FILE                          as bag_report calls it

contact_<body>.png            force, impulse, torque and velocity of a rigid body over time
energies.png                  energies by kind
audit.png                     impulses by source and the audit's residual, time step, smallest det F
joints_<robot>.png            position, velocity and effort of a robot's joints over time
global_quantities.png         the quantities that the scene asks for, a panel for each unit
cracks.png                    J, K_I and K_II of each crack tip and the length of each crack over time
crack_path_<crack>.png        the way of a crack that grew
section_<field>.png           the particles in a slice through the tool, and the cracks
view_<field>.png              the particles and the tools seen from the side (runs in 3D)
compare_contact_<body>.png    several runs: force and impulse, a line for each run
compare_energies.png, compare_audit.png
"""
import argparse
import os
import sys

import matplotlib

matplotlib.use("Agg")
# Its modules lie beside it, also when it runs through the wrapper of the devel space.
sys.dont_write_bytecode = True  # leaves no files among the sources
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import plot_animation  # noqa: E402
import plot_compare  # noqa: E402
import plot_cracks  # noqa: E402
import plot_particles  # noqa: E402
import plot_robots  # noqa: E402
import plot_series  # noqa: E402
import plot_style  # noqa: E402
import plot_tables  # noqa: E402


def draw(options):
    plot_style.style()
    if options.animate:
        plot_animation.animate(plot_tables.Run(options.folders[0], options.title), options.animate)
        return
    if len(options.folders) < 2:
        raise plot_tables.TableError("give a folder with tables, and one for the pictures")
    *folders, plots = options.folders
    runs = [plot_tables.Run(folder, options.title if len(folders) == 1 else "") for folder in folders]
    fields = plot_particles.fields_of(runs[0], options.field) if len(runs) == 1 else []
    os.makedirs(plots, exist_ok=True)
    if len(runs) > 1:
        plot_compare.plot_comparison(runs, plots)
        return
    run, cracks = runs[0], plot_cracks.Cracks(folders[0])
    for body in run.bodies:
        plot_series.plot_contact(run, body, plots)
    plot_robots.plot_robots(run, plots)
    plot_series.plot_energies(run, plots)
    plot_series.plot_audit(run, plots)
    plot_series.plot_global(run, plots)
    plot_cracks.plot_cracks(run, cracks, plots)
    plot_particles.plot_particles(run, plots, fields, cracks)


def main():
    parser = argparse.ArgumentParser(description="Draws pictures of runs from the tables of bag_report --csv.")
    parser.add_argument("folders", nargs="+", metavar="FOLDER",
                        help="with contact_forces.csv and the other tables, one a run; the last: for the pictures")
    parser.add_argument("--title", default="", help="name of the run, above each picture")
    parser.add_argument("--field", default="", help="particle field that colours the particles")
    parser.add_argument("--animate", default="", help="make an animation of snapshots from standard input")
    options = parser.parse_args()
    try:
        draw(options)
    except (plot_tables.TableError, OSError) as error:
        print(f"plot_report.py: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
