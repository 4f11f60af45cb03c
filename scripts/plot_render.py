"""Spheres and triangles drawn with a depth buffer, in parallel projection: spheres and surfaces hide each other."""
import numpy as np

LIGHT = np.array([-0.45, 0.55, 0.70])  # direction of the light: right, up, towards the viewer


class Camera:
    """Looks from `towards` (world vector from the scene to the viewer), z up; lengths keep their size."""

    def __init__(self, towards):
        self.towards = np.asarray(towards, float) / np.linalg.norm(towards)
        self.right = np.cross([0.0, 0.0, 1.0], self.towards)
        self.right /= np.linalg.norm(self.right)
        self.up = np.cross(self.towards, self.right)

    def project(self, points):
        """Right, up and depth (larger is nearer) of world points [m]."""
        return np.asarray(points, float) @ np.column_stack([self.right, self.up, self.towards])


class Canvas:
    """A picture of the rectangle (left, right, bottom, top) [m] of the camera's plane."""

    def __init__(self, camera, extent, width):
        self.camera = camera
        self.extent = extent
        self.scale = width / (extent[1] - extent[0])
        self.width, self.height = width, int(np.ceil((extent[3] - extent[2]) * self.scale))
        self.image = np.ones((self.height * self.width, 3))
        self.depth = np.full(self.height * self.width, -np.inf)
        self._last = np.zeros(self.height * self.width, int)

    def _pixels(self, projected):
        column = np.rint((projected[:, 0] - self.extent[0]) * self.scale).astype(int)
        row = np.rint((self.extent[3] - projected[:, 1]) * self.scale).astype(int)
        return column, row

    def _put(self, column, row, depth, color):
        """Draws points in order of depth, farthest first: of those on one pixel the last one stays."""
        inside = (column >= 0) & (column < self.width) & (row >= 0) & (row < self.height)
        pixel, depth, color = (row * self.width + column)[inside], depth[inside], color[inside]
        self._last[pixel] = np.arange(len(pixel))
        nearest = self._last[pixel] == np.arange(len(pixel))
        pixel, depth, color = pixel[nearest], depth[nearest], color[nearest]
        visible = depth > self.depth[pixel]
        self.depth[pixel[visible]] = depth[visible]
        self.image[pixel[visible]] = color[visible]

    def spheres(self, centers, radius, colors):
        """Draws spheres of one radius [m], each in its own colour (rows of red, green, blue)."""
        projected = self.camera.project(centers)
        order = np.argsort(projected[:, 2])
        projected, colors = projected[order], colors[order]
        column, row = self._pixels(projected)
        size = max(radius * self.scale, 0.7)
        reach = int(size)
        for down in range(-reach, reach + 1):
            for right in range(-reach, reach + 1):
                x, y = right / size, -down / size
                if x * x + y * y > 1.0:
                    continue
                height = np.sqrt(1.0 - x * x - y * y)
                light = 0.62 + 0.42 * max(0.0, float(np.dot([x, y, height], LIGHT)))
                self._put(column + right, row + down, projected[:, 2] + radius * height, np.clip(colors * light, 0, 1))

    def triangles(self, vertices, faces, color):
        """Draws a closed surface in one colour, darker where it turns away from the light, with its sharp edges."""
        projected = self.camera.project(vertices)
        for face in faces:
            a, b, c = projected[face]
            normal = np.cross(b - a, c - a)
            size = np.linalg.norm(normal)
            if size == 0 or normal[2] <= 0:
                continue  # faces away from the viewer
            steps = int(np.ceil(1.5 * self.scale * max(np.linalg.norm((b - a)[:2]), np.linalg.norm((c - a)[:2])))) + 1
            s, t = (grid.ravel() for grid in np.meshgrid(np.linspace(0, 1, steps), np.linspace(0, 1, steps)))
            keep = s + t <= 1.0
            points = a + np.outer(s[keep], b - a) + np.outer(t[keep], c - a)
            light = 0.45 + 0.6 * max(0.0, float(np.dot(normal / size, LIGHT)))
            column, row = self._pixels(points)
            self._put(column, row, points[:, 2], np.tile(np.clip(np.array(color) * light, 0, 1), (len(points), 1)))
        for begin, end in sharp_edges(vertices, faces):
            a, b = self.camera.project([begin, end])
            steps = int(np.ceil(2 * self.scale * np.linalg.norm((b - a)[:2]))) + 2
            points = a + np.outer(np.linspace(0, 1, steps), b - a)
            column, row = self._pixels(points)
            before = 3.0 / self.scale  # drawn on top of the faces that meet here
            for right, down in ((0, 0), (1, 0), (0, 1), (1, 1)):
                self._put(column + right, row + down, points[:, 2] + before, np.full((steps, 3), 0.12))

    def line(self, begin, end, brightness):
        """Draws a thin grey line between two points: 0 is black, 1 is white."""
        a, b = self.camera.project([begin, end])
        steps = int(np.ceil(2 * self.scale * np.linalg.norm((b - a)[:2]))) + 2
        points = a + np.outer(np.linspace(0, 1, steps), b - a)
        column, row = self._pixels(points)
        self._put(column, row, points[:, 2], np.full((steps, 3), brightness))

    def picture(self):
        return self.image.reshape(self.height, self.width, 3)


def sharp_edges(vertices, faces, degrees=25.0):
    """Edges (pairs of points) between faces whose normals differ by more than an angle."""
    owners = {}
    normals = np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    for index, face in enumerate(faces):
        for i in range(3):
            owners.setdefault(tuple(sorted((face[i], face[(i + 1) % 3]))), []).append(index)
    limit = np.cos(np.radians(degrees))
    for (i, j), sides in owners.items():
        if len(sides) != 2 or np.dot(normals[sides[0]], normals[sides[1]]) < limit:
            yield vertices[i], vertices[j]
