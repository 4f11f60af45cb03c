"""Particle clouds (sensor_msgs/PointCloud2) as NumPy arrays, viewed where they were received."""
import numpy as np

from .errors import MpmError

# sensor_msgs/PointField's constants for its datatype.
_NUMBERS = {1: "i1", 2: "u1", 3: "<i2", 4: "<u2", 5: "<i4", 6: "<u4", 7: "<f4", 8: "<f8"}


def simulated_time(stamp, start):
    """[s] since the run's start of a stamp; both [ns]. Time zero of a run that starts at zero is stamped 1 ns, since
    zero means none to ROS."""
    return (stamp - start) / 1e9 if stamp - start > 1 else 0.0


class Particles:
    """One snapshot of n particles. `particles["speed"]` is the column of a field, (n,); doc/watching.md has the units.

    time      [s] simulated since the run's start
    stamp     [ns] of the message
    fields    names: x, y, z, id and the chosen ones
    array     (n,) of NumPy's structured type, a view of the message
    frame     of x, y, z: the world's, or "<world>_local" in a scene far from the origin (doc/watching.md)
    positions (n, 3) float32 [m] in that frame, a view of the message
    """

    def __init__(self, cloud, start):
        """`cloud`: decoded message (decoding.py). `start` [ns]: stamp of simulated time zero."""
        self.stamp = cloud.header.stamp
        self.frame = cloud.header.frame_id
        self.time = simulated_time(self.stamp, start)
        if cloud.is_bigendian:
            raise MpmError("a cloud of a big-endian machine is not read")
        try:
            layout = np.dtype({"names": [field.name for field in cloud.fields],
                               "formats": [_NUMBERS[field.datatype] for field in cloud.fields],
                               "offsets": [field.offset for field in cloud.fields], "itemsize": cloud.point_step})
            self.array = cloud.data.view(layout)
        except (KeyError, TypeError, ValueError) as error:
            raise MpmError(f"a cloud's data are not of the fields that it names: {error}") from error
        self.fields = layout.names

    def __len__(self):
        return len(self.array)

    def __getitem__(self, field):
        try:
            return self.array[field]
        except ValueError:
            raise KeyError(f"there is no field '{field}'; there are {', '.join(self.fields)}; particle_fields or the "
                           "scene's output.particle_fields choose") from None

    @property
    def positions(self):
        x = self.array["x"]
        return np.lib.stride_tricks.as_strided(x, (len(x), 3), (self.array.itemsize, x.itemsize), writeable=False)
