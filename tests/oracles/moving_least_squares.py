"""Writes moving_least_squares.json: a weighted fit by numpy.linalg.lstsq at every query, as the definition has it.
Run: pip install numpy==2.4.6 scipy==1.17.1; python moving_least_squares.py

The fits are centered at the query and have condition numbers below 1e6 (checked here), so two stable solvers agree to 1e-9 with room to
spare. Widths of 0 mean the solver's own choice, which is computed here from its description.
"""

import json
import pathlib

import numpy as np
from scipy.spatial.distance import cdist

random = np.random.default_rng(19811981)
INVERSE_DISTANCE, GAUSSIAN, WENDLAND = range(3)


def monomials(x, degree):
    columns = [np.ones(len(x))]
    if degree >= 1:
        columns += list(x.T)
    if degree >= 2:
        columns += [x[:, i] * x[:, j] for i in range(x.shape[1]) for j in range(i, x.shape[1])]
    return np.stack(columns, axis=1)


def weights(r, weight, power, epsilon, width, polynomials):
    if weight == INVERSE_DISTANCE:
        return (r.min() + epsilon) ** power / (r + epsilon) ** power
    if weight == GAUSSIAN:
        return np.exp(-((r / width) ** 2))
    wanted = min(len(r), 2 * polynomials)
    h = max(width, np.sort(r)[wanted - 1] / 0.8)
    return np.maximum(0, 1 - r / h) ** 4 * (4 * r / h + 1)


def textbook(points, values, query, degree, weight, power, epsilon, width):
    r = cdist(query[None], points)[0]
    offsets = points - query
    basis = monomials(offsets / np.median(r), degree)
    root = np.sqrt(weights(r, weight, power, epsilon, width, basis.shape[1]))
    coefficients, _, rank, singular = np.linalg.lstsq(root[:, None] * basis, root[:, None] * values, rcond=1e-13)
    assert rank == basis.shape[1] and singular[0] / singular[-1] < 1e6, singular
    return coefficients[0]


def case(dimension, count, degree, weight, power=4.0, epsilon=0.0, width=0.0, offset=0.0):
    points = random.uniform(-1, 1, (count, dimension)).round(4) + offset
    queries = random.uniform(-1.1, 1.1, (5, dimension)).round(4) + offset
    values = random.normal(size=(count, 1)).round(4)
    used = width
    if width == 0:
        gaps = cdist(points, points) + np.diag(np.full(count, np.inf))
        used = gaps.min(axis=1).mean() * (2 + degree) * (2 if weight == WENDLAND else 1)
    expected = [textbook(points, values, query, degree, weight, power, epsilon, used) for query in queries]
    return {
        "dimension": dimension,
        "degree": degree,
        "weight": weight,
        "power": power,
        "epsilon": epsilon,
        "width": width,
        "points": points.ravel().tolist(),
        "values": values.ravel().tolist(),
        "queries": queries.ravel().tolist(),
        "expected": np.ravel(expected).tolist(),
    }


cases = []
for dimension, count in [(1, 10), (2, 20), (3, 24), (4, 32)]:
    for degree in range(3):
        cases += [
            case(dimension, count, degree, INVERSE_DISTANCE),
            case(dimension, count, degree, INVERSE_DISTANCE, power=2.5),
            case(dimension, count, degree, INVERSE_DISTANCE, power=3.0, epsilon=0.2),
            case(dimension, count, degree, GAUSSIAN),
            case(dimension, count, degree, GAUSSIAN, width=1.2),
            case(dimension, count, degree, WENDLAND),
            case(dimension, count, degree, WENDLAND, width=0.25),  # widened almost everywhere
        ]
cases += [case(2, 20, 2, weight, offset=1000.0) for weight in range(3)]
text = "[\n" + ",\n".join(json.dumps(entry) for entry in cases) + "\n]\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
