// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of wall/gran/cluster.
#include "styles/walls/wall_arguments.h"

#include "base/option_reader.h"
#include "base/refusal.h"
#include "contact/stock_contact_keywords.h"

#include <cmath>

namespace eccentra::styles {

namespace {

using base::OptionReader;

Eigen::Vector3d read_vector(OptionReader& reader, const std::string& what) {
  const double x = reader.number("x of " + what), y = reader.number("y of " + what), z = reader.number("z of " + what);
  return {x, y, z};
}

contact::WallSurface read_surface(OptionReader& reader) {
  const std::string known = "xplane, yplane, zplane, plane, xcylinder, ycylinder, zcylinder",
                    style = reader.keyword("a primitive wall: " + known);
  if (style == "plane") {
    const Eigen::Vector3d point = read_vector(reader, "a point of the plane");
    const Eigen::Vector3d normal = read_vector(reader, "the plane's normal");
    if (normal.norm() == 0.0)
      base::refuse("keyword 'plane': the normal '0 0 0' has length 0; expected the direction across the plane");
    return contact::WallSurface::plane(point, normal);
  }
  const std::string shape = style.empty() ? style : style.substr(1);
  const int axis = style.empty() ? -1 : style[0] - 'x';
  if (axis < 0 || axis > 2 || (shape != "plane" && shape != "cylinder"))
    base::refuse("primitive wall '{}' is unknown; expected one of {}", style, known);
  const Eigen::Vector3d direction = Eigen::Vector3d::Unit(axis);
  if (shape == "plane")
    return contact::WallSurface::plane(reader.number("the position") * direction, direction);
  const double radius = reader.positive("the radius");
  // Centre coordinates in cyclic order after the axis, as stock LIGGGHTS takes them.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  centre[(axis + 1) % 3] = reader.number("the first coordinate of the centre");
  centre[(axis + 2) % 3] = reader.number("the second coordinate of the centre");
  return contact::WallSurface::cylinder(centre, direction, radius);
}

void check_stays_in_place(const contact::WallSurface& surface, const Eigen::Vector3d& velocity) {
  const double across =
      surface.is_plane() ? std::abs(velocity.dot(surface.direction())) : velocity.cross(surface.direction()).norm();
  if (across > 1e-12 * velocity.norm())
    base::refuse(
        "keyword 'velocity': it would carry the wall away from its place; expected a velocity along a plane, or "
        "along the axis of a cylinder: use mesh walls with fix move/mesh for other motions");
}

void refuse_second_wall(const WallArguments& arguments) {
  if (arguments.surface || !arguments.meshes.empty())
    base::refuse("one wall per fix; expected a fix of its own for each primitive wall and for meshes");
}

void read_primitive(OptionReader& reader, WallArguments& arguments) {
  refuse_second_wall(arguments);
  reader.expect("type");
  arguments.type = reader.count(1);
  arguments.surface = read_surface(reader);
  while (reader.more() && (reader.peek() == "rotate" || reader.peek() == "velocity")) {
    if (reader.keyword() == "rotate") {
      arguments.surface->set_rotation(reader.number("the angular velocity [rad/s]"));
    } else {
      const Eigen::Vector3d velocity = read_vector(reader, "the velocity [m/s]");
      check_stays_in_place(*arguments.surface, velocity);
      arguments.surface->set_velocity(velocity);
    }
  }
}

void read_meshes(OptionReader& reader, WallArguments& arguments) {
  refuse_second_wall(arguments);
  reader.expect("n_meshes");
  const int count = reader.count(1);
  reader.expect("meshes");
  for (int i = 0; i < count; ++i)
    arguments.meshes.push_back(reader.value("the id of a fix mesh/surface"));
}

std::unique_ptr<WallRolling> read_rolling(OptionReader& reader, std::string& name) {
  name = reader.value("a rolling model");
  if (name == "off" || name == "none")
    return nullptr;
  const auto found = wall_rolling_models().find(name);
  if (found == wall_rolling_models().end()) {
    std::string known = "off";
    for (const auto& entry : wall_rolling_models())
      known += ", " + entry.first;
    base::refuse("rolling_friction '{}' is unknown at walls; expected one of {}", name, known);
  }
  return found->second();
}

/// What was not typed, and what fits together.
void complete(WallArguments& arguments, bool friction_bound, bool tangential_update) {
  const bool paper = arguments.damping == contact::DampingLaw::paper;
  arguments.tangential = arguments.names.tangential != "off";
  if (!arguments.tangential)
    arguments.tangential_damping = false;
  arguments.in_blocks = contact::find_contact_model(arguments.names.normal) &&
                        (arguments.names.tangential == "off" || arguments.names.tangential == "history") &&
                        arguments.names.cohesion == "off" && arguments.options.empty();
  if (paper && !arguments.in_blocks)
    base::refuse("damping 'paper' is not offered for the models of LIGGGHTS; expected it with model hertz, "
                 "tangential history or off, and no cohesion");
  if (paper && friction_bound)
    base::refuse("friction_bound: damping paper has a bound of its own, the elastic one for the spring "
                 "alone; expected damping stock, or no friction_bound");
  // `contacts parallel` is what stock does.
  if (paper)
    arguments.friction = contact::FrictionBound::paper;
  else if (!friction_bound)
    arguments.friction = arguments.shared ? contact::FrictionBound::elastic : contact::FrictionBound::stock;
  if (!tangential_update)
    arguments.synchronised = arguments.shared;
  if (!arguments.in_blocks && arguments.tangential && !arguments.tangential_damping) {
    arguments.options.push_back("tangential_damping");
    arguments.options.push_back("off");
  }
}

} // namespace

WallArguments read_wall_arguments(const std::vector<std::string>& all) {
  WallArguments arguments;
  OptionReader reader(all);
  bool friction_bound = false, tangential_update = false, rolling_radius = false;
  std::vector<std::string> switched_off; // switches of models; some are on where nothing is written
  if (reader.keyword("model and its name") != "model")
    base::refuse("'{}' is not 'model'; expected model hertz, or another model, first", all.front());
  arguments.names.normal = StockContact::read_name(reader, "model");
  while (reader.more()) {
    // Stock has the keywords of the rolling model after the wall.
    if (arguments.rolling && arguments.rolling->read_keyword(reader))
      continue;
    const std::string word = reader.keyword();
    if (word == "tangential") {
      arguments.names.tangential = StockContact::read_name(reader, word);
    } else if (word == "cohesion") {
      arguments.names.cohesion = StockContact::read_name(reader, word);
    } else if (word == "friction_bound") {
      friction_bound = true;
      arguments.friction = reader.choice({"elastic", "stock"}) == "elastic" ? contact::FrictionBound::elastic
                                                                            : contact::FrictionBound::stock;
    } else if (word == "tangential_update") {
      tangential_update = true;
      arguments.synchronised = reader.choice({"synchronised", "stock"}) == "synchronised";
    } else if (word == "rolling_radius") {
      rolling_radius = true;
      arguments.rolling_radius =
          reader.choice({"sub_sphere", "body"}) == "body" ? RollingRadius::body : RollingRadius::sub_sphere;
    } else if (contact::is_switch_of_a_model(word)) {
      const bool on = reader.on_off();
      std::vector<std::string>& where = on ? arguments.options : switched_off;
      where.push_back(word);
      where.push_back(on ? "on" : "off");
    } else if (word == "surface") {
      reader.choice({"default"});
    } else if (word == "shear") {
      base::refuse(
          "keyword 'shear' is written otherwise here; expected rotate OMEGA for a cylinder that turns, velocity "
          "VX VY VZ for a wall that slides along itself");
    } else if (contact::stock_contact_keywords().count(word)) {
      contact::refuse_stock_keyword(word, reader.value("its value"));
    } else if (word == "rolling_friction") {
      arguments.rolling = read_rolling(reader, arguments.rolling_model);
    } else if (word == "contacts") {
      arguments.shared = reader.choice({"shared", "parallel"}) == "shared";
    } else if (word == "damping") {
      arguments.damping =
          reader.choice({"stock", "paper"}) == "stock" ? contact::DampingLaw::stock : contact::DampingLaw::paper;
    } else if (word == "tangential_damping") {
      arguments.tangential_damping = reader.on_off();
    } else if (word == "primitive") {
      read_primitive(reader, arguments);
    } else if (word == "mesh") {
      read_meshes(reader, arguments);
    } else {
      reader.unknown(
          "tangential, cohesion, rolling_friction, rolling_radius, contacts, damping, tangential_damping, "
          "friction_bound, tangential_update, primitive (with rotate and velocity, which stock calls shear), "
          "mesh, and the keywords of the models");
    }
  }
  complete(arguments, friction_bound, tangential_update);
  if (!arguments.in_blocks)
    arguments.options.insert(arguments.options.end(), switched_off.begin(), switched_off.end());
  if (rolling_radius && !arguments.rolling)
    base::refuse("rolling_radius: there is no rolling friction; expected rolling_friction with a model, "
                 "or no rolling_radius");
  if (!arguments.surface && arguments.meshes.empty())
    base::refuse("no wall is given; expected 'primitive type T zplane Z' or 'mesh n_meshes 1 meshes ID'");
  return arguments;
}

} // namespace eccentra::styles
