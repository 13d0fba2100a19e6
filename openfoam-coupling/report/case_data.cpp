// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements case_data.h.
#include "report/case_data.h"

#include "base/scene_file.h"

#include <vtkAppendPolyData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace eccentra::report {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file, const std::string& remedy) {
  std::ifstream stream(file);
  if (!stream)
    throw std::runtime_error(file.string() + ": cannot be read: " + remedy);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The text without the comments of OpenFOAM's dictionaries.
std::string without_comments(const std::string& text) {
  static const std::regex comments(R"(//[^\n]*|/\*[^]*?\*/)");
  return std::regex_replace(text, comments, "");
}

/// The text with the case's own numbers in place of `$:scene.name` and `$scene.name`.
std::string with_scene(std::string text, const fs::path& folder) {
  const fs::path file = folder / "scene";
  if (!fs::is_regular_file(file))
    return text;
  for (const auto& [name, value] : base::read_scene(text_of(file, "it has the case's numbers"), file.string()))
    text = std::regex_replace(text, std::regex("\\$:?scene\\." + name + "\\b"), value);
  return text;
}

double entry(const std::string& text, const fs::path& file, const std::string& keyword, double missing, bool required) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex("(?:^|[\\s;}])" + keyword + R"(\s+([^;]+);)"))) {
    if (required)
      throw std::runtime_error(file.string() + ": the entry '" + keyword + "' is missing");
    return missing;
  }
  try {
    std::size_t used = 0;
    const std::string value = match.str(1);
    const double number = std::stod(value, &used);
    if (value.find_first_not_of(" \t\n", used) == std::string::npos && std::isfinite(number))
      return number;
  } catch (const std::exception&) { // the sentence below says it
  }
  throw std::runtime_error(file.string() + ": '" + keyword + " " + match.str(1) + "' is not a number");
}

/// Particle files in the usual places, by the start of their names, in the order of their steps.
std::vector<ParticleFile> find_files(const fs::path& folder, const std::regex& pattern) {
  std::vector<ParticleFile> files;
  for (const char* place : {"postProcessing/eccentra", "post", "."}) {
    const fs::path where = folder / place;
    if (!fs::is_directory(where))
      continue;
    for (const auto& item : fs::directory_iterator(where)) {
      std::smatch match;
      const std::string name = item.path().filename().string();
      if (std::regex_match(name, match, pattern))
        files.push_back({item.path(), std::stol(match.str(1))});
    }
    if (!files.empty())
      break;
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.step < b.step; });
  return files;
}

} // namespace

Table read_csv(const fs::path& file) {
  std::istringstream lines(text_of(file, "the run writes it; has it started?"));
  Table table;
  std::string line;
  std::getline(lines, line);
  std::istringstream names(line);
  for (std::string name; std::getline(names, name, ',');) {
    table.names.push_back(name);
    table.columns[name];
  }
  if (table.names.empty())
    throw std::runtime_error(file.string() + ": the first line must hold the names of the columns");
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    std::vector<double> values;
    std::istringstream arguments(line);
    for (std::string word; std::getline(arguments, word, ',');) {
      char* end = nullptr;
      values.push_back(std::strtod(word.c_str(), &end));
      if (word.empty() || *end != '\0')
        throw std::runtime_error(file.string() + ", line " + std::to_string(number) + ": '" + word +
                                 "' is not a number");
    }
    if (values.size() < table.names.size() && lines.peek() == EOF)
      break;
    if (values.size() != table.names.size())
      throw std::runtime_error(file.string() + ", line " + std::to_string(number) + ": " +
                               std::to_string(values.size()) + " values under " + std::to_string(table.names.size()) +
                               " names");
    for (std::size_t i = 0; i < values.size(); ++i)
      table.columns[table.names[i]].push_back(values[i]);
  }
  return table;
}

Case read_case(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw std::runtime_error(folder.string() + ": no such case folder");
  Case result;
  result.folder = folder;
  result.name = fs::canonical(folder).filename().string();
  const fs::path table = folder / "postProcessing" / "eccentra" / "coupling.csv";
  const fs::path log = folder / "log.liggghts";
  if (fs::is_regular_file(log))
    result.dem = read_dem_log(text_of(log, "the run writes it"));
  // LIGGGHTS writes a second file with the bounding box beside each: those do not count.
  result.bodies = find_files(folder, std::regex(R"((?:particles|bodies)[_.-]?(\d+)\.vt[kp])"));
  result.spheres = find_files(folder, std::regex(R"((?:grains|spheres|clusters|heap)[_.-]?(\d+)\.vt[kp])"));
  if (result.spheres.empty())
    result.spheres = result.bodies;
  if (result.bodies.empty())
    result.bodies = result.spheres;
  const fs::path dictionary = folder / "system" / "annulusMeshDict";
  result.is_annulus = fs::is_regular_file(dictionary);
  if (!result.is_annulus) {
    if (result.bodies.empty())
      throw std::runtime_error(
          folder.string() +
          ": neither system/annulusMeshDict nor files of particles; expected the folder of a run, with "
          "postProcessing/eccentra/particles_*.vtk (dump custom/vtk) or grains_*.vtp (dump cluster/vtk)");
    if (fs::is_regular_file(table))
      result.run = read_csv(table);
    return result;
  }
  const std::string text = with_scene(
      without_comments(text_of(dictionary, "a case of annulusFoam has it; give the case folder itself")), folder);
  const auto number = [&](const char* keyword) { return entry(text, dictionary, keyword, 0, true); };
  result.section.hole_radius = number("holeRadius");
  result.section.pipe_radius = number("pipeRadius");
  result.section.length = number("length");
  result.section.pipe_centre = {0, -number("eccentricity") * (result.section.hole_radius - result.section.pipe_radius)};
  result.inclination = entry(text, dictionary, "inclination", 0, false);
  result.run = read_csv(table);
  return result;
}

vtkSmartPointer<vtkPolyData> read_points(const fs::path& file) {
  vtkSmartPointer<vtkPolyData> points;
  if (file.extension() == ".vtp") {
    const auto reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
    reader->SetFileName(file.c_str());
    reader->Update();
    points = reader->GetOutput();
  } else {
    const auto reader = vtkSmartPointer<vtkPolyDataReader>::New();
    reader->SetFileName(file.c_str());
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->ReadAllFieldsOn();
    reader->Update();
    points = reader->GetOutput();
  }
  if (points == nullptr)
    throw std::runtime_error(file.string() + ": not a file of points that VTK can read");
  return points;
}

Snapshot read_snapshot(const ParticleFile& file) {
  const auto points = read_points(file.path);
  vtkPointData& data = *points->GetPointData();
  vtkDataArray* velocity = velocity_of(*points);
  vtkDataArray* radius = data.GetArray("radius");
  vtkDataArray* mass = data.GetArray("mass");
  vtkDataArray* density = data.GetArray("density");
  vtkDataArray* type = data.GetArray("type");
  const bool by_mass = mass != nullptr && density != nullptr;
  if (points->GetNumberOfPoints() > 0 && (velocity == nullptr || (radius == nullptr && !by_mass)))
    throw std::runtime_error(file.path.string() +
                             ": the points lack a velocity or a radius: dump radius mass density vx vy vz");
  Snapshot snapshot;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    Vector position{};
    Vector speed{};
    points->GetPoint(i, position.data());
    velocity->GetTuple(i, speed.data());
    constexpr double sphere = 4.18879020478639098; // 4 pi / 3
    snapshot.position.push_back(position);
    snapshot.velocity.push_back(speed);
    // The radius of a cluster is that of its bounding sphere.
    snapshot.volume.push_back(by_mass ? mass->GetTuple1(i) / density->GetTuple1(i)
                                      : sphere * std::pow(radius->GetTuple1(i), 3));
    if (radius != nullptr)
      snapshot.radius.push_back(radius->GetTuple1(i));
    if (type != nullptr)
      snapshot.type.push_back(static_cast<int>(type->GetTuple1(i)));
  }
  return snapshot;
}

vtkDataArray* velocity_of(vtkPolyData& points) {
  vtkDataArray* velocity = points.GetPointData()->GetArray("velocity");
  return velocity != nullptr ? velocity : points.GetPointData()->GetArray("v");
}

} // namespace eccentra::report
