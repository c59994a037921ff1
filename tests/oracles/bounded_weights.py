"""Writes bounded_weights.json: bounded biharmonic weights on a plane shape, a surface in space and tetrahedra. One case a line.
Run: pip install numpy==2.4.6 scipy==1.17.1 libigl==2.6.3 clarabel==0.11.1; python bounded_weights.py

`libigl`: energy ½ Σⱼ wⱼᵀ B wⱼ of bbw's weights, rows divided by their sums as libigl's users do, B = C M⁻¹ C of its cotmatrix and massmatrix.
`least` and `weights`: of the joint problem, w ≥ 0 and rows summing to 1, by Clarabel, an interior point method, to about 1e-8 of the energy.
"""

import itertools
import json
import pathlib

import clarabel
import igl
import numpy as np
import scipy.sparse as sparse
from scipy.spatial import Delaunay

random = np.random.default_rng(20110807)


def plane():
    """A plus of scattered points on a bent lattice, with four corners that point inward."""
    i, j = np.meshgrid(np.arange(19), np.arange(19))
    points = np.array([i + j % 2 / 2, j], float).reshape(2, -1).T
    points += random.uniform(-0.15, 0.15, points.shape)
    arm = lambda p, slack: ((abs(p - 9) < 3.2 + slack).any(axis=1)) & (abs(p - 9) < 9).all(axis=1)
    points = points[arm(points, 0)].round(4)
    triangles = Delaunay(points).simplices
    a, b, c = points[triangles].transpose(1, 0, 2)
    area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    return points, triangles[arm((a + b + c) / 3, 0) & (area > 0.1)]


def surface():
    """A torus with uneven triangles."""
    rows, columns = 10, 24
    u, v = np.meshgrid(np.arange(columns) / columns, np.arange(rows) / rows)
    u, v = (2 * np.pi * (x + random.uniform(-0.15, 0.15, x.shape) / columns).ravel() for x in (u, v))
    points = np.array([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)]).T.round(4)
    at = lambda i, j: i % rows * columns + j % columns
    quads = [(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)) for i in range(rows) for j in range(columns)]
    return points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def solid():
    """A bar of cubes, bent a little out of shape, six tetrahedra each around a diagonal (Kuhn)."""
    shape = np.array([12, 4, 4])
    grid = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), -1).reshape(-1, 3)
    points = ((grid + random.uniform(-0.1, 0.1, grid.shape)) / 2).round(4)
    number = lambda at: (at[..., 0] * shape[1] + at[..., 1]) * shape[2] + at[..., 2]
    cubes = grid[(grid < shape - 1).all(axis=1)]
    tetrahedra = []
    for axes in itertools.permutations(range(3)):
        corners = [cubes]
        for axis in axes:
            corners.append(corners[-1] + np.eye(3, dtype=int)[axis])
        if np.linalg.det(np.eye(3)[list(axes)]) < 0:
            corners[2:] = corners[:1:-1]
        tetrahedra.append(np.stack([number(corner) for corner in corners], axis=1))
    return points, np.vstack(tetrahedra)


def least(b, held, one):
    """The joint problem over the free vertices' weights, handle by handle."""
    n, h = b.shape[0], one.shape[1]
    free = np.setdiff1d(np.arange(n), held)
    m = len(free)
    quadratic = sparse.kron(sparse.eye(h), b[free][:, free]).tocsc()
    linear = (b[free][:, held] @ one).T.ravel()
    constraints = sparse.vstack([sparse.kron(np.ones((1, h)), sparse.eye(m)), -sparse.eye(m * h)]).tocsc()
    right = np.concatenate([np.ones(m), np.zeros(m * h)])
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = 1e-11
    cones = [clarabel.ZeroConeT(m), clarabel.NonnegativeConeT(m * h)]
    solution = clarabel.DefaultSolver(sparse.triu(quadratic).tocsc(), linear, constraints, right, cones, settings).solve()
    weights = np.zeros((n, h))
    weights[held] = one
    weights[free] = np.array(solution.x).reshape(h, m).T
    print("   clarabel:", solution.status, solution.iterations)
    return weights


def case(name, points, simplices, handles):
    simplices = simplices.astype(np.int64)
    assert len(np.unique(simplices)) == len(points), "every vertex is in a simplex"
    spatial = np.hstack([points, np.zeros((len(points), 3 - points.shape[1]))])
    c = igl.cotmatrix(spatial, simplices)
    mass = igl.massmatrix(spatial, simplices, igl.MassMatrixType.MASSMATRIX_TYPE_DEFAULT).diagonal()
    b = (c.T @ sparse.diags(1 / mass) @ c).tocsr()
    vertices = np.concatenate(handles).astype(np.int64)
    owners = np.concatenate([[j] * len(handle) for j, handle in enumerate(handles)])
    one = np.eye(len(handles))[owners]
    energy = lambda w: float(np.sum(w * (b @ w)) / 2)
    theirs = igl.bbw(spatial, simplices, vertices, one)
    joint = least(b, vertices, one)
    made = {
        "name": name,
        "dimension": points.shape[1],
        "corners": simplices.shape[1],
        "positions": points.ravel().tolist(),
        "simplices": simplices.ravel().tolist(),
        "vertices": vertices.tolist(),
        "owners": owners.tolist(),
        "libigl": energy(theirs / theirs.sum(axis=1, keepdims=True)),
        "least": energy(joint),
        "weights": [float(f"{x:.7g}") for x in joint.ravel()],
    }
    print(name, len(points), "vertices", len(simplices), "simplices; libigl", made["libigl"], "least", made["least"], "rows off 1 by", abs(theirs.sum(axis=1) - 1).max())
    return made


def nearest(points, *places):
    return sorted({int(np.argmin(np.linalg.norm(points - np.array(place), axis=1))) for place in places})


p, s, t = plane(), surface(), solid()
tips = [(9, 1), (9, 17), (1, 9), (17, 9), (9, 9)]
slice_at = lambda x: nearest(t[0], *[(x, y, z) for y in (0.5, 1) for z in (0.5, 1)])
cases = [
    case("plane", *p, [nearest(p[0], tip) for tip in tips]),
    case("plane, two handles", *p, [nearest(p[0], tip) for tip in tips[:2]]),
    case("surface", *s, [nearest(s[0], place) for place in ((3, 0, 0), (0, 3, 0), (-2, 0, 1), (0, -1, 0))]),
    case("solid", *t, [slice_at(0.5), slice_at(3), slice_at(5)]),
]
text = "[\n" + ",\n".join(json.dumps(made) for made in cases) + "\n]\n"
(pathlib.Path(__file__).parent / "bounded_weights.json").write_text(text)
