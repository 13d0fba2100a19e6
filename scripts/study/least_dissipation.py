# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Creeping drag of a sphere in power-law fluid by the principle of least dissipation: of all incompressible flows that stick to the sphere and to
an outer one, the real one dissipates least, so that each trial flow gives an upper bound of the drag. The trial flows are streamfunctions: splines
in the logarithm of the radius times Gegenbauer functions of the polar angle. Radius and speed of the sphere are 1."""
import math

import numpy

REST = 1e-40  # square of a rate of shear below which it counts as this one
DEGREE, GRADE = 5, 1.5  # of the splines; elements at the sphere are exp(-GRADE) times those outside


def splines(x, knots, degree, derivative=0):
    """Values at x, or a derivative, of all B-splines: an array (x, splines)."""
    if degree == 0:
        return numpy.array([(x >= low) & (x < high) for low, high in zip(knots, knots[1:])], float).T
    below = splines(x, knots, degree - 1, max(derivative - 1, 0))
    out = numpy.zeros((len(x), len(knots) - degree - 1))
    for k in range(out.shape[1]):
        for first, sign in ((k, 1), (k + 1, -1)):
            width = knots[first + degree] - knots[first]
            if width > 0:
                ramp = degree if derivative else x - knots[first] if sign > 0 else knots[first + degree] - x
                out[:, k] += (sign if derivative else 1) * ramp / width * below[:, first]
    return out


def legendre(degree, mu):
    """P and its first three derivatives."""
    series = numpy.zeros(degree + 1)
    series[degree] = 1
    return [numpy.polynomial.legendre.legval(mu, numpy.polynomial.legendre.legder(series, k)) if k <= degree else 0 * mu for k in range(3)]


class Sphere:
    """Trial flows between the sphere and an outer one of this radius, at points of quadrature. rates[c] @ x + fixed[c] are four components whose
    squares add to the square of the rate of shear; weight: of the volume."""

    def __init__(self, outer, elements=20, modes=3):
        ends = math.log(outer) * numpy.expm1(GRADE * numpy.linspace(0, 1, elements + 1)) / math.expm1(GRADE)
        knots = numpy.concatenate([[ends[0]] * DEGREE, ends, [ends[-1]] * DEGREE])
        node, share = numpy.polynomial.legendre.leggauss(DEGREE + 2)
        s = numpy.concatenate([(a + b) / 2 + (b - a) / 2 * node for a, b in zip(ends, ends[1:])])
        of_s = numpy.concatenate([(b - a) / 2 * share for a, b in zip(ends, ends[1:])])
        mu, of_mu = numpy.polynomial.legendre.leggauss(8 * modes + 16)
        mu, of_mu = mu[mu > 0], 2 * of_mu[mu > 0]  # both halves are alike
        f, f_s, f_ss = (splines(s, knots, DEGREE, k) for k in range(3))
        r = numpy.exp(s)[:, None]
        self.weight = (2 * math.pi * (r[:, 0] ** 3 * of_s)[:, None] * of_mu).ravel()
        # At both spheres value and slope are given: the first two splines and the last two. f = 1/2 and f_s = 1 for l = 1 at the inner one.
        given = 0.5 * f[:, 0], 0.5 * f_s[:, 0], 0.5 * f_ss[:, 0]
        second = 0.5 + (knots[DEGREE + 1] - knots[1]) / DEGREE
        given = [a + second * b[:, 1] for a, b in zip(given, (f, f_s, f_ss))]
        self.fixed = self.components(r, mu, 1, *given)
        self.rates = numpy.stack([self.components(r, mu, 2 * mode + 1, f[:, k], f_s[:, k], f_ss[:, k]) for mode in range(modes)
                                  for k in range(2, f.shape[1] - 2)], axis=2)

    @staticmethod
    def components(r, mu, degree, f, f_s, f_ss):
        """Of the streamfunction f (1 - mu^2) P'(mu); f and its derivatives by s = ln r."""
        f, slope, curve = f[:, None], f_s[:, None] / r, (f_ss - f_s)[:, None] / r ** 2
        p, p1, p2 = legendre(degree, mu)
        sine, twice = numpy.sqrt(1 - mu ** 2), degree * (degree + 1)
        out, along = twice * f / r ** 2 * p, -slope / r * sine * p1  # velocity outward, and along the meridian
        of_out, of_along = twice * (slope / r ** 2 - 2 * f / r ** 3) * p, -slope / r * (mu * p1 - sine ** 2 * p2)
        shear = -(curve / r - slope / r ** 2) * sine * p1 - along / r - twice * f / r ** 3 * sine * p1
        return numpy.stack([math.sqrt(2) * of_out, math.sqrt(2) * (of_along + out) / r, math.sqrt(2) * (out + along * mu / sine) / r,
                            shear]).reshape(4, -1)

    def squared(self, x):
        """Square of the rate of shear."""
        return ((self.rates @ x + self.fixed) ** 2).sum(0)

    def least(self, n, x):
        """Newton's method for the flow of least integral of the rate^(n+1), from the flow x of another index."""
        for _ in range(60):
            rate = self.rates @ x + self.fixed
            square = numpy.maximum((rate ** 2).sum(0), REST)
            viscosity = self.weight * square ** ((n - 1) / 2)
            slope = numpy.einsum("cpk,cp->k", self.rates, viscosity * rate)
            curve = (n - 1) * viscosity / square
            joint = numpy.einsum("cpk,cp->pk", self.rates, rate)
            hessian = (joint * curve[:, None]).T @ joint
            for one in self.rates:
                hessian += (one * viscosity[:, None]).T @ one
            step, total = -numpy.linalg.solve(hessian, slope), (viscosity * square).sum()
            share = 1.0
            while (self.weight * self.squared(x + share * step) ** ((n + 1) / 2)).sum() > total * (1 + 1e-14) and share > 1e-6:
                share /= 2
            x = x + share * step
            if abs(slope @ step) < 1e-12 * total:
                return x
        raise ArithmeticError(f"the flow of index {n:g} is not found in 60 steps")

    def flow(self, n):
        """The least flow, by way of indices between."""
        x = numpy.zeros(self.rates.shape[2])
        for between in [*numpy.arange(1.0, n + 1e-9, -0.1), n]:
            x = self.least(between, x)
        return x

    def drag(self, n, x):
        """C_s = F/(3 pi k (U/d)^n d^2)."""
        return (self.weight * self.squared(x) ** ((n + 1) / 2)).sum() * 2 ** n / (12 * math.pi)


def power_law_factor(n, outer, **size):
    """C_s at this outer radius."""
    sphere = Sphere(outer, **size)
    return float(sphere.drag(n, sphere.flow(n)))
