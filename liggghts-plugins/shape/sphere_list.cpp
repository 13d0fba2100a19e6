// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lines, separators, headers and rows of sphere lists.
#include "shape/sphere_list.h"

#include "shape/decimal.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// Coordinates and radii beyond these are no lengths: squares and fifth powers of them must stay finite.
constexpr double kMaxLength = 1e12, kMinRadius = 1e-12;
constexpr const char* kRow = "; expected rows x y z r";

[[noreturn]] void refuse(const std::string& where, const std::string& sentence) {
  throw std::invalid_argument(where + ": " + sentence);
}

struct Line {
  int number; ///< of the file, from 1
  std::string text, comment;
};

/// Lines of any system (LF, CR LF, CR), continued over '&', with what stands behind '#' set apart.
std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  int number = 1;
  bool continued = false;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    if (end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n')
      ++at;
    std::string comment;
    const std::size_t hash = line.find('#');
    if (hash != std::string::npos) {
      comment = line.substr(hash + 1);
      line.erase(hash);
    }
    line.erase(line.find_last_not_of(" \t") + 1);
    const bool continues = !line.empty() && line.back() == '&';
    if (continues)
      line.back() = ' ';
    if (continued)
      lines.back().text += line;
    else
      lines.push_back({number, line, comment});
    continued = continues;
  }
  return lines;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\""), last = text.find_last_not_of(" \t\"");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

/// Fields of a line; the separator is the first of ; , blank that it holds. Empty fields stay, but for a last one.
std::vector<std::string> fields_of(std::string line) {
  std::vector<std::string> fields;
  char separator = ' ';
  if (line.find(';') != std::string::npos) {
    separator = ';';
    std::replace(line.begin(), line.end(), ',', '.'); // where ; parts the fields, a comma is the decimal one
  } else if (line.find(',') != std::string::npos) {
    separator = ',';
  }
  if (trimmed(line).empty())
    return fields;
  std::replace(line.begin(), line.end(), '\t', ' ');
  const auto add_words = [&](const std::string& text) {
    for (std::size_t at = text.find_first_not_of(' '); at != std::string::npos;) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      fields.push_back(trimmed(text.substr(at, end - at)));
      at = text.find_first_not_of(' ', end);
    }
  };
  if (separator == ' ') {
    add_words(line);
    return fields;
  }
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    const std::string field = line.substr(at, end - at);
    if (trimmed(field).empty())
      fields.emplace_back();
    else
      add_words(field);
    at = end + 1;
  }
  if (fields.back().empty())
    fields.pop_back();
  return fields;
}

enum class Column { x, y, z, radius, diameter, label, body, unknown };

/// What a column of this name holds.
Column column_of(const std::string& name) {
  std::string word;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* radius : {"r", "rad", "radius", "radii", "sphereradius"})
    if (word == radius)
      return Column::radius;
  for (const char* diameter : {"d", "dia", "diam", "diameter", "diameters"})
    if (word == diameter)
      return Column::diameter;
  for (const char* body : {"clump", "clumpid", "cluster", "clusterid", "body", "bodyid"})
    if (word == body)
      return Column::body;
  for (const char* label : {"id", "i", "n", "no", "nr", "index", "number", "sphere", "sphereid", "pointid", "type",
                            "atomtype", "mat", "matid", "material", "materialid", "mask"})
    if (word == label)
      return Column::label;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "xyz"[axis]), digit(1, "012"[axis]);
    for (const char* more : {"", "c", "p", "pos", "position", "coord", "coordinate", "center", "centre"})
      if (word == more + letter || word == letter + more)
        return static_cast<Column>(axis);
    for (const char* more : {"points", "position", "center", "centre", "coordinates"}) // ParaView's tables
      if (word == more + digit)
        return static_cast<Column>(axis);
  }
  return Column::unknown;
}

/// Splits "x [mm]" into name and unit; the unit is empty where none is given.
std::pair<std::string, std::string> name_and_unit(const std::string& field) {
  const std::size_t open = field.find_first_of("[(");
  if (open == std::string::npos)
    return {field, {}};
  const std::size_t close = field.find_first_of("])", open);
  return {trimmed(field.substr(0, open)), trimmed(field.substr(open + 1, std::min(close, field.size()) - open - 1))};
}

/// Names of a header; units that stand apart ("x (mm) y (mm)") join their names.
std::vector<std::string> names_of(const std::string& line) {
  std::vector<std::string> names;
  for (const std::string& field : fields_of(line))
    if (!names.empty() && !field.empty() && (field[0] == '[' || field[0] == '('))
      names.back() += field;
    else
      names.push_back(field);
  return names;
}

/// Names of a comment that may be a header: "x y z r", or Yade's "format x_y_z_r_matId".
std::vector<std::string> names_of_comment(std::string comment) {
  const std::size_t format = comment.find("format ");
  if (format != std::string::npos) {
    comment.erase(0, format + 7);
    std::replace(comment.begin(), comment.end(), '_', ' ');
  }
  return names_of(comment);
}

bool has_axes(const std::vector<std::string>& names) {
  std::array<bool, 3> has{};
  for (const std::string& name : names) {
    const Column column = column_of(name_and_unit(name).first);
    if (column <= Column::z)
      has[static_cast<std::size_t>(column)] = true;
  }
  return has[0] && has[1] && has[2];
}

/// The meaning of each column, each of x, y, z and the size once.
std::vector<Column> columns_of(const std::vector<std::string>& names, const std::string& where) {
  std::vector<Column> columns;
  std::array<int, 4> count{};
  for (const std::string& field : names) {
    const auto [name, unit] = name_and_unit(field);
    const Column column = column_of(name);
    if (column == Column::unknown)
      refuse(where, "column '" + name +
                        "' is not known; expected x, y, z and r or d, beside id, type, material or clumpId: "
                        "delete the column");
    if (!unit.empty() && unit != "m")
      refuse(where, "column '" + name + "' is in '" + unit +
                        "'; expected metres: remove the unit and give `scale`, such as scale 1e-3 for mm");
    if (column <= Column::diameter)
      ++count[std::min<std::size_t>(static_cast<std::size_t>(column), 3)];
    columns.push_back(column);
  }
  if (count != std::array<int, 4>{1, 1, 1, 1})
    refuse(where, "the header does not name each of x, y, z and r (or d) once; expected such as 'x y z r': mend it or "
                  "delete it");
  return columns;
}

class Rows {
 public:
  explicit Rows(const std::string& file) : file_(file) {}

  void take(const Line& line) {
    const std::vector<std::string> fields = fields_of(line.text);
    const std::string where = file_ + " line " + std::to_string(line.number);
    if (fields.empty()) {
      const std::vector<std::string> names = names_of_comment(line.comment);
      if (spheres_.empty() && !header_ && has_axes(names))
        comment_names_ = names;
      return;
    }
    const bool arguments = std::none_of(fields.begin(), fields.end(), [](const std::string& f) { return decimal(f); });
    if (arguments && spheres_.empty() && !header_ && has_axes(names_of(line.text))) {
      columns_ = columns_of(names_of(line.text), where);
      header_ = true;
      return;
    }
    if (spheres_.empty() && !header_ && comment_names_.size() == fields.size() && has_axes(comment_names_)) {
      columns_ = columns_of(comment_names_, file_ + " line above line " + std::to_string(line.number));
      header_ = true;
    }
    const std::vector<double> values = numbers(fields, where);
    if (values.size() == 1 && spheres_.empty() && count_ < 0 && values[0] >= 1 && values[0] == std::floor(values[0])) {
      count_ = values[0];
      count_line_ = line.number;
      return;
    }
    if (values.size() != columns_.size())
      refuse(where, std::to_string(values.size()) + " numbers instead of " + std::to_string(columns_.size()) +
                        (header_ ? ", as the header says" + std::string(kRow) + ": complete the row"
                         : values.size() > columns_.size()
                             ? std::string(kRow) + ": delete what follows the radius, or name the columns in a line "
                                                   "above, such as 'x y z r type' (decimal commas need semicolons "
                                                   "between the numbers)"
                             : std::string(kRow) + ": complete the row"));
    add(values, where);
  }

  std::vector<Sphere> spheres() const {
    if (spheres_.empty())
      refuse(file_, "holds no spheres" + std::string(kRow) + ": give one row per sphere");
    if (count_ >= 0 && count_ != static_cast<double>(spheres_.size()))
      refuse(file_ + " line " + std::to_string(count_line_),
             "the count " + std::to_string(static_cast<long>(count_)) + " is not the number of rows that follow, " +
                 std::to_string(spheres_.size()) + ": the file is cut off or the count is wrong");
    return spheres_;
  }

 private:
  static std::vector<double> numbers(const std::vector<std::string>& fields, const std::string& where) {
    std::vector<double> values;
    for (const std::string& field : fields) {
      if (field.empty())
        refuse(where, "a field is empty" + std::string(kRow) + ": complete the row");
      const std::optional<double> value = decimal(field);
      if (!value || !std::isfinite(*value))
        refuse(where, "'" + field + "' is not a finite number" + kRow);
      values.push_back(*value);
    }
    return values;
  }

  void add(const std::vector<double>& values, const std::string& where) {
    Sphere sphere{Eigen::Vector3d::Zero(), 0};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Column column = columns_[k];
      if (column == Column::body) {
        if (spheres_.empty())
          body_ = values[k];
        if (values[k] != body_)
          refuse(where, "this sphere belongs to another clump than those before; expected one clump in a file: write "
                        "one file per clump");
        continue;
      }
      if (column == Column::label)
        continue;
      if (std::abs(values[k]) > kMaxLength)
        refuse(where, "the length " + text_of(values[k]) +
                          " is beyond 1e12; expected metres: give other units, and `scale` where the file is used");
      if (column == Column::radius || column == Column::diameter)
        sphere.radius = column == Column::diameter ? values[k] / 2 : values[k];
      else
        sphere.centre[static_cast<int>(column)] = values[k];
    }
    if (!(sphere.radius > 0))
      refuse(where, "the radius " + text_of(sphere.radius) + " is not greater than 0" + kRow);
    if (sphere.radius < kMinRadius)
      refuse(where, "the radius " + text_of(sphere.radius) +
                        " is below 1e-12; expected metres: give other units, and `scale` where the file is used");
    spheres_.push_back(sphere);
  }

  static std::string text_of(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
  }

  std::string file_;
  std::vector<Column> columns_ = {Column::x, Column::y, Column::z, Column::radius};
  std::vector<std::string> comment_names_;
  bool header_ = false;
  double count_ = -1, body_ = 0;
  int count_line_ = 0;
  std::vector<Sphere> spheres_;
};

} // namespace

SphereList parse_spheres(const std::string& text, const std::string& where) {
  const std::string byte_order_mark = "\xEF\xBB\xBF";
  std::string plain = text.compare(0, byte_order_mark.size(), byte_order_mark) == 0 ? text.substr(3) : text;
  if (plain.find('\0') != std::string::npos || plain.compare(0, 2, "\xFE\xFF") == 0 ||
      plain.compare(0, 2, "\xFF\xFE") == 0)
    refuse(where, "is not plain text; expected ASCII or UTF-8: save it as text, not as UTF-16 or a workbook");
  SphereList list;
  Rows rows(where);
  for (const Line& line : lines_of(plain)) {
    if (line.text.empty() && !line.comment.empty() && line.comment[0] == ':')
      list.keys.push_back(line.comment.substr(1));
    else
      rows.take(line);
  }
  list.spheres = rows.spheres();
  return list;
}

} // namespace eccentra::shape
