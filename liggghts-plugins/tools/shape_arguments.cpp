// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options of clusterShape and their help.
#include "tools/shape_arguments.h"

#include "eccentra/version.h"
#include "shape/decimal.h"
#include "shape/shape_family.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <map>
#include <optional>

namespace eccentra::shape {
namespace {

/// Head of the help: the families say themselves what they are.
std::string description() {
  std::string text = "Makes, measures, compares and draws particle shapes: rigid clusters of overlapping spheres.\n\n"
                     "What to look at:\n";
  for (const ShapeFamily& family : shape_families()) {
    text += "  clusterShape " + family.syntax + "\n";
    if (!family.extensions.empty())
      text += "    or the bare name of a file that ends in " + family.extensions + "\n";
  }
  return text +
         "  clusterShape compare A B      two shapes side by side, e.g. compare cube 64 disk 48\n"
         "  clusterShape advise FAMILY --error E [--data levels.csv]   which level of detail keeps an error below E\n"
         "  clusterShape list             the shapes that have a name";
}

constexpr const char* examples = R"(
Examples:
  clusterShape cube 64 --diameter 6.35e-3 -o c64.clump --png c64.png
  clusterShape disk 48 --diameter 6.35e-3 --json
  clusterShape disk 48 --property-lines --types 2 --type 1 --estimate max
  clusterShape stl part.stl --scale 1e-3 --error 0.05 --mass solid -o part.clump
  clusterShape advise cube --error 0.05 --data results/accuracy-cost/levels.csv
In a LIGGGHTS script: fix ID all particletemplate/cluster SEED ... shape file part.clump diameter 6.35e-3)";

/// CLI11's own checks let nan and inf pass.
CLI::Validator finite_number(bool zero_allowed) {
  return CLI::Validator(
      [zero_allowed](std::string& text) -> std::string {
        const std::optional<double> value = decimal(text);
        if (value && std::isfinite(*value) && (*value > 0 || (zero_allowed && *value == 0)))
          return {};
        return "'" + text + "' is not a number " + (zero_allowed ? "of 0 or more" : "greater than 0");
      },
      "");
}
/// An empty word comes of an unset variable.
const CLI::Validator not_empty(
    [](std::string& text) {
      return text.empty() ? std::string("an empty word is no value: "
                                        "is a variable unset?")
                          : std::string();
    },
    "");
const CLI::Validator positive = finite_number(false), not_negative = finite_number(true);

} // namespace

bool read_arguments(int argc, char** argv, ShapeArguments& a, int& exit_code) {
  CLI::App app(description(), "clusterShape");
  app.footer(examples);
  app.set_version_flag("--version", ECCENTRA_VERSION);
  app.get_formatter()->column_width(28);
  app.add_option("shape", a.words, "the shape, as above")->required()->type_name("WORDS");
  app.add_option("-d,--diameter", a.diameter,
                 "diameter of the sphere of equal volume [m]; default: 6.35e-3 for built-in shapes, as it is for files")
      ->check(positive);
  app.add_option("-o,--output", a.clump, "write the spheres (body frame, metres)")
      ->type_name("FILE.clump")
      ->check(not_empty);
  app.add_option("--vtk", a.vtk, "write the surface, coloured by delta_e/R_eq, for ParaView (.vtp or .vtk)")
      ->type_name("FILE")
      ->check(not_empty);
  app.add_option("--png", a.png, "draw a picture (needs the program Xvfb, which is started unseen)")
      ->type_name("FILE.png")
      ->check(not_empty);
  app.add_flag("--json", a.json, "print JSON instead of a table");
  auto* lines =
      app.add_flag("--property-lines", a.property_lines, "print LIGGGHTS lines that set mu_shape = delta_e/R_eq");
  app.add_option("--partner", a.partner, "of mu_shape: plane, sphere, surface, cluster; default plane")
      ->needs(lines)
      ->type_name("WORD");
  app.add_option(
         "--estimate", a.estimate,
         "of mu_shape: min, mean, max, a probability such as 0.9, or paper (0.32 cube, 0.95 disk); default mean")
      ->needs(lines)
      ->type_name("WORD");
  app.add_option("--types", a.types, "number of atom types in the script; default 1")
      ->needs(lines)
      ->check(CLI::Range(1, 100));
  app.add_option("--type", a.own_type, "atom type that has this shape; default 1")->needs(lines)->check(positive);
  app.add_option("--mu-r", a.mu_r, "also print a line that sets mu_r of eq (33) to this for every pair")
      ->needs(lines)
      ->check(not_negative);
  std::map<std::string, std::string> typed; // of the options of families, in the order of their names
  for (const ShapeFamily& family : shape_families())
    for (const ShapeOption& option : family.options)
      if (typed.emplace(option.name, "").second)
        app.add_option("--" + option.name, typed[option.name], option.help)
            ->group("Options of shapes")
            ->type_name("VALUE")
            ->check(not_empty);
  const std::string advice = "Advice";
  auto* data = app.add_option("--data", a.data, "levels.csv of scripts/accuracy-cost; without it: geometry alone")
                   ->group(advice)
                   ->type_name("FILE.csv")
                   ->check(not_empty);
  app.add_option("--scene", a.scene, "one scene of the data, such as heap; default all")
      ->group(advice)
      ->needs(data)
      ->type_name("NAME");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    exit_code = app.exit(e);
    return false;
  }
  for (const auto& [name, value] : typed)
    if (!value.empty())
      a.options.emplace_back(name, value);
  return true;
}

} // namespace eccentra::shape
