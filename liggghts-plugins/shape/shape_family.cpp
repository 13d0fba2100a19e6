// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of families: those of this folder, which CMake finds by the names of their files, and those added.
#include "shape/shape_family.h"

#include "base/refusal.h"

namespace eccentra::shape {

std::vector<ShapeFamily> families_of_this_library(); // written by CMake from the files family_NAME.cpp

namespace {

std::vector<ShapeFamily>& table() {
  static std::vector<ShapeFamily> families = families_of_this_library();
  return families;
}

const ShapeFamily* find(const std::string& name) {
  for (const ShapeFamily& family : table())
    if (family.name == name)
      return &family;
  return nullptr;
}

} // namespace

const std::vector<ShapeFamily>& shape_families() {
  return table();
}

void add_shape_family(const ShapeFamily& family) {
  if (!find(family.name))
    table().push_back(family);
}

const ShapeFamily& shape_family(const std::string& name) {
  if (const ShapeFamily* family = find(name))
    return *family;
  std::string known;
  for (const ShapeFamily& family : table())
    known += (known.empty() ? "" : ", ") + family.name;
  base::refuse("shape '{}' is not known; expected one of {}", name, known);
}

bool has_own_size(const std::string& name) {
  const ShapeFamily* family = find(name);
  return family && family->own_size;
}

} // namespace eccentra::shape
