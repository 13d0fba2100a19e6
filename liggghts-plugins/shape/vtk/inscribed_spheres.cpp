// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Greedy cover of a solid's volume by inscribed spheres on a distance field.
#include "shape/vtk/inscribed_spheres.h"

#include "shape/union_geometry.h"
#include "shape/vtk/balanced_cover.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace eccentra::shape {
namespace {

constexpr int default_resolution = 48;     ///< points along the longest side
constexpr int points_across_thinnest = 12; ///< at least, where the number of points allows
constexpr double max_points = 1.5e6;       ///< of the grid
constexpr int balancing_steps = 5;         ///< halvings of the protrusion before the rest is grown
constexpr int max_spheres = 4096;          ///< where only an error is asked for
/// The exact volume is worked out once the grid's estimate of the error is within this factor of the error asked for.
constexpr double estimate_margin = 1.5;

/// Grid over the bounding box, with a point in its centre so that symmetric solids get symmetric candidates.
struct Grid {
  Eigen::Vector3d middle;
  double spacing;
  Eigen::Array3i half; ///< points on either side of the middle
  Eigen::Array3i size() const { return 2 * half + 1; }
  Eigen::Vector3d point(int i, int j, int k) const {
    return middle + spacing * Eigen::Vector3d(i - half[0], j - half[1], k - half[2]);
  }
  std::size_t index(int i, int j, int k) const { return (static_cast<std::size_t>(i) * size()[1] + j) * size()[2] + k; }
  std::size_t count() const { return static_cast<std::size_t>(size()[0]) * size()[1] * size()[2]; }
};

Grid grid_for(const Solid& solid, int resolution) {
  const Eigen::Vector3d box = solid.high() - solid.low();
  Grid grid;
  grid.middle = (solid.low() + solid.high()) / 2;
  grid.spacing = box.maxCoeff() / (resolution > 0 ? resolution : default_resolution);
  if (resolution <= 0)
    grid.spacing = std::min(grid.spacing, box.minCoeff() / points_across_thinnest);
  grid.spacing = std::max(grid.spacing, std::cbrt(box.prod() / max_points));
  grid.half = (box / (2 * grid.spacing)).array().ceil().cast<int>();
  return grid;
}

struct Candidate {
  int i, j, k;
  double radius; ///< in grid spacings
  double bound;  ///< of the gain, in grid points
  bool reached = false;
};

double ball(double r) {
  return 4 * M_PI / 3 * r * r * r;
}

/// Volume that two balls share.
double lens(double r1, double r2, double d) {
  if (d >= r1 + r2)
    return 0;
  if (d <= std::abs(r1 - r2))
    return ball(std::min(r1, r2));
  const double h = r1 + r2 - d;
  return M_PI * h * h * (d * d + 2 * d * (r1 + r2) - 3 * (r1 - r2) * (r1 - r2)) / (12 * d);
}

/// A point of the grid inside the solid.
struct InnerPoint {
  int i, j, k;
  double depth; ///< under the surface, in grid spacings
};

std::vector<InnerPoint> inner_points(const Solid& solid, const Grid& grid) {
  std::vector<InnerPoint> points;
  const Eigen::Array3i n = grid.size();
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        const double depth = -solid.distance(grid.point(i, j, k)) / grid.spacing;
        if (depth > 0)
          points.push_back({i, j, k, depth});
        else // so far from the solid, the next points are outside, too
          k += std::max(0, static_cast<int>(std::ceil(-depth)) - 1);
      }
  return points;
}

class Filling {
 public:
  /// `protrusion`, in grid spacings, is what spheres may stand out of the solid.
  Filling(const Grid& grid, const std::vector<InnerPoint>& inside, double protrusion)
      : grid_(grid), open_(grid.count(), 0), inside_(inside.size()), free_(inside.size()) {
    for (const InnerPoint& point : inside) {
      open_[grid.index(point.i, point.j, point.k)] = 1;
      // A point has a cell of its own, half a spacing either way: smaller spheres have no measurable gain.
      if (point.depth > 0.5)
        candidates_.push_back(
            {point.i, point.j, point.k, point.depth + protrusion, ball(point.depth + protrusion + 1)});
    }
  }

  bool empty() const { return candidates_.empty(); }
  double missing() const { return static_cast<double>(free_) / static_cast<double>(inside_); }

  /// Takes the best candidate that touches what was taken before; false if none adds anything.
  bool take(Sphere& sphere) {
    std::vector<Candidate*> heap;
    for (Candidate& c : candidates_)
      if ((first_ || c.reached) && c.bound >= 1)
        heap.push_back(&c);
    // Of equal gains the larger sphere, then the earlier point: the order never depends on the heap.
    const auto lower = [](const Candidate* a, const Candidate* b) {
      return a->bound != b->bound ? a->bound < b->bound : a->radius != b->radius ? a->radius < b->radius : a > b;
    };
    std::make_heap(heap.begin(), heap.end(), lower);
    while (!heap.empty()) {
      std::pop_heap(heap.begin(), heap.end(), lower);
      Candidate* best = heap.back();
      const double gain = visit(*best, false);
      // A bound that still holds makes this the best of all.
      if (gain >= best->bound) {
        commit(*best, sphere);
        return true;
      }
      best->bound = gain;
      if (gain < 1)
        heap.pop_back();
      else
        std::push_heap(heap.begin(), heap.end(), lower);
    }
    return false;
  }

 private:
  /// Grid points that the candidate would add; `fill` closes them.
  double visit(const Candidate& c, bool fill) {
    const int reach = static_cast<int>(std::ceil(c.radius));
    const Eigen::Array3i n = grid_.size();
    double gain = 0;
    for (int i = std::max(0, c.i - reach); i <= std::min(n[0] - 1, c.i + reach); ++i)
      for (int j = std::max(0, c.j - reach); j <= std::min(n[1] - 1, c.j + reach); ++j) {
        const double rest = c.radius * c.radius - (i - c.i) * (i - c.i) - (j - c.j) * (j - c.j);
        if (rest <= 0)
          continue;
        const int run = static_cast<int>(std::sqrt(rest));
        const int begin = std::max(0, c.k - run), end = std::min(n[2] - 1, c.k + run);
        char* row = &open_[grid_.index(i, j, 0)];
        for (int k = begin; k <= end; ++k) {
          gain += row[k];
          if (fill)
            row[k] = 0;
        }
      }
    return gain;
  }

  void commit(Candidate& taken, Sphere& sphere) {
    free_ -= static_cast<std::size_t>(visit(taken, true));
    sphere = {grid_.point(taken.i, taken.j, taken.k), taken.radius * grid_.spacing};
    first_ = false;
    const Candidate t = taken;
    for (Candidate& c : candidates_) {
      const double d = std::hypot(c.i - t.i, c.j - t.j, c.k - t.k);
      c.reached = c.reached || d < c.radius + t.radius;
      // What both share is gone; one spacing more than the ball allows for the roughness of counting.
      c.bound = std::min(c.bound, ball(c.radius + 1) - lens(c.radius, t.radius, d));
    }
    taken.bound = 0;
  }

  Grid grid_;
  std::vector<char> open_; ///< 1 at points inside the solid that no sphere taken holds
  std::vector<Candidate> candidates_;
  std::size_t inside_, free_;
  bool first_ = true;
};

/// The first `count` spheres, or fewer where no more add anything.
std::vector<Sphere> filled(const Grid& grid, const std::vector<InnerPoint>& inside, std::size_t count,
                           double protrusion) {
  Filling filling(grid, inside, protrusion / grid.spacing);
  std::vector<Sphere> spheres;
  Sphere next;
  while (spheres.size() < count && filling.take(next))
    spheres.push_back(next);
  return spheres;
}

double volume_of(const std::vector<Sphere>& spheres) {
  return measure_union(spheres).properties.volume;
}

} // namespace

std::vector<Sphere> inscribed_spheres(const Solid& solid, const InscribedOptions& options) {
  const Grid grid = grid_for(solid, options.resolution);
  const std::vector<InnerPoint> inside = inner_points(solid, grid);
  Filling filling(grid, inside, 0);
  const std::string finer = ": give a higher resolution";
  if (filling.empty())
    throw std::invalid_argument("STL file '" + solid.path() + "' is thinner than the grid of its distance field" +
                                finer);
  const int limit = options.spheres > 0 ? options.spheres : max_spheres;
  std::vector<Sphere> spheres;
  Sphere next;
  while (static_cast<int>(spheres.size()) < limit && filling.take(next)) {
    spheres.push_back(next);
    if (options.volume_error > 0 && filling.missing() < estimate_margin * options.volume_error &&
        1 - measure_union(spheres).properties.volume / solid.properties().volume <= options.volume_error)
      return spheres;
  }
  const std::string reached =
      "STL file '" + solid.path() + "' takes only " + std::to_string(spheres.size()) + " spheres";
  if (options.spheres > 0 && static_cast<int>(spheres.size()) < options.spheres)
    throw std::invalid_argument(reached + " at this resolution, " + std::to_string(options.spheres) +
                                " were asked for" + finer);
  if (options.spheres <= 0) {
    const double error = 1 - measure_union(spheres).properties.volume / solid.properties().volume;
    throw std::invalid_argument(reached + " and then lacks " + std::to_string(100 * error) + " % of its volume, " +
                                std::to_string(100 * options.volume_error) + " % were asked for" + finer +
                                " or a larger error");
  }
  return spheres;
}

std::vector<Sphere> balanced_spheres(const Solid& solid, const InscribedOptions& options) {
  const std::size_t count =
      options.volume_error > 0 ? inscribed_spheres(solid, options).size() : static_cast<std::size_t>(options.spheres);
  const Grid grid = grid_for(solid, options.resolution);
  const std::vector<InnerPoint> inside = inner_points(solid, grid);
  const double wanted = solid.properties().volume;
  // Larger spheres hold more: enclose the protrusion that gives the volume of the solid, from below.
  double low = 0, high = (solid.high() - solid.low()).minCoeff() / 2;
  std::vector<Sphere> best = filled(grid, inside, count, low);
  if (best.empty())
    throw std::invalid_argument("STL file '" + solid.path() +
                                "' is thinner than the grid of its distance field: give a higher resolution");
  for (int step = 0; step < balancing_steps; ++step) {
    const double middle = (low + high) / 2;
    const std::vector<Sphere> spheres = filled(grid, inside, count, middle);
    if (volume_of(spheres) < wanted) {
      low = middle;
      best = spheres;
    } else {
      high = middle;
    }
  }
  grow_to_volume(best, wanted);
  return best;
}

} // namespace eccentra::shape
