// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of wall/gran/cluster.
#include "styles/walls/wall_arguments.h"

#include "base/option_reader.h"
#include "base/refusal.h"
#include "contact/stock_contact_keywords.h"

#include <cmath>
#include <stdexcept>

namespace eccentra::styles {

namespace {

class Reader {
 public:
  explicit Reader(const std::vector<std::string>& arguments) : arguments_(arguments) {}

  std::size_t at = 0;

  bool done() const { return at >= arguments_.size(); }
  const std::string& peek() const { return arguments_[at]; }
  const std::string& next(const std::string& wanted) {
    if (done())
      throw std::invalid_argument("the line ends where " + wanted + " was expected");
    return arguments_[at++];
  }
  void expect(const std::string& word) {
    const std::string& found = next("'" + word + "'");
    if (found != word)
      throw std::invalid_argument("expected '" + word + "' but found '" + found + "'");
  }
  double number(const std::string& name) {
    const std::string& word = next("a number for " + name);
    const std::optional<double> value = base::finite_number(word);
    if (!value)
      base::refuse("{}: '{}' is not a finite number; expected one such as 0.3 or 5e-3", name, word);
    return *value;
  }
  bool on_off(const std::string& name) {
    base::OptionReader reader({name, next("on or off after " + name)});
    reader.keyword();
    return reader.on_off();
  }
  /// True for `yes`, false for `no`, whichever word follows `name`.
  bool choose(const std::string& name, const std::string& yes, const std::string& no) {
    const std::string& word = next(yes + " or " + no + " after " + name);
    if (word != yes && word != no)
      throw std::invalid_argument(name + " must be " + yes + " or " + no + ", not '" + word + "'");
    return word == yes;
  }
  /// The only value that there is for this keyword.
  void expect_only(const std::string& name, const std::string& value, const std::string& why) {
    const std::string& word = next("'" + value + "' after " + name);
    if (word != value)
      throw std::invalid_argument(name + " '" + word + "' is not offered at walls; expected " + value + ": " + why);
  }
  int count(const std::string& name) {
    const double value = number(name);
    if (value != std::floor(value) || value < 1.0)
      throw std::invalid_argument(name + " must be a whole number of at least 1, not '" + arguments_[at - 1] + "'");
    return static_cast<int>(value);
  }
  Eigen::Vector3d vector(const std::string& name) {
    const double x = number(name + " x");
    const double y = number(name + " y");
    const double z = number(name + " z");
    return {x, y, z};
  }

 private:
  const std::vector<std::string>& arguments_;
};

contact::WallSurface read_surface(Reader& reader) {
  const std::string style =
      reader.next("a primitive wall (xplane, yplane, zplane, plane, xcylinder, ycylinder, zcylinder)");
  if (style == "plane") {
    const Eigen::Vector3d point = reader.vector("plane point");
    const Eigen::Vector3d normal = reader.vector("plane normal");
    if (normal.norm() == 0.0)
      throw std::invalid_argument("the plane's normal has length 0: give the direction across the plane");
    return contact::WallSurface::plane(point, normal);
  }
  const std::string shape = style.empty() ? style : style.substr(1);
  const int axis = style.empty() ? -1 : style[0] - 'x';
  if (axis < 0 || axis > 2 || (shape != "plane" && shape != "cylinder"))
    throw std::invalid_argument("unknown primitive wall '" + style +
                                "': xplane, yplane, zplane, plane, xcylinder, ycylinder and zcylinder are there");
  const Eigen::Vector3d direction = Eigen::Vector3d::Unit(axis);
  if (shape == "plane")
    return contact::WallSurface::plane(reader.number(style + " position") * direction, direction);
  const double radius = reader.number(style + " radius");
  if (radius <= 0.0)
    throw std::invalid_argument(style + " radius must be > 0, not " + std::to_string(radius));
  // Centre coordinates in cyclic order after the axis, as stock LIGGGHTS takes them.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  centre[(axis + 1) % 3] = reader.number(style + " first centre coordinate");
  centre[(axis + 2) % 3] = reader.number(style + " second centre coordinate");
  return contact::WallSurface::cylinder(centre, direction, radius);
}

void check_stays_in_place(const contact::WallSurface& surface, const Eigen::Vector3d& velocity) {
  const double across =
      surface.is_plane() ? std::abs(velocity.dot(surface.direction())) : velocity.cross(surface.direction()).norm();
  if (across > 1e-12 * velocity.norm())
    throw std::invalid_argument("velocity would carry the wall away from its place: a plane slides along itself and a "
                                "cylinder along its axis; use mesh walls with fix move/mesh for other motions");
}

void read_primitive(Reader& reader, WallArguments& arguments) {
  if (arguments.surface || !arguments.meshes.empty())
    throw std::invalid_argument("one wall per fix: give a fix of its own to each primitive wall and to meshes");
  reader.expect("type");
  arguments.type = reader.count("type");
  arguments.surface = read_surface(reader);
  while (!reader.done() && (reader.peek() == "rotate" || reader.peek() == "velocity")) {
    if (reader.next("") == "rotate") {
      arguments.surface->set_rotation(reader.number("rotate"));
    } else {
      const Eigen::Vector3d velocity = reader.vector("velocity");
      check_stays_in_place(*arguments.surface, velocity);
      arguments.surface->set_velocity(velocity);
    }
  }
}

void read_meshes(Reader& reader, WallArguments& arguments) {
  if (arguments.surface || !arguments.meshes.empty())
    throw std::invalid_argument("one wall per fix: give a fix of its own to each primitive wall and to meshes");
  reader.expect("n_meshes");
  const int count = reader.count("n_meshes");
  reader.expect("meshes");
  for (int i = 0; i < count; ++i)
    arguments.meshes.push_back(reader.next("the id of a fix mesh/surface"));
}

std::unique_ptr<WallRolling> read_rolling(Reader& reader, const std::vector<std::string>& all) {
  const std::string& word = reader.next("a rolling model after rolling_friction");
  if (word == "off" || word == "none")
    return nullptr;
  const auto found = wall_rolling_models().find(word);
  if (found == wall_rolling_models().end()) {
    std::string known = "off";
    for (const auto& entry : wall_rolling_models())
      known += ", " + entry.first;
    throw std::invalid_argument("rolling_friction '" + word + "' is unknown at walls: there are " + known);
  }
  std::unique_ptr<WallRolling> model = found->second();
  std::size_t before;
  do {
    before = reader.at;
    model->read_arguments(all, reader.at);
  } while (reader.at != before);
  return model;
}

/// A name of one of stock's kinds of models.
std::string read_model(Reader& reader, const std::string& kind) {
  const std::string name = reader.next("a name after " + kind);
  if (!StockContact::knows(kind, name) && !(kind == "model" && contact::find_contact_model(name)))
    throw std::invalid_argument(kind + " '" + name + "' is not offered; expected one of " + StockContact::known(kind));
  return name;
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
    throw std::invalid_argument(
        "damping 'paper' is not offered for the models of LIGGGHTS; expected it with model hertz, "
        "tangential history or off, and no cohesion");
  if (paper && friction_bound)
    throw std::invalid_argument("friction_bound: damping paper has a bound of its own, the elastic one for the spring "
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
  Reader reader(all);
  bool friction_bound = false, tangential_update = false, rolling_radius = false;
  reader.expect("model");
  arguments.names.normal = read_model(reader, "model");
  while (!reader.done()) {
    const std::string& word = reader.next("");
    if (word == "tangential") {
      arguments.names.tangential = read_model(reader, word);
    } else if (word == "cohesion") {
      arguments.names.cohesion = read_model(reader, word);
    } else if (word == "friction_bound") {
      friction_bound = true;
      arguments.friction =
          reader.choose(word, "elastic", "stock") ? contact::FrictionBound::elastic : contact::FrictionBound::stock;
    } else if (word == "tangential_update") {
      tangential_update = true;
      arguments.synchronised = reader.choose(word, "synchronised", "stock");
    } else if (word == "rolling_radius") {
      rolling_radius = true;
      arguments.rolling_radius =
          reader.choose(word, "body", "sub_sphere") ? RollingRadius::body : RollingRadius::sub_sphere;
    } else if (contact::is_switch_of_a_model(word)) {
      if (reader.on_off(word)) {
        arguments.options.push_back(word);
        arguments.options.push_back("on");
      }
    } else if (word == "surface") {
      reader.expect_only(word, "default", "bodies are what their spheres are");
    } else if (word == "shear") {
      throw std::invalid_argument("'shear' is written otherwise here: rotate OMEGA for a cylinder that turns, velocity "
                                  "VX VY VZ for a wall that slides along itself");
    } else if (contact::stock_contact_keywords().count(word)) {
      if (const std::string refused = contact::refused_stock_keyword(word, reader.next("a value for " + word));
          !refused.empty())
        throw std::invalid_argument(refused);
    } else if (word == "rolling_friction") {
      arguments.rolling_model = reader.done() ? "" : reader.peek();
      arguments.rolling = read_rolling(reader, all);
    } else if (word == "contacts") {
      arguments.shared = reader.choose(word, "shared", "parallel");
    } else if (word == "damping") {
      arguments.damping =
          reader.choose(word, "stock", "paper") ? contact::DampingLaw::stock : contact::DampingLaw::paper;
    } else if (word == "tangential_damping") {
      arguments.tangential_damping = reader.on_off(word);
    } else if (word == "primitive") {
      read_primitive(reader, arguments);
    } else if (word == "mesh") {
      read_meshes(reader, arguments);
    } else {
      // Stock has the arguments of the rolling model after the wall.
      const std::size_t here = --reader.at;
      if (arguments.rolling)
        arguments.rolling->read_arguments(all, reader.at);
      if (reader.at == here)
        throw std::invalid_argument(
            "unknown word '" + word +
            "': tangential, cohesion, rolling_friction, rolling_radius, contacts, damping, tangential_damping, "
            "friction_bound, tangential_update, primitive (with rotate "
            "and velocity, which stock calls shear) and mesh are there");
    }
  }
  complete(arguments, friction_bound, tangential_update);
  if (rolling_radius && !arguments.rolling)
    throw std::invalid_argument("rolling_radius: there is no rolling friction; expected rolling_friction with a model, "
                                "or no rolling_radius");
  if (!arguments.surface && arguments.meshes.empty())
    throw std::invalid_argument("no wall is given: add 'primitive type T zplane Z' or 'mesh n_meshes 1 meshes ID'");
  return arguments;
}

} // namespace eccentra::styles
