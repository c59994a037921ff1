"""SciPy's side of the interpolation benchmark, on the arrays in the file that the first argument names: prints milliseconds."""

import json
import sys
import time

import numpy as np
from scipy.interpolate import RBFInterpolator

numbers = np.fromfile(sys.argv[1])
points, values, queries = numbers[:800].reshape(400, 2), numbers[800:1200], numbers[1200:11200].reshape(5000, 2)
times = {}
for kernel, name in [("thin_plate_spline", "thin-plate"), ("gaussian", "gaussian"), ("multiquadric", "multiquadric")]:
    for _ in range(20):
        start = time.perf_counter()
        fit = RBFInterpolator(points, values, kernel=kernel, epsilon=20 if name != "thin-plate" else 1, degree=1)
        made = time.perf_counter()
        fit(queries)
        end = time.perf_counter()
        for step, seconds in (("fit", made - start), ("evaluate", end - made)):
            key = f"{name} {step}"
            times[key] = min(times.get(key, float("inf")), 1000 * seconds)
print(json.dumps(times))
