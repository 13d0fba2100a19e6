// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of families of shapes. Nothing else lists families.
#pragma once

#include "base/option_reader.h"
#include "shape/cluster_shape.h"
#include "shape/note.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// A shape that has a name in the literature, e.g. "cube 64".
struct KnownShape {
  std::vector<std::string> arguments; ///< of the shape, as typed
  std::string description;            ///< one line for lists
};

/// A keyword that may follow the arguments of a shape, with one value.
struct ShapeOption {
  /// As typed, and one line of help.
  std::string name, help;
};

/// A first word of shapes and what it makes.
struct ShapeFamily {
  std::string name;   ///< first word of the shape, e.g. cube
  std::string syntax; ///< of all arguments, e.g. "cube 8|27|64|n^3"
  bool own_size;      ///< has a size without a diameter
  /// Makes the shape of the words behind its name, and reads no others. `diameter` [m] is that of the sphere of equal
  /// volume; <= 0: the size that the shape has. `notes` receives notes for the user. Throws std::invalid_argument.
  ClusterShape (*make)(base::OptionReader& words, double diameter, Notes& notes);
  std::vector<KnownShape> known = {};    ///< for lists; may be empty
  std::string extensions = {};           ///< of files of this family, e.g. ".clump"; empty: none
  std::vector<ShapeOption> options = {}; ///< that may follow its arguments
  /// Arguments of its levels of detail, coarsest first; empty: no levels.
  std::vector<std::vector<std::string>> levels = {};
};

/// All families, in the order of their names' files, then those that were added.
const std::vector<ShapeFamily>& shape_families();
/// Adds a family of another library; a second call with the same name does nothing.
void add_shape_family(const ShapeFamily& family);
/// The family of this name. Throws std::invalid_argument with a sentence that lists all names.
const ShapeFamily& shape_family(const std::string& name);
/// True if `name` begins the arguments of a shape that has a size without a diameter.
bool has_own_size(const std::string& name);

} // namespace eccentra::shape
