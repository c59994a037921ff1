"""Writes tension_spline.json: minimizers of eq. (2) of the 2014 course in 1D and 2D, found without any Green's function.

Run: pip install numpy==2.4.6 scipy==1.17.1; python tension_spline.py    (about two minutes)

The functional  sum (f - y)^2 / sigma + alpha int |Hessian f|^2 + beta int |grad f|^2 + gamma int f^2  is minimized DIRECTLY over
cubic Hermite finite elements, in 2D their tensor products (Bogner, Fox & Schmit 1965), on a domain that reaches so far that its
free boundary does not matter, with all points at nodes; sigma = 0 fixes the values there. Every grid is refined twice. In 1D the
difference falls as h^4; in 2D only as h^2, since f behaves as r^2 ln r at the points: the script checks both orders, extrapolates
(Richardson) and states as "accuracy" what the last extrapolation changed. SciPy's thin plate is a closer check of alpha alone.
"""

import json
import pathlib

import numpy as np
import scipy.sparse as sparse
from scipy.interpolate import RBFInterpolator
from tension_spline_1d import UNIT, extrapolated, hermite_matrices, minimum, refined


def minimize(energy, unit, at, values, sigma):
    right = np.zeros(energy.shape[0])
    if sigma == 0:
        return minimum(energy, right, at, values)
    right[at] = unit * values / sigma
    return minimum(energy + sparse.csr_matrix((np.full(len(at), unit / sigma), (at, at)), shape=energy.shape), right)


def outward(start, step, repeat, reach):
    """Nodes beyond start, until the reach: steps double after so many."""
    ends = np.cumsum(step * 2.0 ** (np.arange(60 * repeat) // repeat))
    return start + ends[: 1 + np.searchsorted(ends, reach)]


def line(nodes, places, values, alpha, beta, gamma, sigma, parts):
    x = refined(nodes, parts)
    bending, slope, mass = hermite_matrices(x)
    u = minimize(alpha * bending + beta * slope + gamma * mass, UNIT, 2 * parts * np.searchsorted(nodes, places), values, sigma)
    return u[:: 2 * parts], u[1 :: 2 * parts]


def plane(nodes, places, values, alpha, beta, gamma, sigma, parts):
    x = refined(nodes, parts)
    bending, slope, mass = hermite_matrices(x)
    energy = alpha * (sparse.kron(bending, mass) + 2 * sparse.kron(slope, slope) + sparse.kron(mass, bending))
    energy = energy + beta * (sparse.kron(slope, mass) + sparse.kron(mass, slope)) + gamma * sparse.kron(mass, mass)
    row, column = (2 * parts * np.searchsorted(nodes, c) for c in places.T)
    u = minimize(energy.tocsr(), UNIT**2, 2 * len(x) * row + column, values, sigma)
    return u.reshape(2 * len(x), -1)[:: 2 * parts, :: 2 * parts]


def entry(dimension, weights, sigma, places, values, queries, expected, accuracy):
    alpha, beta, gamma = weights
    return {
        "dimension": dimension,
        "alpha": alpha,
        "beta": beta,
        "gamma": gamma,
        "smoothing": sigma,
        "points": places.ravel().tolist(),
        "values": values.tolist(),
        "queries": queries.ravel().tolist(),
        "expected": expected.round(13).tolist(),
        "accuracy": float(f"{accuracy:.1e}"),
    }


# Real, equal and complex roots, gamma = 0, alpha alone; and the reach: 36 decay lengths, or none where f is linear outside.
LINES = [
    ((1, 5, 4), 0, 36),
    ((1, 2, 1), 0.5, 36),
    ((1, 0.5, 4), 0, 36),
    ((0.125, 0, 1), 1, 36),
    ((1, 4, 0), 0, 18),
    ((0.5, 1, 0), 0.2, 26),
    ((2, 0, 0), 0, 1),
    ((2, 0, 0), 0.3, 1),
]
# 16 decay lengths; without gamma f is constant or linear but for 1/distance, and the boundary does 1/reach^2. Rounding grows with
# the reach: alpha alone allows 60 and one refinement, and what half the reach and no refinement would change is its accuracy.
PLANES = [
    ((1, 5, 4), 0, 16),
    ((1, 2, 1), 0.1, 16),
    ((1, 0.5, 4), 0, 16),
    ((1, 0, 20), 0.05, 16),
    ((1, 4, 0), 0, 2e3),
    ((1, 0, 0), 0, 60),
    ((1, 0, 0), 0.02, 60),
]


def main():
    random = np.random.default_rng(20140728)
    entries = []
    for weights, sigma, reach in LINES:
        inner = np.arange(-4, 17) / 8
        places = np.sort(random.choice(inner[4:-3], 6, replace=False))
        values = random.normal(size=6).round(4)
        nodes = np.concatenate([-outward(0.5, 1 / 8, 12, reach)[::-1], inner, outward(2, 1 / 8, 12, reach)])
        (expected, _), order, accuracy = extrapolated(lambda parts: line(nodes, places, values, *weights, sigma, parts), 1)
        print(f"1D {weights} sigma {sigma}: order {order:.2f}, accuracy {accuracy:.1e}", flush=True)
        seen = np.abs(nodes) < 3
        assert order > 3.5 or accuracy < 1e-12  # cubics are exact
        entries.append(entry(1, weights, sigma, places, values, nodes[seen], expected[seen], accuracy))

    graded = np.array([0, 1 / 8, 1 / 4, 1 / 2, 3 / 4, 7 / 8])
    inner = np.append((np.arange(-1, 3)[:, None] + graded).ravel(), 3) / 2
    places = np.array([[0, 0], [1, 0.5], [0.5, 1], [1, 1], [0.5, 0]])
    for weights, sigma, reach in PLANES:
        values = random.normal(size=5).round(4)

        def solve(reach, parts):
            far = outward(1.5, 0.25, 3 if reach < 30 else 2, reach)
            nodes = np.concatenate([1 - far[::-1], inner, far])
            seen = np.abs(nodes - 0.5) <= 1.3
            return nodes[seen], plane(nodes, places, values, *weights, sigma, parts)[np.ix_(seen, seen)]

        (seen, coarse), (_, middle) = (solve(reach, parts) for parts in (1, 2))
        if weights[1] == weights[2] == 0:
            best = middle
            accuracy = np.abs(middle - coarse).max() + np.abs(middle - solve(reach / 2, 2)[1]).max()
            print(f"2D {weights} sigma {sigma}: accuracy {accuracy:.1e}", flush=True)
        else:
            fine = solve(reach, 4)[1]
            order = np.log2(np.abs(coarse - middle).max() / np.abs(middle - fine).max())
            first, best = middle + (middle - coarse) / 3, fine + (fine - middle) / 3
            accuracy = np.abs(first - best).max()
            print(f"2D {weights} sigma {sigma}: order {order:.2f}, accuracy {accuracy:.1e}", flush=True)
            assert 1.7 < order < 2.5
        queries = np.stack(np.meshgrid(seen, seen, indexing="ij"), axis=2).reshape(-1, 2)
        some = np.sort(random.choice(len(queries), 60, replace=False))
        entries.append(entry(2, weights, sigma, places, values, queries[some], best.ravel()[some], accuracy))
    for sigma in (0, 0.02):  # alpha alone is the thin plate, which SciPy knows: r^2 ln r is 8 pi alpha times the kernel
        points, queries = (random.uniform(-3, 3, (count, 2)).round(4) for count in (20, 30))
        values = random.normal(size=20).round(4)
        plate = RBFInterpolator(points, values, smoothing=8 * np.pi * 0.7 * sigma, kernel="thin_plate_spline")
        entries.append(entry(2, (0.7, 0, 0), sigma, points, values, queries, plate(queries), 1e-11))
    text = "[\n" + ",\n".join(json.dumps(entry) for entry in entries) + "\n]\n"
    pathlib.Path(__file__).with_suffix(".json").write_text(text)


if __name__ == "__main__":
    main()
