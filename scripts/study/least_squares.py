# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Weighted linear least squares of a few unknowns: pure formulas."""


def solve(matrix, right):
    """Solution of a small symmetric system by elimination with pivots; None where it is singular."""
    size = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for k in range(size):
        best = max(range(k, size), key=lambda i: abs(rows[i][k]))
        if abs(rows[best][k]) < 1e-300:
            return None
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(size):
            if i != k:
                share = rows[i][k] / rows[k][k]
                rows[i] = [a - share * b for a, b in zip(rows[i], rows[k])]
    return [rows[k][size] / rows[k][k] for k in range(size)]


def fit(columns, values, weights):
    """(coefficients, matrix of the normal equations) of `values` as a sum of coefficient * column; coefficients None where the columns
    depend on each other. The inverse of the matrix is the covariance where the weights are 1/error^2."""
    matrix = [[sum(w * a * b for w, a, b in zip(weights, one, other)) for other in columns] for one in columns]
    return solve(matrix, [sum(w * a * v for w, a, v in zip(weights, one, values)) for one in columns]), matrix


def variances(matrix):
    """Diagonal of the inverse of the matrix of the normal equations; None where it is singular."""
    rows = [solve(matrix, [float(i == k) for i in range(len(matrix))]) for k in range(len(matrix))]
    return None if any(row is None for row in rows) else [row[k] for k, row in enumerate(rows)]
