// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finds for each wall of the mesh the wall of the script that it stands for.
#include "link/wall_comparison.h"

#include "link/triangle_tree.h"
#include "link/wall_pieces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace eccentra::link {
namespace {

using Eigen::Vector3d;

/// Places agree to this part of a cylinder's radius, or of a plane's extent: of what is typed with four digits.
constexpr double kSamePlace = 2e-3;
/// Velocities agree to this part of the largest; on triangles, whose corners alone have one, to more.
constexpr double kSameVelocity = 5e-3, kSameVelocityOfTriangles = 2e-2;
/// Two walls of one form may stand for one place if their directions differ by less than this [degrees].
constexpr double kSameDirection = 20.0;
/// Part of a patch that lies on walls of the script for it to have its wall, and that says that it has none.
constexpr double kCovered = 0.98, kBare = 0.02;
/// A triangle mesh this near on average, in parts of a patch's extent, is meant to be that patch.
constexpr double kMeantNearby = 0.25;
/// Radii that differ by less than this part are printed as one.
constexpr double kOneRadius = 1e-6;
/// Components of a direction below this are left out of sentences.
constexpr double kAligned = 1e-6;

Vector3d vector(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

template <class... Values> std::string text(const char* format, Values... values) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

std::string text_of(const Vector3d& v) {
  const auto clean = [&v](int k) { return std::abs(v[k]) > 1e-9 * v.norm() ? v[k] : 0.0; };
  return text("(%.6g %.6g %.6g)", clean(0), clean(1), clean(2));
}

/// Axis that a direction follows, or -1.
int axis_of(const Vector3d& direction) {
  int k = 0;
  direction.cwiseAbs().maxCoeff(&k);
  return (direction - direction[k] * Vector3d::Unit(k)).norm() < kAligned ? k : -1;
}

std::string describe_plane(const Vector3d& point, const Vector3d& normal) {
  const int k = axis_of(normal);
  if (k >= 0)
    return text("the plane %c = %.6g m", "xyz"[k], point[k]);
  return "the plane through " + text_of(point) + " m with normal " + text_of(normal);
}

/// Flat faces lie between two radii.
std::string describe_cylinder(const Vector3d& point, const Vector3d& axis, double low, double radius) {
  const int k = axis_of(axis);
  std::string place = "the line through " + text_of(point - point.dot(axis) * axis) + " m along " + text_of(axis);
  if (k >= 0) {
    const int a = (k + 1) % 3, b = (k + 2) % 3, i = std::min(a, b), j = std::max(a, b);
    const auto clean = [&](double x) { return std::abs(x) < 1e-6 * radius ? 0.0 : x; };
    place = text("the line %c = %.6g m, %c = %.6g m", "xyz"[i], clean(point[i]), "xyz"[j], clean(point[j]));
  }
  const std::string from = low < (1 - kOneRadius) * radius ? text("%.4g to ", low) : "";
  return "a cylinder of radius " + from + text(from.empty() ? "%.6g" : "%.4g", radius) + " m about " + place;
}

double angle_cosine() {
  return std::cos(kSameDirection * std::acos(-1.0) / 180);
}

/// A wall of the script: a primitive one, or a piece of a mesh.
struct ScriptWall {
  std::string id, name;
  SurfacePiece surface; ///< extent 0: a primitive wall
  const PrimitiveWall* primitive = nullptr;
  int mesh = -1;
  bool velocity_known = true;
  bool found = false; ///< it has its place in the mesh
};

struct MeshWall {
  const MeshPatch* patch = nullptr;
  int patch_index = 0;
  const std::vector<Facet>* facets = nullptr;
  SurfacePiece surface;
  std::vector<int> walls; ///< of the script, at its place
  bool covered = false;
};

std::string described(const SurfacePiece& s) {
  if (s.form == SurfaceForm::plane)
    return describe_plane(s.point, s.direction);
  return describe_cylinder(s.point, s.direction, s.low, s.high);
}

class Comparison {
 public:
  Comparison(const WallDescription& dem, const std::vector<MeshPatch>& mesh,
             const std::function<bool(const std::string&)>& apart)
      : dem_(dem), apart_(apart), tree_(triangles_of(dem)) {
    read_script();
    read_mesh(mesh);
  }

  WallVerdict verdict() {
    WallVerdict verdict;
    verdict.chord_heights = chord_heights_;
    for (MeshWall& wall : mesh_)
      find_place(wall);
    mark_meshes_found();
    for (const MeshWall& wall : mesh_)
      if (wall.patch->wall && !wall.covered && verdict.refusal.empty())
        verdict.refusal = misplaced(wall);
    for (const MeshWall& wall : mesh_)
      if (wall.patch->wall && wall.patch->velocity_known && verdict.refusal.empty())
        verdict.refusal = other_velocity(wall);
    if (verdict.refusal.empty())
      verdict.news = news();
    return verdict;
  }

 private:
  static std::vector<TriangleTree::Triangle> triangles_of(const WallDescription& dem) {
    std::vector<TriangleTree::Triangle> all;
    for (const TriangleWall& mesh : dem.meshes)
      for (const auto& corners : mesh.corners)
        all.push_back({vector(corners[0]), vector(corners[1]), vector(corners[2])});
    return all;
  }

  void read_script() {
    for (const PrimitiveWall& wall : dem_.primitives) {
      if (apart_(wall.id))
        continue;
      ScriptWall& mine = walls_.emplace_back();
      mine.id = wall.id;
      mine.name = wall.name;
      mine.primitive = &wall;
      mine.surface.form = wall.form == PrimitiveWall::Form::plane ? SurfaceForm::plane : SurfaceForm::cylinder;
      mine.surface.point = vector(wall.point);
      mine.surface.direction = vector(wall.direction);
      mine.surface.low = mine.surface.high = wall.radius;
    }
    for (std::size_t m = 0; m < dem_.meshes.size(); ++m) {
      const TriangleWall& mesh = dem_.meshes[m];
      std::vector<Facet> facets;
      for (const auto& corners : mesh.corners) {
        facets.emplace_back(std::vector<Vector3d>{vector(corners[0]), vector(corners[1]), vector(corners[2])});
        owner_.push_back({static_cast<int>(m), static_cast<int>(facets.size()) - 1, -1});
      }
      if (apart_(mesh.id))
        continue;
      const std::size_t first = owner_.size() - facets.size();
      for (SurfacePiece& piece : pieces_of(facets)) {
        chord_ = std::max(chord_, piece.chord);
        for (const int f : piece.facets)
          owner_[first + f].wall = static_cast<int>(walls_.size());
        ScriptWall& mine = walls_.emplace_back();
        mine.id = mesh.id;
        mine.name = mesh.name;
        mine.surface = std::move(piece);
        mine.mesh = static_cast<int>(m);
        mine.velocity_known = mesh.velocity_known;
      }
    }
  }

  void read_mesh(const std::vector<MeshPatch>& mesh) {
    facets_.reserve(mesh.size());
    for (std::size_t p = 0; p < mesh.size(); ++p) {
      std::vector<Facet>& facets = facets_.emplace_back();
      for (const PatchFace& face : mesh[p].faces) {
        std::vector<Vector3d> corners;
        for (const Vector3& x : face.corners)
          corners.push_back(vector(x));
        facets.emplace_back(std::move(corners));
      }
      double& chord = chord_heights_.emplace_back(0.0);
      for (SurfacePiece& piece : pieces_of(facets)) {
        chord = std::max(chord, piece.chord);
        if (!apart_(mesh[p].name))
          mesh_.push_back({&mesh[p], static_cast<int>(p), &facets, std::move(piece), {}, false});
      }
    }
  }

  /// How far the mesh's wall lies from one of the script of the same form [m], and how far is no difference.
  std::pair<double, double> deviation(const MeshWall& wall, const ScriptWall& script) const {
    const SurfacePiece &m = wall.surface, &d = script.surface;
    double off = 0;
    if (m.form == SurfaceForm::plane) {
      for (const int f : m.facets)
        for (const Vector3d& x : (*wall.facets)[f].corners)
          off = std::max(off, std::abs((x - d.point).dot(d.direction)));
      return {off, kSamePlace * m.extent};
    }
    for (const double at : {m.begin, m.end}) {
      const Vector3d from = m.point + at * m.direction - d.point;
      off = std::max(off, (from - from.dot(d.direction) * d.direction).norm());
    }
    const double radii = std::max({0.0, m.low - d.high, d.low - m.high});
    const double round = 0.5 * (m.high - m.low + d.high - d.low);
    // Either may be off by its own; the sum only orders candidates.
    return {std::max(radii, std::max(0.0, off - round)), kSamePlace * m.high};
  }

  bool alike(const MeshWall& wall, const ScriptWall& script) const {
    return wall.surface.form == script.surface.form && wall.surface.form != SurfaceForm::other &&
           std::abs(wall.surface.direction.dot(script.surface.direction)) > angle_cosine();
  }

  double tolerance_on_triangles(const MeshWall& wall) const {
    return kSamePlace * wall.surface.extent + wall.surface.chord + chord_;
  }

  /// The furthest point of a face from the triangles of the script.
  std::pair<double, Vector3d> furthest(const Facet& facet) const {
    std::pair<double, Vector3d> worst{0, facet.centre};
    for (const Vector3d& x : facet.corners)
      if (const double distance = tree_.nearest(x).distance; distance > worst.first)
        worst = {distance, x};
    return worst;
  }

  void find_place(MeshWall& wall) {
    bool on_primitive = false;
    for (std::size_t d = 0; d < walls_.size(); ++d) {
      if (!alike(wall, walls_[d]))
        continue;
      const auto [off, allowed] = deviation(wall, walls_[d]);
      if (off > allowed)
        continue;
      wall.walls.push_back(static_cast<int>(d));
      walls_[d].found = true;
      on_primitive = on_primitive || walls_[d].primitive;
    }
    wall.covered = on_primitive;
    if (wall.covered || dem_.meshes.empty())
      return;
    double area = 0, near = 0;
    std::set<int> owners(wall.walls.begin(), wall.walls.end());
    for (const int f : wall.surface.facets) {
      const Facet& facet = (*wall.facets)[f];
      area += facet.area;
      if (furthest(facet).first > tolerance_on_triangles(wall))
        continue;
      const int owner = owner_[tree_.nearest(facet.centre).triangle].wall;
      // Planes and cylinders have been compared, and more exactly than by their facets.
      if (owner < 0 || (alike(wall, walls_[owner]) && !owners.count(owner)))
        continue;
      near += facet.area;
      owners.insert(owner);
    }
    wall.walls.assign(owners.begin(), owners.end());
    const double part = area > 0 ? near / area : 1;
    wall.covered = part >= kCovered;
    if (!wall.covered && part > kBare)
      partly_.push_back(text("%.0f %% of patch '", 100 * (1 - part)) + wall.patch->name + "'");
  }

  /// Meshes of the script may reach beyond the fluid: those with a piece in its place have their place.
  void mark_meshes_found() {
    for (const MeshWall& wall : mesh_)
      for (const int d : wall.walls)
        walls_[d].found = true;
  }

  std::string misplaced(const MeshWall& wall) const {
    const ScriptWall* best = nullptr;
    double least = std::numeric_limits<double>::max();
    for (const ScriptWall& script : walls_) {
      if (script.found || !alike(wall, script))
        continue;
      const double off = deviation(wall, script).first;
      if (off < least) {
        least = off;
        best = &script;
      }
    }
    if (best)
      return "wall '" + best->name + "' of the DEM script is " + described(best->surface) + " but patch '" +
             wall.patch->name + "' of the mesh is " + described(wall.surface) + remedy();
    return other_triangles(wall);
  }

  /// A mesh of the script that has no place and lies near this patch.
  std::string other_triangles(const MeshWall& wall) const {
    if (dem_.meshes.empty())
      return "";
    double area = 0, mean = 0;
    std::pair<double, Vector3d> worst{0, Vector3d::Zero()};
    const ScriptWall* script = nullptr;
    for (const int f : wall.surface.facets) {
      const Facet& facet = (*wall.facets)[f];
      const int owner = owner_[tree_.nearest(facet.centre).triangle].wall;
      const auto far = furthest(facet);
      area += facet.area;
      mean += facet.area * far.first;
      if (far.first > worst.first && owner >= 0) {
        worst = far;
        script = &walls_[owner];
      }
    }
    if (!script || script->found || mean > kMeantNearby * wall.surface.extent * area)
      return "";
    return "wall '" + script->name + "' of the DEM script lies up to " + text("%.4g", worst.first) + " m from patch '" +
           wall.patch->name + "' of the mesh, at " + text_of(worst.second) + " m" + remedy();
  }

  static std::string remedy() {
    return ": make both the same, or name one of them in wallsApart of constant/couplingProperties if they are two "
           "walls";
  }

  /// Velocity of the script's wall at a point of the patch; none where its mesh does not reach.
  std::optional<Vector3d> velocity_of(const ScriptWall& script, const MeshWall& wall, const Vector3d& x) const {
    if (script.primitive)
      return Vector3d(vector(script.primitive->velocity) +
                      vector(script.primitive->angular_velocity).cross(x - vector(script.primitive->point)));
    const TriangleTree::Nearest nearest = tree_.nearest(x);
    if (nearest.triangle < 0 || nearest.distance > tolerance_on_triangles(wall) ||
        owner_[nearest.triangle].mesh != script.mesh)
      return std::nullopt;
    const TriangleWall& mesh = dem_.meshes[script.mesh];
    Vector3d velocity = Vector3d::Zero();
    if (!mesh.velocities.empty())
      for (int k = 0; k < 3; ++k)
        velocity += nearest.weights[k] * vector(mesh.velocities[owner_[nearest.triangle].facet][k]);
    return velocity;
  }

  std::string other_velocity(const MeshWall& wall) const {
    for (const int d : wall.walls)
      if (walls_[d].velocity_known)
        if (const std::string sentence = other_velocity(wall, walls_[d]); !sentence.empty())
          return sentence;
    return "";
  }

  std::string other_velocity(const MeshWall& wall, const ScriptWall& script) const {
    double largest = 0, worst = 0;
    Vector3d place = Vector3d::Zero(), fluid_there = place, script_there = place;
    double fluid_spin = 0, script_spin = 0, fluid_slide = 0, script_slide = 0, area = 0;
    const SurfacePiece& s = wall.surface;
    for (const int f : s.facets) {
      const Facet& facet = (*wall.facets)[f];
      const std::optional<Vector3d> of_script = velocity_of(script, wall, facet.centre);
      if (!of_script)
        continue;
      // A flat face that stands for an arc: what crosses it is the chord's.
      const auto along = [&facet](const Vector3d& v) { return Vector3d(v - v.dot(facet.normal) * facet.normal); };
      const Vector3d of_fluid = along(vector(wall.patch->faces[f].velocity)), of_wall = along(*of_script);
      largest = std::max({largest, of_fluid.norm(), of_wall.norm()});
      if (const double off = (of_fluid - of_wall).norm(); off > worst) {
        worst = off;
        place = facet.centre;
        fluid_there = of_fluid;
        script_there = of_wall;
      }
      const Vector3d from = facet.centre - s.point;
      const Vector3d arm = from - from.dot(s.direction) * s.direction;
      const auto spin = [&](const Vector3d& v) {
        return arm.squaredNorm() > 0 ? arm.cross(v).dot(s.direction) / arm.squaredNorm() : 0.0;
      };
      area += facet.area;
      fluid_spin += facet.area * spin(of_fluid);
      script_spin += facet.area * spin(of_wall);
      fluid_slide += facet.area * of_fluid.dot(s.direction);
      script_slide += facet.area * of_wall.dot(s.direction);
    }
    const double same = script.primitive ? kSameVelocity : kSameVelocityOfTriangles + same_chord(wall);
    if (!(worst > same * largest) || !(area > 0))
      return "";
    const std::string of_script = "wall '" + script.name + "' of the DEM script ",
                      of_patch = " but patch '" + wall.patch->name + "' of the mesh ";
    const std::string make = ": make both the same (the script's wall and the boundary condition of U), or name one of "
                             "them in wallsApart of constant/couplingProperties";
    const double size = largest * area, arm = s.form == SurfaceForm::cylinder ? s.high : 0;
    // Round-off is not a speed.
    const auto clean = [&](double sum, double scale) { return std::abs(sum) > 1e-9 * scale ? sum / area : 0.0; };
    if (arm > 0 && std::abs(fluid_spin - script_spin) * arm > same * size)
      return of_script + text("turns at %.6g rad/s about ", clean(script_spin, size / arm)) + text_of(s.direction) +
             of_patch + text("at %.6g rad/s", clean(fluid_spin, size / arm)) + make;
    if (arm > 0 && std::abs(fluid_slide - script_slide) > same * size)
      return of_script + text("slides at %.6g m/s along ", clean(script_slide, size)) + text_of(s.direction) +
             of_patch + text("at %.6g m/s", clean(fluid_slide, size)) + make;
    return of_script + "moves at " + text_of(script_there) + " m/s" + of_patch + "at " + text_of(fluid_there) +
           " m/s, at " + text_of(place) + " m" + make;
  }

  double same_chord(const MeshWall& wall) const {
    const double size = wall.surface.form == SurfaceForm::cylinder ? wall.surface.high : wall.surface.extent;
    return size > 0 ? (wall.surface.chord + chord_) / size : 0;
  }

  std::string news() const {
    std::set<std::string> bare, lonely;
    for (const MeshWall& wall : mesh_)
      if (wall.patch->wall && !wall.covered && wall.walls.empty())
        bare.insert("patch '" + wall.patch->name + "'");
    std::set<std::string> found;
    for (const ScriptWall& wall : walls_)
      if (wall.found)
        found.insert(wall.name);
    for (const ScriptWall& wall : walls_)
      if (!found.count(wall.name))
        lonely.insert(wall.name);
    bare.insert(partly_.begin(), partly_.end());
    const auto list = [](const std::set<std::string>& names) {
      std::string all;
      for (const std::string& name : names)
        all += (all.empty() ? "" : ", ") + name;
      return all;
    };
    std::string sentences;
    if (!bare.empty())
      sentences =
          "warning: no wall of the DEM script is near " + list(bare) + " of the mesh: particles may leave there\n";
    if (!lonely.empty())
      sentences += "warning: no patch of the mesh is near " + list(lonely) +
                   " of the DEM script: the fluid does not know of that wall\n";
    return sentences;
  }

  struct Owner {
    int mesh, facet, wall;
  };
  const WallDescription& dem_;
  const std::function<bool(const std::string&)>& apart_;
  TriangleTree tree_;        ///< of all meshes of the script
  std::vector<Owner> owner_; ///< of its triangles
  double chord_ = 0;         ///< largest of the script's meshes
  std::vector<ScriptWall> walls_;
  std::vector<std::vector<Facet>> facets_; ///< of each patch
  std::vector<MeshWall> mesh_;
  std::vector<double> chord_heights_;
  std::vector<std::string> partly_;
};

} // namespace

WallVerdict compare_walls(const WallDescription& dem, const std::vector<MeshPatch>& mesh,
                          const std::function<bool(const std::string&)>& apart) {
  return Comparison(dem, mesh, apart).verdict();
}

} // namespace eccentra::link
