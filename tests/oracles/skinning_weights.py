"""Writes skinning_weights.json: operators and weights of libigl on a plane shape, a surface in space and tetrahedra. One case a line.
Run: pip install numpy==2.4.6 scipy==1.17.1 libigl==2.6.3; python skinning_weights.py

C = -cotmatrix as three lists, both mass matrices, harmonic(k = 1, 2, 3) for point and bone handles. libigl's sparse Cholesky factors the same
matrices, so that operators agree to rounding and weights to rounding times the condition of the equations.
"""

import json
import pathlib

import igl
import numpy as np
from scipy.spatial import Delaunay

random = np.random.default_rng(20140728)


def plane():
    """A fat L of scattered points: its obtuse triangles and its corner that points inward are what the gingerbread man has."""
    points = random.uniform(0, 1, (420, 2))
    grid = np.linspace(0, 1, 9)
    border = [(x, y) for x in grid for y in grid if (x in (0, 1) or y in (0, 1)) or (x == 0.5 and y >= 0.5) or (y == 0.5 and x >= 0.5)]
    points = np.vstack([np.array(border), points[[i for i in range(420) if min(np.hypot(*(points[:i] - points[i]).T), default=1) > 0.05]]])
    points = points[~((points[:, 0] > 0.5) & (points[:, 1] > 0.5))].round(4)
    triangles = Delaunay(points).simplices
    middles = points[triangles].mean(axis=1)
    a, b, c = points[triangles].transpose(1, 0, 2)
    area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    return points, triangles[~((middles[:, 0] > 0.5) & (middles[:, 1] > 0.5)) & (abs(area) > 1e-9)]


def surface():
    """A torus with uneven triangles."""
    rows, columns = 8, 14
    u, v = np.meshgrid(np.arange(columns) / columns, np.arange(rows) / rows)
    u, v = (2 * np.pi * (x + random.uniform(-0.15, 0.15, x.shape) / columns).ravel() for x in (u, v))
    points = np.array([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)]).T.round(4)
    at = lambda i, j: i % rows * columns + j % columns
    quads = [(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)) for i in range(rows) for j in range(columns)]
    return points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def solid():
    """A bar of scattered points, thin tetrahedra left out."""
    grid = np.stack(np.meshgrid(np.arange(6), np.arange(3), np.arange(3), indexing="ij"), -1).reshape(-1, 3) / 2.0
    points = (grid + random.uniform(-0.12, 0.12, grid.shape)).round(4)
    tetrahedra = Delaunay(points).simplices
    a, b, c, d = points[tetrahedra].transpose(1, 0, 2)
    volume = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
    tetrahedra[volume < 0] = tetrahedra[volume < 0][:, [0, 2, 1, 3]]
    return points, tetrahedra[abs(volume) > 1e-3]


def case(name, points, simplices, handles):
    simplices = simplices.astype(np.int64)
    used = np.unique(simplices)
    assert len(used) == len(points), "every vertex is in a simplex"
    spatial = np.hstack([points, np.zeros((len(points), 3 - points.shape[1]))])
    c = (-igl.cotmatrix(spatial, simplices)).tocoo()
    lower = c.row >= c.col
    kinds = igl.MassMatrixType
    masses = {
        "barycentric": igl.massmatrix(spatial, simplices, kinds.MASSMATRIX_TYPE_BARYCENTRIC).diagonal(),
        "voronoi": igl.massmatrix(spatial, simplices, kinds.MASSMATRIX_TYPE_DEFAULT).diagonal(),
    }
    vertices = np.concatenate(handles)
    owners = np.concatenate([[j] * len(handle) for j, handle in enumerate(handles)])
    one = np.eye(len(handles))[owners]
    weights = {f"weights{k}": igl.harmonic(spatial, simplices, vertices.astype(np.int64), one, k) for k in (1, 2, 3)}
    numbers = lambda a: [float(f"{x:.16g}") for x in np.asarray(a).ravel()]
    return {
        "name": name,
        "dimension": points.shape[1],
        "corners": simplices.shape[1],
        "positions": points.ravel().tolist(),
        "simplices": simplices.ravel().tolist(),
        "rows": c.row[lower].tolist(),
        "columns": c.col[lower].tolist(),
        "entries": numbers(c.data[lower]),
        **{key: numbers(value) for key, value in masses.items()},
        "vertices": vertices.tolist(),
        "owners": owners.tolist(),
        **{key: numbers(value) for key, value in weights.items()},
    }


def nearest(points, *places):
    return [int(np.argmin(np.linalg.norm(points - np.array(place), axis=1))) for place in places]


meshes = {"plane": plane(), "surface": surface(), "solid": solid()}
p, s, t = (meshes[name][0] for name in ("plane", "surface", "solid"))
handles = {
    "plane": [nearest(p, (0.05, 0.95)), nearest(p, (0.95, 0.05)), sorted(set(nearest(p, (0.1, 0.1), (0.2, 0.2), (0.3, 0.3))))],
    "surface": [nearest(s, (3, 0, 0)), nearest(s, (-3, 0, 0)), nearest(s, (0, 2, 1))],
    "solid": [nearest(t, (0, 0.5, 0.5)), sorted(set(nearest(t, (2, 0.5, 0), (2.5, 0.5, 0))))],
}
cases = [case(name, *meshes[name], [np.array(h) for h in handles[name]]) for name in meshes]
for made in cases:
    print(made["name"], len(made["positions"]) // made["dimension"], "vertices", len(made["simplices"]) // made["corners"], "simplices")
text = "[\n" + ",\n".join(json.dumps(made) for made in cases) + "\n]\n"
(pathlib.Path(__file__).parent / "skinning_weights.json").write_text(text)
