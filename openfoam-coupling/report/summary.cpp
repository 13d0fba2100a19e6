// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements summary.h.
#include "report/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eccentra::report {
namespace {

/// What of coupling.csv is a result of the flow, in the order of the table.
struct Column {
  const char* column;
  const char* name;
  const char* unit;
  double scale;
};
const Column columns[] = {{"particles", "bodies", "", 1},
                          {"mean_velocity", "mean fluid velocity", "m/s", 1},
                          {"pressure_gradient", "pressure gradient", "Pa/m", 1},
                          {"reynolds", "Reynolds number (Metzner-Reed)", "", 1},
                          {"pipe_torque", "torque of the fluid on the pipe", "N m", 1},
                          {"pipe_force_z", "axial force on the pipe", "N", 1},
                          {"hole_force_z", "axial force on the hole", "N", 1},
                          {"solid_concentration", "solid concentration", "%", 100},
                          {"solids_flux", "solid flux", "1e-6 m3/s", 1e6},
                          {"com_height", "height of the solid's centre", "mm", 1000},
                          {"bed_height", "bed height (cells above 30 %)", "mm", 1000},
                          {"fastest_particle", "fastest body", "m/s", 1},
                          {"least_fraction", "least fluid fraction", "", 1}};
/// The largest value of the run counts.
const Column largest[] = {
    {"volume_error", "largest solid volume error", "", 1},     {"impulse_error", "largest impulse error", "", 1},
    {"pressure_error", "largest pressure force error", "", 1}, {"continuity_error", "largest continuity error", "", 1},
    {"left", "bodies that have left the box", "", 1},          {"outside", "most bodies outside the mesh", "", 1}};
const char* const parts[] = {"dem", "fluid", "exchange", "link"};

std::string number(double value) {
  if (value == 0)
    return "0";
  const double size = std::abs(value);
  if (size >= 1e5 || size < 1e-3)
    return fmt::format("{:.2e}", value);
  return fmt::format("{:.4g}", value);
}

std::string cell(const Quantity& q) {
  const std::string value = number(q.mean.value * q.scale);
  constexpr double round_off = 1e-6; // what is the same in every row has no error
  return q.mean.error > round_off * std::abs(q.mean.value)
             ? value + " +-" + fmt::format("{:.2g}", q.mean.error * q.scale)
             : value;
}

bool always_zero(const Table& table, const char* column) {
  if (!table.has(column))
    return false;
  const std::vector<double>& values = table.columns.at(column);
  return std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
}

/// What the bodies of any scene are doing, as means over the files of the last part of the run.
void add_bodies(Summary& summary, const Case& data, double share) {
  const Vector& g = data.dem.gravity;
  const double size = std::hypot(g[0], g[1], g[2]);
  const Vector up = size > 0 ? Vector{-g[0] / size, -g[1] / size, -g[2] / size} : Vector{0, 0, 1};
  const bool counted = data.run.has("particles");
  std::vector<double> count;
  std::vector<double> solid;
  std::vector<double> centre;
  std::vector<double> top;
  std::vector<double> speed;
  std::vector<Snapshot> snapshots;
  for (const ParticleFile& file : data.bodies) {
    if (static_cast<double>(file.step) < (1 - share) * static_cast<double>(data.bodies.back().step))
      continue;
    const Snapshot& snapshot = snapshots.emplace_back(read_snapshot(file));
    const SolidState state = solid_state(snapshot, up);
    count.push_back(static_cast<double>(snapshot.position.size()));
    solid.push_back(state.volume);
    if (snapshot.position.empty())
      continue;
    centre.push_back(state.centre);
    top.push_back(state.top);
    speed.push_back(state.speed);
  }
  if (count.empty())
    return;
  summary.classes = body_classes(snapshots, up, {0, 0, 1});
  if (!counted)
    summary.quantities.push_back({"bodies", "", mean_of(count), 1});
  summary.quantities.push_back({"solid volume", "cm3", mean_of(solid), 1e6});
  if (centre.empty())
    return;
  summary.quantities.push_back({"height of the solid's centre (bodies)", "mm", mean_of(centre), 1000});
  summary.quantities.push_back({"height that 98 % of the solid is below", "mm", mean_of(top), 1000});
  summary.quantities.push_back({"mean speed of the solid", "m/s", mean_of(speed), 1});
}

/// A run without a fluid.
Summary summary_of_bodies(const Case& data, double share) {
  Summary summary;
  summary.name = data.name;
  const double step = data.dem.time_step > 0 ? data.dem.time_step : 1;
  summary.in_steps = !(data.dem.time_step > 0);
  summary.until = step * static_cast<double>(data.bodies.back().step);
  summary.from = (1 - share) * summary.until;
  add_bodies(summary, data, share);
  return summary;
}

} // namespace

Mean mean_of(const std::vector<double>& values, std::size_t parts_wanted) {
  if (values.empty())
    throw std::invalid_argument("a mean needs at least one value");
  const std::size_t batches = std::min(parts_wanted, values.size());
  std::vector<double> batch(batches, 0.0);
  double sum = 0;
  for (std::size_t b = 0; b < batches; ++b) {
    const std::size_t first = b * values.size() / batches;
    const std::size_t last = (b + 1) * values.size() / batches;
    for (std::size_t i = first; i < last; ++i) {
      batch[b] += values[i] / static_cast<double>(last - first);
      sum += values[i];
    }
  }
  Mean mean;
  mean.value = sum / static_cast<double>(values.size());
  if (batches < 2)
    return mean;
  double spread = 0;
  for (const double b : batch)
    spread += (b - mean.value) * (b - mean.value);
  mean.error = std::sqrt(spread / static_cast<double>(batches * (batches - 1)));
  return mean;
}

std::array<double, 2> high_side() {
  return {0, 1}; // annulusMesh puts gravity into the y-z plane, and the pipe towards -y
}

Summary summarise(const Case& data, double share, std::size_t layers) {
  if (!(share > 0 && share <= 1))
    throw std::invalid_argument("the share of the run to take means over is " + std::to_string(share) +
                                ": give more than 0 and at most 1");
  if (!data.is_annulus && data.run.rows() == 0)
    return summary_of_bodies(data, share);
  if (data.run.rows() == 0)
    throw std::runtime_error((data.folder / "postProcessing/eccentra/coupling.csv").string() +
                             ": no row yet: has the run reached its first report?");
  Summary summary;
  summary.name = data.name;
  const auto& time = data.run.columns.at("time");
  summary.until = time.back();
  summary.from = time.back() - share * (time.back() - time.front());
  const auto late = [&](const std::vector<double>& all) {
    std::vector<double> values;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (time[i] >= summary.from)
        values.push_back(all[i]);
    return values;
  };
  // A hole or column that stands has no low side on which solid could lie: the solver's heights over it are 0.
  const bool stands = always_zero(data.run, "com_height") && always_zero(data.run, "bed_height");
  for (const Column& c : columns)
    if (data.run.has(c.column) && !(stands && c.unit == std::string("mm")))
      summary.quantities.push_back({c.name, c.unit, mean_of(late(data.run.columns.at(c.column))), c.scale});

  // From the particles themselves, over the snapshots of the same part of the run.
  if (!data.is_annulus)
    add_bodies(summary, data, share);
  std::vector<double> height;
  std::vector<double> rest;
  summary.profile.assign(data.is_annulus ? layers : 0, 0.0);
  std::vector<Snapshot> snapshots;
  const long last_step = data.bodies.empty() ? 0 : data.bodies.back().step;
  for (const ParticleFile& file : data.bodies) {
    if (!data.is_annulus || static_cast<double>(file.step) < (1 - share) * static_cast<double>(last_step))
      continue;
    const Snapshot& snapshot = snapshots.emplace_back(read_snapshot(file));
    const auto profile = concentration_profile(data.section, snapshot, high_side(), layers);
    for (std::size_t k = 0; k < layers; ++k)
      summary.profile[k] += profile[k];
    height.push_back(bed_height(profile, 2 * data.section.hole_radius));
    constexpr double slow = 0.01; // m/s
    rest.push_back(share_at_rest(snapshot, slow));
  }
  for (double& c : summary.profile)
    c /= std::max<double>(1, static_cast<double>(snapshots.size()));
  if (!snapshots.empty()) {
    const auto up = high_side();
    summary.classes = body_classes(snapshots, {up[0], up[1], 0}, {0, 0, 1});
    for (BodyClass& one : summary.classes) // heights above the lowest point of the hole
      one.height += data.section.hole_radius;
    summary.quantities.push_back({"bed height (profile)", "mm", mean_of(height), 1000});
    summary.quantities.push_back({"solid slower than 10 mm/s", "%", mean_of(rest), 100});
  }
  // The row of the start tells what was there before the fluid's first step with particles: no balance to judge.
  const std::ptrdiff_t first_step = time.size() > 1 && time.front() == 0 ? 1 : 0;
  for (const Column& c : largest)
    if (data.run.has(c.column)) {
      const auto& all = data.run.columns.at(c.column);
      summary.quantities.push_back(
          {c.name, c.unit, {*std::max_element(all.begin() + first_step, all.end()), 0}, c.scale});
    }
  for (const char* part : parts) {
    const std::string column = std::string(part) + "_seconds";
    if (data.run.has(column))
      summary.seconds.emplace_back(part == std::string("dem") ? "DEM" : part, data.run.columns.at(column).back());
  }
  return summary;
}

std::string to_text(const std::vector<Summary>& summaries) {
  constexpr std::size_t first = 42;
  std::size_t wide = 20;
  for (const Summary& s : summaries)
    wide = std::max(wide, s.name.size() + 2);
  std::string text = fmt::format("{:<{}}", "mean +- standard error", first);
  for (const Summary& s : summaries)
    text += fmt::format("{:>{}}", s.name, wide);
  const bool steps = std::any_of(summaries.begin(), summaries.end(), [](const Summary& s) { return s.in_steps; });
  text += fmt::format("\n{:<{}}", steps ? "  over the time [s, or steps]" : "  over the time [s]", first);
  for (const Summary& s : summaries)
    text += fmt::format("{:>{}}", fmt::format("{:.2f}..{:.2f}", s.from, s.until), wide);
  text += "\n";
  std::vector<std::pair<std::string, std::string>> lines; // name and unit, in the order of the first case that has it
  for (const Summary& s : summaries)
    for (const Quantity& q : s.quantities)
      if (std::find(lines.begin(), lines.end(), std::make_pair(q.name, q.unit)) == lines.end())
        lines.emplace_back(q.name, q.unit);
  for (const auto& [name, unit] : lines) {
    text += fmt::format("{:<{}}", unit.empty() ? name : name + " [" + unit + "]", first);
    for (const Summary& s : summaries) {
      const auto q = std::find_if(s.quantities.begin(), s.quantities.end(),
                                  [&name = name](const Quantity& x) { return x.name == name; });
      text += fmt::format("{:>{}}", q == s.quantities.end() ? "-" : cell(*q), wide);
    }
    text += "\n";
  }
  for (std::size_t part = 0; !summaries.empty() && part < summaries[0].seconds.size(); ++part) {
    text += fmt::format("{:<{}}", "seconds in " + summaries[0].seconds[part].first, first);
    for (const Summary& s : summaries)
      text +=
          fmt::format("{:>{}}", part < s.seconds.size() ? fmt::format("{:.1f}", s.seconds[part].second) : "-", wide);
    text += "\n";
  }
  return text;
}

std::string to_csv(const std::vector<Summary>& summaries) {
  std::string text = "case,quantity,unit,mean,standard_error,from_s,until_s\n";
  for (const Summary& s : summaries) {
    for (const Quantity& q : s.quantities)
      text += fmt::format("{},{},{},{:.8g},{:.3g},{:.6g},{:.6g}\n", s.name, q.name, q.unit, q.mean.value * q.scale,
                          q.mean.error * q.scale, s.from, s.until);
    for (const auto& [part, seconds] : s.seconds)
      text += fmt::format("{},seconds in {},s,{:.4g},0,0,{:.6g}\n", s.name, part, seconds, s.until);
  }
  return text;
}

std::string classes_text(const std::vector<Summary>& summaries) {
  std::string text;
  for (const Summary& s : summaries) {
    if (s.classes.size() < 2)
      continue;
    text += fmt::format("\nclasses of {}\n{:>5}{:>9}{:>14}{:>9}{:>11}{:>13}{:>13}{:>15}{:>11}\n", s.name, "type",
                        "slimness", "diameter [mm]", "bodies", "volume [%]", "height [mm]", "speed [m/s]",
                        "along z [m/s]", "slow [%]");
    for (const BodyClass& one : s.classes)
      text += fmt::format("{:>5}{:>9.3f}{:>14.4g}{:>9.4g}{:>11.3g}{:>13.4g}{:>13.4g}{:>15.4g}{:>11.3g}\n", one.type,
                          one.slimness, 1e3 * one.diameter, one.count, 100 * one.part, 1e3 * one.height, one.speed,
                          one.along, 100 * one.slow);
  }
  return text;
}

std::string classes_csv(const std::vector<Summary>& summaries) {
  std::string text = "case,type,slimness,diameter_m,bodies,part_of_volume,height_m,speed_m_per_s,velocity_z_m_per_s,"
                     "part_slower_than_10_mm_per_s\n";
  for (const Summary& s : summaries)
    for (const BodyClass& one : s.classes)
      text += fmt::format("{},{},{:.5g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", s.name, one.type,
                          one.slimness, one.diameter, one.count, one.part, one.height, one.speed, one.along, one.slow);
  return text;
}

std::string profile_csv(const std::vector<Summary>& summaries) {
  std::string text = "height_over_hole_diameter";
  for (const Summary& s : summaries)
    text += "," + s.name;
  text += "\n";
  for (std::size_t k = 0; !summaries.empty() && k < summaries[0].profile.size(); ++k) {
    text += fmt::format("{:.5g}", (static_cast<double>(k) + 0.5) / static_cast<double>(summaries[0].profile.size()));
    for (const Summary& s : summaries)
      text += fmt::format(",{:.6g}", s.profile[k]);
    text += "\n";
  }
  return text;
}

} // namespace eccentra::report
