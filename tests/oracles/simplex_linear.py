"""Writes simplex_linear.json: scipy.interpolate.LinearNDInterpolator, which triangulates by Qhull, in 2 to 5 dimensions, and outside of the
hull the value at its nearest point, which is found by scipy.optimize.nnls. Run: pip install numpy==2.4.6 scipy==1.17.1;
python simplex_linear.py

Random points are in general position, so that the simplex is unique and both sides take the same weights, to rounding.
"""

import json
import pathlib

import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.optimize import nnls

random = np.random.default_rng(41)


def nearest_in_hull(points, query):
    """min ‖Pᵀw − x‖ with w ≥ 0 and Σw = 1, the sum by a row that weighs heavily; polished on its support."""
    heavy = 1e4
    weights = nnls(np.vstack([points.T, heavy * np.ones(len(points))]), np.append(query, heavy))[0]
    active = points[weights > 1e-9]
    edges = active[1:] - active[0]
    along = np.linalg.lstsq(edges.T, query - active[0], rcond=None)[0] if len(edges) else np.zeros(0)
    return active[0] + along @ edges


def case(dimension, count):
    points = random.uniform(-1, 1, (count, dimension)).round(4)
    values = random.normal(size=(count, 2)).round(3)
    queries = random.uniform(-1.1, 1.1, (30, dimension)).round(4) * random.uniform(0.2, 1, (30, 1)).round(3)
    linear = LinearNDInterpolator(points, values)
    expected = linear(queries)
    outside = np.isnan(expected[:, 0])
    middle = points.mean(axis=0)
    for i in np.flatnonzero(outside):
        inside = middle + (nearest_in_hull(points, queries[i]) - middle) * (1 - 1e-12)  # Qhull's walls are sharp
        expected[i] = linear(inside)[0]
    return {
        "dimension": dimension,
        "points": points.ravel().tolist(),
        "values": values.ravel().tolist(),
        "queries": queries.ravel().tolist(),
        "outside": outside.tolist(),
        "expected": expected.ravel().tolist(),
    }


cases = [case(2, 6), case(2, 40), case(2, 400), case(3, 8), case(3, 60), case(3, 400), case(4, 12), case(4, 100), case(5, 10), case(5, 80)]
pathlib.Path(__file__).with_suffix(".json").write_text("[\n" + ",\n".join(map(json.dumps, cases)) + "\n]\n")
inside = sum(case["outside"].count(False) for case in cases)
print(inside, "inside,", sum(len(case["outside"]) for case in cases) - inside, "outside")
