// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature points of spheres, clusters and Gaussian kernels.
#include "exchange/depositionPoints.H"

#include <cmath>
#include <stdexcept>

namespace eccentra::exchange {
namespace {

/// +-e_k with a sixth each: second moment about axis k is e_k^2 / 3.
void sixPoints(const double* extent, std::vector<DepositionPoint>& points) {
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) {
      const double* e = extent + 3 * k;
      points.push_back({{sign * e[0], sign * e[1], sign * e[2]}, 1.0 / 6.0});
    }
}

/// Three-point Gauss-Hermite rule per direction: exact for polynomials up to degree five against the Gaussian.
void gaussPoints(double width, std::vector<DepositionPoint>& points) {
  const double node[3] = {-std::sqrt(3.0) * width, 0.0, std::sqrt(3.0) * width};
  const double weight[3] = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        points.push_back({{node[i], node[j], node[k]}, weight[i] * weight[j] * weight[k]});
}

} // namespace

VoidFraction voidFractionOf(const std::string& word) {
  if (word == "centre")
    return VoidFraction::centre;
  if (word == "divided")
    return VoidFraction::divided;
  if (word == "gaussian")
    return VoidFraction::gaussian;
  if (word == "diffusion")
    return VoidFraction::diffusion;
  throw std::invalid_argument("voidFraction '" + word + "' is unknown: use centre, divided, gaussian or diffusion");
}

void depositionPoints(VoidFraction method, double volume, const double* extent, double width,
                      std::vector<DepositionPoint>& points) {
  points.clear();
  if (method == VoidFraction::gaussian) {
    gaussPoints(width, points);
  } else if (extent) {
    sixPoints(extent, points);
  } else if (method == VoidFraction::divided) {
    // A ball's second moment is R^2 / 5 per volume.
    const double e = std::sqrt(3.0 / 5.0) * std::cbrt(3.0 * volume / (4.0 * M_PI));
    const double ball[9] = {e, 0, 0, 0, e, 0, 0, 0, e};
    sixPoints(ball, points);
  } else {
    points.push_back({{0, 0, 0}, 1.0});
  }
}

} // namespace eccentra::exchange
