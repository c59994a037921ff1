"""Writes the mesh of the skinning weights' benchmark: python3 gingerbread.py VERTICES FILE. A made gingerbread man in the plane, a hexagonal lattice inside an
outline of round limbs, and six handles: head, middle, hands and feet.

The file is text: counts of vertices, dimension, simplices, corners, held vertices and handles; positions; simplices; (vertex, handle) of each
vertex held.
"""

import sys

import numpy as np
from scipy.spatial import Delaunay, cKDTree

HANDLES = np.array([[0, 0.8], [0, 0], [-0.75, 0.3], [0.75, 0.3], [-0.4, -0.95], [0.4, -0.95]])


def limb(p, a, b, radius):
    a, d = np.array(a), np.subtract(b, a)
    t = np.clip((p - a) @ d / (d @ d), 0, 1)
    return np.linalg.norm(p - a - t[:, None] * d, axis=1) - radius


def joined(a, b, width=0.1):
    t = np.clip(0.5 + (b - a) / (2 * width), 0, 1)
    return b * (1 - t) + a * t - width * t * (1 - t)


def outside(p):
    """About the distance to the outline, below 0 inside."""
    d = joined(limb(p, (0, -0.1), (0, 0.15), 0.3), np.linalg.norm(p - [0, 0.75], axis=1) - 0.32)
    for side in (-1, 1):
        d = joined(d, limb(p, (side * 0.15, 0.2), (side * 0.75, 0.3), 0.16))
        d = joined(d, limb(p, (side * 0.15, -0.3), (side * 0.4, -0.95), 0.18))
    return d


def mesh(spacing):
    x, y = np.meshgrid(np.arange(-1.2, 1.2, spacing), np.arange(-1.3, 1.3, spacing * np.sqrt(0.75)))
    x[1::2] += spacing / 2
    lattice = np.column_stack([x.ravel(), y.ravel()])
    fine = np.stack(np.meshgrid(np.linspace(-1.2, 1.2, 900), np.linspace(-1.3, 1.3, 900)), -1).reshape(-1, 2)
    border = fine[abs(outside(fine)) < 0.004]
    for _ in range(3):
        slope = [(outside(border + e) - outside(border - e)) / 2e-5 for e in ((1e-5, 0), (0, 1e-5))]
        border = border - outside(border)[:, None] * np.array(slope).T
    # Walk along the outline in steps of one spacing.
    tree, left, chosen, at = cKDTree(border), np.ones(len(border), bool), [], 0
    while True:
        chosen.append(at)
        left[tree.query_ball_point(border[at], 0.8 * spacing)] = False
        near = [k for k in tree.query_ball_point(border[at], 1.5 * spacing) if left[k]]
        if near:
            at = near[np.argmin(np.linalg.norm(border[near] - border[at], axis=1))]
        elif left.any():
            at = np.flatnonzero(left)[0]
        else:
            break
    points = np.vstack([lattice[outside(lattice) < -0.6 * spacing], border[chosen]])
    triangles = Delaunay(points).simplices
    triangles = triangles[outside(points[triangles].mean(axis=1)) < -0.05 * spacing]
    used, triangles = np.unique(triangles, return_inverse=True)
    return points[used], triangles.reshape(-1, 3)


low, high = 0.005, 0.3
for _ in range(30):
    points, triangles = mesh(np.sqrt(low * high))
    low, high = (np.sqrt(low * high), high) if len(points) > int(sys.argv[1]) else (low, np.sqrt(low * high))
    if abs(len(points) - int(sys.argv[1])) <= 3:
        break
held = [np.argmin(np.linalg.norm(points - handle, axis=1)) for handle in HANDLES]
with open(sys.argv[2], "w") as file:
    file.write(f"{len(points)} 2 {len(triangles)} 3 {len(held)} {len(held)}\n")
    np.savetxt(file, points, "%.17g")
    np.savetxt(file, triangles, "%d")
    np.savetxt(file, np.column_stack([held, np.arange(len(held))]), "%d")
