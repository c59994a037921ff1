"""Writes rbf_interpolator.json: scipy.interpolate.RBFInterpolator on all kernels that we share, degrees -1 to 2, with and without
smoothing, 1 to 5 dimensions, 5 to 400 points. Run: pip install numpy==2.4.6 scipy==1.17.1; python rbf_interpolator.py

epsilon is 1/width. Both sides solve the same equations in double precision by different means (SciPy scales the polynomial block only,
we scale the points), so that values differ by about the condition number times 1e-16.
"""

import itertools
import json
import pathlib
import warnings

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial.distance import cdist

# Our name: SciPy's, and the lowest degree.
KERNELS = {
    "linear": ("linear", 0),
    "thin-plate": ("thin_plate_spline", 1),
    "cubic": ("cubic", 1),
    "quintic": ("quintic", 2),
    "multiquadric": ("multiquadric", 0),
    "inverse-multiquadric": ("inverse_multiquadric", -1),
    "inverse-quadratic": ("inverse_quadratic", -1),
    "gaussian": ("gaussian", -1),
}
random = np.random.default_rng(20260728)
warnings.simplefilter("error")


def data_set(dimension, count, query_count, outputs):
    points = random.uniform(-1, 1, (count, dimension)).round(4)
    gaps = cdist(points, points) + np.diag(np.full(count, np.inf))
    return {
        "dimension": dimension,
        "points": points,
        "values": random.normal(size=(count, outputs)).round(3),
        "queries": random.uniform(-1.2, 1.2, (query_count, dimension)).round(3),
        "width": float(gaps.min(axis=1).mean().round(3)),
    }


def cases(index, data):
    for name, (theirs, lowest) in KERNELS.items():
        # SciPy scales the distances of kernels without a width too; ours have none. The wider of two widths makes for bad conditioning.
        widths = [1] if name in ("linear", "thin-plate", "cubic", "quintic") else [data["width"], 3 * data["width"]]
        for width, degree in itertools.product(widths, range(lowest, 3)):
            for smoothing in (0, 0.05):
                epsilon = 1 / width
                fit = RBFInterpolator(data["points"], data["values"], kernel=theirs, epsilon=epsilon, degree=degree, smoothing=smoothing)
                yield {
                    "set": index,
                    "kernel": name,
                    "width": width,
                    "degree": degree,
                    "smoothing": smoothing,
                    "expected": fit(data["queries"]).ravel().tolist(),
                }


sets = [data_set(1, 5, 4, 2), data_set(2, 12, 4, 1), data_set(3, 30, 4, 1), data_set(4, 60, 4, 1), data_set(5, 100, 4, 1), data_set(2, 400, 6, 1)]
rows = [case for index, data in enumerate(sets) for case in cases(index, data)]
plain = [{key: value.ravel().tolist() if isinstance(value, np.ndarray) else value for key, value in data.items()} for data in sets]
text = '{"sets": [\n' + ",\n".join(map(json.dumps, plain)) + '\n],\n"cases": [\n' + ",\n".join(map(json.dumps, rows)) + "\n]}\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
