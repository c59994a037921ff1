"""libigl's side of the skinning weights' benchmark, on the mesh in the file that the first argument names (gingerbread.py says how): prints medians of
rounds in milliseconds, as many rounds as the second argument says, and energies ½ Σⱼ wⱼᵀ B wⱼ.

`bbw` is as the Python package calls it, with up to 100 active sets; `bbw 8` with as many as libigl's own tutorial. Energies are of rows
divided by their sums.
"""

import json
import statistics
import sys
import time

import igl
import numpy as np
import scipy.sparse as sparse

with open(sys.argv[1]) as file:
    n, d, m, corners, held, handles = map(int, file.readline().split())
    numbers = np.array(file.read().split(), float)
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
positions = np.hstack([numbers[: n * d].reshape(n, d), np.zeros((n, 3 - d))])
simplices = numbers[n * d : n * d + m * corners].reshape(m, corners).astype(np.int64)
vertices, owners = numbers[n * d + m * corners :].reshape(held, 2).astype(np.int64).T.copy()
one = np.eye(handles)[owners]


def operators():
    c = igl.cotmatrix(positions, simplices)
    mass = igl.massmatrix(positions, simplices, igl.MassMatrixType.MASSMATRIX_TYPE_DEFAULT)
    return (c.T @ sparse.diags(1 / mass.diagonal()) @ c).tocsr()


steps = {
    "operators": operators,
    "harmonic": lambda: igl.harmonic(positions, simplices, vertices, one, 1),
    "biharmonic": lambda: igl.harmonic(positions, simplices, vertices, one, 2),
    "bbw": lambda: igl.bbw(positions, simplices, vertices, one),
    "bbw 8": lambda: igl.bbw(positions, simplices, vertices, one, max_iter=8),
}
times, made = {name: [] for name in steps}, {}
for _ in range(rounds):
    for name, step in steps.items():
        start = time.perf_counter()
        made[name] = step()
        times[name].append(1000 * (time.perf_counter() - start))
energy = made["operators"]
result = {name: statistics.median(taken) for name, taken in times.items()}
for name in ("bbw", "bbw 8"):
    weights = made[name] / made[name].sum(axis=1, keepdims=True)
    result[f"{name} energy"] = float(np.sum(weights * (energy @ weights)) / 2)
    result[f"{name} rows off 1"] = float(abs(made[name].sum(axis=1) - 1).max())
print(json.dumps(result))
