"""Motion of a duct in layered ground, in high precision: an independent check of the models of the ground.

Needs Python 3.11 with numpy, scipy and python-flint.
    python independent_motion.py difficult/*.toml > independent_motion.csv
Option --check repeats everything with panels of 0.6 times the length and prints the largest change as a share of the peak.

The scenes are scene files whose quantities are bare numbers in SI.

Method.  For each wavenumber m every layer carries four solutions of the equations of equilibrium,
(U, W) = (1, 1) e^{-m t}, (m t, m t + k) e^{-m t}, (1, -1) e^{m s}, (m s, -m s + k) e^{m s}, k = 3 - 4 nu, with t measured from
the layer's top and s <= 0 from its bottom.  The surface, the interfaces and the base make one linear system of 4 unknowns a
layer and 2 for a half-space, solved as it stands in ball arithmetic of 1000 bits, whose radius bounds the rounding error (it
grows fast with the number of layers).  The Hankel integral is a sum of 20-point Gauss-Legendre rules on panels that double
from 1e-7/m and are no longer than the radius, the depth and the layers allow.  A wheel at (x, y) moves the duct along by
u_r (xi - x)/r; reverse traffic mirrors x.
"""

import sys
import tomllib
from pathlib import Path

import numpy as np
from flint import arb, arb_mat, ctx
from scipy.special import j0, j1

ctx.prec = 1000
X20, W20 = np.polynomial.legendre.leggauss(20)


def solutions(m, E, nu, t, s):
    """Columns (U, W, sigma_z/m, tau/m) of the four solutions; the first two alone where s is None."""
    mu, k = E / (2 * (1 + nu)), 3 - 4 * nu
    x = m * t
    e = (-x).exp()
    out = [
        [e, e, -2 * mu * e, -2 * mu * e],
        [x * e, (x + k) * e, -2 * mu * (x + 2 * (1 - nu)) * e, -2 * mu * (x + 1 - 2 * nu) * e],
    ]
    if s is not None:
        y = m * s
        f = y.exp()
        out += [
            [f, -f, -2 * mu * f, 2 * mu * f],
            [y * f, (k - y) * f, 2 * mu * (2 * (1 - nu) - y) * f, 2 * mu * (y - 1 + 2 * nu) * f],
        ]
    return out


def kernel(layers, base, m, depth):
    """U and W at `depth` for unit pressure at wavenumber m; layers (h, E, nu), base (E, nu) or None for rock."""
    m, zero = arb(m), arb(0)
    layers = [tuple(arb(v) for v in layer) for layer in layers]
    count = len(layers)
    size = 4 * count + (2 if base else 0)
    rows, right = [], []

    def columns(i, t):
        if i < count:
            h, E, nu = layers[i]
            return solutions(m, E, nu, t, t - h)
        return solutions(m, arb(base[0]), arb(base[1]), t, None)

    for q, value in ((2, -1 / m), (3, zero)):
        row = [zero] * size
        for j, c in enumerate(columns(0, zero)):
            row[j] = c[q]
        rows.append(row)
        right.append(value)
    for i in range(count):
        last = i + 1 == count and not base
        for q in range(2 if last else 4):
            row = [zero] * size
            for j, c in enumerate(columns(i, layers[i][0])):
                row[4 * i + j] = c[q]
            if not last:
                for j, c in enumerate(columns(i + 1, zero)):
                    row[4 * i + 4 + j] = -c[q]
            rows.append(row)
            right.append(zero)
    matrix = arb_mat(size, size, [v for row in rows for v in row])
    right = arb_mat(size, 1, right)
    top, i, depth = zero, 0, arb(depth)
    while i < count and depth > top + layers[i][0]:
        top += layers[i][0]
        i += 1
    if i == count and not base:
        return 0.0, 0.0
    here = columns(i, depth - top)
    x = matrix.solve(right, algorithm="lu")
    found = [sum((x[4 * i + j, 0] * c[q] for j, c in enumerate(here)), zero) for q in (0, 1)]
    assert all(float(v.rad()) <= 1e-20 * abs(float(v.mid())) + 1e-30 for v in found), m
    return [float(v.mid()) for v in found]


class Line:
    """The ground at one depth, for radii up to `reach`."""

    def __init__(self, layers, base, depth, reach, shrink):
        self.depth = depth
        thick = sum(layer[0] for layer in layers)
        longest = shrink * min(6 / reach, 1.5 / max(depth, 0.3), max(3 / max(thick, 0.1), 0.3))
        edges = [0.0, 1e-7]
        while edges[-1] < 40 / depth:
            edges.append(edges[-1] + min(edges[-1], longest))
        half, mid = 0.5 * np.diff(edges), 0.5 * (np.array(edges[1:]) + np.array(edges[:-1]))
        self.m = (mid[:, None] + half[:, None] * X20).ravel()
        self.w = (half[:, None] * W20).ravel()
        self.U, self.W = np.array([kernel(layers, base, float(m), depth) for m in self.m]).T

    def at(self, r, a):
        """u_r/r, du_r/dr and u_z under 1 N on a disc of radius a."""
        x = self.m * a
        p = (np.where(x < 1e-6, 0.5, j1(x) / np.where(x == 0, 1, x)) / np.pi) * self.m * self.w
        y = self.m * r
        zero, one = j0(y), j1(y)
        ratio = np.where(y < 1e-5, 0.5, one / np.where(y == 0, 1, y))
        return (
            np.sum(p * self.U * self.m * ratio),
            np.sum(p * self.U * self.m * (zero - ratio)),
            np.sum(p * self.W * zero),
        )


def motion(line, wheels, offset, sign, positions):
    """Rows D_l, D_v, dD_l/dxi."""
    out = np.zeros((3, len(positions)))
    for k, xi in enumerate(positions):
        for x, y, force, a in wheels:
            ahead = xi - sign * x
            r = np.hypot(ahead, y - offset)
            ratio, slope, down = line.at(r, a)
            share = (ahead / r) ** 2 if r > 0 else 1.0
            out[:, k] += force * np.array([ratio * ahead, down, slope * share + ratio * (1 - share)])
    return out


def peak(line, wheels, offset, sign, which):
    """Largest |D_l| (0) or |D_v| (1), by a scan and three closer ones."""
    side = max(abs(w[1] - offset) for w in wheels)
    reach = max(abs(w[0]) for w in wheels) + 10 * np.hypot(line.depth, side)
    centre, step = 0.0, reach / 600
    xs = np.arange(-600, 601) * step
    for _ in range(4):
        values = np.abs(motion(line, wheels, offset, sign, xs)[which])
        centre = xs[values.argmax()]
        xs = centre + np.linspace(-step, step, 41)
        step /= 10
    return values.max()


def scene(path, shrink=1.0):
    text = tomllib.loads(Path(path).read_text())
    ground, duct, vehicle = text["ground"], text["duct"], text["vehicles"][0]
    soils = [(s.get("thickness"), s["young_modulus"], s["poisson_ratio"]) for s in ground["layers"]]
    if "rigid_base_depth" in ground:
        last = ground["rigid_base_depth"] - sum(s[0] for s in soils[:-1])
        layers, base = soils[:-1] + [(last, *soils[-1][1:])], None
    else:
        layers, base = soils[:-1], soils[-1][1:]
    wheels = [(w.get("x", 0.0), w.get("y", 0.0), w["load"], w.get("contact_radius", 0.0)) for w in vehicle["wheels"]]
    sign = -1.0 if vehicle.get("direction") == "reverse" else 1.0
    offset, depth = duct.get("lateral_offset", 0.0), duct["depth"]
    extent = max(abs(w[0]) for w in wheels)
    positions = np.round(np.concatenate([[-12.0], np.linspace(-extent - 3 * depth, extent + 3 * depth, 27), [12.0]]), 6)
    line = Line(layers, base, depth, 12 + extent + abs(offset), shrink)
    values = motion(line, wheels, offset, sign, positions)
    for key, which in (("longitudinal_peak", 0), ("vertical_peak", 1)):
        if key in ground:
            values *= ground[key] / peak(line, wheels, offset, sign, which)
    values[2] *= -sign * vehicle["speed"]
    return positions, values


if __name__ == "__main__":
    check = sys.argv[1] == "--check"
    if not check:
        print("scene,position_m,longitudinal_m,vertical_m,longitudinal_velocity_m_per_s")
    for path in sorted(sys.argv[2 if check else 1 :]):
        positions, values = scene(path)
        if check:
            other = scene(path, 0.6)[1]
            print(Path(path).stem, *(np.abs(values - other).max(axis=1) / np.abs(values).max(axis=1)))
        else:
            for xi, (dl, dv, v) in zip(positions, values.T):
                print(f"{Path(path).stem},{xi!r},{dl:.14e},{dv:.14e},{v:.12e}".replace("np.float64(", "").replace(")", ""))
        sys.stdout.flush()
