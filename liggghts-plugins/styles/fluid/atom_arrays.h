// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Per-atom arrays that exist only if asked for, and travel with their atoms through migration, sorting and restart.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace eccentra::styles {

/// A set of arrays of doubles with one row per atom. Rows are contiguous; an array that is not enabled takes no memory.
class AtomArrays {
 public:
  /// Declares an array under a small id (0..31), of `columns` doubles per atom.
  void declare(unsigned id, int columns, bool enabled);
  bool enabled(unsigned id) const { return find(id) != nullptr; }
  double* data(unsigned id) const;
  /// Doubles per atom over all enabled arrays.
  int columns() const;
  /// Bit set of the enabled ids.
  unsigned layout() const;

  void grow(std::size_t rows);
  void copy(int from, int to);
  void zero(int row);
  int pack(int row, double* buffer) const;
  int unpack(int row, const double* buffer);
  /// As unpack, from a buffer written by arrays of another layout: what both have is taken, the rest keeps zero.
  int unpack(int row, const double* buffer, unsigned written_layout);

 private:
  struct Array {
    unsigned id;
    int columns;
    bool enabled;
    std::vector<double> values;
  };
  const Array* find(unsigned id) const;
  std::vector<Array> arrays_;
  std::size_t rows_ = 0;
};

} // namespace eccentra::styles
