// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in the order of the body's members.
#include "shape/rounded_record.h"

#include <cmath>
#include <stdexcept>

namespace eccentra::shape {
namespace {

class Reader {
 public:
  explicit Reader(const std::vector<double>& values) : values_(values) {}
  double number() {
    if (next_ >= values_.size())
      throw std::invalid_argument("the record of a rounded body ends too early");
    if (!std::isfinite(values_[next_]))
      throw std::invalid_argument("the record of a rounded body has a value that is no number");
    return values_[next_++];
  }
  /// A whole number from 0 to below `limit`.
  int index(std::size_t limit) {
    const double value = number();
    if (!(value >= 0 && value < static_cast<double>(limit)) || value != std::floor(value))
      throw std::invalid_argument("the record of a rounded body has a count or an index that cannot be");
    return static_cast<int>(value);
  }
  /// A count of things of so many numbers each.
  int count(std::size_t numbers) { return index((values_.size() - next_) / numbers + 1); }
  Eigen::Vector3d vector() {
    Eigen::Vector3d v;
    for (int k = 0; k < 3; ++k)
      v[k] = number();
    return v;
  }

 private:
  const std::vector<double>& values_;
  std::size_t next_ = 0;
};

} // namespace

std::vector<double> record_of(const RoundedHull& hull) {
  std::vector<double> record{hull.disk() ? 1. : 0., hull.radius(), hull.contact_radius(), hull.volume(),
                             hull.surface()};
  const auto put = [&](const Eigen::Vector3d& v) { record.insert(record.end(), {v.x(), v.y(), v.z()}); };
  const auto put_count = [&](std::size_t count) { record.push_back(static_cast<double>(count)); };
  put(hull.inertia_per_mass());
  if (const DiskCore* disk = hull.disk()) {
    record.insert(record.end(), {disk->radius, disk->half_height});
    return record;
  }
  const ConvexCore& core = *hull.polyhedron();
  put_count(core.vertices.size());
  for (const Eigen::Vector3d& v : core.vertices)
    put(v);
  put_count(core.faces.size());
  for (const CoreFace& face : core.faces) {
    put(face.normal);
    record.insert(record.end(), {face.offset, face.area});
    put_count(face.corners.size());
    for (const int k : face.corners)
      record.push_back(k);
  }
  put_count(core.edges.size());
  for (const CoreEdge& e : core.edges)
    for (const int k : {e.from, e.to, e.left + 1, e.right + 1})
      record.push_back(k);
  return record;
}

RoundedHull hull_of_record(const std::string& name, const std::vector<double>& record) {
  Reader in(record);
  const bool is_disk = in.index(2) != 0;
  const double radius = in.number();
  RoundedHull::Properties p;
  p.contact_radius = in.number();
  p.volume = in.number();
  p.surface = in.number();
  p.inertia_per_mass = in.vector();
  if (!(radius > 0 && p.contact_radius > 0 && p.volume > 0 && p.surface > 0 && p.inertia_per_mass.minCoeff() > 0))
    throw std::invalid_argument("the record of a rounded body has a size or a moment that is not greater than 0");
  if (is_disk) {
    const double rim = in.number();
    return RoundedHull(name, DiskCore{rim, in.number()}, radius, p);
  }
  ConvexCore core;
  core.vertices.resize(in.count(3));
  for (Eigen::Vector3d& v : core.vertices)
    v = in.vector();
  core.faces.resize(in.count(5));
  for (CoreFace& face : core.faces) {
    face.normal = in.vector();
    face.offset = in.number();
    face.area = in.number();
    face.corners.resize(in.count(1));
    for (int& k : face.corners)
      k = in.index(core.vertices.size());
  }
  core.edges.resize(in.count(4));
  for (CoreEdge& e : core.edges) {
    e.from = in.index(core.vertices.size());
    e.to = in.index(core.vertices.size());
    for (int* face : {&e.left, &e.right})
      *face = in.index(core.faces.size() + 1) - 1; // a segment's edge has none: -1
  }
  if (core.vertices.empty())
    throw std::invalid_argument("the record of a rounded body has no vertices");
  return RoundedHull(name, core, radius, p);
}

} // namespace eccentra::shape
