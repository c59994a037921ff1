"""Writes tension_kernel.json: Green's functions of alpha L^2 - beta L + gamma, and the Bessel functions in them, by mpmath.

Run: pip install mpmath==1.3.0; python tension_kernel.py

Each is the partial fraction (g_a - g_b) / (alpha (b^2 - a^2)) with complex roots as they come, in 60 digits, so
that no cancellation matters; equal roots are moved apart by a relative 1e-18. Where gamma = 0 the value at r = 0 is subtracted
(the limit there, in closed form). "second" is G'', which the test needs to say how well conditioned G' is.
"""

import json
import pathlib

from mpmath import besselk, euler, exp, log, mp, mpf, pi, re, sqrt

mp.dps = 60


def bessel(order, z):
    return besselk(order, z) if re(z) < 800 else mpf(0)  # as good as 0 in double precision


# g and its first and second derivative, of -Laplace + k^2.
GREEN = {
    1: lambda k, r: (exp(-k * r) / (2 * k), -exp(-k * r) / 2, k * exp(-k * r) / 2),
    2: lambda k, r: tuple(
        x / (2 * pi) for x in (bessel(0, k * r), -k * bessel(1, k * r), k * k * (bessel(0, k * r) + bessel(1, k * r) / (k * r)))
    ),
    3: lambda k, r: tuple(exp(-k * r) * x / (4 * pi) for x in (1 / r, -(1 + k * r) / r**2, (2 + 2 * k * r + (k * r) ** 2) / r**3)),
}
# The same for k = 0, up to a constant.
LAPLACE = {
    1: lambda r: (-r / 2, mpf(-1) / 2, mpf(0)),
    2: lambda r: tuple(-x / (2 * pi) for x in (log(r), 1 / r, -1 / r**2)),
    3: lambda r: tuple(x / (4 * pi) for x in (1 / r, -1 / r**2, 2 / r**3)),
}
# lim g_0 - g_b at r = 0.
LIMIT = {1: lambda b: -1 / (2 * b), 2: lambda b: (log(b / 2) + euler) / (2 * pi), 3: lambda b: b / (4 * pi)}
PLATE = {
    1: lambda r: (r**3 / 12, r**2 / 4, r / 2),
    2: lambda r: (r**2 * log(r) / (8 * pi), r * (2 * log(r) + 1) / (8 * pi), (2 * log(r) + 3) / (8 * pi)),
    3: lambda r: (-r / (8 * pi), -1 / (8 * pi), mpf(0)),
}


def kernel(alpha, beta, gamma, dimension, r):
    alpha, beta, gamma, r = map(mpf, (alpha, beta, gamma, r))
    if alpha == 0:
        k = sqrt(gamma / beta)
        return [x / beta for x in (GREEN[1](k, r) if k else LAPLACE[1](r))]
    if beta == gamma == 0:
        return [x / alpha for x in PLATE[dimension](r)]
    root = sqrt(mp.mpc(beta**2 - 4 * alpha * gamma))
    if root == 0:
        root = beta * mpf(10) ** -18  # changes a double's digits by 1e-36, and costs 18 of the 60
    p, q = (beta - root) / (2 * alpha), (beta + root) / (2 * alpha)
    b = sqrt(q)
    if gamma == 0:
        parts = [x - y for x, y in zip(LAPLACE[dimension](r), GREEN[dimension](b, r))]
        parts[0] -= LIMIT[dimension](b)
        return [re(x) / beta for x in parts]
    a = sqrt(p)
    return [
        re(x - y) / re(alpha * (q - p)) if root.imag == 0 else re((x - y) / (alpha * (q - p)))
        for x, y in zip(GREEN[dimension](a, r), GREEN[dimension](b, r))
    ]


WEIGHTS = [
    (1, 5, 4),
    (0.01, 1, 1),
    (1, 1e6, 1),
    (1e-6, 1, 1),
    (1, 1, 1e-10),
    (1, 1e-4, 1e-16),  # real roots
    (1, 2, 1),
    (3, 12, 12),
    (1, 2.0000001, 1),
    (1, 2 + 2**-40, 1),
    (1, 2 - 2**-40, 1),
    (1, 1.9999999, 1),  # equal and nearly
    (1, 1, 1),
    (2, 0.5, 30),
    (1, 0, 1),
    (1e-8, 0, 1),
    (1, 1e-9, 1),  # complex pairs
    (1, 1, 0),
    (2, 1e-8, 0),
    (1e-8, 1, 0),
    (1, 100, 0),  # gamma = 0
    (3, 0, 0),
    (1e-3, 0, 0),
]
DISTANCES = [1e-12, 1e-6, 1e-3, 0.05, 0.3, 0.9, 1.7, 2.4, 4, 9, 30, 200]


def short(x):
    return float(mp.nstr(x, 17))


entries = []
for dimension in (1, 2, 3):
    for alpha, beta, gamma in WEIGHTS + ([(0, 2, 3), (0, 2, 0)] if dimension == 1 else []):
        rows = [[short(x) for x in kernel(alpha, beta, gamma, dimension, r)] for r in DISTANCES]
        value, slope, second = zip(*rows)
        entries.append(
            {
                "dimension": dimension,
                "alpha": alpha,
                "beta": beta,
                "gamma": gamma,
                "r": DISTANCES,
                "value": value,
                "slope": slope,
                "second": second,
            }
        )
points = [10.0**e for e in (-300, -100, -30, -10, -5, -3, -2, -1)] + [
    0.3,
    0.7,
    1,
    1.5,
    1.9999,
    2,
    2.0001,
    2.5,
    3,
    5,
    8,
    20,
    60,
    300,
    700,
]
entries.append({"x": points, "k0": [short(besselk(0, mpf(x))) for x in points], "k1": [short(besselk(1, mpf(x))) for x in points]})
text = "[\n" + ",\n".join(json.dumps(entry) for entry in entries) + "\n]\n"
pathlib.Path(__file__).with_suffix(".json").write_text(text)
