// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From the facets of a file to one solid, or to the sentence that says what they are instead; distances by VTK.
#include "shape/vtk/solid.h"

#include "shape/vtk/poly_data.h"
#include "shape/vtk/stl_reader.h"
#include "shape/vtk/surface_crossings.h"

#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

namespace eccentra::shape {
namespace {

/// Vertices closer than these parts of the diagonal are one: STL repeats each vertex with the digits of a float. The
/// later ones are tried where the surface is open without, and taken only if no facet vanishes.
constexpr std::array<double, 3> kJoining = {1e-6, 1e-5, 1e-4};
/// Facets cross or overlap where they do so by more than this part of the diagonal.
constexpr double kCrossing = 1e-6;
/// Below this part of the bounding box nothing is enclosed.
constexpr double kLeastVolume = 1e-9;
/// Farther from the origin than so many diagonals the floats of STL do not resolve the solid.
constexpr double kMaxOffset = 1e4;

std::string point_text(const Eigen::Vector3d& p) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "(%.6g %.6g %.6g)", p.x(), p.y(), p.z());
  return text.data();
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

/// "1 facet is", "3 facets are".
std::string facets_are(int count) {
  return std::to_string(count) + (count == 1 ? " facet is" : " facets are");
}

double diagonal_of(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const auto& t : surface.triangles)
    for (const int v : t)
      box.extend(surface.vertices[v]);
  return box.diagonal().norm();
}

/// Vertices where the facets of more than one fan meet.
struct Pinch {
  int vertex = -1;
  bool same_shell = false;
};

/// A vertex whose facets do not all hang together by edges of two facets.
Pinch find_pinch(const Surface& surface, const std::vector<int>& shell_of) {
  std::vector<std::vector<int>> facets(surface.vertices.size());
  for (std::size_t n = 0; n < surface.triangles.size(); ++n)
    for (const int v : surface.triangles[n])
      facets[v].push_back(static_cast<int>(n));
  for (std::size_t v = 0; v < facets.size(); ++v) {
    if (facets[v].empty())
      continue;
    std::map<int, std::vector<int>> around; // other vertex of an edge at v -> facets there
    for (const int n : facets[v])
      for (const int w : surface.triangles[n])
        if (w != static_cast<int>(v))
          around[w].push_back(n);
    std::set<int> seen{facets[v].front()};
    std::vector<int> open{facets[v].front()};
    while (!open.empty()) {
      const int n = open.back();
      open.pop_back();
      for (const int w : surface.triangles[n])
        if (w != static_cast<int>(v) && around[w].size() == 2)
          for (const int m : around[w])
            if (seen.insert(m).second)
              open.push_back(m);
    }
    for (const int n : facets[v])
      if (seen.count(n) == 0)
        return {static_cast<int>(v), shell_of[n] == shell_of[facets[v].front()]};
  }
  return {};
}

} // namespace

struct Solid::DistanceField {
  explicit DistanceField(const Surface& surface) : frame(surface) {
    function->SetInput(poly_data(frame.to_unit(surface)));
  }
  UnitFrame frame;
  vtkNew<vtkImplicitPolyDataDistance> function;
};

/// Joins vertices and drops facets until the surface is closed; refuses an open one.
void Solid::repair(const Surface& raw) {
  const auto count = static_cast<int>(raw.triangles.size());
  OpenEdges open;
  for (const double tolerance : kJoining) {
    Surface joined = join_vertices(raw, tolerance);
    drop_degenerate(joined);
    const int degenerate = count - static_cast<int>(joined.triangles.size());
    const RepeatedFacets repeated = drop_repeated(joined);
    drop_unused_vertices(joined);
    if (tolerance == kJoining[0]) {
      surface_ = joined;
      open = open_edges(joined);
      if (degenerate > 0)
        notes_.push_back({where_ + facets_are(degenerate) + " degenerate (two corners in one place) and left out"});
      if (repeated.copies > 0)
        notes_.push_back({where_ + facets_are(repeated.copies) + " there twice and left out"});
      if (repeated.walls > 0)
        notes_.push_back({where_ + facets_are(repeated.walls) +
                          " back to back with another, as walls between parts that share them or as loose sheets, and "
                          "left out"});
    } else if (joined.triangles.size() == surface_.triangles.size() && open_edges(joined).total() == 0) {
      surface_ = joined;
      open = {};
      notes_.push_back({where_ + "corners up to " + number_text(tolerance) +
                        " of its size apart were joined, which closes the surface"});
    }
    if (open.total() == 0)
      break;
  }
  if (surface_.triangles.empty())
    throw std::invalid_argument(where_ + "encloses no volume: all its facets are degenerate or back to back; export a "
                                         "solid");
  if (open.total() > 0) {
    const Eigen::Vector3d place = (surface_.vertices[open.first[0]] + surface_.vertices[open.first[1]]) / 2;
    std::string sentence = where_ + "is not a closed surface: ";
    if (open.single > 0)
      sentence += std::to_string(open.single) + " edges lack a neighbour";
    if (open.several > 0)
      sentence += std::string(open.single > 0 ? " and " : "") + "in " + std::to_string(open.several) +
                  " edges an odd number of facets meet, three or more";
    throw std::invalid_argument(sentence + " (the first near " + point_text(place) +
                                "); expected the closed surface of one solid: close the holes and remove stray facets "
                                "first");
  }
}

/// Refuses surfaces that are not the boundary of one solid, perhaps with cavities.
void Solid::require_one_solid(const std::vector<Shell>& shells) {
  const std::string one = "; expected one solid: ", number = std::to_string(shells.size());
  std::vector<int> shell_of(surface_.triangles.size());
  for (std::size_t k = 0; k < shells.size(); ++k)
    for (const int n : shells[k].triangles)
      shell_of[n] = static_cast<int>(k);

  const EdgeFacets edges = facets_of_edges(surface_);
  if (const auto crossing = find_crossing(surface_, kCrossing * (high_ - low_).norm())) {
    const std::string place = " near " + point_text(crossing->place);
    if (shell_of[crossing->first] != shell_of[crossing->second]) {
      // Where two solids share edges, their facets do not say which of them is whose.
      const bool shared = std::any_of(edges.begin(), edges.end(), [](const auto& e) { return e.second.size() > 2; });
      throw std::invalid_argument(where_ + "holds " + (shared ? "several" : number) + " solids, " +
                                  (shared ? "" : number + " ") + "pieces of which two cross or touch each other" +
                                  place + one + "unite them to one surface first, or write one file per solid");
    }
    throw std::invalid_argument(where_ + "crosses or folds over itself" + place +
                                "; expected a surface that does not: remove overlapping facets first");
  }
  // Edges of four and more facets.
  for (const auto& [edge, facets] : edges) {
    if (facets.size() == 2)
      continue;
    const std::string place =
        " near " + point_text((surface_.vertices[edge.first] + surface_.vertices[edge.second]) / 2);
    std::map<int, int> of_shell;
    for (const int n : facets)
      ++of_shell[shell_of[n]];
    for (const auto& [shell, times] : of_shell)
      if (times % 2 != 0)
        throw std::invalid_argument(where_ + "has inner walls: surfaces part in an edge" + place + one +
                                    "unite its parts to one outer surface first");
    if (of_shell.size() > 1)
      throw std::invalid_argument(where_ + "holds " + number + " solids, " + number +
                                  " pieces that are joined in an edge only" + place + one +
                                  "write one file per solid, or join them by more than an edge");
    throw std::invalid_argument(where_ + "touches itself along an edge" + place +
                                "; expected a surface that does not: join or part it there");
  }
  const Pinch pinch = find_pinch(surface_, shell_of);
  if (pinch.vertex >= 0) {
    const std::string place = " near " + point_text(surface_.vertices[pinch.vertex]);
    if (pinch.same_shell)
      throw std::invalid_argument(where_ + "touches itself in a vertex" + place +
                                  "; expected a surface that does not: join or part it there");
    throw std::invalid_argument(where_ + "holds " + number + " solids, " + number +
                                " pieces that are joined in a vertex only" + place + one +
                                "write one file per solid, or join them by more than a vertex");
  }

  // No facets cross: shells lie beside or within each other.
  const double box = (high_ - low_).prod();
  std::vector<int> depth(shells.size(), 0);
  for (std::size_t k = 0; k < shells.size(); ++k) {
    if (!(std::abs(shells[k].volume) > kLeastVolume * box))
      throw std::invalid_argument(where_ + "holds a shell of " + std::to_string(shells[k].triangles.size()) +
                                  " facets that encloses no volume, near " +
                                  point_text(surface_.vertices[surface_.triangles[shells[k].triangles[0]][0]]) + one +
                                  "remove it");
    const Eigen::Vector3d inner = surface_.vertices[surface_.triangles[shells[k].triangles[0]][0]];
    for (std::size_t m = 0; m < shells.size(); ++m)
      if (m != k && winding_number(surface_, shells[m].triangles, inner) != 0)
        ++depth[k];
  }
  const auto outer = static_cast<int>(std::count_if(depth.begin(), depth.end(), [](int d) { return d % 2 == 0; }));
  const auto free_standing = static_cast<int>(std::count(depth.begin(), depth.end(), 0));
  if (free_standing > 1)
    throw std::invalid_argument(where_ + "holds " + std::to_string(free_standing) + " solids, " +
                                std::to_string(free_standing) + " pieces that are not joined" + one +
                                "write one file per solid");
  if (outer > 1)
    throw std::invalid_argument(where_ + "holds " + std::to_string(outer) +
                                " solids, one loose in the cavity of another" + one + "remove the inner one");
  double cavities = 0;
  for (std::size_t k = 0; k < shells.size(); ++k) {
    if (depth[k] == 0)
      continue;
    if (shells[k].volume > 0)
      throw std::invalid_argument(where_ + "holds 2 solids, one inside the other, near " +
                                  point_text(surface_.vertices[surface_.triangles[shells[k].triangles[0]][0]]) + one +
                                  "remove the inner one, or turn its facets inward if it is a cavity");
    cavities -= shells[k].volume;
  }
  if (cavities > 0)
    notes_.push_back({where_ + "is a hollow body: " + std::to_string(shells.size() - 1) + " cavity or cavities with " +
                      number_text(100 * cavities / (cavities + solid_properties(surface_).volume)) +
                      " % of the volume within its outer surface; they hold no mass, and spheres lie in the walls"});
}

Solid::Solid(const std::string& path, double scale) : path_(path), where_("STL file '" + path + "': ") {
  Surface raw = read_stl(path);
  const double size = diagonal_of(raw);
  if (!(size > 0))
    throw std::invalid_argument(where_ + "encloses no volume: all its corners are in one place; export a solid");
  const double offset = raw.vertices[raw.triangles[0][0]].norm();
  if (offset > kMaxOffset * size)
    throw std::invalid_argument(where_ + "lies " + number_text(offset / size) +
                                " times its size away from the origin, where the floats of STL do not resolve it; "
                                "expected at most 1e4: move it to the origin before it is exported");
  for (Eigen::Vector3d& v : raw.vertices)
    v *= scale;
  repair(raw);
  std::vector<Shell> shells = orient_shells(surface_, where_);
  int turned = 0;
  for (const Shell& shell : shells)
    turned += shell.turned;
  low_ = high_ = surface_.vertices[surface_.triangles[0][0]];
  for (const auto& t : surface_.triangles)
    for (const int v : t) {
      low_ = low_.cwiseMin(surface_.vertices[v]);
      high_ = high_.cwiseMax(surface_.vertices[v]);
    }
  // The shell that reaches lowest is an outer one; where it faces inward, the whole file is inside out.
  std::size_t lowest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < shells.size(); ++k)
    for (const int n : shells[k].triangles)
      for (const int v : surface_.triangles[n])
        if (surface_.vertices[v].x() < least) {
          least = surface_.vertices[v].x();
          lowest = k;
        }
  if (shells[lowest].volume < 0) {
    for (auto& t : surface_.triangles)
      std::swap(t[1], t[2]);
    for (Shell& shell : shells)
      shell.volume = -shell.volume;
    notes_.push_back({where_ + "was inside out: all its facets faced inward and were turned"});
  }
  if (turned > 0)
    notes_.push_back({where_ + std::to_string(turned) + " of its " + std::to_string(surface_.triangles.size()) +
                      " facets faced the other way than the rest and were turned"});
  properties_ = solid_properties(surface_);
  const double box = (high_ - low_).prod();
  if (shells.size() == 1 && !(properties_.volume > kLeastVolume * box))
    throw std::invalid_argument(where_ + "encloses no volume: export a solid");
  require_one_solid(shells);
  all_triangles_.resize(surface_.triangles.size());
  std::iota(all_triangles_.begin(), all_triangles_.end(), 0);
  field_ = std::make_shared<DistanceField>(surface_);
}

double Solid::distance(const Eigen::Vector3d& point) const {
  Eigen::Vector3d x = field_->frame.to_unit(point);
  return field_->frame.size * field_->function->EvaluateFunction(x.data());
}

bool Solid::holds(const Eigen::Vector3d& point) const {
  return winding_number(surface_, all_triangles_, point) > 0;
}

} // namespace eccentra::shape
