"""Writes linear_blend.json: libigl's lbs_matrix. Run: pip install numpy==2.4.6 libigl==2.6.3; python linear_blend.py

libigl works in double: 1e-6 of the deformed extent is what single precision, blending up to ten transforms, may lose.
"""

import json
import pathlib

import igl
import numpy as np

random = np.random.default_rng(20140806)


def case(dimension, count, handles, scale=1.0, unity=True):
    positions = (random.uniform(-1, 1, (count, dimension)) * scale).round(5)
    weights = random.uniform(-0.1, 1, (count, handles))
    if unity:
        weights /= weights.sum(axis=1, keepdims=True)
    transforms = random.uniform(-1, 1, (handles, dimension, dimension + 1)).round(4)
    transforms[:, :, dimension] *= scale
    stacked = transforms.transpose(0, 2, 1).reshape(-1, dimension)
    deformed = np.asarray(igl.lbs_matrix(positions, weights)) @ stacked
    return {
        "dimension": dimension,
        "handles": handles,
        "positions": positions.ravel().tolist(),
        "weights": weights.ravel().tolist(),
        "transforms": transforms.ravel().tolist(),
        "deformed": deformed.ravel().tolist(),
    }


cases = [
    case(dimension, count, handles, scale, unity)
    for dimension in (2, 3)
    for count, handles, scale, unity in [(25, 3, 1.0, True), (18, 10, 100.0, True), (21, 4, 0.01, False)]
]
text = "[\n" + ",\n".join(json.dumps(entry) for entry in cases) + "\n]\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
