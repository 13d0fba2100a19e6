// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements dem_log.h.
#include "report/dem_log.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

namespace eccentra::report {
namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& line) {
  std::istringstream stream(line.substr(0, line.find('#')));
  Words words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return words;
}

std::optional<double> number(const Words& words, std::size_t at) {
  if (at >= words.size())
    return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(words[at].c_str(), &end);
  if (words[at].empty() || *end != '\0' || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// `count` numbers from a place on, or nothing.
std::optional<std::vector<double>> numbers(const Words& words, std::size_t at, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = number(words, at + i);
    if (!value)
      return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::optional<Vector> unit(const std::vector<double>& values, std::size_t at) {
  const double length = std::hypot(values[at], values[at + 1], values[at + 2]);
  if (!(length > 0))
    return std::nullopt;
  return Vector{values[at] / length, values[at + 1] / length, values[at + 2] / length};
}

std::size_t place_of(const Words& words, const char* word) {
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
}

/// `primitive type T SHAPE ...`
std::optional<Wall> primitive(const Words& words) {
  const std::size_t at = place_of(words, "primitive") + 3;
  if (at >= words.size())
    return std::nullopt;
  const std::string& name = words[at];
  Wall wall;
  if (name == "plane") {
    const auto values = numbers(words, at + 1, 6);
    const auto normal = values ? unit(*values, 3) : std::nullopt;
    if (!normal)
      return std::nullopt;
    wall.point = {(*values)[0], (*values)[1], (*values)[2]};
    wall.axis = *normal;
    return wall;
  }
  if (name.size() < 6 || name[0] < 'x' || name[0] > 'z')
    return std::nullopt;
  const auto d = static_cast<std::size_t>(name[0] - 'x');
  wall.axis = {0, 0, 0};
  wall.axis[d] = 1;
  const auto values = numbers(words, at + 1, name.substr(1) == "plane" ? 1 : 3);
  if (!values)
    return std::nullopt;
  if (name.substr(1) == "plane") {
    wall.point[d] = (*values)[0];
    return wall;
  }
  if (name.substr(1) != "cylinder")
    return std::nullopt;
  wall.kind = Wall::Kind::cylinder;
  wall.radius = (*values)[0];
  wall.point[(d + 1) % 3] = (*values)[1];
  wall.point[(d + 2) % 3] = (*values)[2];
  return wall;
}

struct Placed {
  WallMesh mesh;
  bool turned = false;
};

/// `fix ID group mesh/surface... file F type T ...`
Placed placed(const Words& words) {
  Placed result;
  result.mesh.id = words[1];
  result.turned = place_of(words, "rotate") < words.size();
  for (std::size_t i = 4; i + 1 < words.size(); ++i) {
    if (words[i] == "file")
      result.mesh.file = words[i + 1];
    if (words[i] == "scale")
      result.mesh.scale = number(words, i + 1).value_or(1);
    if (words[i] == "move")
      if (const auto by = numbers(words, i + 1, 3))
        result.mesh.move = {(*by)[0], (*by)[1], (*by)[2]};
  }
  return result;
}

class Reader {
 public:
  void line(const std::string& text) {
    const std::string box = "orthogonal box = (";
    if (const auto at = text.find(box); at != std::string::npos)
      read_box(text.substr(at + box.size()));
    if (text.find('$') != std::string::npos)
      return;
    const Words words = words_of(text);
    if (words.size() < 2)
      return;
    if (words[0] == "timestep") {
      const double step = number(words, 1).value_or(0);
      run.time_step = ran_ && step != run.time_step ? 0 : step;
    } else if (words[0] == "run") {
      ran_ = true;
    } else if (words[0] == "unfix") {
      run.walls.erase(words[1]);
      meshes_.erase(words[1]);
      users_.erase(words[1]);
      if (words[1] == gravity_)
        run.gravity = {0, 0, 0};
    } else if (words[0] == "fix" && words.size() > 4) {
      fix(words);
    }
  }

  DemRun finished() {
    for (const auto& [id, placed_mesh] : meshes_) {
      const bool used = std::any_of(users_.begin(), users_.end(), [&id = id](const auto& user) {
        return std::find(user.second.begin(), user.second.end(), id) != user.second.end();
      });
      if (!used)
        continue;
      if (placed_mesh.turned)
        run.left_out.push_back(id);
      else
        run.meshes.push_back(placed_mesh.mesh);
    }
    return run;
  }

 private:
  void fix(const Words& words) {
    const std::string& style = words[3];
    if (style == "gravity") {
      const std::size_t at = place_of(words, "vector");
      const auto values = numbers(words, at + 1, 3);
      const auto direction = values ? unit(*values, 0) : std::nullopt;
      const auto size = number(words, 4);
      if (direction && size) {
        gravity_ = words[1];
        for (std::size_t d = 0; d < 3; ++d)
          run.gravity[d] = *size * (*direction)[d];
      }
    } else if (style.rfind("mesh/surface", 0) == 0) {
      meshes_[words[1]] = placed(words);
    } else if (style == "wall/gran" || style == "wall/gran/cluster") {
      run.walls.erase(words[1]);
      if (const auto wall = primitive(words))
        run.walls[words[1]] = *wall;
      const std::size_t list = place_of(words, "meshes");
      if (list < words.size())
        users_[words[1]] = Words(words.begin() + static_cast<std::ptrdiff_t>(list) + 1, words.end());
    }
  }

  void read_box(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
    Words words = words_of(text);
    words.erase(std::remove(words.begin(), words.end(), "to"), words.end());
    if (const auto values = numbers(words, 0, 6)) {
      for (std::size_t d = 0; d < 3; ++d) {
        run.box[2 * d] = (*values)[d];
        run.box[2 * d + 1] = (*values)[d + 3];
      }
      run.has_box = true;
    }
  }

  DemRun run;
  std::string gravity_;
  bool ran_ = false;
  std::map<std::string, Placed> meshes_;
  std::map<std::string, Words> users_; // of meshes, by the id of the wall
};

} // namespace

DemRun read_dem_log(const std::string& text) {
  Reader reader;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    reader.line(line);
  return reader.finished();
}

} // namespace eccentra::report
