"""Writes discrete_green.json: the course's matrices in exact fractions, and SciPy's splines. Run: pip install numpy==2.4.6 scipy==1.17.1;
python discrete_green.py

`grids`: D row by row as words have it, the equations of eq. (4) with their Lagrange multipliers solved exactly, and Green's matrix as the
corner of the exact inverse of the bordered matrix. What is left is the solver's own rounding: 1e-9 of the largest number is generous for
grids this small.
`splines`: the natural cubic spline (scipy.interpolate.CubicSpline) through samples `step` apart, which second differences approach
like 1/step².
"""

import json
import pathlib
from fractions import Fraction
from math import comb

import numpy as np
from scipy.interpolate import CubicSpline

random = np.random.default_rng(20140728)
FREE, DIRICHLET, NEUMANN, PERIODIC = range(4)


def difference(size, order, boundary):
    """Rows of D by what a sample beyond the ends is said to be; a difference of odd order lies between two samples."""
    stencil = [(-1) ** (order - k) * comb(order, k) for k in range(order + 1)]
    if boundary == FREE:
        starts = range(size - order)
    elif boundary == PERIODIC:
        starts = [i - order // 2 for i in range(size)]
    elif order % 2 == 0:
        starts = range(-1, size - 1)
    else:
        beyond = 1 if boundary == DIRICHLET else 0  # gaps at the ends count, or are flat
        starts = range(-(order // 2) - beyond, size - 1 - order // 2 + beyond)
    rows = []
    for start in starts:
        row = [0] * size
        for k, factor in enumerate(stencil):
            i = start + k
            if boundary == PERIODIC:
                i %= size
            if boundary == NEUMANN:  # mirrored in the ends
                i = -1 - i if i < 0 else 2 * size - 1 - i if i >= size else i
            if boundary == DIRICHLET and order == 3 and (i == -2 or i == size + 1):  # odd about the zero one beyond the end
                i, factor = (0 if i == -2 else size - 1), -factor
            if 0 <= i < size:
                row[i] += factor
        rows.append(row)
    return rows


def solve(matrix, right):
    """Gauss–Jordan in fractions; `right` is a list of rows."""
    size = len(matrix)
    rows = [list(map(Fraction, a)) + list(map(Fraction, b)) for a, b in zip(matrix, right)]
    for k in range(size):
        pivot = next(i for i in range(k, size) if rows[i][k] != 0)
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(size):
            if i != k and rows[i][k] != 0:
                factor = rows[i][k]
                rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k])]
    return [row[size:] for row in rows]


def bordered(square, columns):
    """[A B; Bᵀ 0] with B given by columns."""
    top = [row + [column[i] for column in columns] for i, row in enumerate(square)]
    return top + [column + [0] * len(columns) for column in columns]


def grid(size, order, boundary, samples):
    d = difference(size, order, boundary)
    square = [[sum(row[i] * row[j] for row in d) for j in range(size)] for i in range(size)]
    nullity = {FREE: order, DIRICHLET: 0, NEUMANN: 1, PERIODIC: 1}[boundary]
    null_space = [[i**power for i in range(size)] for power in range(nullity)]
    identity = [[int(i == j) for j in range(size)] for i in range(size + nullity)]
    green = solve(bordered(square, null_space), identity)[:size]
    values = random.normal(size=len(samples)).round(4).tolist()
    selection = [[int(i == sample) for i in range(size)] for sample in samples]
    right = [[0]] * size + [[Fraction(value)] for value in values]
    curve = [row[0] for row in solve(bordered(square, selection), right)[:size]]
    return {
        "size": size,
        "order": order,
        "boundary": boundary,
        "samples": samples,
        "values": values,
        "operator": [x for row in d for x in row],
        "green": [float(x) for row in green for x in row] if size < 12 else [],
        "curve": [float(x) for x in curve],
    }


def spline(step):
    values = [0.3, 1.2, -0.7, 0.4, 0.9]
    at = np.arange(5) * step
    curve = CubicSpline(at, values, bc_type="natural")(np.arange(at[-1] + 1))
    every = max(1, step // 8)
    return {"step": step, "values": values, "every": every, "curve": curve[::every].tolist()}


grids = [
    grid(size, order, boundary, samples)
    for boundary in range(4)
    for order in (1, 2, 3)
    for size, samples in [(9, [1, 4, 6, 8]), (40, [33, 5, 17, 18])]
]
text = json.dumps({"grids": "GRIDS", "splines": [spline(step) for step in (4, 8, 16, 32, 64)]})
lines = "[\n" + ",\n".join(json.dumps(entry) for entry in grids) + "\n]"
pathlib.Path(__file__).with_suffix(".json").write_text(text.replace('"GRIDS"', lines) + "\n")
