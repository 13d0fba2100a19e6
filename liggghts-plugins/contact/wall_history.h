// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Tangential history of wall contacts: as many entries per atom as it has contacts, packed for migration and restart.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace eccentra::contact {

/// Names one contact of an atom with a wall fix: sub-sphere, mesh and triangle (0 and 0 for a primitive wall).
/// Exactly representable in a double, in which it travels.
class WallContactKey {
 public:
  static constexpr int kMaxSubSpheres = 1 << 14;
  static constexpr int kMaxMeshes = 1 << 7;

  WallContactKey() = default;
  /// `sub` < kMaxSubSpheres, `mesh` < kMaxMeshes; a primitive wall has mesh and triangle 0.
  WallContactKey(int sub, int mesh, int triangle)
      : value_((static_cast<std::int64_t>(triangle) * kMaxMeshes + mesh) * kMaxSubSpheres + sub) {}
  /// From packed().
  explicit WallContactKey(double packed) : value_(static_cast<std::int64_t>(packed)) {}

  /// The key as a double, without loss, as restart files hold it.
  double packed() const { return static_cast<double>(value_); }
  /// Index of the sub-sphere.
  int sub() const { return static_cast<int>(value_ % kMaxSubSpheres); }
  /// Index of the mesh.
  int mesh() const { return static_cast<int>(value_ / kMaxSubSpheres % kMaxMeshes); }
  /// Index of the triangle.
  int triangle() const { return static_cast<int>(value_ / kMaxSubSpheres / kMaxMeshes); }
  /// True for the same contact.
  bool operator==(const WallContactKey& other) const { return value_ == other.value_; }

 private:
  std::int64_t value_ = 0;
};

/// What one contact remembers from step to step.
struct WallHistoryEntry {
  WallContactKey key;            ///< which contact
  Eigen::Vector3d shear;         ///< tangential displacement [m], world frame
  Eigen::Vector3d rolling;       ///< what the rolling model remembers
  std::vector<double> more = {}; ///< what contact models of LIGGGHTS's own remember
};

/// Rows are local atoms. Packed form of an atom: number of doubles that follow, then (key, shear x y z, rolling x y z,
/// number of further values, these) per contact.
class WallHistory {
 public:
  /// The contacts of one atom.
  using Entries = std::vector<WallHistoryEntry>;

  /// Room for the atoms of a rank.
  void grow(int atoms) { of_atom_.resize(atoms); }
  /// Of local atom i.
  Entries& operator[](int i) { return of_atom_[i]; }
  const Entries& operator[](int i) const { return of_atom_[i]; }
  /// Atom `from` takes the place of atom `to`.
  void move(int from, int to) {
    if (from != to)
      of_atom_[to] = std::move(of_atom_[from]);
  }
  /// Doubles of the packed form of atom i.
  int packed_size(int i) const { return packed_size(of_atom_[i]); }
  /// Writes the packed form; returns its length.
  int pack(int i, double* buffer) const {
    int m = 0;
    buffer[m++] = packed_size(i) - 1;
    for (const WallHistoryEntry& entry : of_atom_[i]) {
      buffer[m++] = entry.key.packed();
      for (const Eigen::Vector3d& vector : {entry.shear, entry.rolling})
        for (int k = 0; k < 3; ++k)
          buffer[m++] = vector[k];
      buffer[m++] = static_cast<double>(entry.more.size());
      for (const double value : entry.more)
        buffer[m++] = value;
    }
    return m;
  }
  /// Reads the packed form in place of what is there; returns its length.
  int unpack(int i, const double* buffer) {
    int m = 0;
    const int end = 1 + static_cast<int>(buffer[m++]);
    of_atom_[i].clear();
    while (m < end) {
      WallHistoryEntry entry;
      entry.key = WallContactKey(buffer[m++]);
      for (Eigen::Vector3d* vector : {&entry.shear, &entry.rolling})
        for (int k = 0; k < 3; ++k)
          (*vector)[k] = buffer[m++];
      entry.more.resize(static_cast<std::size_t>(buffer[m++]));
      for (double& value : entry.more)
        value = buffer[m++];
      of_atom_[i].push_back(entry);
    }
    return m;
  }
  /// Doubles of the largest atom.
  int largest() const {
    int most = 1;
    for (const Entries& entries : of_atom_)
      most = std::max(most, packed_size(entries));
    return most;
  }
  /// Memory [bytes].
  double memory() const {
    double bytes = 0;
    for (const Entries& entries : of_atom_)
      bytes += sizeof(Entries) + entries.capacity() * sizeof(WallHistoryEntry);
    return bytes;
  }

 private:
  static constexpr int kDoublesPerEntry = 8;
  static int packed_size(const Entries& entries) {
    int size = 1;
    for (const WallHistoryEntry& entry : entries)
      size += kDoublesPerEntry + static_cast<int>(entry.more.size());
    return size;
  }
  std::vector<Entries> of_atom_;
};

} // namespace eccentra::contact
