// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements AtomArrays.
#include "styles/fluid/atom_arrays.h"

#include <algorithm>

namespace eccentra::styles {

void AtomArrays::declare(unsigned id, int columns, bool enabled) {
  for (Array& array : arrays_) {
    if (array.id != id)
      continue;
    array.enabled = enabled;
    array.values.assign(enabled ? rows_ * array.columns : 0, 0.0);
    array.values.shrink_to_fit();
    return;
  }
  arrays_.push_back({id, columns, enabled, std::vector<double>(enabled ? rows_ * columns : 0, 0.0)});
}

const AtomArrays::Array* AtomArrays::find(unsigned id) const {
  for (const Array& array : arrays_)
    if (array.id == id && array.enabled)
      return &array;
  return nullptr;
}

double* AtomArrays::data(unsigned id) const {
  const Array* array = find(id);
  return array ? const_cast<double*>(array->values.data()) : nullptr;
}

int AtomArrays::columns() const {
  int sum = 0;
  for (const Array& array : arrays_)
    sum += array.enabled ? array.columns : 0;
  return sum;
}

unsigned AtomArrays::layout() const {
  unsigned bits = 0;
  for (const Array& array : arrays_)
    bits |= array.enabled ? 1u << array.id : 0u;
  return bits;
}

void AtomArrays::grow(std::size_t rows) {
  rows_ = std::max(rows, rows_);
  for (Array& array : arrays_)
    if (array.enabled)
      array.values.resize(rows_ * array.columns, 0.0);
}

void AtomArrays::copy(int from, int to) {
  for (Array& array : arrays_)
    if (array.enabled)
      std::copy_n(&array.values[std::size_t(from) * array.columns], array.columns,
                  &array.values[std::size_t(to) * array.columns]);
}

void AtomArrays::zero(int row) {
  for (Array& array : arrays_)
    if (array.enabled)
      std::fill_n(&array.values[std::size_t(row) * array.columns], array.columns, 0.0);
}

int AtomArrays::pack(int row, double* buffer) const {
  double* out = buffer;
  for (const Array& array : arrays_)
    if (array.enabled)
      out = std::copy_n(&array.values[std::size_t(row) * array.columns], array.columns, out);
  return static_cast<int>(out - buffer);
}

int AtomArrays::unpack(int row, const double* buffer) {
  return unpack(row, buffer, layout());
}

int AtomArrays::unpack(int row, const double* buffer, unsigned written_layout) {
  const double* in = buffer;
  for (Array& array : arrays_) {
    if (!(written_layout & (1u << array.id)))
      continue;
    if (array.enabled)
      std::copy_n(in, array.columns, &array.values[std::size_t(row) * array.columns]);
    in += array.columns;
  }
  return static_cast<int>(in - buffer);
}

} // namespace eccentra::styles
