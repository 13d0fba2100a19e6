// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reader and writer of .clump files.
#include "shape/clump_file.h"

#include "shape/decimal.h"
#include "shape/sphere_list.h"
#include "shape/union_geometry.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace eccentra::shape {
namespace {

constexpr std::size_t kMaxBytes = 64u << 20; ///< of a file: a million rows
/// Mass properties belong to spheres whose union has the volume stated with them, within this part of it.
constexpr double kSameVolume = 1e-6;

struct Key {
  const char* name;
  std::size_t values;
};
constexpr std::array<Key, 5> kKeys = {
    {{"union_volume", 1}, {"volume", 1}, {"surface", 1}, {"centre", 3}, {"inertia", 6}}};

std::string read_text(const std::string& path, const std::string& where) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw std::invalid_argument(where + " is a folder: give the file in it");
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::invalid_argument("cannot read the " + where + ": check the name and the folder");
  std::string text;
  std::array<char, 1 << 16> block{};
  while (in.read(block.data(), block.size()), in.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMaxBytes)
      throw std::invalid_argument(where + " is longer than 64 MiB: it is no list of the spheres of one body");
  }
  return text;
}

/// The properties that the lines "#:" state; nothing where there are none.
std::optional<MassProperties> chosen_of(const SphereList& list, const std::string& where) {
  if (list.keys.empty())
    return std::nullopt;
  std::array<std::vector<double>, kKeys.size()> found;
  for (const std::string& line : list.keys) {
    std::istringstream arguments(line);
    std::string name;
    arguments >> name;
    std::size_t k = 0;
    while (k < kKeys.size() && name != kKeys[k].name)
      ++k;
    if (k == kKeys.size())
      throw std::invalid_argument(where + ": the line '#:" + line +
                                  "' is not known; expected union_volume, volume, surface, centre and inertia: delete "
                                  "it");
    for (std::string word; arguments >> word;) {
      const std::optional<double> value = decimal(word);
      if (!value || !std::isfinite(*value))
        throw std::invalid_argument(where + ": '" + word + "' in the line '#:" + line +
                                    "' is not a finite number: delete all lines that begin with #: to use the union "
                                    "of the spheres");
      found[k].push_back(*value);
    }
  }
  for (std::size_t k = 0; k < kKeys.size(); ++k)
    if (found[k].size() != kKeys[k].values)
      throw std::invalid_argument(where + ": its lines '#:" + kKeys[k].name + "' hold " +
                                  std::to_string(found[k].size()) + " numbers; expected " +
                                  std::to_string(kKeys[k].values) +
                                  ": complete them, or delete all lines that begin with #: to use the union of the "
                                  "spheres");
  const double volume = measure_union(list.spheres).properties.volume;
  if (!(std::abs(volume - found[0][0]) <= kSameVolume * volume)) {
    std::ostringstream sentence;
    sentence << where << ": its lines '#:' are of spheres with a union volume of " << found[0][0] << ", but these have "
             << volume
             << ": write the file anew, or delete all lines that begin with #: to use the union of the spheres";
    throw std::invalid_argument(sentence.str());
  }
  MassProperties p;
  p.volume = found[1][0];
  p.surface = found[2][0];
  p.centre = Eigen::Vector3d(found[3].data());
  const std::vector<double>& i = found[4];
  p.inertia_per_mass << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return p;
}

} // namespace

Clump read_clump(const std::string& path) {
  const std::string where = "clump file '" + path + "'";
  const SphereList list = parse_spheres(read_text(path, where), where);
  return {list.spheres, chosen_of(list, where)};
}

void write_clump(std::ostream& out, const ClusterShape& shape) {
  const double union_volume = measure_union(shape.spheres()).properties.volume;
  const bool chosen = std::abs(union_volume - shape.volume()) > kSameVolume * union_volume;
  const Eigen::Vector3d inertia = shape.inertia_per_mass();
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  out << "# " << shape.name() << ": " << shape.spheres().size() << " spheres, body frame, metres\n"
      << "# volume " << shape.volume() << " m3, equivalent radius " << shape.equivalent_radius() << " m, sphericity "
      << shape.sphericity() << "\n# inertia per unit mass " << inertia.transpose() << " m2\n";
  if (chosen)
    out << "# The lines #: are read by Eccentra: mass, centre and inertia are not those of the union of the spheres.\n"
        << "#: union_volume " << union_volume << "\n#: volume " << shape.volume() << "\n#: surface " << shape.surface()
        << "\n#: centre 0 0 0\n#: inertia " << inertia.transpose() << " 0 0 0\n";
  out << "# x y z r\n";
  for (const Sphere& s : shape.spheres())
    out << s.centre.x() << ' ' << s.centre.y() << ' ' << s.centre.z() << ' ' << s.radius << '\n';
}

} // namespace eccentra::shape
