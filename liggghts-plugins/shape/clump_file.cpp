// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reader and writer of sphere lists.
#include "shape/clump_file.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace eccentra::shape {

std::vector<Sphere> read_clump(const std::string& path) {
  std::ifstream in(path);
  if (!in)
    throw std::invalid_argument("cannot read the clump file '" + path + "': check the name and the folder");
  std::vector<Sphere> spheres;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line.erase(std::min(line.find('#'), line.size()));
    std::istringstream arguments(line);
    std::array<double, 4> value{};
    std::size_t count = 0;
    const std::string where = "clump file '" + path + "' line " + std::to_string(number) + ": ";
    for (std::string word; arguments >> word; ++count) {
      char* end = nullptr;
      const double number_read = std::strtod(word.c_str(), &end);
      if (*end || !std::isfinite(number_read))
        throw std::invalid_argument(where + "'" + word + "' is not a finite number: a line holds x y z r");
      if (count < value.size())
        value[count] = number_read;
    }
    if (count == 0)
      continue;
    if (count != value.size())
      throw std::invalid_argument(where + std::to_string(count) + " numbers instead of 4: a line holds x y z r");
    if (value[3] <= 0)
      throw std::invalid_argument(where + "radius " + std::to_string(value[3]) + " must be greater than 0");
    spheres.push_back({Eigen::Vector3d(value[0], value[1], value[2]), value[3]});
  }
  if (in.bad() || spheres.empty())
    throw std::invalid_argument("clump file '" + path + "' holds no spheres: give one line x y z r per sphere");
  return spheres;
}

void write_clump(std::ostream& out, const ClusterShape& shape) {
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  out << "# " << shape.name() << ": " << shape.spheres().size() << " spheres, body frame, metres\n"
      << "# volume " << shape.volume() << " m3, equivalent radius " << shape.equivalent_radius() << " m, sphericity "
      << shape.sphericity() << "\n# inertia per unit mass " << shape.inertia_per_mass().transpose()
      << " m2\n# x y z r\n";
  for (const Sphere& s : shape.spheres())
    out << s.centre.x() << ' ' << s.centre.y() << ' ' << s.centre.z() << ' ' << s.radius << '\n';
}

} // namespace eccentra::shape
