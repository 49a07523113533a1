#!/usr/bin/env python3
"""Reference values of the surface flexibility: writes flexibilities.json beside itself.

Run:  python3 flexibilities.py          (needs Python 3 and mpmath, nothing else; some minutes on two cores)

The state equations z' = K(y) z of docs/theory.md section 2, z = (U, V, S, T), are solved directly: the two solutions that
the base allows are carried up to the surface by Taylor steps with 100 digits, more than cancellation can eat, so none of
the tricks of the program that is tested are needed and it shares no code with it. A step is at most a fifth of the
radius of convergence of the coefficients, which is estimated from their own Taylor series, and 3/s. Each number is
computed a second time with all steps halved; both agree to 1e-20. Before anything is written the script checks itself
against closed forms and against values that other programs computed for this project.
"""
import json
import os
from multiprocessing import Pool
from mpmath import mp, mpf

mp.dps = 100
ORDER = 60        # of the Taylor steps
AGREE = mpf(10) ** -20
# Wave numbers in units of 1/h (of |gamma| where there is no base).
WAVES = ["1e-4", "3e-4", "1e-3", "3e-3", "0.01", "0.03", "0.1", "0.2", "0.4", "0.7",
         "1", "1.6", "2.5", "4", "6", "10", "15", "20", "30", "40"]


# Truncated power series -----------------------------------------------------------------------------------------------

def fit(c, n=ORDER):
    return (c + [mpf(0)] * n)[:n]


class Series:
    """Taylor polynomial of a function of the depth."""

    def __init__(self, coefficients):
        self.c = fit(list(coefficients))

    @staticmethod
    def of(x):
        return x if isinstance(x, Series) else Series([mpf(x)])

    def __add__(self, other):
        return Series([a + b for a, b in zip(self.c, Series.of(other).c)])

    __radd__ = __add__

    def __neg__(self):
        return Series([-a for a in self.c])

    def __sub__(self, other):
        return self + -Series.of(other)

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        if not isinstance(other, Series):
            return Series([a * mpf(other) for a in self.c])
        a, b = self.c, other.c
        return Series([mp.fdot(a[:k + 1], b[k::-1]) for k in range(ORDER)])

    __rmul__ = __mul__

    def __truediv__(self, other):
        if not isinstance(other, Series):
            return self * (1 / mpf(other))
        a, b, q = self.c, other.c, []
        for k in range(ORDER):
            q.append((a[k] - (mp.fdot(q, b[k:0:-1]) if k else 0)) / b[0])
        return Series(q)

    def __rtruediv__(self, other):
        return Series.of(other) / self

    def integral(self, constant):
        return Series([constant] + [a / (k + 1) for k, a in enumerate(self.c[:-1])])

    def derivative(self):
        return Series([k * a for k, a in enumerate(self.c)][1:])


def exp(x):
    d, e = x.derivative().c, [mp.exp(x.c[0])]
    for k in range(1, ORDER):
        e.append(mp.fdot(d[:k], e[k - 1::-1]) / k)
    return Series(e)


def sin(x):
    d, s, c = x.derivative().c, [mp.sin(x.c[0])], [mp.cos(x.c[0])]
    for k in range(1, ORDER):
        s.append(mp.fdot(d[:k], c[k - 1::-1]) / k)
        c.append(-mp.fdot(d[:k], s[k - 1::-1]) / k)
    return Series(s)


def erf(x):
    slope = 2 / mp.sqrt(mp.pi) * exp(-x * x) * x.derivative()
    return slope.integral(mp.erf(x.c[0]))


def tanh(x):
    # t' = (1 - t^2) x'
    d, t, w = x.derivative().c, [mp.tanh(x.c[0])], []
    for k in range(1, ORDER):
        w.append((1 if k == 1 else 0) - mp.fdot(t, t[::-1]))
        t.append(mp.fdot(d[:k], w[k - 1::-1]) / k)
    return Series(t)


class Root:
    """The depth y = x^2, whose powers of half an order are whole powers of x and have a series at 0, too."""

    def __init__(self, x):
        self.x = x


def power(x, p):
    """x^p, x not 0 at the middle unless p is a whole number."""
    if isinstance(x, Root):
        return power(x.x, 2 * p)
    p = mpf(p)
    if p == int(p) and p >= 0:
        result = Series.of(1)
        for _ in range(int(p)):
            result = result * x
        return result
    # r' x = p r x'
    a, r = x.c, [x.c[0] ** p]
    for k in range(1, ORDER):
        r.append(mp.fsum((p * (k - j) - j) * a[k - j] * r[j] for j in range(k)) / (k * a[0]))
    return Series(r)


# Elastic constants ----------------------------------------------------------------------------------------------------

def kappa_of(plane, nu):
    return 3 - 4 * nu if plane == "strain" else (3 - nu) / (1 + nu)


def number(x):
    """Decimals as they are printed."""
    return mpf(repr(x)) if isinstance(x, float) else mpf(x)


def shear_of(moduli, modulus, nu):
    return modulus if moduli == "shear" else modulus / (2 * (1 + nu))


def bulk(moduli, modulus, nu):
    young = modulus if moduli == "young" else modulus * 2 * (1 + nu)
    return young / (3 * (1 - 2 * nu))


def law(grading, thickness, moduli):
    """(modulus(y), nu(y) or None, m): functions of a Series y; m > 1 where they are smooth in y^(1/m) only."""
    kind = grading["type"]
    g = lambda key: number(grading[key])
    if kind == "homogeneous":
        return lambda y: Series.of(g("modulus")), None, 1
    if kind == "exponential":
        gamma = g("gradient") if "gradient" in grading else mp.log(g("base") / g("surface")) / thickness
        return lambda y: g("surface") * exp(gamma * y), None, 1
    if kind == "linear":
        return lambda y: g("surface") + (g("base") - g("surface")) / thickness * y, None, 1
    if kind == "power-law":
        return lambda y: g("surface") * power(1 + y / g("length"), g("exponent")), None, 1
    if kind in ("error-function", "sigmoid"):
        shape = erf if kind == "error-function" else tanh
        mean, half = (g("above") + g("below")) / 2, (g("below") - g("above")) / 2
        return lambda y: mean + half * shape((y - g("centre")) / g("width")), None, 1
    if kind == "formula":
        return FORMULAS[grading["modulus"]], FORMULAS[grading["poisson"]] if "poisson" in grading else None, 1
    if kind == "volume-fraction":
        p = g("exponent")
        m = 1 if p == int(p) else 2
        assert p * m == int(p * m)
        fraction = lambda y: power(y, p) * (1 / thickness ** p)
        top, low = grading["surface"], grading["base"]
        (e1, n1), (e2, n2) = [(number(x["modulus"]), number(x["poisson"])) for x in (top, low)]
        if grading["rule"] == "mixture":
            return (lambda y: e1 + (e2 - e1) * fraction(y)), (lambda y: n1 + (n2 - n1) * fraction(y)), m
        assert grading["rule"] == "mori-tanaka"
        # Y. Benveniste, Mechanics of Materials 6 (1987) 147-157: spheres of the base's material in the surface's.
        g1, g2 = shear_of(moduli, e1, n1), shear_of(moduli, e2, n2)
        k1, k2 = bulk(moduli, e1, n1), bulk(moduli, e2, n2)
        f1 = g1 * (9 * k1 + 8 * g1) / (6 * (k1 + 2 * g1))

        def mixed(y):
            v = fraction(y)
            k = k1 + v * (k2 - k1) / (1 + (1 - v) * ((k2 - k1) / (k1 + 4 * g1 / 3)))
            mu = g1 + v * (g2 - g1) / (1 + (1 - v) * ((g2 - g1) / (g1 + f1)))
            return k, mu

        def modulus(y):
            k, mu = mixed(y)
            return mu if moduli == "shear" else 9 * k * mu / (3 * k + mu)

        def poisson(y):
            k, mu = mixed(y)
            return (3 * k - 2 * mu) / (2 * (3 * k + mu))

        return modulus, poisson, m
    raise ValueError(kind)


FORMULAS = {
    "1 + 0.5*sin(3*y)": lambda y: 1 + sin(3 * y) / 2,
    "2 - exp(-y)": lambda y: 2 - exp(-y),
    "0.2 + 0.1*y": lambda y: mpf("0.2") + y / 10,
}


# State equations ------------------------------------------------------------------------------------------------------

class Stretch:
    """A smooth stretch of the layer: the coefficients of the state equations as Taylor series anywhere in it.

    The independent variable is x, y = x^m: a law that is smooth in a root of the depth is smooth in x.
    """

    def __init__(self, plane, moduli, poisson, grading, thickness):
        self.plane, self.moduli, self.thickness = plane, moduli, thickness
        self.constant = grading["type"] == "homogeneous"
        self.modulus, self.nu, self.m = law(grading, thickness, moduli)
        self.poisson = poisson
        self.length = mp.root(thickness, self.m) if thickness else None
        self.cache = {}

    def at(self, x):
        """(kappa, mu) there."""
        mu, kappa = self.series(x)
        return kappa.c[0], mu.c[0]

    def series(self, x0):
        x = Series([x0, 1])
        y = Root(x) if self.m == 2 else x
        nu = Series.of(self.nu(y)) if self.nu else Series.of(self.poisson)
        mu = shear_of(self.moduli, Series.of(self.modulus(y)), nu)
        return mu, kappa_of(self.plane, nu)

    def coefficients(self, x0):
        """Series about x0 of dy/dx times 1/mu, lambda, beta/mu, 8 mu/(1 + kappa), and of dy/dx itself."""
        mu, kappa = self.series(x0)
        stretch = Series.of(1) if self.m == 1 else 2 * Series([x0, 1])
        return [c * stretch for c in (
            1 / mu,
            (3 - kappa) / (1 + kappa),
            (kappa - 1) / (1 + kappa) / mu,
            8 * mu / (1 + kappa),
        )] + [stretch]

    def steps(self, refinement):
        """Steps from the base up: lower end, length, coefficients about the lower end."""
        if refinement not in self.cache:
            steps, x = [], self.length
            while x > 0:
                coefficients = self.coefficients(x)
                step = min(x, radius(coefficients) / 5 / refinement)
                steps.append((x, step, coefficients))
                x -= step
            self.cache[refinement] = steps
        return self.cache[refinement]

    def up(self, s, solutions, refinement):
        """Solutions (U, V, S, T) at the bottom of the stretch, carried to its top."""
        rate = s * (1 if self.m == 1 else 2 * self.length)
        for x, step, coefficients in self.steps(refinement):
            count = int(mp.ceil(step * rate * refinement / 3)) or 1
            for k in range(count):
                # The law itself tells the coefficients about the lower end of each part.
                here = coefficients if k == 0 or self.constant else self.coefficients(x - step * k / count)
                solutions = taylor(here, s, solutions, -step / count)
        return solutions


def radius(coefficients):
    """Radius of convergence, estimated from below by the last coefficients; of entire functions, any length."""
    rate = mpf(0)
    for series in coefficients:
        scale = max(abs(a) for a in series.c[:3])
        for k in range(ORDER // 2, ORDER):
            if series.c[k]:
                rate = max(rate, (abs(series.c[k]) / scale) ** (mpf(1) / k))
    return 1 / rate if rate else mp.inf


def taylor(coefficients, s, solutions, step):
    softness, lateral, coupled, stiff, stretch = [
        [a * step ** (k + 1) for k, a in enumerate(series.c)] for series in coefficients]
    constant = all(not any(series.c[1:]) for series in coefficients)

    def product(a, z, k):
        if constant:
            return a[0] * z[k]
        return mp.fdot(a[:k + 1], z[k::-1])

    result = []
    for start in solutions:
        u, v, sh, t = [[a] for a in start]
        for k in range(ORDER + 20 if constant else ORDER - 1):
            n = k + 1
            du = s * product(stretch, v, k) + product(softness, sh, k)
            dv = -s * product(lateral, u, k) + product(coupled, t, k)
            ds = s * s * product(stiff, u, k) + s * product(lateral, t, k)
            dt = -s * product(stretch, sh, k)
            for z, d in ((u, du), (v, dv), (sh, ds), (t, dt)):
                z.append(d / n)
        result.append([mp.fsum(z) for z in (u, v, sh, t)])
    return result


# Bases ----------------------------------------------------------------------------------------------------------------

def allowed(case, s, kappa, mu):
    """The two solutions that the base allows, at the bottom of the layer."""
    base = case["base"]
    if base["type"] == "rigid":
        return [[0, 0, mu, 0], [0, 0, 0, mu]]
    if base["type"] == "frictionless":
        return [[1, 0, 0, 0], [0, 0, 0, mu]]
    if base["type"] == "half-plane":
        kappa2, mu2 = kappa_of(case["plane"], number(base["poisson"])), number(base["shear"])
        c, beta = -(kappa2 + 1) / (4 * mu2 * s), (kappa2 - 1) / (kappa2 + 1)
        # d = C t under unit tractions.
        return [[c * mu2, -c * beta * mu2, mu2, 0], [-c * beta * mu2, c * mu2, 0, mu2]]
    raise ValueError(base)


def infinite(case, s):
    """On no base: with stresses in units of the local modulus the coefficients are constant; two of four modes decay."""
    grading = case["grading"]
    kappa = kappa_of(case["plane"], number(case["poisson"]))
    mu = shear_of(case["moduli"], number(grading.get("surface", grading.get("modulus"))), number(case["poisson"]))
    gamma = number(grading.get("gradient", 0))
    if not gamma:
        a0 = (kappa + 1) / (4 * mu)
        return kappa, mu, [[-a0, (kappa - 1) / (kappa + 1) * a0, s, 0], [(kappa - 1) / (kappa + 1) * a0, -a0, 0, s]]
    contraction, beta = (3 - kappa) / (1 + kappa), (kappa - 1) / (kappa + 1)
    matrix = mp.matrix([
        [0, s, 1, 0],
        [-s * contraction, 0, 0, beta],
        [8 * s * s / (1 + kappa), 0, -gamma, s * contraction],
        [0, 0, -s, -gamma],
    ])
    values, vectors = mp.eig(matrix)
    decaying = [k for k in range(4) if mp.re(values[k]) < 0]
    assert len(decaying) == 2, values
    modes = [[vectors[i, k] for i in range(4)] for k in decaying]
    return kappa, mu, [[u, v, mu * sh, mu * t] for u, v, sh, t in modes]


def flexibility(case, wave, refinement=1):
    """s Fvv/A0, s Fuu/A0, s Fuv/A0 at `wave` in units of 1/h (of |gamma| without a base)."""
    wave = mpf(wave)
    if case["base"]["type"] == "infinite":
        s = wave * abs(number(case["grading"].get("gradient", 1)))
        kappa, mu, solutions = infinite(case, s)
    else:
        parts = stretches(case)
        s = wave / number(case["thickness"])
        kappa, mu = parts[-1].at(parts[-1].length)
        solutions = allowed(case, s, kappa, mu)
        for part in reversed(parts):
            solutions = part.up(s, solutions, refinement)
        kappa, mu = parts[0].at(mpf(0))
    (u1, v1, s1, t1), (u2, v2, s2, t2) = solutions
    # Amplitudes at the surface: p = -sigma_yy = -T cos, q = -sigma_xy = -S sin; d = C t, F = -C.
    c = mp.matrix([[u1, u2], [v1, v2]]) * mp.inverse(mp.matrix([[s1, s2], [t1, t2]]))
    scale = -s * 4 * mu / (kappa + 1)
    vv, uu, uv, vu = [mp.re(scale * x) for x in (c[1, 1], c[0, 0], c[0, 1], c[1, 0])]
    assert abs(uv - vu) < AGREE * mp.sqrt(vv * uu), "Betti"
    return vv, uu, uv


def stretches(case):
    if "_stretches" not in case:
        grading = case["grading"]
        make = lambda nu, g, h: Stretch(case["plane"], case["moduli"], number(nu), g, number(h))
        if grading["type"] == "stack":
            case["_stretches"] = [make(x["poisson"], x["grading"], x["thickness"]) for x in grading["layers"]]
        else:
            case["_stretches"] = [make(case["poisson"], grading, case["thickness"])]
    return case["_stretches"]


def distance(a, b):
    return max(abs(a[0] / b[0] - 1), abs(a[1] / b[1] - 1), abs(a[2] - b[2]) / mp.sqrt(b[0] * b[1]))


# Cases ----------------------------------------------------------------------------------------------------------------

RIGID, SLIDING, INFINITE = {"type": "rigid"}, {"type": "frictionless"}, {"type": "infinite"}


def half_plane(shear, poisson):
    return {"type": "half-plane", "shear": shear, "poisson": poisson}


def case(about, base, grading, thickness=1.0, poisson=0.3, plane="strain", moduli="shear"):
    return dict(about=about, plane=plane, poisson=poisson, thickness=thickness, base=base, grading=grading, moduli=moduli)


def homogeneous(modulus):
    return {"type": "homogeneous", "modulus": modulus}


def between(kind, surface, base):
    return {"type": kind, "surface": surface, "base": base}


def step(kind, above, below, centre, width):
    return {"type": kind, "above": above, "below": below, "centre": centre, "width": width}


def mixture(rule, surface, base, exponent):
    material = lambda m: {"modulus": m[0], "poisson": m[1]}
    return {"type": "volume-fraction", "surface": material(surface), "base": material(base), "exponent": exponent,
            "rule": rule}


def stack(*layers):
    """Of (thickness, grading, poisson)."""
    layers = [{"thickness": t, "poisson": nu, "grading": g if isinstance(g, dict) else homogeneous(g)}
              for t, g, nu in layers]
    return {"type": "stack", "layers": layers}


CASES = [
    case("homogeneous", RIGID, homogeneous(1.0)),
    case("homogeneous, plane stress, without friction", SLIDING, homogeneous(3.0), 2.0, 0.2, "stress"),
    case("homogeneous on a stiffer half-plane, plane stress", half_plane(3.0, 0.25), homogeneous(1.5), 0.5, 0.3, "stress"),
    case("homogeneous on a half-plane of its own: none of it shows", half_plane(2.0, 0.4), homogeneous(2.0), 1.0, 0.4),
    case("homogeneous without a base", INFINITE, homogeneous(2.0), None, 0.4),
    case("homogeneous and incompressible", RIGID, homogeneous(1.0), 1.0, 0.5),
    case("homogeneous, nu = -0.99", RIGID, homogeneous(1.0), 1.0, -0.99),
    case("exponential", RIGID, between("exponential", 1.0, 8.0), 5.0),
    case("exponential, softer below, plane stress, without friction", SLIDING, between("exponential", 4.0, 0.5), 2.0, 0.25,
         "stress"),
    case("exponential, nu = -0.99, without friction", SLIDING, between("exponential", 1.0, 3.0), 1.0, -0.99),
    case("exponential on a half-plane", half_plane(0.7, 0.2), between("exponential", 1.0, 5.0), 1.5, 0.45),
    case("exponential, incompressible on an incompressible half-plane", half_plane(4.0, 0.5),
         between("exponential", 1.0, 4.0), 1.0, 0.5),
    case("exponential without a base", INFINITE, {"type": "exponential", "surface": 1.0, "gradient": 0.7}, None, 0.3),
    case("exponential without a base, plane stress", INFINITE, {"type": "exponential", "surface": 2.0, "gradient": 0.1},
         None, 0.2, "stress"),
    case("exponential over a ratio of 1e6", RIGID, between("exponential", 1.0, 1e6), 1.0, 0.3),
    case("exponential over a ratio of 1e-6", RIGID, between("exponential", 1.0, 1e-6), 1.0, 0.3),
    case("linear, plane stress", RIGID, between("linear", 1.0, 5.0), 2.0, 0.3, "stress"),
    case("linear on a half-plane", half_plane(5.0, 0.3), between("linear", 5.0, 1.0), 1.0, 0.25),
    case("power law, exponent 2", RIGID, {"type": "power-law", "surface": 1.0, "length": 2.0, "exponent": 2.0}, 5.0),
    case("power law, exponent -1.5, without friction", SLIDING,
         {"type": "power-law", "surface": 3.0, "length": 2.0, "exponent": -1.5}, 5.0, 0.35),
    case("power law, exponent 0.5, incompressible", RIGID,
         {"type": "power-law", "surface": 1.0, "length": 0.5, "exponent": 0.5}, 1.0, 0.5),
    case("error function", RIGID, step("error-function", 1.0, 4.0, 0.8, 0.3), 2.0),
    case("error function, steep, on a half-plane", half_plane(0.25, 0.35), step("error-function", 2.0, 0.5, 0.5, 0.05),
         1.0, 0.2),
    case("sigmoid, incompressible, without friction", SLIDING, step("sigmoid", 5.0, 1.0, 0.4, 0.2), 1.0, 0.5),
    case("sigmoid, Young's moduli, plane stress", RIGID, step("sigmoid", 1.0, 10.0, 1.5, 0.4), 3.0, 0.3, "stress", "young"),
    case("formula", RIGID, {"type": "formula", "modulus": "1 + 0.5*sin(3*y)"}, 2.0, 0.3),
    case("formula of both constants", RIGID, {"type": "formula", "modulus": "2 - exp(-y)", "poisson": "0.2 + 0.1*y"}, 2.0),
    case("formula of both constants, Young's moduli, on a half-plane", half_plane(2.0, 0.1),
         {"type": "formula", "modulus": "1 + 0.5*sin(3*y)", "poisson": "0.2 + 0.1*y"}, 1.0, 0.3, "strain", "young"),
    case("formula of Poisson's ratio, plane stress, without friction", SLIDING,
         {"type": "formula", "modulus": "2 - exp(-y)", "poisson": "0.2 + 0.1*y"}, 2.0, 0.3, "stress"),
    case("volume fraction, mixture, exponent 2", RIGID, mixture("mixture", (1.0, 0.35), (6.0, 0.2), 2.0), 1.0, 0.35),
    case("volume fraction, mixture, exponent 0.5: an infinite gradient at the surface", half_plane(6.0, 0.2),
         mixture("mixture", (1.0, 0.35), (6.0, 0.2), 0.5), 1.0, 0.35),
    case("volume fraction, Mori-Tanaka, Young's moduli", RIGID, mixture("mori-tanaka", (70.0, 0.33), (420.0, 0.17), 1.0),
         2.0, 0.33, "strain", "young"),
    case("volume fraction, Mori-Tanaka, exponent 1.5, without friction", SLIDING,
         mixture("mori-tanaka", (2.0, 0.2), (0.5, 0.4), 1.5), 1.0, 0.2),
    case("three homogeneous layers", RIGID, stack((0.5, 1.0, 0.3), (1.0, 3.0, 0.25), (0.8, 0.5, 0.35)), 2.3),
    case("three homogeneous layers, Young's moduli, without friction", SLIDING,
         stack((0.5, 1.0, 0.3), (1.0, 3.0, 0.25), (0.8, 0.5, 0.35)), 2.3, 0.3, "strain", "young"),
    case("graded interlayer on a half-plane", half_plane(8.0, 0.28),
         stack((0.5, 1.0, 0.3), (0.4, between("exponential", 1.0, 8.0), 0.3), (0.6, 8.0, 0.3)), 1.5),
    case("coating of 1e-6", RIGID, stack((1e-6, 5.0, 0.25), (1.0, 1.0, 0.3)), 1.000001),
    case("soft layer on one a million times stiffer", RIGID, stack((0.3, 1.0, 0.3), (0.7, 1e6, 0.3)), 1.0),
    case("stiff layer on one a million times softer", half_plane(1e-6, 0.3), stack((0.3, 1.0, 0.3), (0.7, 1e-6, 0.3)), 1.0),
    case("incompressible interlayer, plane strain", RIGID, stack((0.2, 1.0, 0.3), (0.1, 0.05, 0.5), (0.7, 2.0, -0.5)), 1.0),
]


# Checks of the script -------------------------------------------------------------------------------------------------

# Computed for this project by other programs; plugins/flexibilities/src/fixtures.rs and magnus.rs.
GOLDEN = [
    (0.3, -13.8, 0.001, [29.121806940410983281, 100.44260076766072412, 0.013278462999273003777]),
    (0.3, -13.8, 12.0, [4.1140074734761803339, 1.7707140069300995418, -1.4029818260883636241]),
    (0.3, 13.8, 0.001, [0.000029577018237761163822, 0.00010351956189088842097, 1.0716159995293210832e-9]),
    (0.5, -13.8, 0.7, [332.29028540707994518, 10.203580001549805437, -10.386545099672280155]),
    (0.5, 13.8, 0.001, [1.5218581329435147698e-12, 0.00014492738447308798203, 1.0501836858439994167e-8]),
    (0.5, 2.0, 5.0, [0.56611563863712319894, 0.83687954819652376388, 0.13141612251042790576]),
    (-0.99, -13.8, 12.0, [2.5986360921612935031, 1.6671172043167634852, -1.5694311867380075783]),
    (-0.99, 13.8, 12.0, [0.42749053583324553211, 0.51711728654663953695, -0.31349647484503867]),
]
TWO_LAYERS = [
    [0.0014030652669467727143, 0.0049105789710694541855, 1.8333248922619624069e-6],
    [0.14173485284160875022, 0.40772625291107262004, 0.0061087460323505935931],
    [0.99745009365220761592, 0.99827378205122040048, -0.28361741038994007546],
]
POWER_LAW = [
    [0.0027211041091330635755, 0.009523168317859985147, 5.8872948572039376961e-6],
    [0.27732038640847239493, 0.61234724590284362674, 0.0074743399384353587663],
    [0.94274079590762698323, 0.97593453547825306552, -0.26227116594969684214],
]


def checks():
    def compare(what, got, expected, tolerance):
        error = distance(got, [mpf(x) for x in expected])
        assert error < tolerance, (what, mp.nstr(error, 3))

    for nu, gamma, s, expected in GOLDEN:
        # exp(gamma) as a ratio of moduli with all digits, which a scene would not carry.
        c = case("", RIGID, {"type": "exponential", "surface": 1.0, "gradient": gamma}, 1.0, nu)
        compare(("golden", nu, gamma, s), flexibility(c, s), expected, 1e-15)
    power = case("", RIGID, {"type": "power-law", "surface": 1.0, "length": 2.0, "exponent": 2.0})
    two = case("", RIGID, stack((0.25, 1.0, 0.3), (0.75, 8.0, 0.3)))
    for s, p, t in zip([0.01, 1.0, 20.0], POWER_LAW, TWO_LAYERS):
        compare(("power law", s), flexibility(power, s), p, 1e-15)
        compare(("two layers", s), flexibility(two, s), t, 1e-15)
    for w in map(mpf, ["1e-4", "0.1", "1", "10", "40"]):
        for nu in [0.3, 0.5, -0.99]:
            n, kappa = number(nu), 3 - 4 * number(nu)
            bonded = (kappa * mp.sinh(2 * w) - 2 * w) / (
                kappa * mp.cosh(2 * w) + 2 * w * w + 5 - 12 * n + 8 * n * n)
            got = flexibility(case("", RIGID, homogeneous(3.0), 2.0, nu), w)
            assert abs(got[0] / bonded - 1) < AGREE, ("bonded", nu, w)
            sliding = 2 * mp.sinh(w) ** 2 / (2 * w + mp.sinh(2 * w))
            got = flexibility(case("", SLIDING, homogeneous(3.0), 2.0, nu), w)
            assert abs(got[0] / sliding - 1) < AGREE, ("without friction", nu, w)
            got = flexibility(case("", half_plane(3.0, nu), homogeneous(3.0), 2.0, nu), w)
            limit = [mpf(1), mpf(1), -(kappa - 1) / (kappa + 1)]
            assert distance(got, limit) < AGREE, ("half-plane", nu, w)
        # A layer that is thick against the wave forgets its base: the infinite solid, got by eigenvectors.
        endless = flexibility(case("", INFINITE, {"type": "exponential", "surface": 1.0, "gradient": 0.7}, None), w)
        if w >= 1:
            h = mpf(60)
            thick = case("", RIGID, {"type": "exponential", "surface": 1.0, "gradient": 0.7}, 60.0)
            got = flexibility(thick, w * number(0.7) * h)
            assert distance(got, endless) < AGREE, ("infinite", w)


def solved(index):
    c = CASES[index]
    rows, worst = [], mpf(0)
    for wave in WAVES:
        once, twice = flexibility(c, wave), flexibility(c, wave, 2)
        worst = max(worst, distance(once, twice))
        rows.append(twice)
    assert worst < AGREE, (c["about"], mp.nstr(worst, 3))
    return rows, mp.nstr(worst, 3)


ABOUT = (
    "Scaled surface flexibilities s Fvv/A0, s Fuu/A0, s Fuv/A0 (vv, uu, uv; A0 of the surface) at wave numbers s in units of "
    "1/thickness (of |gradient| without a base), 17 digits, written by flexibilities.py. plane, poisson, thickness, base, "
    "grading and moduli are the keys of a scene's [layer]; thickness null: left out."
)


def main():
    checks()
    print("checks passed", flush=True)
    cases = []
    with Pool(2) as pool:
        for c, (rows, worst) in zip(CASES, pool.imap(solved, range(len(CASES)))):
            print(f"{c['about']}: steps halved: {worst}", flush=True)
            columns = [[mp.nstr(row[i], 17, min_fixed=0, max_fixed=0) for row in rows] for i in range(3)]
            keys = {k: v for k, v in c.items() if not k.startswith("_")}
            lines = [f'    {json.dumps(k)}: {json.dumps(v)}' for k, v in keys.items()]
            lines.append(f'    "s": [{", ".join(WAVES)}]')
            lines += [f'    "{name}": [{", ".join(column)}]' for name, column in zip(["vv", "uu", "uv"], columns)]
            cases.append("  {\n" + ",\n".join(lines) + "\n  }")
    text = '{\n"about": ' + json.dumps(ABOUT) + ',\n"cases": [\n' + ",\n".join(cases) + "\n]\n}\n"
    json.loads(text)
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "flexibilities.json"), "w") as file:
        file.write(text)


if __name__ == "__main__":
    main()
