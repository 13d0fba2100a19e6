// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// clusterShape: from the command line to the shape and to what was asked about it.
#include "shape/builtin_shapes.h"
#include "shape/clump_file.h"
#include "shape/shape_keywords.h"
#include "shape/vtk/picture.h"
#include "shape/vtk/stl_shape.h"
#include "tools/advise.h"
#include "tools/shape_arguments.h"
#include "tools/shape_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace {
using namespace eccentra::shape;

/// Size of built-in shapes where none is asked for: the cuttings of the paper [m].
constexpr double default_diameter = 6.35e-3;

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Lets a bare file name stand for `file NAME` or `stl NAME`, and adds the options that belong to these arguments.
std::vector<std::string> complete_arguments(const ShapeArguments& a, const std::vector<std::string>& typed) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < typed.size(); ++k) {
    std::string name = typed[k];
    const bool clump = ends_with(name, ".clump"), stl = ends_with(name, ".stl") || ends_with(name, ".STL");
    if (name == "file" || name == "stl") {
      words.push_back(name);
      if (++k >= typed.size())
        break;
      words.push_back(typed[k]);
      name = words[words.size() - 2];
    } else if (clump || stl) {
      name = clump ? "file" : "stl";
      words.push_back(name);
      words.push_back(typed[k]);
    } else {
      words.push_back(name);
      continue;
    }
    auto add = [&](const char* key, bool given, const std::string& value) {
      if (given)
        words.insert(words.end(), {key, value});
    };
    add("scale", a.scale > 0, fmt::format("{}", a.scale));
    if (name == "stl") {
      add("spheres", a.spheres > 0, std::to_string(a.spheres));
      add("error", a.error > 0, fmt::format("{}", a.error));
      add("resolution", a.resolution > 0, std::to_string(a.resolution));
      add("mass", !a.mass.empty(), a.mass);
    }
  }
  return words;
}

ClusterShape next_shape(const ShapeArguments& a, const std::vector<std::string>& words, std::size_t& place) {
  if (place >= words.size())
    throw std::invalid_argument("a shape is missing: see clusterShape --help");
  const bool sized = words[place] == "file" || words[place] == "stl";
  std::size_t used = 0;
  ClusterShape shape = make_shape(words, place, used, a.diameter > 0 ? a.diameter : sized ? 0 : default_diameter);
  place += used;
  return shape;
}

void require_end(const std::vector<std::string>& words, std::size_t place) {
  if (place < words.size())
    throw std::invalid_argument("word '" + words[place] + "' is not understood: see clusterShape --help");
}

void require_stl_options_fit(const ShapeArguments& a, const std::vector<std::string>& words) {
  bool stl = false, file = false;
  for (const std::string& word : words) {
    stl = stl || word == "stl";
    file = file || word == "file";
  }
  if (!stl && (a.spheres > 0 || a.error > 0 || a.resolution > 0 || !a.mass.empty()))
    throw std::invalid_argument("--spheres, --error, --resolution and --mass belong to STL files: none was given");
  if (!stl && !file && a.scale > 0)
    throw std::invalid_argument("--scale belongs to files: give the size of a built-in shape by --diameter");
}

void write_files(const ShapeArguments& a, const std::vector<ClusterShape>& shapes) {
  if (!a.clump.empty()) {
    std::ofstream out(a.clump);
    write_clump(out, shapes[0]);
    if (!out.flush())
      throw std::invalid_argument("cannot write '" + a.clump + "': check the folder and the space on the disk");
  }
  if (!a.vtk.empty())
    write_surface(shapes, a.vtk);
  if (!a.png.empty())
    write_picture(shapes, a.png);
}

std::string list_text() {
  std::string text;
  for (const BuiltinShape& s : builtin_shapes()) {
    std::size_t used = 0;
    const ClusterShape shape = make_shape({s.family, std::to_string(s.count)}, 0, used, default_diameter);
    text += fmt::format("{:<10} sphericity {:.3f}  {}\n", shape.name(), shape.sphericity(), s.description);
  }
  return text + fmt::format("cube n^3   any other cube up to n = {}\n", largest_cube);
}

/// Numbers of spheres that the table of an STL file shows: 1, 2, 4, ... and all.
std::vector<int> ladder(int all) {
  std::vector<int> steps;
  for (int k = 1; k < all; k *= 2)
    steps.push_back(k);
  steps.push_back(all);
  return steps;
}

void report_stl(const ShapeArguments& a, const std::string& path) {
  if (a.spheres == 0 && a.error == 0)
    throw std::invalid_argument("shape stl '" + path + "' needs to know where to stop: give --spheres N or --error E");
  const Solid solid(path, a.scale > 0 ? a.scale : 1);
  const std::vector<Sphere> spheres = inscribed_spheres(solid, {a.spheres, a.error, a.resolution});
  const MassOf mass_of = a.mass == "solid" ? MassOf::solid : MassOf::spheres;
  const ClusterShape shape = shape_of_solid(solid, spheres, mass_of, a.diameter);
  const ShapeReport report = measure(shape, shape);
  const SolidEccentricity own = solid_eccentricity(solid);
  std::vector<FitQuality> fits;
  for (const int count : ladder(static_cast<int>(spheres.size())))
    fits.push_back(fit_quality(solid, own, {spheres.begin(), spheres.begin() + count}, mass_of));
  if (a.property_lines) {
    fmt::print("{}", property_lines(report, {a.partner, a.estimate}, {a.types, a.own_type, a.mu_r}));
  } else if (a.json) {
    nlohmann::json json = to_json(report), table = nlohmann::json::array();
    for (const FitQuality& f : fits)
      table.push_back({{"spheres", f.spheres},
                       {"volume_error", f.volume},
                       {"inertia_error", f.inertia},
                       {"surface_distance", {{"mean", f.mean_distance}, {"max", f.max_distance}}},
                       {"eccentricity_error", {{"mean", f.mean_eccentricity}, {"max", f.max_eccentricity}}}});
    const MassProperties& p = solid.properties();
    json["solid"] = {{"volume", p.volume},
                     {"surface", p.surface},
                     {"centre", {p.centre.x(), p.centre.y(), p.centre.z()}},
                     {"eccentricity", {{"plane", {{"mean", own.mean}, {"max", own.max}}}}}};
    json["fit"] = table;
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}", to_text(report));
    fmt::print("  mass properties of the {}; solid: {} triangles, volume {:.6g} m3, delta_e/R_eq on plane mean {:.4f} "
               "max {:.4f}\n",
               mass_of == MassOf::solid ? "solid" : "union of the spheres", solid.triangles().size(),
               solid.properties().volume, own.mean, own.max);
    fmt::print("  spheres   volume  inertia  distance to surface/R_eq  delta_e/R_eq on plane\n"
               "             error    error       mean        max       mean error  max error\n");
    for (const FitQuality& f : fits)
      fmt::print("  {:>7} {:>7.2f}% {:>7.2f}% {:>10.4f} {:>10.4f} {:>16.4f} {:>10.4f}\n", f.spheres, 100 * f.volume,
                 100 * f.inertia, f.mean_distance, f.max_distance, f.mean_eccentricity, f.max_eccentricity);
  }
  write_files(a, {shape});
}

/// Takes arguments that a LIGGGHTS script would have behind a shape ("diameter 6.35e-3", "spheres 50") for the options
/// they name.
ShapeArguments with_script_words(ShapeArguments a) {
  std::vector<std::string> rest;
  for (std::size_t k = 0; k < a.words.size(); ++k) {
    const std::string key = a.words[k];
    const bool known = key == "diameter" || key == "scale" || key == "spheres" || key == "error" ||
                       key == "resolution" || key == "mass";
    if (!known) {
      rest.push_back(key);
      continue;
    }
    const std::string& value = word_at(a.words, ++k, "a value after '" + key + "'");
    if (key == "mass" && value != "solid" && value != "union")
      throw std::invalid_argument("mass is '" + value + "': choose solid or union");
    if (key == "mass")
      a.mass = value;
    else if (key == "spheres")
      a.spheres = static_cast<int>(whole_number(value, key));
    else if (key == "resolution")
      a.resolution = static_cast<int>(whole_number(value, key));
    else
      (key == "diameter" ? a.diameter : key == "scale" ? a.scale : a.error) = positive_number(value, key);
  }
  a.words = rest;
  return a;
}

void report_advice(const ShapeArguments& a) {
  const std::string& body = word_at(a.words, 1, "cube or disk after 'advise'");
  require_end(a.words, 2);
  if (!(a.error > 0))
    throw std::invalid_argument("advise needs to know the error that is allowed: give --error E, such as 0.05 for 5 %");
  if (a.data.empty()) {
    const std::vector<GeometryLevel> levels = geometry_levels(body);
    fmt::print("{}", a.json ? json_of(levels, a.error).dump(2) + "\n" : text_of(levels, a.error));
    return;
  }
  std::ifstream in(a.data);
  if (!in)
    throw std::invalid_argument("cannot open '" + a.data + "': check the path, or leave --data out");
  const std::vector<Advice> advice = advise(read_level_results(in, a.data), body, a.scene, a.error);
  fmt::print("{}", a.json ? json_of(advice, a.error, a.data).dump(2) + "\n" : text_of(advice, a.error, a.data));
}

void run(const ShapeArguments& typed) {
  if (typed.words[0] == "advise") {
    report_advice(typed);
    return;
  }
  if (!typed.data.empty())
    throw std::invalid_argument(
        "--data and --scene belong to advise: write 'clusterShape advise cube --error 0.05 --data " + typed.data + "'");
  const ShapeArguments a = typed.words[0] == "compare" ? typed : with_script_words(typed);
  if (a.words[0] == "list") {
    require_end(a.words, 1);
    fmt::print("{}", list_text());
    return;
  }
  const bool compare = a.words[0] == "compare";
  const std::vector<std::string> words =
      complete_arguments(a, std::vector<std::string>(a.words.begin() + (compare ? 1 : 0), a.words.end()));
  require_stl_options_fit(a, words);
  if (!compare && words[0] == "stl") {
    const std::string& path = word_at(words, 1, "the name of an STL file after 'stl'");
    require_end(a.words, a.words[0] == "stl" ? 2 : 1);
    report_stl(a, path);
    return;
  }
  std::size_t place = 0;
  std::vector<ClusterShape> shapes{next_shape(a, words, place)};
  if (compare)
    shapes.push_back(next_shape(a, words, place));
  require_end(words, place);
  const ShapeReport first = measure(shapes[0], shapes.back());
  if (a.property_lines) {
    fmt::print("{}", property_lines(first, {a.partner, a.estimate}, {a.types, a.own_type, a.mu_r}));
  } else if (!compare) {
    fmt::print("{}", a.json ? to_json(first).dump(2) + "\n" : to_text(first));
  } else {
    const ShapeReport second = measure(shapes[1], shapes[0]);
    fmt::print("{}", a.json ? nlohmann::json{{"a", to_json(first)}, {"b", to_json(second)}}.dump(2) + "\n"
                            : compare_text(first, second));
  }
  write_files(a, shapes);
}

} // namespace

int main(int argc, char** argv) {
  ShapeArguments arguments;
  int exit_code = 0;
  if (!read_arguments(argc, argv, arguments, exit_code))
    return exit_code;
  try {
    install_stl_keywords();
    run(arguments);
  } catch (const std::exception& e) {
    std::fflush(stdout);
    fmt::print(stderr, "clusterShape: {}\n", e.what());
    return 1;
  }
  return 0;
}
