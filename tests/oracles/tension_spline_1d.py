"""Writes tension_spline_1d.json: splines in tension with zero-slope ends.

Run: pip install numpy==2.4.6 scipy==1.17.1; python tension_spline_1d.py

beta = 0: scipy.interpolate.CubicSpline with clamped ends. beta > 0: the functional alpha int f''^2 + beta int f'^2 is minimized
DIRECTLY over cubic Hermite finite elements, with the data at nodes and the end slopes held at 0: no formula of tension splines is
used. The error at nodes falls as h^4 (the script checks that); Richardson extrapolation of two refinements leaves what "accuracy"
says, estimated by the change from extrapolating twice. Elements have lengths that are powers of two, so that their matrices are
exact, and solutions are refined with residuals in extended precision: rounding stays below 1e-12.
"""

import json
import pathlib

import numpy as np
import scipy.sparse as sparse
from scipy.interpolate import CubicSpline
from scipy.sparse.linalg import splu

# int of products of derivatives of the shape functions (value, slope) at both ends of an element of length h, times powers of h and
# UNIT: integers.
UNIT = 420
BENDING = 420 * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
SLOPE = 14 * np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]])
MASS = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])


def hermite_matrices(x):
    """Bending, slope and mass matrix over nodes x, times UNIT; unknowns f0, f0', f1, f1' ..."""
    h = np.diff(x)
    scale = np.stack([np.ones_like(h), h, np.ones_like(h), h], axis=1)
    rows = 2 * np.arange(len(h))[:, None] + np.arange(4)
    row, column = np.repeat(rows, 4, axis=1).ravel(), np.tile(rows, (1, 4)).ravel()
    size = (2 * len(x),) * 2

    def assemble(local, power):
        entries = h[:, None, None] ** power * scale[:, :, None] * scale[:, None, :] * local
        return sparse.csr_matrix((entries.ravel(), (row, column)), shape=size)

    return assemble(BENDING, -3.0), assemble(SLOPE, -1.0), assemble(MASS, 1.0)


def minimum(matrix, right, fixed=(), values=()):
    """argmin u^T matrix u / 2 - right^T u with u[fixed] = values."""
    u = np.zeros(matrix.shape[0], np.longdouble)
    fixed = np.asarray(fixed, int)
    u[fixed] = values
    free = np.setdiff1d(np.arange(len(u)), fixed)
    rows = matrix.tocsr()[free]
    scale = 1 / np.sqrt(matrix.diagonal()[free])
    scaled = (sparse.diags_array(scale) @ rows[:, free] @ sparse.diags_array(scale)).tocsc()
    factors = splu(scaled, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0, options={"SymmetricMode": True})
    rows = rows.astype(np.longdouble)
    for _ in range(6):
        residual = right[free] - rows @ u
        u[free] += scale * factors.solve((scale * residual).astype(float))
    return u.astype(float)


def refined(x, parts):
    """Every interval of x in equal parts."""
    return np.append((x[:-1, None] + np.diff(x)[:, None] * np.arange(parts) / parts).ravel(), x[-1])


def minimize(nodes, places, values, alpha, beta, parts):
    x = refined(nodes, parts)
    bending, slope, _ = hermite_matrices(x)
    at = 2 * parts * np.searchsorted(nodes, places)
    fixed = np.concatenate([at, [1, 2 * len(x) - 1]])
    u = minimum(alpha * bending + beta * slope, np.zeros(2 * len(x)), fixed, np.append(values, [0, 0]))
    return u[:: 2 * parts], u[1 :: 2 * parts]


def extrapolated(solve, parts):
    """solve(parts) at h, h/2, h/4: extrapolated in h^4 and h^6; the observed order; what the last extrapolation changed."""
    coarse, middle, fine = (np.array(solve(parts * k)) for k in (1, 2, 4))
    ratio = np.abs(coarse - middle).max() / np.abs(middle - fine).max()
    first, second = middle + (middle - coarse) / 15, fine + (fine - middle) / 15
    best = second + (second - first) / 63
    return best, np.log2(ratio), np.abs(best - second).max()


def main():
    random = np.random.default_rng(20140728)
    entries = []
    for count, alpha, beta in [
        (2, 1, 0),
        (5, 1, 0),
        (12, 3, 0),
        (2, 1, 4),
        (3, 1, 1),
        (6, 2, 10),
        (6, 1, 100),
        (10, 1, 1e3),
        (9, 0.5, 0.01),
    ]:
        nodes = np.sort(random.choice(np.arange(40), 3 * count, replace=False)) / 8
        places = (
            np.sort(np.append(random.choice(nodes[1:-1], count - 2, replace=False), nodes[[0, -1]]))
            if count > 2
            else nodes[[0, -1]]
        )
        values = random.normal(size=count).round(4)
        if beta == 0:
            spline = CubicSpline(places, values, bc_type="clamped")
            expected, slopes, accuracy = spline(nodes), spline(nodes, 1), 1e-13
        else:
            step = 8 / int(2 ** np.ceil(np.log2(1 + np.sqrt(beta / alpha)))) / 32
            grid = np.union1d(nodes, np.arange(nodes[0], nodes[-1], step))
            (expected, slopes), order, accuracy = extrapolated(lambda parts: minimize(grid, places, values, alpha, beta, parts), 1)
            expected, slopes = expected[np.isin(grid, nodes)], slopes[np.isin(grid, nodes)]
            print(f"alpha {alpha} beta {beta}: order {order:.2f}, accuracy {accuracy:.1e}")
            assert order > 3.5
        entries.append(
            {
                "alpha": alpha,
                "beta": beta,
                "points": places.tolist(),
                "values": values.tolist(),
                "queries": nodes.tolist(),
                "expected": expected.round(15).tolist(),
                "slopes": slopes.round(14).tolist(),
                "accuracy": float(f"{accuracy:.1e}"),
            }
        )
    text = "[\n" + ",\n".join(json.dumps(entry) for entry in entries) + "\n]\n"
    pathlib.Path(__file__).with_suffix(".json").write_text(text)


if __name__ == "__main__":
    main()
