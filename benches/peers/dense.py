#!/usr/bin/env python3
"""The split method in dense numpy: a flat punch on an exponentially graded layer, bonded to a rigid base, half-width 1.

An implementation of docs/theory.md, sections 2 and 3, that shares no line with slipzone and little of its road: the
flexibility comes from a 4 by 4 system of exponentials in place of a closed form, the kernel's Fourier integral from one
Gauss rule in place of Legendre panels, its smooth part from one Chebyshev interpolant, the root of the friction curve
from scipy's brentq. No estimate of any error: whoever calls chooses the resolution.

    python benches/peers/dense.py        # a JSON object for each of a few resolutions
"""

import json
import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import brentq
from scipy.special import sici


@dataclass(frozen=True)
class Layer:
    """Modulus exp(gamma y) from 1 at the surface to `ratio` at the depth `thickness`, in plane strain."""

    thickness: float
    ratio: float
    nu: float

    @property
    def gamma(self):
        return math.log(self.ratio) / self.thickness

    @property
    def kappa(self):
        return 3 - 4 * self.nu

    @property
    def beta(self):
        return (self.kappa - 1) / (self.kappa + 1)

    @property
    def a0(self):
        return (self.kappa + 1) / 4


@dataclass(frozen=True)
class Resolution:
    """What decides accuracy and time."""

    waves: int = 40  # nodes of the Fourier integral
    reach: float = 30.0  # it ends at reach/thickness, where the series takes over
    terms: int = 16  # of the series
    smooth: int = 48  # nodes of the interpolant; even, so that none is 0
    contact: int = 24  # nodes of the half contact, and of the half stick zone
    slip: int = 120  # nodes of the slip zone
    u_max: float = 3.7  # where the double-exponential grids end


# --- The layer: s F(s)/A0, and the coefficients of its powers of gamma/s ---------------------------------------------


def flexibility(layer, s):
    """s F/A0 as an array of 2 by 2 matrices in the order (u, v)."""
    kappa, beta, eps = layer.kappa, layer.beta, layer.gamma / s
    lam, zero, one = (3 - kappa) / (1 + kappa), 0 * s, 1 + 0 * s
    # States (U, V, sigma_xy/(mu s), sigma_yy/(mu s)): their derivative is s times this matrix times them.
    system = np.array(
        [
            [zero, one, one, zero],
            [-lam * one, zero, zero, beta * one],
            [8 / (1 + kappa) * one, zero, -eps, lam * one],
            [zero, zero, -one, -eps],
        ]
    )
    roots, modes = np.linalg.eig(np.moveaxis(system, 2, 0))
    # What decays is anchored at the surface and what grows at the base, so that no exponential overflows.
    decay = np.exp(-np.abs(roots.real) * (s * layer.thickness)[:, None])
    phase = np.exp(1j * roots.imag * (s * layer.thickness)[:, None])
    grows = roots.real > 0
    top = modes * np.where(grows, decay / phase, 1)[:, None, :]
    base = modes * np.where(grows, 1, decay * phase)[:, None, :]
    conditions = np.concatenate([top[:, 2:, :], base[:, :2, :]], axis=1)
    unit_tractions = np.broadcast_to(np.eye(4, 2), (len(s), 4, 2))
    compliance = top[:, :2, :] @ np.linalg.solve(conditions, unit_tractions)
    return -compliance.real / layer.a0


def series(layer, terms):
    """Matrices c_1, c_2, ... of s F/A0 = c_0 + sum c_k (gamma/s)^k: the Riccati equation order by order."""
    kappa, beta = layer.kappa, layer.beta
    a = np.array([[0, 1], [-(3 - kappa) / (1 + kappa), 0]])
    d = np.diag([8 / (1 + kappa), 0])
    c = [-(kappa + 1) / 4 * np.array([[1, -beta], [-beta, 1]])]
    x = a - c[0] @ d
    sylvester = np.kron(x, np.eye(2)) + np.kron(np.eye(2), x)
    for k in range(1, terms + 1):
        right = -c[k - 1] + sum((c[j] @ d @ c[k - j] for j in range(1, k)), np.zeros((2, 2)))
        c.append(np.linalg.solve(sylvester, right.ravel()).reshape(2, 2))
    return -np.array(c[1:]) / layer.a0


# --- Kernels: k(t) = A(t) + sign(t) E(t) + log|t| O(t) ----------------------------------------------------------------


class Kernel:
    """`int_0^cut values(s) exp(ist) ds + sum coefficients_k int_cut^inf s^-k exp(ist) ds`: its imaginary part, which is
    odd, or its real part, which is even; and `extra(t)`, which is smooth and has the same parity."""

    def __init__(self, rule, cut, values, coefficients, is_odd, smooth, extra=np.zeros_like):
        s, weights = rule
        part = (lambda z: z.imag) if is_odd else (lambda z: z.real)
        t = 2 * np.cos(np.pi * (np.arange(smooth // 2) + 0.5) / smooth)
        # E_k(-i cut t) by recurrence from E_1 = -Ci + i (pi/2 - Si).
        si, ci = sici(cut * t)
        tail, e = 0, -ci + 1j * (np.pi / 2 - si)
        for k, coefficient in enumerate(coefficients, 1):
            tail = tail + coefficient * cut ** (1 - k) * e
            e = (np.exp(1j * cut * t) + 1j * cut * t * e) / k
        whole = part(np.exp(1j * np.outer(t, s)) @ (weights * values) + tail)
        # What the tail has of singularities: P(t) (i pi/2 - log t), P = sum coefficients_k (it)^(k-1)/(k-1)!.
        p = np.array([c * 1j ** (k % 4) / math.factorial(k) for k, c in enumerate(coefficients)])
        self.jump, self.log = part(1j * np.pi / 2 * p)[::-1], part(-p)[::-1]
        right = whole - np.polyval(self.jump, t) - np.log(t) * np.polyval(self.log, t) + extra(t)
        # First-kind nodes fall from 2 to -2.
        samples = np.concatenate([right, (-1 if is_odd else 1) * right[::-1]])
        j = np.arange(smooth)
        transform = np.cos(np.pi * np.outer(j, j + 0.5) / smooth) * 2 / smooth
        self.chebyshev = transform @ samples
        self.chebyshev[0] /= 2

    def __call__(self, t, sign, log):
        """With what stands for sign(t) and log|t|: themselves, or their product weights."""
        smooth = chebyshev.chebval(t / 2, self.chebyshev)
        return smooth + sign * np.polyval(self.jump, t) + log * np.polyval(self.log, t)

    def weighed(self, t, steps):
        """Integrated against the sinc function whose node is so many steps away."""
        si, ci = sici(np.pi * np.abs(steps))
        return self(t, 2 / np.pi * np.sign(steps) * si, np.log(np.abs(t)) - ci)


def kernels(layer, resolution):
    """k_vv, k_uu, k_uv, and what an even density makes of the depth: G/A0 with its logarithm -log|t| told apart."""
    cut = resolution.reach / layer.thickness
    nodes, weights = np.polynomial.legendre.leggauss(resolution.waves)
    s, weights = cut * (nodes + 1) / 2, cut * weights / 2
    m = flexibility(layer, s) - np.array([[1, -layer.beta], [-layer.beta, 1]])
    c = series(layer, resolution.terms) * (layer.gamma ** np.arange(1, resolution.terms + 1))[:, None, None]
    of = lambda i, j, is_odd: Kernel((s, weights), cut, m[:, i, j], c[:, i, j], is_odd, resolution.smooth)
    length = 40 / cut  # exp(-length s) is gone at the cut
    depth_values = (m[:, 1, 1] + np.exp(-length * s)) / s
    depth = Kernel((s, weights), cut, depth_values, np.concatenate([[0], c[:, 1, 1]]), False, resolution.smooth,
                   lambda t: np.log(t**2 + length**2) / 2)
    return of(1, 1, True), of(0, 0, True), of(0, 1, False), depth


# --- Grids: x = half tanh(w), w = pi/2 sinh(u) ------------------------------------------------------------------------


class Grid:
    """Nodes or collocation points at `u`, with the distance to the nearer end kept apart from rounding."""

    def __init__(self, u, half):
        self.u, self.half, self.w = u, half, np.pi / 2 * np.sinh(u)
        self.x = half * np.tanh(self.w)
        self.gap = half * np.exp(-np.abs(self.w)) / np.cosh(self.w)
        self.slope = half * np.pi / 2 * np.cosh(u) / np.cosh(self.w) ** 2
        self.root = half / np.cosh(self.w)  # sqrt(half^2 - x^2)

    def minus(self, other):
        """x - x' for all pairs on one interval, without cancellation."""
        difference = self.w[:, None] - other.w[None, :]
        return self.half * np.sinh(difference) / np.cosh(self.w)[:, None] / np.cosh(other.w)[None, :]


def staggered(n, u_max, half):
    """Nodes at all steps, and collocation points half-way between those on the right."""
    step = u_max / n
    return step, Grid(step * np.arange(-n, n + 1), half), Grid(step * (np.arange(n) + 0.5), half)


def folded(matrix, parity):
    """Columns of the nodes -n..n as those of the nodes 0..n of a density of that parity."""
    n = matrix.shape[1] // 2
    right = matrix[:, n:].copy()
    right[:, 1:] += parity * matrix[:, :n][:, ::-1]
    return right


# --- The contact --------------------------------------------------------------------------------------------------------


class FlatPunch:
    """Pressure of unit force under a flat punch, and the shear of Goodman friction."""

    def __init__(self, layer, resolution=Resolution()):
        self.layer, self.resolution = layer, resolution
        self.k_vv, self.k_uu, self.k_uv, depth = kernels(layer, resolution)
        n = resolution.contact
        self.step, self.nodes, points = staggered(n, resolution.u_max, 1.0)
        t, steps = points.minus(self.nodes), (points.u[:, None] - self.nodes.u[None, :]) / self.step
        regular = self.step / np.pi * folded(self.k_vv.weighed(t, steps), 1)
        matrix = np.zeros((n + 1, n + 1))
        scale = (points.slope / points.root)[:, None]
        matrix[:n] = scale * (self.step / np.pi * folded(1 / t, 1) + regular)
        matrix[n] = folded(np.full((1, 2 * n + 1), self.step), 1)
        half = np.linalg.solve(matrix, np.eye(n + 1)[n])
        self.density = np.concatenate([half[:0:-1], half])  # p x'
        self.centre = half[0] / self.nodes.slope[n]
        moved = -regular @ half
        self.edge = (1 - 2 * self.step * np.sum(points.slope * points.x * moved / points.root)) / np.pi
        # v at the right edge, where distances are gaps.
        gap = np.where(self.nodes.u > 0, self.nodes.gap, 1 - self.nodes.x)
        moves = depth(gap, 1, np.log(gap)) - np.log(gap)
        self.indentation = layer.a0 / np.pi * self.step * np.sum(self.density * moves)

    def pressure(self, x, gap):
        """p at points whose distance to the edge is `gap`, by the density's sinc functions."""
        w = np.log((1 + x) / gap) / 2
        u = np.arcsinh(2 * w / np.pi)
        sinc = np.sinc((u[:, None] - self.nodes.u[None, :]) / self.step)
        return sinc @ self.density / Grid(u, 1.0).slope, u

    def friction(self, stick):
        """The friction coefficient that belongs to a stick zone: the last unknown of one system."""
        n, beta = self.resolution.contact, self.layer.beta
        step, nodes, points = staggered(n, self.resolution.u_max, stick)
        steps = (points.u[:, None] - nodes.u[None, :]) / step
        t = points.minus(nodes)
        matrix = np.zeros((n + 1, n + 1))  # Q_1 .. Q_n, eta
        matrix[:n, :n] = step / np.pi * folded(1 / t + self.k_uu.weighed(t, steps), -1)[:, 1:]
        # The slip zone's shear is eta p, of either sign on either side.
        u, slip_step = np.linspace(-self.resolution.u_max, self.resolution.u_max, self.resolution.slip, retstep=True)
        slip = Grid(u, (1 - stick) / 2)
        to_stick = np.where(u < 0, slip.gap, 1 - stick - slip.gap)
        to_edge = np.where(u > 0, slip.gap, 1 - stick - slip.gap)
        weights = slip_step * slip.slope * self.pressure(stick + to_stick, to_edge)[0]
        near = -(points.gap[:, None] + to_stick[None, :])
        far = points.x[:, None] + (stick + to_stick)[None, :]
        slides = lambda t: 1 / t + self.k_uu(t, np.sign(t), np.log(np.abs(t)))
        matrix[:n, n] = (slides(near) - slides(far)) @ weights / np.pi
        pressure, u = self.pressure(points.x, 1 - points.x)
        across = points.x[:, None] - self.nodes.x[None, :]
        coupling = self.k_uv.weighed(across, (u[:, None] - self.nodes.u[None, :]) / self.step)
        right = np.zeros(n + 1)
        right[:n] = self.step / np.pi * coupling @ self.density - beta * pressure
        scale = points.slope / points.root
        matrix[:n] *= scale[:, None]
        right[:n] *= scale
        # No singularity at the ends: q sqrt(a^2 - x^2) falls like sqrt(a - x) between the last two nodes.
        last, before = 2 * n, 2 * n - 1
        matrix[n, n - 1] = nodes.root[last] / nodes.slope[last]
        matrix[n, n - 2] = -nodes.root[before] / nodes.slope[before] * math.sqrt(nodes.gap[last] / nodes.gap[before])
        matrix[n] /= np.abs(matrix[n]).max()
        return np.linalg.solve(matrix, right)[n]

    def stick(self, eta, xtol=1e-12):
        """The stick zone of a friction coefficient, in ln(a/(1 - a)); one root is taken for granted."""
        ratio = lambda along: 1 / (1 + math.exp(-along))
        return ratio(brentq(lambda along: self.friction(ratio(along)) - eta, -3.0, 6.0, xtol=xtol))


# Of growing accuracy: what they reach on the standard scene is measured, not chosen.
LADDER = [
    Resolution(waves=12, reach=8, terms=6, smooth=12, contact=4, slip=16, u_max=2.3),
    Resolution(waves=12, reach=10, terms=6, smooth=16, contact=6, slip=24, u_max=2.6),
    Resolution(waves=16, reach=14, terms=8, smooth=20, contact=10, slip=40, u_max=3.0),
    Resolution(waves=20, reach=16, terms=10, smooth=24, contact=14, slip=60, u_max=3.4),
    Resolution(waves=30, reach=20, terms=12, smooth=36, contact=24, slip=80, u_max=3.7),
    Resolution(waves=40, reach=30, terms=16, smooth=48, contact=32, slip=120, u_max=3.9),
    Resolution(waves=60, reach=40, terms=20, smooth=64, contact=48, slip=300, u_max=4.2),
]


def timed(run, rounds):
    """What it gives, and the shortest of so many times."""
    times = []
    for _ in range(rounds):
        started = time.perf_counter()
        found = run()
        times.append(time.perf_counter() - started)
    return found, min(times)


def main():
    layer, eta = Layer(5.0, 8.0, 0.3), 0.3
    for resolution in LADDER:
        punch, seconds = timed(lambda: FlatPunch(layer, resolution), 20)
        ratio, with_friction = timed(lambda: FlatPunch(layer, resolution).stick(eta), 5)
        print(json.dumps({
            "unknowns": resolution.contact + 1, "edge": punch.edge, "centre": punch.centre, "seconds": seconds,
            "indentation": punch.indentation, "ratio": ratio, "seconds_with_friction": with_friction,
        }), flush=True)


if __name__ == "__main__":
    main()
