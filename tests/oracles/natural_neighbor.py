"""Writes natural_neighbor.json: Sibson's weights by three other ways. Run: pip install numpy==2.4.6 scipy==1.17.1 metpy==1.7.1;
python natural_neighbor.py

"metpy": values by metpy.interpolate.natural_neighbor_to_points, an implementation by other people on SciPy's triangulation.
"voronoi": weights from areas of cells of scipy.spatial.Voronoi, made without and with the query; far guards bound the outer cells.
"exact": weights and gradients in rational numbers of the doubles given, so right to the last digit: cells of the points clipped half-plane
by half-plane, without and with the query; the gradient is a central difference of step 1e-30. Grids, needles, crowds, and
queries close to the hull's boundary or to a point, where the others lose digits or fail.
"""

import json
import pathlib
from fractions import Fraction

import numpy as np
from metpy.interpolate import natural_neighbor_to_points
from scipy.spatial import ConvexHull, Voronoi

random = np.random.default_rng(19811118)


def some(count):
    return random.uniform(-1, 1, (count, 2)).round(4)


def inside(points, count, spread=0.5):
    """Convex combinations of the points."""
    return (random.dirichlet(np.full(len(points), spread), count) @ points).round(4)


# --- MetPy ---


def metpy_case(count):
    points, values = some(count), random.normal(size=count).round(4)
    queries = inside(points, 12, 0.3)
    found = natural_neighbor_to_points(points, values, queries)
    assert np.isfinite(found).all()
    return {"source": "metpy", "points": points, "values": values, "queries": queries, "expected": found}


# --- areas of Voronoi cells, without and with the query ---

GUARD = 60.0


def cell_areas(points):
    guards = GUARD * np.array([[np.cos(t), np.sin(t)] for t in 0.1 + np.arange(12) * np.pi / 6])
    diagram = Voronoi(np.vstack([points, guards]))
    corners = [diagram.vertices[diagram.regions[diagram.point_region[i]]] for i in range(len(points))]
    return np.array([ConvexHull(c).volume for c in corners]), corners[-1]


def voronoi_case(count):
    points = some(count)
    before, _ = cell_areas(points)
    queries, weights = [], []
    for query in inside(points, 100, 0.3):
        after, cell = cell_areas(np.vstack([points, query]))
        if np.linalg.norm(cell - query, axis=1).max() > GUARD / 4:
            continue  # the guards would take a part
        taken = before - after[:-1]
        queries.append(query)
        weights.append(np.where(taken > 1e-9 * after[-1], taken, 0) / after[-1])
        if len(queries) == 8:
            break
    return {"source": "voronoi", "points": points, "values": [], "queries": queries, "weights": weights}


# --- rational numbers ---


def clip(polygon, a, b, c):
    """What of the polygon has a x + b y <= c."""
    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        at_p, at_q = a * p[0] + b * p[1] - c, a * q[0] + b * q[1] - c
        if at_p <= 0:
            kept.append(p)
        if at_p * at_q < 0:
            t = at_p / (at_p - at_q)
            kept.append((p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])))
    return kept


def nearer(polygon, p, q):
    """What of the polygon is nearer to p than to q."""
    return clip(polygon, q[0] - p[0], q[1] - p[1], (q[0] ** 2 + q[1] ** 2 - p[0] ** 2 - p[1] ** 2) / 2)


def area(polygon):
    return sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(polygon, polygon[1:] + polygon[:1])) / 2


def exact_weights(points, query):
    far = Fraction(10) ** 30
    taken = []
    for p in points:
        cell = [(-far, -far), (far, -far), (far, far), (-far, far)]
        for other in points:
            if other != p:
                cell = nearer(cell, p, other)
        taken.append(area(cell) - area(nearer(cell, p, query)))
    assert sum(taken) < far, "the query is not inside the hull"
    return [t / sum(taken) for t in taken]


def exact_case(name, points, queries):
    rational = [tuple(Fraction(float(c)) for c in p) for p in points]
    values = random.normal(size=len(points)).round(4)
    step = Fraction(1, 10**30)
    all_weights, gradients = [], []
    for query in queries:
        x = [Fraction(float(c)) for c in query]
        all_weights.append([float(w) for w in exact_weights(rational, x)])
        for axis in range(2):
            ahead, behind = list(x), list(x)
            ahead[axis] += step
            behind[axis] -= step
            slopes = [u - v for u, v in zip(exact_weights(rational, ahead), exact_weights(rational, behind))]
            gradients.append(float(sum(s * Fraction(float(v)) for s, v in zip(slopes, values)) / (2 * step)))
    case = {"source": "exact", "name": name, "points": points, "values": values, "queries": queries}
    return {**case, "weights": all_weights, "gradients": gradients}


def exact_cases():
    grid = np.array([[i, j] for i in range(4) for j in range(4)], float)
    turn = np.array([[0.8, -0.6], [0.6, 0.8]])
    circle = np.array([[3, 4], [4, 3], [-3, 4], [5, 0], [0, -5], [-4, -3], [3, -4], [-5, 0]], float)
    scattered = some(12)
    needle = some(8) * [1, 1e-6] @ turn  # along an axis, it would be evened out
    crowd = np.vstack([some(6), np.round([0.2, 0.1] + 1e-4 * some(5), 8)])
    yield exact_case("grid", grid, [[1.5, 1.5], [0.25, 0.5], [1.7, 2.2], [1.0, 1.25], [2.9, 2.95], [1.0001, 1.9999]])
    yield exact_case("turned grid, far from the origin", grid @ turn + 1e4, inside(grid, 5, 0.1) @ turn + 1e4)
    yield exact_case("circle", circle, [[0, 0], [1e-7, 0], [1, 2], [4.9, 0.2], [3.5, 3.48]])
    yield exact_case("scattered", scattered, inside(scattered, 6))
    a, b = scattered[ConvexHull(scattered).vertices[:2]]
    inward = np.array([a[1] - b[1], b[0] - a[0]])
    heights = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10]
    yield exact_case("close to the boundary", scattered, [0.37 * b + 0.63 * a + h * inward for h in heights])
    yield exact_case("close to a point", grid, [[1 + 0.6 * h, 2 + 0.8 * h] for h in heights])
    yield exact_case("needle", needle, random.dirichlet(np.full(8, 0.5), 5) @ needle)
    yield exact_case("crowd", crowd, [*inside(crowd, 3), *(random.dirichlet(np.ones(5), 3) @ crowd[6:])])


def plain(value):
    """Numbers as short as they can be."""
    return [0 if v == 0 else v for v in np.asarray(value, float).ravel().tolist()]


cases = [*(metpy_case(n) for n in (5, 12, 40, 150)), *(voronoi_case(n) for n in (5, 10, 25, 60)), *exact_cases()]
lines = [json.dumps({k: v if isinstance(v, str) else plain(v) for k, v in case.items()}) for case in cases]
pathlib.Path(__file__).with_suffix(".json").write_text("[\n" + ",\n".join(lines) + "\n]\n")
