// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounded bodies by the words of their shapes; random numbers, directions and orientations, the same in every run.
#pragma once

#include "shape/cluster_shape.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace eccentra::test {
using Eigen::Vector3d;
using shape::RoundedHull;

inline RoundedHull made(const std::string& line, double diameter = 2) {
  std::istringstream in(line);
  std::vector<std::string> arguments;
  for (std::string word; in >> word;)
    arguments.push_back(word);
  std::size_t used = 0;
  return *shape::make_shape(arguments, 0, used, diameter).hull();
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Eigen::Vector3d direction() {
    std::normal_distribution<double> n;
    return Eigen::Vector3d(n(engine_), n(engine_), n(engine_)).normalized();
  }
  Eigen::Quaterniond orientation() {
    std::normal_distribution<double> n;
    return Eigen::Quaterniond(n(engine_), n(engine_), n(engine_), n(engine_)).normalized();
  }
  /// About a random axis by a random angle.
  Eigen::Matrix3d turn() { return Eigen::AngleAxisd(uniform(0, M_PI), direction()).toRotationMatrix(); }

 private:
  std::mt19937_64 engine_;
};

} // namespace eccentra::test
