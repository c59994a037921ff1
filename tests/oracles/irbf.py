"""Writes irbf.json: the deformation of paper 001 computed directly from its equations by numpy.

A second implementation that shares nothing with the solver: it stacks the appendix's whole matrix Z (with the slips of the transcript
mended: no translation in an edge difference, sqrt(w) on every edge row, sqrt(lambda) on the coefficients), solves it by least squares
instead of normal equations, and iterates local and global steps to convergence from the rest shape. The shape is a convex box, where the
interior distance is the Euclidean one.

    python3 -m pip install numpy==2.4.6 && python3 tests/oracles/irbf.py
"""

import json
import pathlib

import numpy as np

SIZE = np.array([4.0, 1.0, 1.2])
CELLS = (12, 3, 4)
CENTERS, SPACING = 24, 0.2
RELATIVE_WIDTH, SMOOTHNESS, ANCHOR_WEIGHT, EDGE_EXPONENT = 2.0, 1e-4, 100.0, -1.0


def box():
    """The divided surface of the box, outward-oriented."""
    numbers, points, triangles = {}, [], []

    def vertex(key):
        if key not in numbers:
            numbers[key] = len(points)
            points.append([SIZE[a] * key[a] / CELLS[a] for a in range(3)])
        return numbers[key]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for high in (0, 1):
            for i in range(CELLS[u]):
                for j in range(CELLS[v]):
                    quad = []
                    for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        key = [0, 0, 0]
                        key[axis], key[u], key[v] = CELLS[axis] * high, i + du, j + dv
                        quad.append(vertex(tuple(key)))
                    a, b, c, d = quad if high else quad[::-1]
                    triangles += [[a, b, c], [a, c, d]]
    return np.array(points), np.array(triangles)


def farthest_points(points, count):
    chosen = [0]
    nearest = np.linalg.norm(points - points[0], axis=1)
    while len(chosen) < count:
        chosen.append(int(np.argmax(nearest)))
        nearest = np.minimum(nearest, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return chosen


def closest_rotation(covariance):
    u, _, vt = np.linalg.svd(covariance)
    return u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt


positions, triangles = box()
low, high = positions.min(axis=0), positions.max(axis=0)
middle, diagonal = (low + high) / 2, np.linalg.norm(high - low)
solver = (positions - middle) / diagonal

centers = farthest_points(solver, CENTERS)
places = solver[centers]
between = np.linalg.norm(places[:, None] - places[None], axis=2) + np.diag([np.inf] * CENTERS)
h = RELATIVE_WIDTH * between.min(axis=1).mean()


def phi(points):
    """Eqs. (2) and (3): normalized inverse multiquadrics."""
    values = 1 / np.sqrt(np.linalg.norm(points[:, None] - places[None], axis=2) ** 2 + h**2)
    return values / values.sum(axis=1, keepdims=True)


spheres = np.array([[(x - middle[0]) / diagonal, 0, 0, 0.45 / diagonal] for x in (0.6, 1.6, 2.4, 3.4)])
edges, rows = [], []
for *center, radius in spheres:
    for axis in range(3):
        offset = np.zeros(3)
        offset[axis] = radius
        ends = np.array([center - offset, center + offset])
        edge = ends[1] - ends[0]
        root = np.linalg.norm(edge) ** (EDGE_EXPONENT / 2)
        edges.append(root * edge)
        difference = phi(ends)
        rows.append(np.concatenate([root * edge, [0], root * (difference[1] - difference[0])]))
edges, rows = np.array(edges), np.array(rows)

corners = [v for v, p in enumerate(positions) if all(min(abs(p[a]), abs(p[a] - SIZE[a])) < 1e-9 for a in range(3))]
rest = solver[corners]
targets = positions[corners].copy()
angle = 0.9
for k, p in enumerate(targets):
    if p[0] > 2:
        c, s = np.cos(angle), np.sin(angle)
        x, y = p[0] - 2, p[1] - 0.5
        targets[k] = [2 + c * x - s * y, 0.9 + s * x + c * y, p[2] + 0.1]
wanted = (targets - middle) / diagonal

anchors = ANCHOR_WEIGHT * np.hstack([rest, np.ones((len(rest), 1)), phi(rest)])
regularization = np.hstack([np.zeros((CENTERS, 4)), np.sqrt(SMOOTHNESS) * np.eye(CENTERS)])
z = np.vstack([rows, anchors, regularization])
inverse = np.linalg.pinv(z)
# From the rigid motion that fits the handles best, as a user would see it: any start in the same basin ends the same.
start = closest_rotation((wanted - wanted.mean(axis=0)).T @ (rest - rest.mean(axis=0)))
rotations = [start] * len(spheres)
for _ in range(20000):
    right = np.vstack([edges[3 * b : 3 * b + 3] @ m.T for b, m in enumerate(rotations)] + [ANCHOR_WEIGHT * wanted, np.zeros((CENTERS, 3))])
    solution = inverse @ right
    moved = rows @ solution
    rotations = [closest_rotation(moved[3 * b : 3 * b + 3].T @ edges[3 * b : 3 * b + 3]) for b in range(len(spheres))]
    target = np.vstack([edges[3 * b : 3 * b + 3] @ m.T for b, m in enumerate(rotations)])
energy = ((moved - target) ** 2).sum() + SMOOTHNESS * (solution[4:] ** 2).sum()
deformed = np.hstack([solver, np.ones((len(solver), 1)), phi(solver)]) @ solution * diagonal + middle

# The body as the library reads it: every voxel center of a grid inside the box, distances rounded down, so that the reader's "at
# least the Euclidean distance" restores them.
dimensions = [int(np.ceil(s / SPACING)) for s in SIZE]
spacing = SPACING / diagonal
origin = (low + SPACING / 2 - middle) / diagonal
grid = np.array([[i, j, k] for k in range(dimensions[2]) for j in range(dimensions[1]) for i in range(dimensions[0])])
voxels = origin + spacing * grid
distances = np.linalg.norm(places[:, None] - voxels[None], axis=2)
scale = distances.max() / 65535

result = {
    "positions": positions.ravel().round(9).tolist(),
    "triangles": triangles.ravel().tolist(),
    "normalization": {"center": middle.tolist(), "diagonal": diagonal},
    "grid": {"origin": origin.tolist(), "spacing": spacing, "dimensions": dimensions},
    "centers": centers,
    "spheres": spheres.ravel().tolist(),
    "distanceScale": scale,
    "options": {"relativeWidth": RELATIVE_WIDTH, "smoothness": SMOOTHNESS, "anchorWeight": ANCHOR_WEIGHT, "edgeExponent": EDGE_EXPONENT},
    "handles": corners,
    "targets": targets.ravel().round(9).tolist(),
    "energy": energy,
    "deformed": deformed.ravel().round(7).tolist(),
}
path = pathlib.Path(__file__).with_suffix(".json")
path.write_text(json.dumps(result, separators=(",", ":")) + "\n")
print(f"{path.name}: {len(positions)} vertices, {len(voxels)} voxels, energy {energy:.6g}, {path.stat().st_size} bytes")
