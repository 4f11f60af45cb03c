#!/usr/bin/python3
"""Pictures of a run from the CSV tables that bag_report and run_scene write.

    plot_report.py CSV_DIR PLOTS_DIR [--title T] [--field F]

contact_<body>.png    force, torque and velocity of a rigid body over time
energies.png          energies by kind
audit.png             residual of the momentum audit, and the impulses by source
section_<field>.png   the particles in a slice through the tool
view_<field>.png      the particles and the tools seen from the side (runs in 3D)
"""
import argparse
import os
import sys

import matplotlib

matplotlib.use("Agg")
# Its companions lie beside it, also when it runs through the wrapper of the devel space.
sys.dont_write_bytecode = True  # nothing is left among the sources
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import plot_particles  # noqa: E402
import plot_series  # noqa: E402
import plot_tables  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description="Draws pictures of a run from the tables of bag_report --csv.")
    parser.add_argument("csv", help="folder with contact_forces.csv and the other tables")
    parser.add_argument("plots", help="folder for the pictures; made if need be")
    parser.add_argument("--title", default="", help="name of the run, above each picture")
    parser.add_argument("--field", default="", help="particle field that colours the particles")
    options = parser.parse_args()
    try:
        run = plot_tables.Run(options.csv)
        fields = plot_particles.fields_of(run, options.field)
        os.makedirs(options.plots, exist_ok=True)
        title = options.title or os.path.basename(os.path.abspath(options.csv))
        plot_series.style()
        for body in run.bodies:
            plot_series.plot_contact(run, body, options.plots, title)
        plot_series.plot_energies(run, options.plots, title)
        plot_series.plot_audit(run, options.plots, title)
        plot_particles.plot_particles(run, options.plots, title, fields)
    except (plot_tables.TableError, OSError) as error:
        print(f"plot_report.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
