"""Distances of second-order fast marching by scikit-fmm, an implementation independent of ours, in a solid L.

    pip install scikit-fmm==2025.6.23 && python tests/oracles/fast_marching.py

writes fast_marching.txt beside itself:

    nx ny nz
    sx sy sz                    the source, in cells: voxel (i, j, k) has its center at (i, j, k)
    nx*ny*nz distances          x fastest, in cells; -1 outside the domain and in the ball where the march starts

The march starts from a sphere about the source (the zero set of |x - s| - radius), not from the source itself: scikit-fmm
would start from a single cell with an error of the order of a cell, which is what our exact ball avoids.
"""

from pathlib import Path

import numpy as np
import skfmm

SHAPE = (24, 24, 6)
SOURCE = np.array([5.2, 19.6, 2.3])
RADIUS = 3.5

x, y, z = np.meshgrid(*(np.arange(n, dtype=float) for n in SHAPE), indexing="ij")
outside = (x >= 11) & (y >= 11)
straight = np.sqrt((x - SOURCE[0]) ** 2 + (y - SOURCE[1]) ** 2 + (z - SOURCE[2]) ** 2)
phi = np.ma.MaskedArray(straight - RADIUS, outside)
distance = skfmm.distance(phi, order=2) + RADIUS
known = ~np.ma.getmaskarray(distance) & (straight > RADIUS)

with open(Path(__file__).with_name("fast_marching.txt"), "w") as out:
    print(*SHAPE, file=out)
    print(*SOURCE, file=out)
    values = np.where(known, distance.filled(-1), -1).flatten(order="F")
    for row in values.reshape(-1, SHAPE[0]):
        print(*(f"{v:.5g}" if v >= 0 else "-1" for v in row), file=out)
