#!/usr/bin/env python3
"""A cylinder pressed without friction into a homogeneous layer on a rigid base, by ContactMechanics: a JSON object for
each grid. See README.md.

In one dimension the library takes `thickness` and leaves it unused (1.8.3), so the line contact is a grid of N by 1 points in two,
repeated for ever: images sixteen thicknesses away are not felt to eight digits or so.
"""

import json
import time

import numpy as np
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Systems import NonSmoothContactSystem
from SurfaceTopography import Topography

THICKNESS, SHEAR, NU, RADIUS = 1.0, 1.0, 0.3, 10.0
# The contact becomes as wide as the layer is thick, on either side.
FORCE = 0.349084814062548
PERIOD = 16.0


def solve(n):
    started = time.perf_counter()
    step = PERIOD / n
    x = (np.arange(n) - n // 2) * step
    shape = Topography((-(x**2) / (2 * RADIUS))[:, None], (PERIOD, step), periodic=True)
    layer = PeriodicFFTElasticHalfSpace((n, 1), 2 * SHEAR * (1 + NU), (PERIOD, step), thickness=THICKNESS, poisson=NU)
    contact = NonSmoothContactSystem(layer, shape)
    found = contact.minimize_proxy(external_force=FORCE * step, pentol=1e-12, forcetol=1e-12, thermotol=1e-10)
    assert found.success, found.message
    pressure = np.asarray(found.jac)[:, 0] / step**2
    return float(found.offset), float(pressure[n // 2]), time.perf_counter() - started


def main():
    solve(64)  # what is made once
    for n in (64, 256, 1024, 4096, 16384):
        indentation, centre, _ = solve(n)
        seconds = min(solve(n)[2] for _ in range(3))
        print(json.dumps({"unknowns": n, "indentation": indentation, "centre": centre, "seconds": seconds}), flush=True)


if __name__ == "__main__":
    main()
