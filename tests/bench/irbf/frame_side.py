"""libigl's side of a frame: ARAP (spokes and rims) of the mesh and handles in the file that the first argument names (frame-side.mjs). Prints
one JSON object. Second argument `converge`: iterations from rest until the energy is within 10% of the converged one. Otherwise a number of
iterations to time, from rest; what is factored once is left out.
"""

import json
import sys
import time

import igl
import numpy as np

with open(sys.argv[1], "rb") as file:
    n, m, k, _ = np.fromfile(file, np.int32, 4)
    rest = np.fromfile(file, np.float64, 3 * n).reshape(n, 3)
    targets = np.fromfile(file, np.float64, 3 * k).reshape(k, 3)
    triangles = np.fromfile(file, np.int32, 3 * m).reshape(m, 3).astype(np.int64)
    handles = np.fromfile(file, np.int32, k)

data = igl.ARAPData()
data.energy = igl.ARAPEnergyType.ARAP_ENERGY_TYPE_SPOKES_AND_RIMS
data.max_iter = 1
igl.arap_precomputation(rest, triangles, 3, handles, data)


def cotangent_energy():
    """Pose → energy: for every vertex, over the edges of its triangles, half the cotangent of the angle across, with the best rotation."""
    corner = [rest[triangles[:, i]] for i in range(3)]
    edges, weights = [], []
    for i in range(3):
        a, b = corner[(i + 1) % 3] - corner[i], corner[(i + 2) % 3] - corner[i]
        weights.append(0.5 * np.einsum("ij,ij->i", a, b) / np.linalg.norm(np.cross(a, b), axis=1))
        edges.append(triangles[:, [(i + 1) % 3, (i + 2) % 3]])
    first, second = np.concatenate(edges).T
    weight = np.concatenate(weights)
    # An edge of a triangle counts at each of the triangle's corners.
    at = np.concatenate([np.concatenate([triangles[:, i]] * 3) for i in range(3)])
    first, second, weight = np.tile(first, 3), np.tile(second, 3), np.tile(weight, 3)
    e = rest[second] - rest[first]
    order = np.argsort(at, kind="stable")
    starts = np.flatnonzero(np.r_[True, np.diff(at[order]) > 0])
    owner = at[order][starts]

    def energy(pose):
        d = pose[second] - pose[first]
        products = (weight[:, None, None] * d[:, :, None] * e[:, None, :])[order]
        s = np.add.reduceat(products, starts)
        u, values, vt = np.linalg.svd(s)
        values[:, 2] *= np.sign(np.linalg.det(u @ vt))
        squares = np.einsum("i,ij,ij->", weight, d, d) + np.einsum("i,ij,ij->", weight, e, e)
        assert len(owner) == n
        return float(squares - 2 * values.sum())

    return energy


if sys.argv[2] == "converge":
    energy = cotangent_energy()
    pose, energies = rest.copy(), []
    while len(energies) < 2000:
        pose = igl.arap_solve(targets, data, pose)
        energies.append(energy(pose))
        # Judged over fifty iterations: the steps of the last hundreds are small but many.
        if len(energies) > 50 and energies[-51] / energies[-1] < 1.002:
            break
    least = energies[-1]
    print(json.dumps({"iterations": next(i for i, e in enumerate(energies, 1) if e <= 1.1 * least), "run": len(energies), "energy": least}))
else:
    pose, taken = rest.copy(), []
    for _ in range(int(sys.argv[2])):
        start = time.perf_counter()
        pose = igl.arap_solve(targets, data, pose)
        taken.append(1000 * (time.perf_counter() - start))
    print(json.dumps({"iteration": min(taken)}))
