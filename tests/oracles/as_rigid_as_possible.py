"""Writes as_rigid_as_possible.json: libigl's ARAP of a plane mesh, whose energy is per triangle. Run: pip install numpy==2.4.6 libigl==2.6.3;
python as_rigid_as_possible.py

libigl holds vertices at given places; so do handles that hold one vertex each way. Both alternate from the rest shape: after many rounds they
agree to what the rounds leave, 1e-5 of the extent.
"""

import json
import pathlib

import igl
import numpy as np

random = np.random.default_rng(20140807)


def grid(columns, rows):
    positions = np.array([[2 * i / columns, j / rows] for j in range(rows + 1) for i in range(columns + 1)])
    inner = (positions[:, 0] % 2 > 0) & (positions[:, 1] % 1 > 0)
    positions[inner] += random.uniform(-0.2, 0.2, (inner.sum(), 2)) * [2 / columns, 1 / rows]
    triangles = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            triangles += [[a, b, d], [a, d, c]] if (i + j) % 2 else [[a, b, c], [c, b, d]]
    return positions.round(5), np.array(triangles)


def case(columns, rows, angle, rounds):
    positions, triangles = grid(columns, rows)
    left = np.arange(0, len(positions), columns + 1)
    right = left + columns
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    transforms = [np.eye(2, 3), np.column_stack([turn, np.array([0.1, 0.4]) - turn @ [2, 0.5] + [2, 0.5]])]
    held = np.concatenate([left, right]).astype(np.int32)
    goals = np.concatenate([positions[left], positions[right] @ turn.T + transforms[1][:, 2]])
    data = igl.ARAPData()
    data.max_iter = rounds
    igl.arap_precomputation(positions, triangles, 2, held, data)
    deformed = igl.arap_solve(goals, data, positions.copy())
    return {
        "positions": positions.ravel().tolist(),
        "triangles": triangles.ravel().tolist(),
        "vertices": held.tolist(),
        "owners": [0] * len(left) + [1] * len(right),
        "transforms": np.array(transforms).ravel().tolist(),
        "deformed": np.asarray(deformed).ravel().tolist(),
    }


cases = [case(8, 4, 0.6, 3000), case(10, 3, -1.2, 3000), case(12, 5, 1.5, 3000)]
text = "[\n" + ",\n".join(json.dumps(entry) for entry in cases) + "\n]\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
