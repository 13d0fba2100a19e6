// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Families of shapes: what a family says of itself. Nothing else lists them.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/note.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// A shape that has a name in the literature, e.g. "cube 64".
struct KnownShape {
  std::vector<std::string> arguments;
  std::string description;
};

/// A keyword that may follow the arguments of a shape, with one value.
struct ShapeOption {
  std::string name, help;
};

/// Arguments of a shape as they stand in a line: arguments[first] is the name of its family.
struct ShapeRequest {
  const std::vector<std::string>& arguments;
  std::size_t first;
  double diameter; ///< of the sphere of equal volume [m]; <= 0: as large as it is
  /// Argument `k` behind the name, from 1; throws std::invalid_argument saying that `need` is missing.
  const std::string& word(std::size_t k, const std::string& need) const;
  /// The number of spheres behind the name.
  long count() const;
};

struct ShapeFamily {
  std::string name;   ///< first word of the shape, e.g. cube
  std::string syntax; ///< how the arguments go on, e.g. "cube 8|27|64|n^3"
  bool own_size;      ///< has a size without a diameter
  /// Makes the shape; `used` becomes the number of arguments consumed, `notes` gets what the user may not expect.
  ClusterShape (*make)(const ShapeRequest& request, std::size_t& used, Notes& notes);
  std::vector<KnownShape> known = {}; ///< for lists; may be empty
  std::string extensions = {};        ///< of files that stand for this family, e.g. ".clump"; empty: none
  std::vector<ShapeOption> options = {};
  /// Words of its levels of detail, coarsest first; empty: none to advise on.
  std::vector<std::vector<std::string>> levels = {};
};

/// All families, in the order of their names' files, then those that were added.
const std::vector<ShapeFamily>& shape_families();
/// Adds a family, once, that lives in another library.
void add_shape_family(const ShapeFamily& family);
/// The family of this name; throws std::invalid_argument that lists all where there is none.
const ShapeFamily& shape_family(const std::string& name);
/// True if `name` begins the arguments of a shape that has a size without a diameter.
bool has_own_size(const std::string& name);

} // namespace eccentra::shape
