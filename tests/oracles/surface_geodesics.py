"""Writes surface_geodesics.json: exact distances along triangle meshes, by libigl. One case a line.
Run: pip install numpy==2.4.6 scipy==1.17.1 libigl==2.6.3; python tests/oracles/surface_geodesics.py
"""

import json
import pathlib

import igl
import numpy as np
from scipy.spatial import ConvexHull

random = np.random.default_rng(20090715)


def lumpy_sphere(count):
    """Scattered points on a sphere, joined by their hull, then moved in and out; uneven triangles."""
    points = random.normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    triangles = ConvexHull(points).simplices
    a, b, c = points[triangles].transpose(1, 0, 2)
    turned = np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return (points * (1 + 0.3 * np.sin(3 * points[:, [1]]) * np.cos(4 * points[:, [0]]))).round(5), triangles


def torus(rows, columns):
    u, v = np.meshgrid(np.arange(columns) / columns, np.arange(rows) / rows)
    u, v = (2 * np.pi * (x + random.uniform(-0.3, 0.3, x.shape) / n).ravel() for x, n in ((u, columns), (v, rows)))
    points = np.array([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)]).T.round(5)
    at = lambda i, j: i % rows * columns + j % columns
    quads = [(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)) for i in range(rows) for j in range(columns)]
    return points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


with open(pathlib.Path(__file__).with_suffix(".json"), "w") as out:
    lines = []
    for points, triangles in (lumpy_sphere(400), torus(14, 30)):
        sources = [0, len(points) // 2]
        none = np.array([], int)
        distances = [igl.exact_geodesic(points, triangles, np.array([s]), none, np.arange(len(points)), none) for s in sources]
        case = {
            "positions": points.ravel().tolist(),
            "triangles": triangles.ravel().tolist(),
            "sources": sources,
            "distances": np.concatenate(distances).round(6).tolist(),
        }
        lines.append(json.dumps(case))
    out.write("[\n" + ",\n".join(lines) + "\n]\n")
