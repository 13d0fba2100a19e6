// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix particletemplate/multisphere/shape: our shapes, with their exact mass and inertia, for stock fix multisphere.
#include "base/option_reader.h"
#include "base/refusal.h"
#include "shape/cluster_shape.h"
#include "shape/shape_keywords.h"
#include "styles/entry/printed_notes.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "comm.h"
#include "error.h"
#include "fix_template_multisphere.h"
#include "lammps.h"
#include "modify.h"

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace eccentra::styles {

namespace {

using namespace LAMMPS_NS;

// Everything that looks for templates knows this name; ours is stock's template, given other words.
constexpr const char* kStockStyle = "particletemplate/multisphere";
// Stock still throws dice for the share of each sub-sphere in the volume, which only its own CFD coupling reads.
constexpr const char* kVolumeShareTries = "100000";

std::string exact(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// Words of the line after the seed, taken apart.
struct TemplateArguments {
  std::vector<std::string> before; ///< arguments of all stock templates, passed on as they are
  std::vector<std::string> after;  ///< arguments of stock multisphere, passed on as they are
  std::vector<std::string> shape;
  double density = 0.0;
  double diameter = 0.0;
  bool has_type = false;
};

bool is_pass_through(const std::string& word) {
  return word == "type" || word == "fflag" || word == "tflag";
}

TemplateArguments take_apart(const std::vector<std::string>& arguments) {
  TemplateArguments parts;
  base::OptionReader reader(arguments);
  while (reader.more() && reader.peek() != "shape") {
    const std::string& word = parts.before.emplace_back(reader.keyword());
    if (word != "density")
      continue;
    if (const std::string& kind = reader.value("constant VALUE"); kind != "constant")
      base::refuse("keyword 'density': '{}' is not 'constant'; expected density constant VALUE, because bodies of one "
                   "template are alike",
                   kind);
    parts.density = reader.positive("the density [kg/m3]");
    parts.before.insert(parts.before.end(), {"constant", exact(parts.density)});
  }
  if (!reader.more())
    base::refuse("no shape is given; expected one, for example 'shape cube 64 diameter 6.35e-3'");
  if (parts.density == 0.0)
    base::refuse("no density is given; expected 'density constant VALUE' before 'shape'");
  reader.keyword();
  while (reader.more() && reader.peek() != "diameter" && !is_pass_through(reader.peek()))
    parts.shape.push_back(reader.keyword());
  if (reader.more() && reader.peek() == "diameter") {
    reader.keyword();
    parts.diameter = reader.positive("the diameter [m]");
  }
  if (reader.more() && !is_pass_through(reader.peek())) {
    reader.keyword();
    reader.unknown("diameter, type, fflag, tflag");
  }
  while (reader.more()) {
    parts.has_type = parts.has_type || reader.peek() == "type";
    parts.after.push_back(reader.keyword());
  }
  return parts;
}

/// The line that stock understands.
std::vector<std::string> stock_arguments(const TemplateArguments& parts, const shape::ClusterShape& shape,
                                         int default_type) {
  std::vector<std::string> arguments = parts.before;
  arguments.insert(arguments.end(),
                   {"nspheres", std::to_string(shape.spheres().size()), "ntry", kVolumeShareTries, "spheres"});
  for (const shape::Sphere& sphere : shape.spheres())
    for (const double value : {sphere.centre.x(), sphere.centre.y(), sphere.centre.z(), sphere.radius})
      arguments.push_back(exact(value));
  const double mass = parts.density * shape.volume();
  const Eigen::Vector3d inertia = mass * shape.inertia_per_mass();
  // Upper triangle by rows; the body frame is that of the principal axes.
  arguments.insert(arguments.end(), {"mass", exact(mass), "inertia_tensor", exact(inertia[0]), "0", "0",
                                     exact(inertia[1]), "0", exact(inertia[2]), "use_density"});
  arguments.insert(arguments.end(), parts.after.begin(), parts.after.end());
  if (!parts.has_type)
    arguments.insert(arguments.end(), {"type", std::to_string(default_type)});
  return arguments;
}

Fix* create(LAMMPS* lmp, int narg, char** arg) {
  const std::string where = "fix " + std::string(arg[0]) + " particletemplate/multisphere/shape: ";
  try {
    if (narg < 5)
      throw std::invalid_argument("write: SEED atom_type 1 density constant VALUE shape cube 64 diameter D");
    const TemplateArguments parts = take_apart({arg + 4, arg + narg});
    std::size_t used = 0;
    shape::Notes notes;
    const shape::ClusterShape shape = shape::make_shape(parts.shape, 0, used, parts.diameter, notes);
    if (used != parts.shape.size())
      throw std::invalid_argument("unknown word '" + parts.shape[used] + "' after the shape");
    print_notes(lmp, where.substr(0, where.size() - 2), notes);
    if (shape.hull())
      throw std::invalid_argument("shape '" + shape.name() +
                                  "' is a rounded body, which fix multisphere does not know; expected spheres: use "
                                  "particletemplate/cluster");
    if (shape.spheres().size() < 2)
      throw std::invalid_argument("shape '" + shape.name() +
                                  "' is one sphere, which fix multisphere does not take: use particletemplate/sphere");
    std::vector<std::string> arguments = {arg[0], arg[1], kStockStyle, arg[3]};
    const int default_type = lmp->modify->n_fixes_style_strict(kStockStyle) + 1;
    for (std::string& word : stock_arguments(parts, shape, default_type))
      arguments.push_back(std::move(word));
    std::vector<char*> pointers;
    for (std::string& word : arguments)
      pointers.push_back(word.data());
    return new FixTemplateMultisphere(lmp, static_cast<int>(pointers.size()), pointers.data());
  } catch (const std::invalid_argument& problem) {
    lmp->error->all(FLERR, (where + problem.what()).c_str());
    return nullptr;
  }
}

const RegisterStyle registered({"fix", "particletemplate/multisphere/shape",
                                "our shapes with exact mass properties for stock fix multisphere", &create});

} // namespace

} // namespace eccentra::styles
