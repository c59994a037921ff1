"""Writes heat_distance.json: geodesics in heat on voxels by NumPy and SciPy's sparse LU, and scikit-fmm's distances (fast marching, order 2)
from the same sources. One case a line.
Run: pip install numpy==2.4.6 scipy==1.17.1 scikit-fmm==2025.6.23; python tests/oracles/heat_distance.py

`heat` is the method that heat_distance.hpp describes, written with matrices: differences D between face neighbors, L = DᵀD, one operator for
gradients and its transpose for the divergence. `marched` starts from the sphere of radius 3.5 about the source, as tests/oracles/fast_marching.py
says; -1 within it. Voxels (i, j, k) of the domain in the order of i + nx (j + ny k).
"""

import json
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
import skfmm
from scipy.sparse.linalg import splu

TIME, BALL, DECAY = 0.2, 3.5, 4.0


def heat_distances(inside, source):
    cells = np.argwhere(inside.transpose(2, 1, 0))[:, ::-1]
    n = len(cells)
    number = np.full(np.array(inside.shape) + 2, -1)
    number[tuple((cells + 1).T)] = np.arange(n)
    neighbor = lambda axis, step: number[tuple((cells + 1 + step * np.eye(3, dtype=int)[axis]).T)]

    laplacian, missing, differences = sparse.csr_matrix((n, n)), np.zeros(n), []
    for axis in range(3):
        high = neighbor(axis, 1)
        low = np.flatnonzero(high >= 0)
        rows, ones = np.arange(len(low)), np.ones(len(low))
        pick = lambda columns: sparse.csr_matrix((ones, (rows, columns)), (len(low), n))
        differences.append((pick(high[low]) - pick(low), (pick(high[low]) + pick(low)) / 2))
        laplacian += differences[-1][0].T @ differences[-1][0]
        missing += (high < 0).astype(float) + (neighbor(axis, -1) < 0)

    away = cells - source
    distance = np.linalg.norm(away, axis=1)
    ball = distance <= max(BALL, distance.min() + 1)
    heat = np.where(ball, np.exp(-DECAY * (distance - distance.min())), 0)
    u = splu((sparse.eye(n) + TIME * (laplacian + 2 * sparse.diags(missing))).tocsc()).solve(heat)

    fall = np.zeros((n, 3))
    for axis in range(3):
        ratio = [np.where(neighbor(axis, step) >= 0, u[neighbor(axis, step)] / u, np.nan) for step in (-1, 1)]
        low = np.where(np.isnan(ratio[0]), 1 / ratio[1], ratio[0])
        high = np.where(np.isnan(ratio[1]), 1 / ratio[0], ratio[1])
        fall[:, axis] = low - high
    direction = np.where(ball[:, None], away, fall)
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    divergence = sum(d.T @ (mean @ direction[:, axis]) for axis, (d, mean) in enumerate(differences))
    phi = splu((laplacian + sparse.csr_matrix(([1.0], ([0], [0])), (n, n))).tocsc()).solve(divergence)
    phi += (distance - phi)[ball].mean()
    return np.where(ball, distance, np.maximum(phi, distance)), distance


i, j, k = np.meshgrid(np.arange(20), np.arange(20), np.arange(5), indexing="ij")
inside = (i < 9) | (j < 9)
lines = []
for source in ([4.2, 16.6, 2.3], [15.0, -0.6, 1.0], [8.4, 8.3, 4.6]):
    heat, straight = heat_distances(inside, np.array(source))
    phi = np.ma.MaskedArray(np.sqrt((i - source[0]) ** 2 + (j - source[1]) ** 2 + (k - source[2]) ** 2) - BALL, ~inside)
    marched = (skfmm.distance(phi, order=2) + BALL).filled(-1).transpose(2, 1, 0)[inside.transpose(2, 1, 0)]
    marched[straight <= BALL] = -1
    case = {"size": [20, 20, 5], "bend": 9, "source": source, "heat": heat.round(9).tolist(), "marched": marched.round(4).tolist()}
    lines.append(json.dumps(case))
Path(__file__).with_suffix(".json").write_text("[\n" + ",\n".join(lines) + "\n]\n")
