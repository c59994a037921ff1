"""The other side of the table of leakage: libigl's surface ARAP (spokes and rims) on the mesh in the JSON file that the first argument names.

Reads positions, triangles, and either tips (vertex numbers) or how many to find: the farthest along the edges from those before, beginning
with the farthest from vertex 0. Every tip is held by its vertex alone; each in turn is moved 0.144 diagonals in four random directions
(seed 1), from rest, until twenty iterations move no vertex by 1e-4 of the diagonal. Prints tips, targets and what each drag leaks: the
largest motion of another tip's region (the vertices within 0.05 diagonals of it, on average) over that of the moved one's.
"""

import json
import sys

import igl
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

with open(sys.argv[1], encoding="utf-8") as file:
    given = json.load(file)
V = np.array(given["positions"], float).reshape(-1, 3)
F = np.array(given["triangles"], np.int64).reshape(-1, 3)
diagonal = np.linalg.norm(np.ptp(V, 0))


def farthest(count):
    pairs = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    lengths = np.linalg.norm(V[pairs[:, 0]] - V[pairs[:, 1]], axis=1)
    # Edges of two triangles come twice: the sum of both is twice the length, along every edge alike but those of one triangle.
    graph = coo_matrix((lengths, pairs.T), shape=(len(V), len(V))).tocsr()
    graph = graph.maximum(graph.T)
    found = [int(dijkstra(graph, directed=False, indices=0).argmax())]
    while len(found) < count:
        away = dijkstra(graph, directed=False, indices=found, min_only=True)
        found.append(int(np.where(np.isfinite(away), away, -1).argmax()))
    return found


tips = given["tips"] if isinstance(given["tips"], list) else farthest(given["tips"])
regions = [np.linalg.norm(V - V[tip], axis=1) < 0.05 * diagonal for tip in tips]
data = igl.ARAPData()
igl.arap_precomputation(V.copy(), F, 3, np.array(tips, np.int64), data)
data.max_iter = 20
random = np.random.default_rng(1)
targets, leaks = [], []
for k in range(len(tips)):
    for _ in range(4):
        way = random.normal(size=3)
        to = V[tips].copy()
        to[k] += 0.144 * diagonal * way / np.linalg.norm(way)
        pose = V.copy()
        for _ in range(100):
            before, pose = pose, igl.arap_solve(to, data, pose)
            if np.linalg.norm(pose - before, axis=1).max() < 1e-4 * diagonal:
                break
        motion = [np.linalg.norm(pose - V, axis=1)[region].mean() for region in regions]
        leaks.append(float(max(m for i, m in enumerate(motion) if i != k) / motion[k]))
        targets.append(to.tolist())
print(json.dumps({"tips": tips, "targets": targets, "leaks": leaks}))
