// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names, reads, checks and writes files of resistances.
#include "shape/resistance_cache.h"

#include "shape/rounded_surface.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <vector>

namespace eccentra::shape {
namespace {

/// Raised with every change of the method that changes a digit.
constexpr int kVersion = 1;
constexpr const char* kTitle = "eccentra resistance of a shape";
constexpr int kNumbers = 9 + 9 + 9 + 18 + 3;
/// Places are told apart to this part of d.
constexpr double kPlace = 1e-9;
/// A body's places for its key: fewer than its solution uses, and enough to tell bodies apart.
constexpr int kKeyTriangles = 6;

/// FNV-1a.
class Hash {
 public:
  void add(std::int64_t value) {
    for (int byte = 0; byte < 8; ++byte)
      sum_ = (sum_ ^ (std::uint64_t(value) >> (8 * byte) & 255U)) * 0x100000001b3U;
  }
  void add(double value) { add(std::int64_t(std::llround(value / kPlace))); }
  void add(const std::string& text) {
    for (const char c : text)
      add(std::int64_t(c));
  }
  std::string text() const { return fmt::format("{:016x}", sum_); }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325U;
};

Hash begun(const Eigen::Vector3d& inertia) {
  Hash hash;
  hash.add(std::int64_t(kVersion));
  for (int k = 0; k < 3; ++k)
    hash.add(std::int64_t(inertia[k] == inertia[(k + 1) % 3]));
  return hash;
}

std::string key_of(const ClusterShape& shape) {
  Hash hash = begun(shape.inertia_per_mass());
  const double d = 2 * shape.equivalent_radius();
  for (const Sphere& sphere : shape.spheres()) {
    for (int k = 0; k < 3; ++k)
      hash.add(sphere.centre[k] / d);
    hash.add(sphere.radius / d);
  }
  return hash.text();
}

std::string key_of(const RoundedHull& body) {
  Hash hash = begun(body.inertia_per_mass());
  const double d = 2 * body.equivalent_radius();
  for (const Eigen::Vector3d& vertex : surface_of(body, kKeyTriangles).vertices)
    for (int k = 0; k < 3; ++k)
      hash.add(vertex[k] / d);
  hash.add(body.radius() / d);
  return hash.text();
}

template <class Numbers> void for_numbers(Resistance& r, Numbers&& each) {
  each(r.translation.data(), 9);
  each(r.rotation.data(), 9);
  each(r.coupling.data(), 9);
  each(r.strain.data(), 18);
  each(r.centre.data(), 3);
}

/// The file's text but for its last line, which is the hash of the others.
std::string body_text(const std::string& key, Resistance r) {
  std::string text = fmt::format("{}\nversion {}\ngeometry {}\n", kTitle, kVersion, key);
  for_numbers(r, [&](const double* values, int count) {
    for (int k = 0; k < count; ++k)
      text += fmt::format("{}{:.17g}", k > 0 ? " " : "", values[k]);
    text += "\n";
  });
  return text;
}

std::string sealed(const std::string& text) {
  Hash hash;
  hash.add(text);
  return text + "seal " + hash.text() + "\n";
}

std::optional<Resistance> read(const std::filesystem::path& path, const std::string& key) {
  std::ifstream in(path);
  std::string title, word, found;
  int version = 0;
  if (!std::getline(in, title) || title != kTitle || !(in >> word >> version >> word >> found) || found != key)
    return {};
  Resistance r;
  for_numbers(r, [&](double* values, int count) {
    for (int k = 0; k < count; ++k)
      in >> values[k];
  });
  // What was read must give the file again, to the last byte.
  std::ifstream again(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(again)), {});
  if (!in || bytes != sealed(body_text(key, r)))
    return {};
  return r;
}

void write(const std::filesystem::path& path, const std::string& key, const Resistance& r) {
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  // Whole or not at all: other runs may be reading.
  const std::filesystem::path draft = fmt::format("{}.{}", path.string(), getpid());
  std::ofstream out(draft, std::ios::binary);
  out << sealed(body_text(key, r));
  out.close();
  if (out)
    std::filesystem::rename(draft, path, failed);
  if (!out || failed)
    std::filesystem::remove(draft, failed);
}

template <class Body> Resistance cached(const Body& body) {
  const std::string folder = resistance_cache_folder();
  if (folder.empty())
    return resistance_of(body);
  const std::string key = key_of(body);
  const std::filesystem::path path = std::filesystem::path(folder) / ("resistance-" + key + ".txt");
  if (const auto known = read(path, key))
    return *known;
  const Resistance solved = resistance_of(body);
  write(path, key, solved);
  return solved;
}

} // namespace

std::string resistance_cache_folder() {
  const auto set = [](const char* name) -> std::string {
    const char* value = std::getenv(name);
    return value ? value : "";
  };
  const std::string own = set("ECCENTRA_CACHE");
  if (!own.empty())
    return own == "none" ? "" : own;
  if (!set("XDG_CACHE_HOME").empty())
    return set("XDG_CACHE_HOME") + "/eccentra";
  return set("HOME").empty() ? "" : set("HOME") + "/.cache/eccentra";
}

Resistance cached_resistance(const ClusterShape& shape) {
  if (shape.hull() && shape.spheres().size() > 1)
    return cached(*shape.hull());
  return shape.spheres().size() == 1 ? Resistance{} : cached(shape);
}

Resistance cached_resistance(const RoundedHull& body) {
  return cached(body);
}

} // namespace eccentra::shape
