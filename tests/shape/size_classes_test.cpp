// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Classes of size have the number, the mass and the moments of their distributions.
#include "shape/size_classes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// Sum over the classes of number times diameter to a power.
double moment(const std::vector<SizeClass>& classes, double power) {
  double sum = 0;
  for (const SizeClass& one : classes)
    sum += one.number * std::pow(one.diameter, power);
  return sum;
}

TEST(SizeClasses, UniformByNumberHasTheMassOfItsRange) {
  for (const int count : {1, 2, 8}) {
    const auto classes = uniform_sizes(SizeBasis::number, 1e-3, 3e-3, count);
    ASSERT_EQ(classes.size(), static_cast<std::size_t>(count));
    for (const SizeClass& one : classes)
      EXPECT_NEAR(one.number, 1.0 / count, 1e-9);
    // The mean of d^3 from 1 to 3 mm is (81 - 1)/(4 * 2) mm^3, whatever the number of classes.
    EXPECT_NEAR(moment(classes, 3), 10e-9, 1e-14);
  }
  // The first of two classes spans 1 to 2 mm: the mean of d^3 is 15/4 mm^3.
  EXPECT_NEAR(std::pow(uniform_sizes(SizeBasis::number, 1e-3, 3e-3, 2)[0].diameter, 3), 3.75e-9, 1e-14);
}

TEST(SizeClasses, UniformByMassHasTheNumberOfItsRange) {
  const auto classes = uniform_sizes(SizeBasis::mass, 1e-3, 3e-3, 4);
  const double mass = moment(classes, 3);
  for (const SizeClass& one : classes)
    EXPECT_NEAR(one.number * std::pow(one.diameter, 3) / mass, 0.25, 1e-9);
  // Mass over number of all bodies is one over the mean of d^-3 by mass, (1 - 1/9)/(2 * 2) mm^-3.
  EXPECT_NEAR(mass, 1e-9 / ((1 - 1.0 / 9) / 4), 1e-14);
}

TEST(SizeClasses, MomentsOfBells) {
  // Within three deviations sigma: mean of z^2 is 1 - 6 phi(3)/(2 Phi(3) - 1) = 0.97334.
  const double mean = 4e-3, sigma = 1e-3, spread = 0.973337;
  const auto gauss = gaussian_sizes(SizeBasis::number, mean, sigma, 8);
  EXPECT_NEAR(moment(gauss, 3), std::pow(mean, 3) + 3 * mean * sigma * sigma * spread, 1e-12);
  // Lognormal: the median divides the classes, and the mean of d^3 is exp(9 s^2/2), less what the cut leaves out.
  const double s = 0.3;
  const auto log = lognormal_sizes(SizeBasis::number, mean, s, 8);
  EXPECT_LT(log[3].diameter, mean);
  EXPECT_GT(log[4].diameter, mean);
  const double cut =
      (std::erf((3 - 3 * s) / std::sqrt(2)) + std::erf((3 + 3 * s) / std::sqrt(2))) / 2 / std::erf(3 / std::sqrt(2));
  EXPECT_NEAR(moment(log, 3), std::pow(mean, 3) * std::exp(4.5 * s * s) * cut, 1e-4 * std::pow(mean, 3));
}

TEST(SizeClasses, SieveByMass) {
  const auto classes =
      sieve_sizes("# aperture [m], passing [%]\n1e-3 0\n2e-3 25\n\n4e-3 25 # nothing between\n8e-3 100\n", "s");
  ASSERT_EQ(classes.size(), 2U);
  const double mass = moment(classes, 3);
  EXPECT_NEAR(classes[0].number * std::pow(classes[0].diameter, 3) / mass, 0.25, 1e-12);
  // 1 over the mean of d^-3 from 1 to 2 mm, even in ln d: 3 ln 2/(1 - 1/8) mm^3.
  EXPECT_NEAR(std::pow(classes[0].diameter, 3), 1e-9 * 3 * std::log(2.0) / 0.875, 1e-15);
  EXPECT_NEAR(moment(classes, 0), 1, 1e-12);
}

TEST(SizeClasses, RefusesWhatIsNone) {
  EXPECT_THROW(uniform_sizes(SizeBasis::number, 3e-3, 1e-3, 4), std::invalid_argument);
  EXPECT_THROW(gaussian_sizes(SizeBasis::number, 3e-3, 1e-3, 4), std::invalid_argument);
  EXPECT_THROW(lognormal_sizes(SizeBasis::number, 3e-3, 3, 4), std::invalid_argument);
  for (const char* text :
       {"", "1e-3 0\n", "1e-3 5\n2e-3 100\n", "2e-3 0\n1e-3 100\n", "1e-3 0\n2e-3 50\n3e-3 40\n4e-3 100\n",
        "1e-3 0\n2e-3 99\n", "1e-3 0 7\n2e-3 100\n", "1e-3 0\n2e-3 x\n", "1e-3 0\n2e-3 110\n"})
    EXPECT_THROW(sieve_sizes(text, "s"), std::invalid_argument) << text;
}

} // namespace
} // namespace eccentra::shape
