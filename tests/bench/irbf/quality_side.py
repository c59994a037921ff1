"""libigl's side of the bent bar in the file that the first argument names (quality-side.mjs): ARAP of its tetrahedra from rest until it stands
still. Prints one JSON object: its measure, and ours taken again here by singular values.
"""

import json
import sys

import igl
import numpy as np

with open(sys.argv[1], "rb") as file:
    n, m, k, p = np.fromfile(file, np.int32, 4)
    rest = np.fromfile(file, np.float64, 3 * n).reshape(n, 3)
    targets = np.fromfile(file, np.float64, 3 * k).reshape(k, 3)
    poses = np.fromfile(file, np.float64, 3 * n * p).reshape(p, n, 3)
    tetrahedra = np.fromfile(file, np.int32, 4 * m).reshape(m, 4).astype(np.int64)
    corners = np.fromfile(file, np.int32, k)


def edges(points):
    return np.stack([points[tetrahedra[:, i]] - points[tetrahedra[:, 0]] for i in (1, 2, 3)], axis=2)


at_rest = edges(rest)
volumes = np.linalg.det(at_rest) / 6
inverse = np.linalg.inv(at_rest)


def measure(pose):
    """Paper 001, §5: A min ‖df − R‖², where the least singular value counts negative if df turns inside out."""
    differential = edges(pose) @ inverse
    turned = np.linalg.det(differential)
    values = np.linalg.svd(differential, compute_uv=False)
    values[:, 2] *= np.where(turned < 0, -1, 1)
    distortion = volumes * ((values - 1) ** 2).sum(axis=1)
    return {
        "volume": float((volumes * turned).sum() / volumes.sum()),
        "total": float(distortion.sum()),
        "max": float(distortion.max()),
        "flips": int((turned < 0).sum()),
    }


data = igl.ARAPData()
data.energy = igl.ARAPEnergyType.ARAP_ENERGY_TYPE_ELEMENTS
data.max_iter = 50
igl.arap_precomputation(rest, tetrahedra, 3, corners, data)
pose, iterations = rest.copy(), 0
while iterations < 1000:
    before = pose
    pose = igl.arap_solve(targets, data, pose)
    iterations += data.max_iter
    if abs(pose - before).max() < 1e-3:
        break
print(json.dumps({"iterations": iterations, "libigl": measure(pose), "ours": [measure(one) for one in poses]}))
