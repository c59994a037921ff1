"""Writes rbf_fits.json: fits that SciPy's RBFInterpolator does not know, by numpy.linalg: weight decay (2014 course, eq. (3)), fewer centers
than points, Mahalanobis distances, and the kernels of compact support. Run: pip install numpy==2.4.6 scipy==1.17.1; python rbf_fits.py

The constrained least squares is solved through an orthonormal basis of the null space (scipy.linalg.null_space) and numpy.linalg.lstsq.
"""

import json
import pathlib

import numpy as np
from scipy.linalg import null_space
from scipy.spatial.distance import cdist

random = np.random.default_rng(51)


def wendland(k):
    def phi(s, dimension):
        l = dimension // 2 + k + 1
        inside = np.clip(1 - s, 0, None)
        return [
            inside**l,
            inside ** (l + 1) * ((l + 1) * s + 1),
            inside ** (l + 2) * ((l * l + 4 * l + 3) * s**2 + (3 * l + 6) * s + 3) / 3,
        ][k]

    return phi


def buhmann(s, _):
    with np.errstate(divide="ignore", invalid="ignore"):
        value = 6 * (2 * s**4 * np.log(s) - 7 / 2 * s**4 + 16 / 3 * s**3 - 2 * s**2 + 1 / 6)
    return np.where(s == 0, 1, np.where(s < 1, value, 0))


KERNELS = {
    "gaussian": lambda s, _: np.exp(-(s**2)),
    "multiquadric": lambda s, _: np.sqrt(1 + s**2),
    "inverse-multiquadric": lambda s, _: 1 / np.sqrt(1 + s**2),
    "wendland-c0": wendland(0),
    "wendland-c2": wendland(1),
    "wendland-c4": wendland(2),
    "buhmann": buhmann,
    "compact-inverse-multiquadric": lambda s, _: np.where(s < 4, 1 / np.sqrt(1 + s**2) - 1 / np.sqrt(17), 0),
    "cubic": lambda s, _: s**3,
}


def monomials(x, degree):
    d = x.shape[1]
    columns = [np.ones(len(x))] * (degree >= 0) + [x[:, i] for i in range(d)] * (degree >= 1)
    columns += [x[:, i] * x[:, j] for i in range(d) for j in range(i, d)] * (degree >= 2)
    return np.array(columns).T.reshape(len(x), len(columns))


def case(kernel, dimension, count, degree=-1, width=1.0, decay=0.0, centers=0, metric=False):
    points = random.uniform(-1, 1, (count, dimension)).round(4)
    queries = random.uniform(-1.2, 1.2, (5, dimension)).round(4)
    values = random.normal(size=(count, 1)).round(4)
    middle = random.uniform(-1, 1, (centers, dimension)).round(4) if centers else points
    root = random.normal(size=(dimension, dimension)).round(2)
    m = root @ root.T + np.eye(dimension) if metric else np.eye(dimension)
    factor = np.linalg.cholesky(m)
    phi = lambda a: KERNELS[kernel](cdist(a @ factor, middle @ factor) / width, dimension)
    tail = monomials(middle, degree)
    free = null_space(tail.T) if tail.shape[1] else np.eye(len(middle))
    design = np.hstack([phi(points) @ free, monomials(points, degree)])
    penalty = np.sqrt(decay) * np.hstack([np.eye(free.shape[1]), np.zeros((free.shape[1], tail.shape[1]))])
    solution = np.linalg.lstsq(np.vstack([design, penalty]), np.vstack([values, np.zeros((len(penalty), 1))]), rcond=None)[0]
    expected = np.hstack([phi(queries) @ free, monomials(queries, degree)]) @ solution
    if decay and not centers and degree < 0:  # eq. (3) as printed
        r = phi(points)
        printed = phi(queries) @ np.linalg.solve(r.T @ r + decay * np.eye(count), r.T @ values)
        assert np.allclose(printed, expected, rtol=1e-6, atol=1e-9)
    return {
        "options": {
            "dimension": dimension,
            "points": points.ravel().tolist(),
            "values": values.ravel().tolist(),
            "kernel": kernel,
            "degree": degree,
            "width": width,
            "weightDecay": decay,
            **({"centers": middle.ravel().tolist()} if centers else {}),
            **({"metric": m.ravel().tolist()} if metric else {}),
        },
        "queries": queries.ravel().tolist(),
        "expected": expected.ravel().tolist(),
    }


cases = [
    case("gaussian", 1, 10, width=0.3, decay=1e-3),
    case("gaussian", 2, 20, width=0.5, decay=1e-2),
    case("inverse-multiquadric", 3, 25, degree=1, width=0.6, decay=0.1),
    case("multiquadric", 2, 20, degree=0, width=0.5, decay=0.05),
    case("cubic", 2, 20, degree=1, decay=0.01),
    case("gaussian", 2, 40, width=0.6, centers=8),
    case("inverse-multiquadric", 3, 60, degree=1, width=0.7, centers=12),
    case("multiquadric", 1, 30, degree=2, width=0.4, centers=7),
    case("cubic", 2, 30, degree=1, centers=9, decay=0.02),
    case("gaussian", 2, 5, width=0.6, centers=8, decay=0.1),
    case("gaussian", 2, 15, width=0.7, metric=True),
    case("multiquadric", 3, 15, degree=1, width=0.7, metric=True),
    case("wendland-c0", 1, 9, width=0.8),
    case("wendland-c2", 2, 15, width=1.2),
    case("wendland-c4", 3, 15, width=1.5),
    case("wendland-c2", 5, 20, degree=1, width=2.5),
    case("buhmann", 2, 15, width=1.2),
    case("compact-inverse-multiquadric", 2, 15, degree=0, width=0.3),
]
pathlib.Path(__file__).with_suffix(".json").write_text("[\n" + ",\n".join(map(json.dumps, cases)) + "\n]\n")
