"""Reference displacements of difficult layered grounds, in multiple precision.

Needs Python 3 with mpmath (and gmpy2 for speed).  python reference_figures.py > computed_difficult.csv

Method, on purpose a different one from the crate's: for every wavenumber m the state (U, W, tau/m, sigma/m) is carried
from the base to the surface with the plain transfer matrix exp(-H m h), in 55 digits plus the 2 m H/ln 10 that its
growing exponentials lose.  H holds the equations of equilibrium and Hooke's law.  The Hankel integral is a
Gauss-Legendre sum on panels graded toward m = 0 and no longer than four turns of the Bessel function at the largest radius,
ended where exp(-m z) < 1e-17.  Radii beyond 50 depths are left out, for the time they take.  At depth 0 (point load only) the uppermost soil's half-space is subtracted, so that the
integrand decays with exp(-2 m h), and Boussinesq's closed form is added.  Option --check repeats every depth with panels of
0.6 times the length and prints the largest change as a share of the peak.

Points: radii r_mm; systems below in mm, MPa.  Load: 100 kN on a disc of radius a_mm (0: point load).
"""

import sys
from mpmath import mp, mpf, matrix, eye, cosh, sinh, exp, besselj, pi, log, ceil

DIGITS = 55

SYSTEMS = {
    # name: (thickness, modulus, Poisson's ratio, contact radius, depths, radii); no modulus for the base: rock
    "soft_band": ([300, 100, 500], [1000, 0.1, 1000, 100], [0.3, 0.4, 0.25, 0.35], 150,
                  [300, 350, 400, 1200], [0, 150, 1000, 5000, 50000]),
    "stiff_sheet_2mm": ([200, 2, 500], [100, 1e6, 100, 50], [0.35, 0.3, 0.35, 0.4], 150,
                        [201, 202, 700], [0, 300, 2000, 50000]),
    "soft_sheet_2mm": ([200, 2, 500], [1000, 0.1, 1000, 500], [0.35, 0.5, 0.35, 0.5], 0,
                       [200, 201, 202, 1200], [0, 100, 1000, 50000]),
    "incompressible": ([50, 300, 1000], [3000, 30, 300, 60], [0.5, 0.5, 0.5, 0.5], 150,
                       [50, 350, 2000], [0, 200, 1500, 50000]),
    "ten_layers": ([40, 60, 120, 30, 200, 300, 10, 500, 700, 1000],
                   [8000, 3000, 300, 9000, 80, 400, 5, 250, 1000, 40, 120],
                   [0.35, 0.3, 0.4, 0.2, 0.45, 0.35, 0.5, 0.3, 0.25, 0.49, 0.4], 120,
                   [100, 455, 760, 1500, 4000], [0, 200, 1200, 8000, 50000]),
    "twenty_layers": ([20, 35, 50, 2, 75, 100, 150, 5, 200, 250, 60, 90, 300, 400, 12, 500, 650, 800, 1000, 3000],
                      [5000, 2000, 800, 20000, 300, 500, 120, 2, 60, 200, 4000, 50, 90, 30, 10000, 150, 70, 200, 25, 400, 1000],
                      [0.35, 0.35, 0.3, 0.2, 0.35, 0.4, 0.45, 0.5, 0.3, 0.35, 0.25, 0.4, 0.49, 0.35, 0.15, 0.3, 0.35, 0.4, 0.45, 0.3, 0.25],
                      150, [432, 1200, 5000], [0, 300, 2500, 50000]),
    "shallow_rock": ([300], [50], [0.5], 150, [100, 290, 299.9], [0, 150, 400, 2000, 50000]),
    "deep_rock": ([10000, 10000], [100, 1000], [0.5, 0.3], 0, [1200, 10000, 19000], [0, 1000, 10000, 50000]),
    "soft_on_rock": ([50, 400, 3000], [4000, 0.4, 4000], [0.3, 0.45, 0.2], 150, [50, 250, 450, 2000], [0, 200, 1000, 50000]),
    "thick_contrast": ([10000, 10000], [10000, 1, 10000], [0.2, 0.45, 0.3], 150, [5000, 10000, 12000], [0, 3000, 20000, 50000]),
    "contrast_1e8": ([200, 300], [1e5, 10, 1e-3], [0.2, 0.35, 0.45], 150, [200, 1200], [0, 1000, 10000, 50000]),
    "sandwich_1e8": ([200, 300, 500], [1000, 1e-1, 1e3, 1e-1], [0.2, 0.35, 0.3, 0.45], 0, [350, 1200], [0, 1000, 10000, 50000]),
    "soft_skin_2mm": ([2], [1, 1e4], [0.5, 0.3], 20, [1, 2, 40], [0, 10, 21, 100]),
    "stiff_skin_2mm": ([2], [1e4, 1], [0.3, 0.5], 20, [2, 40, 1200], [0, 10, 100, 500]),
    "surface_stiff": ([100, 300], [5000, 100, 40], [0.3, 0.4, 0.35], 0, [0], [10, 100, 1000, 50000]),
    "surface_soft": ([50, 300], [5, 5000, 40], [0.45, 0.2, 0.5], 0, [0], [5, 50, 500, 10000]),
}


def generator(E, nu):
    mu = E / (2 * (1 + nu))
    a = nu / (1 - nu)
    H = matrix(4, 4)
    H[0, 1], H[0, 2] = 1, 1 / mu
    H[1, 0], H[1, 3] = -a, (1 - 2 * nu) / (2 * mu * (1 - nu))
    H[2, 0], H[2, 3] = 2 * mu / (1 - nu), a
    H[3, 2] = -1
    N = H * H - eye(4)
    return H, N, H * N


def upward(material, x):
    """exp(-H x); (H^2 - 1)^2 = 0."""
    H, N, HN = material
    c, s = cosh(x), sinh(x)
    return c * eye(4) - s * H + (x * s / 2) * N - ((x * c - s) / 2) * HN


def decaying(E, nu):
    """Two solutions of the half-space that decay downward, at its top."""
    mu, k = E / (2 * (1 + nu)), 3 - 4 * nu
    return matrix([[1, 0], [1, k], [-2 * mu, mu * (1 - k)], [-2 * mu, -mu * (1 + k)]])


class Ground:
    def __init__(self, h, E, nu, depth):
        h, E, nu = [mpf(str(v)) / 1000 for v in h], [mpf(str(v)) * 10**6 for v in E], [mpf(str(v)) for v in nu]
        self.depth = mpf(str(depth)) / 1000
        self.top = (E[0], nu[0], h[0] if h else None)
        self.base = (E[-1], nu[-1]) if len(E) > len(h) else None
        self.total = sum(h)
        # pieces (thickness, material) from the bottom up, cut at the depth
        self.below, self.above, level = [], [], mpf(0)
        for i, thickness in enumerate(h):
            material = generator(E[i], nu[i])
            cut = min(max(self.depth - level, mpf(0)), thickness)
            if cut > 0:
                self.above.insert(0, (cut, material))
            if cut < thickness:
                self.below.insert(0, (thickness - cut, material))
            level += thickness
        self.beneath = max(self.depth - level, mpf(0))
        if self.beneath > 0:
            self.base_material = generator(*self.base)

    def kernel(self, m):
        """(U, W) m at the depth for unit surface pressure."""
        lost = int(ceil(2 * m * max(self.total, self.depth) / log(10)))
        with mp.workdps(DIGITS + lost):
            if self.base:
                y = decaying(*self.base)
            else:
                y = matrix([[0, 0], [0, 0], [1, 0], [0, 1]])
            at_depth = y
            if self.beneath > 0:
                H, N, HN = self.base_material
                x = m * self.beneath
                # exp(H x) on decaying solutions: minus the argument of upward()
                at_depth = upward((H, N, HN), -x) * y
            for thickness, material in self.below:
                y = upward(material, m * thickness) * y
            if self.below or self.beneath == 0:
                at_depth = y
            for thickness, material in self.above:
                y = upward(material, m * thickness) * y
            # tau = 0, sigma/m = -1/m: times m
            det = y[2, 0] * y[3, 1] - y[2, 1] * y[3, 0]
            c0, c1 = y[2, 1] / det, -y[2, 0] / det
            return (at_depth[0, 0] * c0 + at_depth[0, 1] * c1, at_depth[1, 0] * c0 + at_depth[1, 1] * c1)


_rules = {}


def gauss(n):
    if n not in _rules:
        rule = []
        with mp.workdps(DIGITS + 10):
            for i in range(n):
                x = mp.cos(pi * (i + mpf(3) / 4) / (n + mpf(1) / 2))
                for _ in range(8):
                    p0, p1 = mpf(1), x
                    for k in range(1, n):
                        p0, p1 = p1, ((2 * k + 1) * x * p1 - k * p0) / (k + 1)
                    d = n * (x * p1 - p0) / (x * x - 1)
                    x -= p1 / d
                rule.append((x, 2 / ((1 - x * x) * d * d)))
        _rules[n] = rule
    return _rules[n]


def kept(system, depth):
    return [r for r in system[5] if r <= 50 * (depth or 2 * system[0][0])]


def displacements(system, depth, length=1):
    h, E, nu, a, _, _ = system
    force, a = mpf(100000), mpf(str(a)) / 1000
    radii = [mpf(str(r)) / 1000 for r in kept(system, depth)]
    ground = Ground(h, E, nu, depth)
    surface = depth == 0
    end = 17 * log(10) / (2 * ground.top[2] if surface else ground.depth)
    largest = max(max(radii), a)
    total = [[mpf(0), mpf(0)] for _ in radii]
    rule = gauss(26)
    start, first = mpf(0), mpf(10) ** -9 / max(ground.total, ground.depth)
    while start < end:
        stop = first if start == 0 else start + length * min(start / 2, 8 * pi / largest)
        middle, half = (start + stop) / 2, (stop - start) / 2
        for t, w in rule:
            m = middle + half * t
            u, v = ground.kernel(m)
            if surface:
                top_E, top_nu, _ = ground.top
                mu = top_E / (2 * (1 + top_nu))
                u += (1 - 2 * top_nu) / (2 * mu)
                v -= (1 - top_nu) / mu
            factor = w * half * force / (2 * pi)
            if a > 0:
                factor *= 2 * besselj(1, m * a) / (m * a)
            u, v = u * factor, v * factor
            for i, r in enumerate(radii):
                total[i][0] += u * besselj(1, m * r)
                total[i][1] += v * besselj(0, m * r)
        start = stop
    if surface:
        top_E, top_nu, _ = ground.top
        for i, r in enumerate(radii):
            total[i][0] -= (1 + top_nu) * force / (2 * pi * top_E) * (1 - 2 * top_nu) / r
            total[i][1] += (1 + top_nu) * force / (2 * pi * top_E) * 2 * (1 - top_nu) / r
    return total


def main():
    mp.dps = DIGITS
    check = "--check" in sys.argv
    names = [n for n in sys.argv[1:] if not n.startswith("-")] or list(SYSTEMS)
    if not check:
        print("case,r_mm,z_mm,ur_mm,uz_mm")
    for name in names:
        system = SYSTEMS[name]
        for depth in system[4]:
            values = displacements(system, depth)
            if check:
                again = displacements(system, depth, mpf("0.6"))
                for k in (0, 1):
                    peak = max(abs(v[k]) for v in values)
                    change = max(abs(v[k] - w[k]) for v, w in zip(values, again))
                    print(name, depth, "u_r" if k == 0 else "u_z", mp.nstr(change / peak, 3), flush=True)
                continue
            for r, (u, v) in zip(kept(system, depth), values):
                print(f"{name},{r},{depth},{mp.nstr(u * 1000, 17)},{mp.nstr(v * 1000, 17)}", flush=True)


main()
