"""Writes shepard.json: Shepard's formula taken literally, with 50 digits. Run: pip install numpy==2.4.6 mpmath==1.3.0; python shepard.py

Values are the quotient of sums; gradients are central differences of it, which 50 digits make exact. Each is one rounding away from
the truth, so 1e-12 of the largest value (or gradient) leaves room for the solver's own rounding only.
"""

import json
import pathlib

import mpmath as mp
import numpy as np

mp.mp.dps = 50
random = np.random.default_rng(19681968)


def textbook(points, values, query, power, epsilon):
    weights = [(mp.sqrt(sum((a - b) ** 2 for a, b in zip(query, point))) + epsilon) ** -power for point in points]
    return [sum(w * row[j] for w, row in zip(weights, values)) / sum(weights) for j in range(len(values[0]))]


def exact(rows):
    return [[mp.mpf(float(x)) for x in row] for row in rows]


def case(dimension, count, outputs, power, epsilon=0.0, scale=1.0, offset=0.0):
    points = (random.uniform(-1, 1, (count, dimension)).round(4) + offset) * scale
    queries = (random.uniform(-1.5, 1.5, (5, dimension)).round(4) + offset) * scale
    queries[0] = points[0] + 1e-3 * scale  # close to a point
    queries[1] = 40 * scale  # far away
    values = random.normal(size=(count, outputs)).round(4)
    p, e, f, h = exact(points), mp.mpf(epsilon), exact(values), mp.mpf(10) ** -18 * scale
    expected, gradients = [], []
    for query in exact(queries):
        expected += textbook(p, f, query, mp.mpf(power), e)
        steps = []
        for axis in range(dimension):
            ends = [[x + sign * h * (a == axis) for a, x in enumerate(query)] for sign in (1, -1)]
            after, before = (textbook(p, f, end, mp.mpf(power), e) for end in ends)
            steps.append([(a - b) / (2 * h) for a, b in zip(after, before)])
        gradients += [steps[axis][j] for j in range(outputs) for axis in range(dimension)]
    return {
        "dimension": dimension,
        "outputs": outputs,
        "power": power,
        "epsilon": epsilon,
        "points": points.ravel().tolist(),
        "values": values.ravel().tolist(),
        "queries": queries.ravel().tolist(),
        "expected": [float(x) for x in expected],
        "gradients": [float(x) for x in gradients],
    }


cases = [
    case(dimension, count, 1 + dimension % 2, power, epsilon)
    for dimension, count in [(1, 7), (2, 15), (3, 12), (4, 9)]
    for power in [0.5, 1.0, 2.0, 3.5, 12.0]
    for epsilon in [0.0, 0.05]
]
cases += [
    case(2, 12, 2, 2.0, scale=2.0**900),  # squares of distances overflow
    case(2, 12, 2, 3.0, scale=2.0**-900),  # and vanish
    case(2, 12, 1, 2.0, offset=1000.0),
    case(3, 12, 1, 60.0),
]
text = "[\n" + ",\n".join(json.dumps(entry) for entry in cases) + "\n]\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
