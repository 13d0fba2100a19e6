// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Text, JSON and LIGGGHTS lines about shapes.
#include "tools/shape_report.h"

#include "shape/resistance_cache.h"
#include "shape/rounded_hull.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// The largest mu_shape of the paper. Its disk value is the offset of a rim sub-sphere, max |c| / R_eq; its cube value
/// follows from no definition tried (C64: 0.40 mean, 0.71 largest on a plane): both are kept as the paper's inputs.
constexpr double paper_cube = 0.32, paper_disk = 0.95;
constexpr double reported_probabilities[] = {0.05, 0.25, 0.5, 0.75, 0.95};

using Partners = std::vector<std::pair<const char*, const EccentricityDistribution*>>;
Partners partners_of(const ShapeReport& r) {
  return {{"plane", &r.plane}, {"sphere", &r.sphere}, {"surface", &r.surface}, {"cluster", &r.cluster}};
}

nlohmann::json to_json(const EccentricityDistribution& d) {
  nlohmann::json quantiles;
  for (const double p : reported_probabilities)
    quantiles[fmt::format("{:.2f}", p)] = d.quantile(p);
  return {{"min", d.min()}, {"mean", d.mean()}, {"max", d.max()}, {"quantiles", quantiles}};
}

nlohmann::json to_json(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

nlohmann::json to_json(const Eigen::Matrix3d& m) {
  return {to_json(m.row(0).transpose().eval()), to_json(m.row(1).transpose().eval()),
          to_json(m.row(2).transpose().eval())};
}

Eigen::Vector3d jeffery_periods(const Resistance& r) {
  return {r.jeffery_period(0), r.jeffery_period(1), r.jeffery_period(2)};
}

nlohmann::json to_json(const Resistance& r, double d) {
  return {{"translation", to_json(r.translation)},
          {"rotation", to_json(r.rotation)},
          {"coupling", to_json(r.coupling)},
          {"bretherton", to_json(r.bretherton())},
          {"jeffery_period", to_json(jeffery_periods(r))},
          {"centre", to_json((d * r.centre).eval())}};
}

std::string to_text(const Resistance& r, double d) {
  std::string text = fmt::format("  in creeping flow, by body axis {:>14} {:>10} {:>10}\n", "x", "y", "z");
  const auto row = [&](const char* label, const Eigen::Vector3d& v) {
    text += fmt::format("    {:<31} {:>10} {:>10} {:>10}\n", label, number(v[0]), number(v[1]), number(v[2]));
  };
  row("K, of the sphere's drag", r.translation.diagonal());
  row("K_rot, of the sphere's torque", r.rotation.diagonal());
  row("B, spin by strain", r.bretherton());
  row("Jeffery's period times rate", jeffery_periods(r));
  row("centre of resistance, m", d * r.centre);
  const auto off = [](const Eigen::Matrix3d& m) { return (m - Eigen::Matrix3d(m.diagonal().asDiagonal())).norm(); };
  if (off(r.translation) + off(r.rotation) > 0)
    text += fmt::format("    off the diagonal: K {:.3g}, K_rot {:.3g}; coupling {:.3g} (--json has all of it)\n",
                        off(r.translation), off(r.rotation), r.coupling.norm());
  return text;
}

/// What a table shows of one shape: label, value, unit.
struct Row {
  std::string label;
  double value;
  std::string unit;
};

std::vector<Row> rows_of(const ShapeReport& r) {
  const ClusterShape& s = r.shape;
  const Eigen::Vector3d inertia = s.inertia_per_mass();
  const double sphere_inertia = 0.4 * s.equivalent_radius() * s.equivalent_radius();
  std::vector<Row> rows;
  if (s.hull())
    rows = {{"radius of edges and corners", s.hull()->radius(), "m"},
            {"radius in Hertz's law", s.hull()->contact_radius(), "m"},
            {"vertices, or points on rims", static_cast<double>(s.spheres().size()), ""}};
  else
    rows = {{"spheres", static_cast<double>(s.spheres().size()), ""},
            {"spheres that can be touched", static_cast<double>(s.surface_spheres().size()), ""},
            {"smallest radius of those", s.smallest_radius(), "m"}};
  const std::vector<Row> of_all = {
      {"volume", s.volume(), "m3"},
      {"surface", s.surface(), "m2"},
      {"sphericity", s.sphericity(), ""},
      {"equivalent radius R_eq", s.equivalent_radius(), "m"},
      {"bounding radius", s.bounding_radius(), "m"},
      {"bounding radius / R_eq", s.bounding_radius() / s.equivalent_radius(), ""},
      {"inertia per mass, x", inertia.x(), "m2"},
      {"inertia per mass, y", inertia.y(), "m2"},
      {"inertia per mass, z", inertia.z(), "m2"},
      {"inertia / (0.4 R_eq^2), x", inertia.x() / sphere_inertia, ""},
      {"inertia / (0.4 R_eq^2), y", inertia.y() / sphere_inertia, ""},
      {"inertia / (0.4 R_eq^2), z", inertia.z() / sphere_inertia, ""},
  };
  rows.insert(rows.end(), of_all.begin(), of_all.end());
  const char* axes[] = {"x", "y", "z"};
  const Eigen::Vector3d b = r.resistance.bretherton(), period = jeffery_periods(r.resistance);
  for (int k = 0; k < 3; ++k)
    rows.push_back({fmt::format("K, {}", axes[k]), r.resistance.translation(k, k), ""});
  for (int k = 0; k < 3; ++k)
    rows.push_back({fmt::format("K_rot, {}", axes[k]), r.resistance.rotation(k, k), ""});
  for (int k = 0; k < 3; ++k)
    rows.push_back({fmt::format("B, {}", axes[k]), b[k], ""});
  for (int k = 0; k < 3; ++k)
    rows.push_back({fmt::format("Jeffery's period * rate, {}", axes[k]), period[k], ""});
  for (const auto& [name, d] : partners_of(r)) {
    rows.push_back({fmt::format("delta_e/R_eq on {}, min", name), d->min(), ""});
    rows.push_back({fmt::format("delta_e/R_eq on {}, mean", name), d->mean(), ""});
    rows.push_back({fmt::format("delta_e/R_eq on {}, max", name), d->max(), ""});
  }
  return rows;
}

} // namespace

ShapeReport measure(const ClusterShape& shape, const ClusterShape& partner) {
  return {shape,
          eccentricity_plane(shape),
          eccentricity_sphere(shape, shape.equivalent_radius()),
          eccentricity_surface(shape),
          eccentricity_cluster(shape, partner),
          partner.name(),
          cached_resistance(shape),
          {}};
}

double default_mu_shape(const ShapeReport& report) {
  return mu_shape(report, {});
}

double mu_shape(const ShapeReport& report, const MuShapeChoice& choice) {
  if (choice.estimate == "paper") {
    for (const auto& [family, value] : {std::pair{"cube", paper_cube}, {"disk", paper_disk}})
      if (report.shape.name().rfind(family, 0) == 0)
        return value;
    throw std::invalid_argument("the paper gives no mu_shape for '" + report.shape.name() +
                                "': it has one for cube and disk; choose min, mean or max");
  }
  const Partners partners = partners_of(report);
  for (const auto& [name, d] : partners) {
    if (choice.partner != name)
      continue;
    if (choice.estimate == "min")
      return d->min();
    if (choice.estimate == "mean")
      return d->mean();
    if (choice.estimate == "max")
      return d->max();
    char* end = nullptr;
    const double probability = std::strtod(choice.estimate.c_str(), &end);
    if (choice.estimate.empty() || *end || !(probability >= 0 && probability <= 1))
      throw std::invalid_argument("estimate of mu_shape '" + choice.estimate +
                                  "' is unknown: choose min, mean, max, a probability between 0 and 1, or paper");
    return d->quantile(probability);
  }
  throw std::invalid_argument("partner of mu_shape '" + choice.partner +
                              "' is unknown: choose plane, sphere, surface or cluster");
}

nlohmann::json to_json(const ShapeReport& r) {
  const ClusterShape& s = r.shape;
  nlohmann::json eccentricity;
  for (const auto& [name, d] : partners_of(r))
    eccentricity[name] = to_json(*d);
  nlohmann::json notes = nlohmann::json::array();
  for (const Note& note : r.notes)
    notes.push_back({{"text", note.text}, {"warning", note.warning}});
  nlohmann::json json = {{"name", s.name()},
                         {"notes", notes},
                         {"spheres", s.spheres().size()},
                         {"touchable_spheres", s.surface_spheres().size()},
                         {"smallest_radius", s.smallest_radius()},
                         {"volume", s.volume()},
                         {"surface", s.surface()},
                         {"equivalent_radius", s.equivalent_radius()},
                         {"bounding_radius", s.bounding_radius()},
                         {"sphericity", s.sphericity()},
                         {"centre", to_json(s.given_centre())},
                         {"inertia", to_json(s.inertia_per_mass())},
                         {"resistance", to_json(r.resistance, 2 * s.equivalent_radius())},
                         {"eccentricity", eccentricity},
                         {"eccentricity_partner", r.partner},
                         {"mu_shape", default_mu_shape(r)}};
  if (s.hull())
    json["rounding"] = {{"radius", s.hull()->radius()}, {"contact_radius", s.hull()->contact_radius()}};
  return json;
}

std::string to_text(const ShapeReport& r) {
  std::string text = fmt::format("{}\n", r.shape.name());
  for (const Row& row : rows_of(r)) {
    if (row.label.rfind("K, ", 0) == 0)
      break; // below, by axis
    text += fmt::format("  {:<28} {:>13} {}\n", row.label, number(row.value), row.unit);
  }
  text += to_text(r.resistance, 2 * r.shape.equivalent_radius());
  text += fmt::format("  shape eccentricity delta_e/R_eq\n    {:<9}", "met by");
  for (const char* head : {"min", "5 %", "25 %", "median", "75 %", "95 %", "max", "mean"})
    text += fmt::format(" {:>7}", head);
  for (const auto& [name, d] : partners_of(r)) {
    text += fmt::format("\n    {:<9} {:>7.4f}", name, d->min());
    for (const double p : reported_probabilities)
      text += fmt::format(" {:>7.4f}", d->quantile(p));
    text += fmt::format(" {:>7.4f} {:>7.4f}", d->max(), d->mean());
  }
  return text + fmt::format("\n    (cluster: {})\n  {:<28} {:>13}\n", r.partner, "mu_shape (mean on a plane)",
                            number(default_mu_shape(r)));
}

std::string compare_text(const ShapeReport& a, const ShapeReport& b) {
  std::string text = fmt::format("{:<32} {:>14} {:>14} {:>9}\n", "", "A", "B", "B / A");
  text +=
      fmt::format("A is {}, B is {}; \"on cluster\" means each against the other\n", a.shape.name(), b.shape.name());
  const std::vector<Row> left = rows_of(a), right = rows_of(b);
  constexpr std::size_t of_kind = 3; // rows that clusters and rounded bodies do not share
  for (std::size_t k = !a.shape.hull() == !b.shape.hull() ? 0 : of_kind; k < left.size(); ++k) {
    const double ratio = right[k].value / left[k].value;
    text += fmt::format(
        "{:<32} {:>14} {:>14} {:>9} {}\n", left[k].label, number(left[k].value), number(right[k].value),
        std::isfinite(ratio) && left[k].label.find(", min") == std::string::npos ? fmt::format("{:.4f}", ratio) : "-",
        left[k].unit);
  }
  return text;
}

std::string property_lines(const ShapeReport& report, const MuShapeChoice& choice, const PairTypes& pairs) {
  const int types = pairs.types, own = pairs.own;
  if (types < 1 || own < 1 || own > types)
    throw std::invalid_argument(
        fmt::format("atom type {} is not one of {} types: give --type between 1 and --types", own, types));
  const double value = mu_shape(report, choice);
  std::string text = fmt::format(
      "# mu_shape = delta_e/R_eq of {} ({}): {}; eq (33): mu_r + mu_shape\n", report.shape.name(),
      report.shape.hull() ? std::string("rounded") : fmt::format("{} spheres", report.shape.spheres().size()),
      choice.estimate == "paper" ? std::string("the paper's own value")
                                 : choice.estimate + " over contacts with a " + choice.partner);
  for (const auto& [name, d] : partners_of(report))
    text += fmt::format("#   on {:<8} min {:.4f}  mean {:.4f}  max {:.4f}\n", name, d->min(), d->mean(), d->max());
  const auto add_line = [&](const char* id, const char* property, auto&& of_pair) {
    text += fmt::format("fix {} all property/global {} peratomtypepair {}", id, property, types);
    for (int i = 1; i <= types; ++i)
      for (int j = 1; j <= types; ++j)
        text += fmt::format(" {:.6g}", of_pair(i, j));
    text += "\n";
  };
  if (pairs.mu_r >= 0)
    add_line("mu_r", "coefficientRollingFriction", [&](int, int) { return pairs.mu_r; });
  add_line("mu_shape", "shapeRollingFriction", [&](int i, int j) { return i == own || j == own ? value : 0.0; });
  return text;
}

} // namespace eccentra::shape
