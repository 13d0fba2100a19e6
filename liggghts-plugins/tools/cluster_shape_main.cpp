// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// clusterShape: from the command line to the shape and to what was asked about it.
#include "base/option_reader.h"
#include "base/standard_output.h"
#include "shape/clump_file.h"
#include "shape/shape_family.h"
#include "shape/shape_keywords.h"
#include "shape/vtk/hull_of_stl.h"
#include "shape/vtk/picture.h"
#include "shape/vtk/stl_shape.h"
#include "tools/advise.h"
#include "tools/shape_arguments.h"
#include "tools/shape_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <fstream>
#include <set>
#include <stdexcept>

namespace {
using namespace eccentra::shape;

/// Size of built-in shapes where none is asked for: the cuttings of the paper [m].
constexpr double default_diameter = 6.35e-3;

bool ends_with(std::string text, const std::string& end) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return !end.empty() && text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

const ShapeFamily* family_named(const std::string& word) {
  for (const ShapeFamily& family : shape_families())
    if (family.name == word)
      return &family;
  return nullptr;
}

bool has_option(const ShapeFamily& family, const std::string& name) {
  return std::any_of(family.options.begin(), family.options.end(),
                     [&](const ShapeOption& o) { return o.name == name; });
}

/// Lets a bare file name stand for the arguments of its family, and adds the options typed to the families that have
/// them.
std::vector<std::string> complete_arguments(const ShapeArguments& a, const std::vector<std::string>& typed) {
  std::vector<std::string> words;
  std::set<std::string> families;
  for (std::size_t k = 0; k < typed.size(); ++k) {
    const ShapeFamily* family = family_named(typed[k]);
    if (family) {
      words.push_back(typed[k]);
      if (++k >= typed.size())
        break;
    } else {
      for (const ShapeFamily& other : shape_families())
        if (ends_with(typed[k], other.extensions))
          family = &other;
      if (family)
        words.push_back(family->name);
    }
    words.push_back(typed[k]);
    if (!family)
      continue;
    families.insert(family->name);
    for (const auto& [name, value] : a.options)
      if (has_option(*family, name))
        words.insert(words.end(), {name, value});
  }
  for (const auto& [name, value] : a.options) {
    std::string owners;
    bool used = false;
    for (const ShapeFamily& family : shape_families())
      if (has_option(family, name)) {
        owners += (owners.empty() ? "" : " and ") + family.name;
        used = used || families.count(family.name) > 0;
      }
    if (!used)
      throw std::invalid_argument("--" + name + " belongs to shapes " + owners + ": none was given" +
                                  (name == "scale" ? "; give the size of another shape by --diameter" : ""));
  }
  return words;
}

ClusterShape next_shape(const ShapeArguments& a, const std::vector<std::string>& words, std::size_t& place,
                        Notes& notes) {
  if (place >= words.size())
    throw std::invalid_argument("a shape is missing: see clusterShape --help");
  std::size_t used = 0;
  ClusterShape shape = make_shape(words, place, used,
                                  a.diameter > 0               ? a.diameter
                                  : has_own_size(words[place]) ? 0
                                                               : default_diameter,
                                  notes);
  place += used;
  return shape;
}

void require_end(const std::vector<std::string>& words, std::size_t place) {
  if (place < words.size())
    throw std::invalid_argument("word '" + words[place] + "' is not understood: see clusterShape --help");
}

/// Beside the results, so that these stay what other programs read; JSON has them among the results.
void print_notes(const ShapeArguments& a, const Notes& notes) {
  if (a.json && !a.property_lines)
    return;
  for (const Note& note : notes)
    fmt::print(stderr, "clusterShape: {}: {}\n", note.warning ? "warning" : "note", note.text);
}

void write_files(const ShapeArguments& a, const std::vector<ClusterShape>& shapes) {
  if (!a.clump.empty()) {
    if (shapes[0].hull())
      throw std::invalid_argument("-o: '" + a.clump + "' is a list of spheres, which the rounded body '" +
                                  shapes[0].name() +
                                  "' is not; expected a cluster: use --vtk, or name the body in the script");
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
  for (const ShapeFamily& family : shape_families())
    for (const KnownShape& known : family.known) {
      std::size_t used = 0;
      const ClusterShape shape = make_shape(known.arguments, 0, used, default_diameter);
      text += fmt::format("{:<10} sphericity {:.3f}  {}\n", shape.name(), shape.sphericity(), known.description);
    }
  return text;
}

/// Numbers of spheres that the table of an STL file shows: 1, 2, 4, ... and all; of a balanced cover, whose first
/// spheres are not the answer for fewer, all.
std::vector<int> ladder(int all, Cover cover) {
  std::vector<int> steps;
  for (int k = 1; k < all && cover == Cover::inside; k *= 2)
    steps.push_back(k);
  steps.push_back(all);
  return steps;
}

void report_stl(const ShapeArguments& a, const std::vector<std::string>& words) {
  eccentra::base::OptionReader reader(words);
  reader.keyword();
  const StlRequest request = read_stl_request(reader);
  require_end(words, reader.at());
  const Solid solid(request.path, request.scale);
  const std::vector<Sphere> spheres = cover_of(solid, request);
  Notes notes;
  const ClusterShape shape = shape_of_solid(solid, spheres, request, a.diameter, notes);
  print_notes(a, notes);
  ShapeReport report = measure(shape, shape);
  report.notes = notes;
  const SolidEccentricity own = solid_eccentricity(solid);
  std::vector<FitQuality> fits;
  for (const int count : ladder(static_cast<int>(spheres.size()), request.cover))
    fits.push_back(fit_quality(solid, own, {spheres.begin(), spheres.begin() + count}, request.mass_of));
  if (a.property_lines) {
    fmt::print("{}", property_lines(report, {a.partner, a.estimate}, {a.types, a.own_type, a.mu_r}));
  } else if (a.json) {
    nlohmann::json json = to_json(report), table = nlohmann::json::array();
    for (const FitQuality& f : fits)
      table.push_back({{"spheres", f.spheres},
                       {"volume_error", f.volume},
                       {"protrusion", f.protrusion},
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
               request.mass_of == MassOf::solid ? "solid" : "union of the spheres", solid.triangles().size(),
               solid.properties().volume, own.mean, own.max);
    fmt::print("  spheres   volume  inertia  distance to surface/R_eq  protrusion  delta_e/R_eq on plane\n"
               "           missing    error       mean        max      max/R_eq    mean error  max error\n");
    for (const FitQuality& f : fits)
      fmt::print("  {:>7} {:>7.2f}% {:>7.2f}% {:>10.4f} {:>10.4f} {:>13.4f} {:>13.4f} {:>10.4f}\n", f.spheres,
                 100 * f.volume, 100 * f.inertia, f.mean_distance, f.max_distance, f.protrusion, f.mean_eccentricity,
                 f.max_eccentricity);
  }
  write_files(a, {shape});
}

/// Takes `diameter D`, as a LIGGGHTS script has it behind a shape, for --diameter.
ShapeArguments with_script_words(ShapeArguments a) {
  std::vector<std::string> rest;
  eccentra::base::OptionReader reader(a.words);
  while (reader.more())
    if (reader.peek() != "diameter") {
      rest.push_back(reader.keyword());
    } else {
      if (a.diameter > 0)
        throw std::invalid_argument("the diameter is given twice: give it once");
      reader.keyword();
      a.diameter = reader.positive("the diameter [m]");
    }
  a.words = rest;
  return a;
}

void report_advice(const ShapeArguments& a) {
  eccentra::base::OptionReader words(a.words);
  words.keyword();
  const std::string& body = words.value("a family such as cube or disk");
  require_end(a.words, 2);
  double error = 0;
  for (const auto& [name, value] : a.options)
    if (name == "error") {
      eccentra::base::OptionReader typed({name, value});
      typed.keyword();
      error = typed.positive();
    } else
      throw std::invalid_argument("--" + name + " does not belong to advise: leave it out");
  if (!(error > 0))
    throw std::invalid_argument("advise needs to know the error that is allowed: give --error E, such as 0.05 for 5 %");
  if (a.data.empty()) {
    const std::vector<GeometryLevel> levels = geometry_levels(body);
    fmt::print("{}", a.json ? json_of(levels, error).dump(2) + "\n" : text_of(levels, error));
    return;
  }
  std::ifstream in(a.data);
  if (!in)
    throw std::invalid_argument("cannot open '" + a.data + "': check the path, or leave --data out");
  const std::vector<Advice> advice = advise(read_level_results(in, a.data), body, a.scene, error);
  fmt::print("{}", a.json ? json_of(advice, error, a.data).dump(2) + "\n" : text_of(advice, error, a.data));
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
  if (!compare && !words.empty() && words[0] == "stl") {
    report_stl(a, words);
    return;
  }
  std::size_t place = 0;
  std::vector<Notes> notes(compare ? 2 : 1);
  std::vector<ClusterShape> shapes{next_shape(a, words, place, notes[0])};
  if (compare)
    shapes.push_back(next_shape(a, words, place, notes[1]));
  require_end(words, place);
  for (const Notes& of_shape : notes)
    print_notes(a, of_shape);
  ShapeReport first = measure(shapes[0], shapes.back());
  first.notes = notes[0];
  if (a.property_lines) {
    fmt::print("{}", property_lines(first, {a.partner, a.estimate}, {a.types, a.own_type, a.mu_r}));
  } else if (!compare) {
    fmt::print("{}", a.json ? to_json(first).dump(2) + "\n" : to_text(first));
  } else {
    ShapeReport second = measure(shapes[1], shapes[0]);
    second.notes = notes[1];
    fmt::print("{}", a.json ? nlohmann::json{{"a", to_json(first)}, {"b", to_json(second)}}.dump(2) + "\n"
                            : compare_text(first, second));
  }
  write_files(a, shapes);
}

} // namespace

int main(int argc, char** argv) {
  ShapeArguments arguments;
  int exit_code = 0;
  try {
    install_stl_keywords();
    install_hull_words();
    if (read_arguments(argc, argv, arguments, exit_code))
      run(arguments);
    eccentra::finish_standard_output();
  } catch (const std::exception& e) {
    std::fflush(stdout);
    fmt::print(stderr, "clusterShape: error: {}\n", e.what());
    return 1;
  }
  return exit_code;
}
