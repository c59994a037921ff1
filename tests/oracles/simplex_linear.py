"""Writes simplex_linear.json: what other people's code makes of scattered data.
Run: pip install numpy==2.4.6 scipy==1.17.1 quadprog==0.1.14; python simplex_linear.py

Inside the hull of points in general position: scipy.interpolate.LinearNDInterpolator, whose NaN says "outside". Outside: the nearest
point of all faces of scipy.spatial.ConvexHull, tried one by one, and the linear interpolant of that face. Cospherical points: all that
lie on the circumsphere of the simplex that scipy.spatial.Delaunay finds, with the weights of least norm from quadprog.
"""

import itertools
import json
import pathlib

import numpy as np
import quadprog
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import ConvexHull, Delaunay

random = np.random.default_rng(20140728)


def nearest_on_hull(points, query):
    """Indices and weights of the face and of the point of it that is nearest."""
    best = (np.inf, None, None)
    faces = {
        tuple(sorted(face))
        for facet in ConvexHull(points).simplices
        for size in range(1, len(facet) + 1)
        for face in itertools.combinations(facet, size)
    }
    for face in sorted(faces):
        corners = points[list(face)]
        edges = (corners[1:] - corners[0]).T
        tail = np.linalg.lstsq(edges, query - corners[0], rcond=None)[0] if len(face) > 1 else np.zeros(0)
        weights = np.concatenate([[1 - tail.sum()], tail])
        distance = np.linalg.norm(weights @ corners - query)
        if weights.min() >= 0 and distance < best[0]:
            best = (distance, list(face), weights)
    return best[1], best[2]


def entry(points, values, queries, expected, inside):
    return {
        "dimension": points.shape[1],
        "points": points.ravel().tolist(),
        "values": values.tolist(),
        "queries": queries.ravel().tolist(),
        "expected": np.asarray(expected).tolist(),
        "inside": [int(yes) for yes in inside],
    }


def general(dimension, count, asked):
    points = random.uniform(-1, 1, (count, dimension)).round(4)
    values = random.normal(size=count).round(4)
    queries = (points.mean(axis=0) + random.uniform(-0.9, 0.9, (asked, dimension))).round(4)
    queries[: asked // 2] = [random.dirichlet(np.ones(dimension + 2)) @ random.permutation(points)[: dimension + 2] for _ in range(asked // 2)]
    queries = queries.round(4)
    expected = LinearNDInterpolator(points, values)(queries)
    inside = ~np.isnan(expected)
    for q in np.flatnonzero(~inside):
        face, weights = nearest_on_hull(points, queries[q])
        expected[q] = weights @ values[face]
    return entry(points, values, queries, expected, inside)


def cospherical(points, asked):
    points = np.asarray(points, float)
    values = random.normal(size=len(points)).round(4)
    queries = np.array([random.dirichlet(np.full(len(points), 0.5)) @ points for _ in range(asked)]).round(4)
    cells = Delaunay(points)
    expected = []
    for query, simplex in zip(queries, cells.find_simplex(queries, tol=1e-12)):
        assert simplex >= 0
        corners = points[cells.simplices[simplex]]
        center = np.linalg.solve(2 * (corners[1:] - corners[0]), (corners[1:] ** 2).sum(1) - (corners[0] ** 2).sum())
        radius = np.linalg.norm(corners[0] - center)
        cell = np.flatnonzero(abs(np.linalg.norm(points - center, axis=1) - radius) < 1e-9 * radius)
        equations = np.vstack([points[cell].T - query[:, None], np.ones(len(cell))])
        constraints = np.hstack([equations.T, np.eye(len(cell))])
        bounds = np.concatenate([np.zeros(points.shape[1]), [1], np.zeros(len(cell))])
        weights = quadprog.solve_qp(np.eye(len(cell)), np.zeros(len(cell)), constraints, bounds, points.shape[1] + 1)[0]
        expected.append(weights @ values[cell])
    return entry(points, values, queries, expected, [True] * asked)


def lattice(steps, *spacing):
    return np.array(list(itertools.product(range(steps), repeat=len(spacing)))) * np.array(spacing)


def on_sphere(squared, dimension):
    reach = range(-int(squared**0.5), int(squared**0.5) + 1)
    return [p for p in itertools.product(reach, repeat=dimension) if sum(x * x for x in p) == squared]


cases = [
    *(general(2, count, 16) for count in (6, 40, 400)),
    *(general(3, count, 16) for count in (6, 60, 400)),
    *(general(4, count, 14) for count in (8, 50, 200)),
    *(general(5, count, 12) for count in (9, 40, 120)),
    cospherical(lattice(5, 0.3, 0.5), 16),
    cospherical(lattice(3, 0.3, 0.5, 0.7), 16),
    cospherical(lattice(2, 1, 2, 3, 4, 5), 16),
    cospherical(on_sphere(65**2, 2), 16),  # 36 points of a circle
    cospherical(on_sphere(81, 3), 16),
    cospherical(np.vstack([np.eye(5), -np.eye(5)]), 16),
]
text = "[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
