// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rolling models at walls: meshes that turn, against closed forms, and all models at wall/gran/cluster.
#include "styles/rolling/rolling_scene.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace eccentra::test;

namespace {

/// A wall style with the model arguments that follow it; pair_style takes the same model.
struct WallModel {
  const char* name;
  const char* style;
  const char* model;
  const char* arguments; ///< of pair and wall
};

std::string name_of(const ::testing::TestParamInfo<WallModel>& info) {
  return info.param.name;
}

RollingScene scene_of(const WallModel& model, double mu) {
  RollingScene scene;
  scene.model = model.model;
  scene.arguments = model.arguments;
  const bool ours = scene.model == "shape";
  scene.mu_shape = ours ? mu : 0;
  scene.mu_r = ours ? 0 : mu;
  scene.walls = "";
  return scene;
}

std::string wall(const WallModel& model, const std::string& what) {
  return std::string("fix floor all ") + model.style + " model hertz tangential history rolling_friction " +
         model.model + " " + what + " " + model.arguments + "\n";
}

using Corners = std::array<Eigen::Vector3d, 3>;

std::string write_stl(const std::string& folder, const std::vector<Corners>& triangles) {
  const std::filesystem::path path = fresh_folder(folder) / "wall.stl";
  std::ofstream out(path);
  out.precision(17);
  out << "solid wall\n";
  for (const Corners& corners : triangles) {
    out << "facet normal 0 0 1\nouter loop\n";
    for (const Eigen::Vector3d& c : corners)
      out << "vertex " << c[0] << " " << c[1] << " " << c[2] << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid wall\n";
  return path;
}

std::vector<Corners> plate() {
  const double half = 0.02;
  const Eigen::Vector3d a(-half, -half, 0), b(half, -half, 0), c(half, half, 0), d(-half, half, 0);
  return {{a, b, c}, {a, c, d}};
}

constexpr double kDrumRadius = 0.03;

std::vector<Corners> drum(int facets) {
  std::vector<Corners> triangles;
  const auto corner = [facets](int k, double z) -> Eigen::Vector3d {
    const double angle = 2 * kPi * (k % facets) / facets;
    return {kDrumRadius * std::cos(angle), kDrumRadius * std::sin(angle), z};
  };
  const double half = 0.01;
  for (int k = 0; k < facets; ++k) {
    triangles.push_back({corner(k, -half), corner(k + 1, -half), corner(k + 1, half)});
    triangles.push_back({corner(k, -half), corner(k + 1, half), corner(k, half)});
  }
  return triangles;
}

std::string turning_mesh(const WallModel& model, const std::string& stl, double spin) {
  return "fix mesh all mesh/surface file " + stl +
         " type 1\nfix turn all move/mesh mesh mesh rotate origin 0 0 0 axis " + "0 0 1 period " +
         number(2 * kPi / spin) + "\n" + wall(model, "mesh n_meshes 1 meshes mesh");
}

} // namespace

class TurningMesh : public ::testing::TestWithParam<WallModel> {};

// A sphere on a plate that turns about the vertical through it: its spin grows by 5/2 mu g / R until it is the plate's.
TEST_P(TurningMesh, PlateTurnsTheSphereOnIt) {
  const double mu = 0.05;
  const double spin = 6;
  RollingScene scene = scene_of(GetParam(), mu);
  scene.mu_s = 0; // the sphere stays where it is: beside the axis, not on the diagonal of the plate
  scene.arguments += " torsionTorque on";
  WallModel model = GetParam();
  model.arguments = scene.arguments.c_str();
  LiggghtsSession session;
  const double weight = sphere_mass() * kGravity;
  session.script(rolling_scene(scene) + turning_mesh(model, write_stl("plate", plate()), spin) +
                 sphere_at({0.001, -0.0005, kRadius - resting_overlap(scene, weight)}) + spheres_done());
  const double rate = 2.5 * mu * kGravity / kRadius;
  const long half = std::lround(0.5 * spin / rate / scene.timestep);
  run(session, half);
  EXPECT_NEAR(sphere(session, 1).omega[2], 0.5 * spin, 0.01 * spin);
  run(session, 2 * half);
  double mean = 0; // springs swing about it
  const int samples = 40;
  for (int k = 0; k < samples; ++k) {
    run(session, 87); // together a period of epsd's, 2 pi sqrt(I / k_r)
    mean += sphere(session, 1).omega[2] / samples;
  }
  EXPECT_NEAR(mean, spin, 0.03 * spin);
}

// A sphere held at the side of a turning drum without sliding friction takes the drum's spin.
TEST_P(TurningMesh, DrumTurnsTheSphereAtItsSide) {
  RollingScene scene = scene_of(GetParam(), 0.5);
  scene.gravity = {1, 0, 0};
  scene.mu_s = 0;
  const double spin = 3;
  LiggghtsSession session;
  session.script(rolling_scene(scene) + turning_mesh(GetParam(), write_stl("drum", drum(120)), spin) +
                 sphere_at({kDrumRadius - kRadius - 3e-5, 0, 0}) + spheres_done());
  run(session, 10000);
  // one step of the models without memory; the facets shake the rest
  const double chatter = 2.5 * 0.5 * kGravity * scene.timestep / kRadius;
  EXPECT_NEAR(sphere(session, 1).omega[2], spin, 0.03 * spin + 3 * chatter);
}

class TurningDrum : public TurningMesh {};

// A sphere that rolls in a turning drum stays where the slope is the coefficient: tan = mu.
TEST_P(TurningDrum, SphereClimbsToItsCoefficient) {
  const double mu = 0.1;
  RollingScene scene = scene_of(GetParam(), mu);
  scene.gravity = {0, -1, 0};
  const double angle = std::atan(mu);
  const double spin = 3;
  LiggghtsSession session;
  const double way = kDrumRadius - kRadius;
  session.script(rolling_scene(scene) + turning_mesh(GetParam(), write_stl("climb", drum(360)), spin) +
                 sphere_at({way * std::sin(angle), -way * std::cos(angle), 0}) + spheres_done());
  set_motion(session, 1, {0, 0, 0}, {0, 0, spin * kDrumRadius / kRadius});
  double mean = 0;
  const int samples = 20;
  for (int k = 0; k < samples; ++k) {
    run(session, 1000); // 0.2 s in all
    const SphereState state = sphere(session, 1);
    mean += std::atan2(state.x[0], -state.x[1]) / samples;
  }
  EXPECT_NEAR(std::tan(mean), mu, 0.05 * mu); // facets of a degree
}

INSTANTIATE_TEST_SUITE_P(Walls, TurningMesh,
                         ::testing::Values(WallModel{"stock_limited", "wall/gran", "shape", "form limited"},
                                           WallModel{"stock_epsd", "wall/gran", "shape", "form epsd"},
                                           WallModel{"limited", "wall/gran/cluster", "shape", "form limited"},
                                           WallModel{"epsd", "wall/gran/cluster", "shape", "form epsd"},
                                           WallModel{"directional", "wall/gran/cluster", "shape", "form directional"},
                                           WallModel{"cdt", "wall/gran/cluster", "cdt", ""},
                                           WallModel{"stock_epsd2", "wall/gran/cluster", "epsd2", ""}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Walls, TurningDrum,
                         ::testing::Values(WallModel{"stock_limited", "wall/gran", "shape", "form limited"},
                                           WallModel{"limited", "wall/gran/cluster", "shape", "form limited"},
                                           WallModel{"cdt", "wall/gran/cluster", "cdt", ""}),
                         name_of);

class ModelsAtOurWalls : public ::testing::TestWithParam<WallModel> {};

// On a plane at rest nothing tells wall/gran/cluster from stock walls: a sphere that slips, rolls and stops.
TEST_P(ModelsAtOurWalls, EqualStockWallsOnAPlane) {
  const std::string springs = "fix m7 all property/global coefficientRollingViscousDamping peratomtypepair 1 0.3\n"
                              "fix m8 all property/global rollingStiffness scalar 2.25\n"
                              "fix m9 all property/global coeffRollingStiffness peratomtypepair 1 0.3\n";
  const auto rolled = [&](const char* style) {
    RollingScene scene = scene_of(GetParam(), 0.1);
    scene.arguments = "";
    scene.pair_arguments = GetParam().arguments;
    WallModel model = GetParam();
    model.style = style;
    model.arguments = std::string(style) == "wall/gran" ? "" : "contacts parallel";
    LiggghtsSession session;
    const double weight = sphere_mass() * kGravity;
    std::string script = rolling_scene(scene);
    script.insert(script.find("pair_style"), springs);
    session.script(script + wall(model, "primitive type 1 zplane 0.0") +
                   sphere_at({0, 0, kRadius - 0.9 * resting_overlap(scene, weight)}) + spheres_done());
    set_motion(session, 1, {0.1, 0.02, 0}, {3, 0, 5});
    run(session, 8000);
    return sphere(session, 1);
  };
  const SphereState stock = rolled("wall/gran");
  const SphereState ours = rolled("wall/gran/cluster");
  EXPECT_LT(stock.v[0], 0.05); // it has met resistance
  // Stock's luding bounds its torque with adhesion that Hertz does not have: it reads in front of the contact's
  // history.
  const double tolerance = std::string(GetParam().model) == "luding" ? 1e-5 : 1e-9;
  EXPECT_LT((stock.x - ours.x).norm(), tolerance * 0.1);
  EXPECT_LT((stock.v - ours.v).norm(), tolerance);
  EXPECT_LT((stock.omega - ours.omega).norm() * kRadius, tolerance);
}

INSTANTIATE_TEST_SUITE_P(Walls, ModelsAtOurWalls,
                         ::testing::Values(WallModel{"cdt", "", "cdt", ""}, WallModel{"epsd", "", "epsd", ""},
                                           WallModel{"epsd2", "", "epsd2", ""}, WallModel{"epsd3", "", "epsd3", ""},
                                           WallModel{"luding", "", "luding", ""}, WallModel{"shape", "", "shape", ""},
                                           WallModel{"eccentric", "", "eccentric", "shape cube 64"}),
                         name_of);
