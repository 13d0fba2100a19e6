// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Integrates number and mass over the range of each class.
#include "shape/size_classes.h"

#include "shape/decimal.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace eccentra::shape {
namespace {

constexpr int kSteps = 4000; // of an integral over a whole distribution
constexpr double kCut = 3;   // deviations
constexpr double kAll = 100; // %

double cube(double x) {
  return x * x * x;
}

/// A weight over a coordinate, and the diameter there.
struct Distribution {
  double from, to;
  std::function<double(double)> weight;
  std::function<double(double)> diameter;
};

/// Number and mass of a range, in units of their own.
struct Content {
  double number = 0, mass = 0;
  double diameter() const { return std::cbrt(mass / number); }
};

std::vector<SizeClass> classes_of(SizeBasis basis, const Distribution& law, int count) {
  // Ends of the steps by the part of the weight that lies below; a class ends within a step, whose content is divided.
  const double step = (law.to - law.from) / kSteps;
  double total = 0;
  for (int i = 0; i < kSteps; ++i)
    total += law.weight(law.from + (i + 0.5) * step);
  std::vector<Content> contents(static_cast<std::size_t>(count));
  double below = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double at = law.from + (i + 0.5) * step, part = law.weight(at) / total, d = law.diameter(at);
    for (double done = 0; done < part;) {
      const int k = std::min(static_cast<int>((below + done) * count + 1e-9), count - 1);
      const double here = k == count - 1 ? part - done : std::min(part - done, (k + 1.0) / count - (below + done));
      Content& content = contents[static_cast<std::size_t>(k)];
      content.number += basis == SizeBasis::number ? here : here / cube(d);
      content.mass += basis == SizeBasis::number ? here * cube(d) : here;
      done += std::max(here, 1e-15);
    }
    below += part;
  }
  double number = 0;
  for (const Content& content : contents)
    number += content.number;
  std::vector<SizeClass> classes;
  for (const Content& content : contents)
    classes.push_back({content.number / number, content.diameter()});
  return classes;
}

double bell(double deviations) {
  return std::exp(-0.5 * deviations * deviations);
}

void refuse_if(bool wrong, const std::string& sentence) {
  if (wrong)
    throw std::invalid_argument(sentence);
}

} // namespace

std::vector<SizeClass> uniform_sizes(SizeBasis basis, double least, double most, int count) {
  refuse_if(!(most > least), "the largest diameter is not above the least one; expected the least diameter first");
  return classes_of(basis, {least, most, [](double) { return 1.0; }, [](double d) { return d; }}, count);
}

std::vector<SizeClass> gaussian_sizes(SizeBasis basis, double mean, double deviation, int count) {
  refuse_if(!(mean > kCut * deviation),
            "the deviation is a third of the mean or more, and diameters are drawn within three deviations; expected a "
            "smaller deviation");
  return classes_of(basis, {-kCut, kCut, bell, [&](double z) { return mean + z * deviation; }}, count);
}

std::vector<SizeClass> lognormal_sizes(SizeBasis basis, double median, double deviation, int count) {
  constexpr double widest = 2; // three of them are a factor of 400
  refuse_if(deviation > widest, "the deviation of the logarithm is above 2; expected one such as 0.3");
  return classes_of(basis, {-kCut, kCut, bell, [&](double z) { return median * std::exp(z * deviation); }}, count);
}

std::vector<SizeClass> sieve_sizes(const std::string& text, const std::string& where) {
  std::istringstream lines(text);
  std::vector<double> apertures, passing;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto refuse = [&](const std::string& sentence) {
      throw std::invalid_argument(where + ", line " + std::to_string(number) + ": " + sentence);
    };
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<double> values;
    for (std::string word; words >> word;) {
      const std::optional<double> value = decimal(word);
      if (!value || !std::isfinite(*value))
        refuse("'" + word + "' is not a number; expected an aperture in m and the part that passes it in %");
      values.push_back(*value);
    }
    if (values.empty())
      continue;
    if (values.size() != 2)
      refuse(std::to_string(values.size()) + " numbers; expected an aperture in m and the part that passes it in %");
    if (!(values[0] > (apertures.empty() ? 0 : apertures.back())))
      refuse("the aperture is not above the one before it; expected rising apertures in m");
    if (passing.empty() ? values[1] != 0 : !(values[1] >= passing.back()) || values[1] > kAll)
      refuse(passing.empty() ? "something passes the smallest aperture; expected 0 % there, at the smallest size"
                             : "the part that passes falls, or is above 100 %; expected rising parts in %");
    apertures.push_back(values[0]);
    passing.push_back(values[1]);
  }
  if (apertures.size() < 2 || passing.back() != kAll)
    throw std::invalid_argument(where +
                                ": the largest aperture does not pass 100 %; expected rows of an aperture in m and "
                                "the part that passes it in %, from 0 to 100");
  std::vector<SizeClass> classes;
  double all = 0;
  for (std::size_t k = 1; k < apertures.size(); ++k) {
    const double mass = passing[k] - passing[k - 1], low = apertures[k - 1], high = apertures[k];
    if (mass == 0)
      continue;
    // The mean of 1/d^3 over an even spread in ln d.
    const double inverse = (1 / cube(low) - 1 / cube(high)) / (3 * std::log(high / low));
    classes.push_back({mass * inverse, std::cbrt(1 / inverse)});
    all += classes.back().number;
  }
  for (SizeClass& one : classes)
    one.number /= all;
  return classes;
}

} // namespace eccentra::shape
