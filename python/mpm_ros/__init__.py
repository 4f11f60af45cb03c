"""mpm_ros in Python: step a simulation, run many, and read their recordings. doc/python.md shows the use.

    Simulator        a simulator node of one's own, or one that runs, stepped in lockstep
    Observation      what a step answers: bodies, contact forces, particles, as NumPy arrays
    Simulators       many simulators of one scene, stepped at the same time
    Observations     what they answer, with a row for each
    Recording        a bag, split or whole, as NumPy arrays or pandas
    run_sweep        many runs of one scene with other values
    Sweep            such runs, with their parameters, metrics and recordings
    MpmError         whatever went wrong, in one sentence
    mpm_ros.msg, mpm_ros.srv    the generated messages and services

The names are loaded at their first use, so that tools which only want the messages need no NumPy.
"""
import importlib
import pkgutil

# The generated messages lie in another folder of this name. A process that was spawned with this program's sys.path, on which
# the build folder's own package has put the sources first, finds them by this.
__path__ = pkgutil.extend_path(__path__, __name__)

_HOMES = {"MpmError": "errors", "Observation": "observation", "Observations": "simulators", "Particles": "particles",
          "Recording": "recording", "Simulator": "simulator", "Simulators": "simulators", "Sweep": "sweep",
          "SweepRun": "sweep", "Table": "recording", "run_sweep": "sweep"}
__all__ = list(_HOMES)


def __getattr__(name):
    if name not in _HOMES:
        raise AttributeError(f"module 'mpm_ros' has no attribute '{name}'")
    return getattr(importlib.import_module("." + _HOMES[name], __name__), name)
