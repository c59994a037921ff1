"""The scikit-fmm side of `npm run bench -- bake`: order 2, on the same voxels cropped to their box, from every eighth of the same
centers. Prints one JSON object: milliseconds of skfmm.distance alone, the median to compare with a center, and the mean, which other
work on the machine delays as it does a whole bake. The array that it starts from, Euclidean distance to the center less a ball, is
made outside the clock, as the ball is part of our march.

    python skfmm_side.py DOMAIN.json
"""

import json
import sys
import time

import numpy as np
import skfmm

with open(sys.argv[1]) as file:
    domain = json.load(file)
nx, ny, nz = domain["dimensions"]
outside = np.ones(nx * ny * nz, bool)
outside[domain["voxels"]] = False
outside = outside.reshape(nz, ny, nx)
inside = np.argwhere(~outside)
low, high = inside.min(0), inside.max(0) + 1
outside = np.ascontiguousarray(outside[tuple(slice(a, b) for a, b in zip(low, high))])
places = np.meshgrid(*(np.arange(n, dtype=float) for n in outside.shape), indexing="ij")

times = []
for center in domain["centers"][::8]:
    straight = np.sqrt(sum((x - s) ** 2 for x, s in zip(places, np.array(center)[::-1] - low)))
    phi = np.ma.MaskedArray(straight - max(3.5, straight[~outside].min() + 1.5), outside)
    start = time.perf_counter()
    skfmm.distance(phi, order=2)
    times.append(time.perf_counter() - start)
print(json.dumps({"center": 1e3 * float(np.median(times)), "run": 1e3 * float(np.mean(times))}))
