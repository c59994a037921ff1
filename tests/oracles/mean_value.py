"""Writes mean_value.json: mean value coordinates of points inside and outside closed triangle meshes, by other formulas than ours.
Run: pip install numpy==2.4.6; python tests/oracles/mean_value.py

`weights`: Ju, Schaefer & Warren's pseudo-code (2005, Fig. 4), in numpy. `one_side`: the same sums over the triangles that show the point
their inner side, or their outer side where those outweigh them. Before writing, both are held to what they mean: the integral over
directions of the surface's hat functions over distance, by recursive quadrature of each triangle.
"""

import json
import pathlib

import numpy as np

random = np.random.default_rng(20050731)


def corner_weights(x, p):
    """Ju et al.'s weights of a triangle's corners; p is 3 x 3."""
    d = np.linalg.norm(p - x, axis=1)
    u = (p - x) / d[:, None]
    length = [np.linalg.norm(u[(i + 1) % 3] - u[(i + 2) % 3]) for i in range(3)]
    theta = 2 * np.arcsin(np.array(length) / 2)
    h = theta.sum() / 2
    c = [2 * np.sin(h) * np.sin(h - theta[i]) / (np.sin(theta[(i + 1) % 3]) * np.sin(theta[(i + 2) % 3])) - 1 for i in range(3)]
    s = np.sign(np.linalg.det(u)) * np.sqrt(np.maximum(1 - np.array(c) ** 2, 0))
    if (abs(s) < 1e-9).any():
        return np.zeros(3)
    return np.array(
        [
            (theta[i] - c[(i + 1) % 3] * theta[(i + 2) % 3] - c[(i + 2) % 3] * theta[(i + 1) % 3])
            / (2 * d[i] * np.sin(theta[(i + 1) % 3]) * s[(i + 2) % 3])
            for i in range(3)
        ]
    )


def integral(x, p, depth=7):
    """The integral of the hat functions times (y - x).n / |y - x|^4 over a triangle, midpoints of 4^depth parts."""
    parts, hats = p[None], np.eye(3)[None]
    for _ in range(depth):
        split = lambda t: np.concatenate(
            [np.stack(q, 1) for q in ((t[:, 0], m(t, 0), m(t, 2)), (t[:, 1], m(t, 1), m(t, 0)), (t[:, 2], m(t, 2), m(t, 1)), (m(t, 0), m(t, 1), m(t, 2)))]
        )
        m = lambda t, k: (t[:, k] + t[:, (k + 1) % 3]) / 2
        parts, hats = split(parts), split(hats)
    y = parts.mean(1) - x
    normal = np.cross(p[1] - p[0], p[2] - p[0]) / 2 / len(parts)
    return (hats.mean(1) * (y @ normal / (y**2).sum(1) ** 2)[:, None]).sum(0)


def torus(rows, columns):
    u, v = np.meshgrid(np.arange(columns) / columns, np.arange(rows) / rows)
    u, v = (2 * np.pi * (x + random.uniform(-0.2, 0.2, x.shape) / n).ravel() for x, n in ((u, columns), (v, rows)))
    points = np.array([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)]).T.round(4)
    at = lambda i, j: i % rows * columns + j % columns
    quads = [(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)) for i in range(rows) for j in range(columns)]
    return points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def tetrahedron():
    return np.array([[0, 0, 0], [1, 0, 0], [0, 1.2, 0], [0.1, 0.2, 0.9]]), np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


cases = []
for (points, triangles), queries in (
    (tetrahedron(), [[0.2, 0.3, 0.2], [0.1, 0.1, 0.05], [1, 1, 1]]),
    (torus(5, 9), [[1.9, 0.2, 0.1], [-1.5, 1.3, -0.3], [0.1, -2.2, 0.5], [0.1, 0.2, 0], [4, 1, 2]]),
):
    for query in queries:
        x = np.array(query)
        front, back = np.zeros(len(points)), np.zeros(len(points))
        for t in triangles:
            w = corner_weights(x, points[t])
            exact = integral(x, points[t])
            assert abs(w - exact).max() < 2e-3 * abs(exact).max() + 1e-9, (w, exact)
            np.add.at(front if np.linalg.det(points[t] - x) > 0 else back, t, w)
        total = front + back
        side = front if front.sum() >= -back.sum() else back
        cases.append(
            {
                "positions": points.ravel().tolist(),
                "triangles": triangles.ravel().tolist(),
                "point": query,
                "weights": (total / total.sum()).tolist(),
                "one_side": (side / side.sum()).tolist(),
            }
        )

text = "[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
