"""Writes rbf.json: what other people's code makes of scattered data. Run: pip install numpy==2.4.6 scipy==1.17.1; python rbf.py

Plain cases come from scipy.interpolate.RBFInterpolator (epsilon = 1/width; its signs of linear, thin plate and multiquadric differ
from ours, which does not change the interpolant). SciPy knows neither normalized kernels nor a width for each place: those
come from a textbook solve with numpy.linalg.
"""

import json
import pathlib

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial.distance import cdist

SCIPY_NAMES = ["linear", "cubic", "thin_plate_spline", "gaussian", "multiquadric", "inverse_multiquadric", "inverse_quadratic"]
LINEAR, CUBIC, THIN_PLATE, GAUSSIAN, MULTIQUADRIC, INVERSE_MULTIQUADRIC, INVERSE_QUADRIC = range(7)
TEXTBOOK = {
    GAUSSIAN: lambda s: np.exp(-(s**2)),
    MULTIQUADRIC: lambda s: np.sqrt(1 + s**2),
    INVERSE_MULTIQUADRIC: lambda s: 1 / np.sqrt(1 + s**2),
    INVERSE_QUADRIC: lambda s: 1 / (1 + s**2),
}
random = np.random.default_rng(20140728)


def textbook(points, values, queries, kernel, widths, degree, normalized):
    def rows(at):
        basis = TEXTBOOK[kernel](cdist(at, points) / widths)
        if kernel == MULTIQUADRIC:
            basis = basis * widths
        if normalized:
            basis = basis / basis.sum(axis=1, keepdims=True)
        tail = [np.ones((len(at), 1)), at][: degree + 1]
        return np.hstack([basis, *tail])

    block = rows(points)
    tail = block[:, len(points) :]
    system = np.vstack([block, np.hstack([tail.T, np.zeros((tail.shape[1], tail.shape[1]))])])
    coefficients = np.linalg.solve(system, np.concatenate([values, np.zeros(tail.shape[1])]))
    return rows(queries) @ coefficients


def case(kernel, dimension, count, degree, width=1.0, normalized=False, own_widths=False, offset=0.0):
    points = random.uniform(-1, 1, (count, dimension)) + offset
    queries = random.uniform(-1.5, 1.5, (6, dimension)) + offset
    points, queries = points.round(4), queries.round(4)
    values = random.normal(size=count).round(4)
    gaps = cdist(points, points) + np.diag(np.full(count, np.inf))
    widths = (width * gaps.min(axis=1)).round(4) if own_widths else np.full(count, width)
    if normalized or own_widths:
        expected = textbook(points, values, queries, kernel, widths, degree, normalized)
    else:
        expected = RBFInterpolator(points, values, kernel=SCIPY_NAMES[kernel], epsilon=1 / width, degree=degree)(queries)
    return {
        "kernel": kernel,
        "width": width,
        "degree": degree,
        "normalized": int(normalized),
        "dimension": dimension,
        "widths": widths.tolist() if own_widths else [],
        "points": points.ravel().tolist(),
        "values": values.tolist(),
        "queries": queries.ravel().tolist(),
        "expected": expected.tolist(),
    }


cases = [
    case(THIN_PLATE, 2, 16, 1),
    case(THIN_PLATE, 2, 9, 1, offset=100),
    case(CUBIC, 3, 12, 1),
    case(LINEAR, 1, 5, 0),
    case(LINEAR, 2, 40, 1),
    case(GAUSSIAN, 2, 10, -1, width=0.4),
    case(GAUSSIAN, 1, 6, 0, width=0.3),
    case(MULTIQUADRIC, 3, 15, 0, width=0.5),
    case(INVERSE_MULTIQUADRIC, 2, 12, -1, width=0.6),
    case(INVERSE_QUADRIC, 3, 10, 1, width=0.7),
    case(MULTIQUADRIC, 2, 18, 0, width=0.5, own_widths=True),
    case(INVERSE_MULTIQUADRIC, 2, 18, -1, normalized=True, own_widths=True),
    case(GAUSSIAN, 3, 8, -1, width=0.5, normalized=True),
]
text = "[\n" + ",\n".join(json.dumps(entry) for entry in cases) + "\n]\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
