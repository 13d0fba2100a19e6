// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of two materials: each coefficient of a pair of types is the one that acts between them, at walls, too. Scenes
// of spheres and clusters: each has its own model.
#include "styles/pairs/all_materials.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>

using namespace eccentra;
using namespace eccentra::test;

namespace {

/// A coefficient of pairs of types, and a model that reads it; keywords follow the wall.
struct Coefficient {
  const char* property;
  const char* models;
  const char* keywords = "";
};

const Coefficient coefficients[] = {
    {"coefficientRestitution", "hertz"},
    {"coefficientFriction", "hertz"},
    {"coefficientRestitution", "hooke"},
    {"coefficientFriction", "hooke"},
    {"coefficientRollingFriction", "hertz rolling_friction cdt"},
    {"coefficientRollingFriction", "hertz rolling_friction epsd"},
    {"coefficientRollingFriction", "hertz rolling_friction epsd2"},
    {"coefficientRollingFriction", "hertz rolling_friction epsd3"},
    {"coefficientRollingFriction", "luding rolling_friction luding"},
    {"coefficientRollingViscousDamping", "hertz rolling_friction epsd"},
    {"coeffRollingStiffness", "luding rolling_friction luding"},
    {"shapeRollingFriction", "hertz rolling_friction shape", "form limited"},
    {"shapeRollingFriction", "hertz rolling_friction shape", "form directional"},
    {"shapeRollingFriction", "hertz rolling_friction shape", "form epsd"},
    {"cohesionEnergyDensity", "hertz cohesion sjkr"},
    {"cohesionEnergyDensity", "hertz cohesion sjkr2"},
    {"kn", "hooke/stiffness"},
    {"kt", "hooke/stiffness"},
    {"gamman", "hooke/stiffness"},
    {"gammat", "hooke/stiffness"},
    {"kn", "hertz/stiffness"},
    {"gamman", "hertz/stiffness"},
    {"coefficientMaxElasticStiffness", "hooke/hysteresis"},
    {"coefficientAdhesionStiffness", "hooke/hysteresis"},
    {"LoadingStiffness", "luding"},
    {"pullOffForce", "luding"},
    {"UnloadingStiffness", "edinburgh"},
    {"pullOffForce", "edinburgh"},
};

/// How the values of the types 1-1, 1-2 and 2-2 stand to the usual one.
double of_types(int a, int b) {
  return a != b ? 0.9 : a == 1 ? 1 : 0.8;
}

std::string usual_value(const std::string& property) {
  for (const auto& [name, value] : values_per_pair())
    if (property == name)
      return value;
  return property == "coefficientRestitution" ? "0.7" : "0.6";
}

/// A box of one or two types with all that models read; `given` is what the pairs of types have of `property`.
void open_types(LiggghtsSession& session, int types, const Coefficient& c,
                const std::function<double(int, int)>& given) {
  session.script("atom_style granular\natom_modify map array\nboundary f f f\nnewton off\ncommunicate single vel yes\n"
                 "units si\nregion box block -0.05 0.05 -0.05 0.05 -0.05 0.05 units box\ncreate_box " +
                 std::to_string(types) + " box\nneighbor 0.001 bin\nneigh_modify delay 0\n");
  const auto each = [&](const std::string& value) { return value + (types > 1 ? " " + value : ""); };
  session.script("fix y all property/global youngsModulus peratomtype " + each("5e6") +
                 "\nfix n all property/global poissonsRatio peratomtype " + each("0.3") + "\n");
  int number = 0;
  const auto pairs = [&](const std::string& property, const std::string& value) {
    std::string line = "fix q" + std::to_string(number++) + " all property/global " + property + " peratomtypepair " +
                       std::to_string(types);
    for (int a = 1; a <= types; ++a)
      for (int b = 1; b <= types; ++b) {
        std::ostringstream text;
        text.precision(17);
        text << std::stod(value) * (property == c.property ? given(a, b) : 1);
        line += " " + text.str();
      }
    session.command(line);
  };
  pairs("coefficientRestitution", usual_value("coefficientRestitution"));
  pairs("coefficientFriction", usual_value("coefficientFriction"));
  for (const auto& [name, value] : values_per_pair())
    pairs(name, value);
  give_other_materials(session, types);
  session.script("pair_style gran/cluster model " + std::string(c.models) + " tangential history " + c.keywords +
                 "\npair_coeff * *\nfix integrate all nve/cluster\ntimestep 4e-6\n");
}

using State = std::array<double, 27>;

/// Two bodies of types a and b meet, and beside them a body of type a meets a plane of type b; where they are and how
/// they move then.
State meet(LiggghtsSession& session, const Coefficient& c, int a, int b) {
  session.script("fix side all wall/gran/cluster model " + std::string(c.models) +
                 " tangential history primitive type " + std::to_string(b) + " xplane -0.03 " + c.keywords + "\n");
  const auto cube = shape_of("cube", "8");
  const int types[3] = {a, b, a};
  for (int k = 0; k < 3; ++k) {
    Start start;
    const double side = k == 0 ? -1 : 1;
    start.position = Eigen::Vector3d(k == 2 ? -0.03 + 3.4e-3 : side * 3.4e-3, side * 5e-4, 0);
    start.velocity = Eigen::Vector3d(-side * 0.3, 0.1 * side, 0.05);
    start.omega = Eigen::Vector3d(30, -20 * side, 60 * side);
    start.orientation = Eigen::Quaterniond(0.98, 0.1, 0.1 * side, 0.05).normalized();
    add_body(session, cube, start);
    if (const int i = session.local(k + 1); i >= 0)
      session.atom().type[i] = types[k];
  }
  Start far; // LIGGGHTS wants a first type
  far.position = Eigen::Vector3d(0.04, 0.04, 0.04);
  add_sphere(session, far, 3e-3);
  session.command("run 1000");
  State state{};
  for (int k = 0; k < 3; ++k) {
    const int i = session.local(k + 1);
    double* next = state.data() + 9 * k;
    next = std::copy_n(session.atom().x[i], 3, next);
    next = std::copy_n(session.atom().v[i], 3, next);
    std::copy_n(session.atom().omega[i], 3, next);
  }
  return state;
}

/// The pair's part of a state, and that of the body at the plane.
std::vector<double> part(const State& state, bool wall) {
  return {state.begin() + (wall ? 18 : 0), state.end() - (wall ? 0 : 9)};
}

} // namespace

TEST(PairMaterials, EachCoefficientIsThatOfItsPairOfTypes) {
  for (const Coefficient& c : coefficients) {
    const auto alone = [&](double value) {
      LiggghtsSession session;
      open_types(session, 1, c, [value](int, int) { return value; });
      return meet(session, c, 1, 1);
    };
    const State one = alone(of_types(1, 1)), mixed = alone(of_types(1, 2)), other = alone(of_types(2, 2));
    const std::string what = std::string(c.property) + ", " + c.models + " " + c.keywords;
    for (const bool wall : {false, true}) {
      EXPECT_NE(part(one, wall), part(mixed, wall)) << what << ", wall " << wall << ": the coefficient must matter";
      EXPECT_NE(part(other, wall), part(mixed, wall)) << what << ", wall " << wall << ": the coefficient must matter";
    }
    for (const int a : {1, 2})
      for (const int b : {1, 2}) {
        LiggghtsSession session;
        open_types(session, 2, c, of_types);
        EXPECT_EQ(meet(session, c, a, b), a != b ? mixed : a == 1 ? one : other) << what << ", types " << a << " " << b;
      }
  }
}

namespace {

/// Pairs that meet far from each other: spheres, clusters, and one of either.
struct Meeting {
  bool cluster[2];
  Eigen::Vector3d at;
};
const Meeting meetings[] = {{{false, false}, {0, -0.03, 0}}, {{true, true}, {0, 0, 0}}, {{true, false}, {0, 0.03, 0}}};

void add_meeting(LiggghtsSession& session, const Meeting& m) {
  for (int k = 0; k < 2; ++k) {
    Start start;
    const double side = k == 0 ? -1 : 1;
    start.position = m.at + Eigen::Vector3d(side * 3.4e-3, side * 5e-4, 0);
    start.velocity = Eigen::Vector3d(-side * 0.3, 0.1 * side, 0.05);
    start.omega = Eigen::Vector3d(30, -20 * side, 60 * side);
    if (m.cluster[k])
      add_body(session, shape_of("cube", "8"), start);
    else
      add_sphere(session, start, 3.2e-3);
  }
}

std::vector<double> state_of(LiggghtsSession& session, int first) {
  std::vector<double> state;
  for (const int tag : {first, first + 1}) {
    const int i = session.local(tag);
    for (const double* row : {session.atom().x[i], session.atom().v[i], session.atom().omega[i]})
      state.insert(state.end(), row, row + 3);
  }
  return state;
}

void open_models(LiggghtsSession& session, const std::string& pair, const std::string& move = "nve/cluster") {
  open_box(session, {});
  give_materials(session);
  session.script("pair_style " + pair + "\npair_coeff * *\nfix integrate all " + move + "\ntimestep 2e-6\n");
}

} // namespace

// One scene of spheres and clusters: spheres have stock's digits, clusters those of a scene of their own.
TEST(MixedScenes, SpheresMeetAsStocksAndClustersAsAmongThemselves) {
  std::vector<std::string> all = {"model hertz tangential history rolling_friction shape form epsd"};
  for (const std::string& normal : known("model"))
    if (normal != "off")
      all.push_back("model " + normal + " tangential history");
  for (const std::string& rolling : known("rolling_friction"))
    if (rolling != "off" && rolling != "eccentric" && rolling != "shape" && rolling != "luding")
      all.push_back("model hertz tangential history rolling_friction " + rolling);
  for (const std::string& cohesion : known("cohesion"))
    if (cohesion != "off")
      all.push_back("model hertz tangential history cohesion " + cohesion);
  for (const std::string& models : all) {
    LiggghtsSession together;
    open_models(together, "gran/cluster " + models + " contacts parallel");
    for (const Meeting& m : meetings)
      add_meeting(together, m);
    together.command("run 1500");
    for (int n = 0; n < 3; ++n) {
      LiggghtsSession alone;
      if (n == 0)
        open_models(alone, "gran " + models, "nve/sphere");
      else
        open_models(alone, "gran/cluster " + models + " contacts parallel");
      add_meeting(alone, meetings[n]);
      alone.command("run 1500");
      const std::vector<double> expected = state_of(alone, 1), found = state_of(together, 1 + 2 * n);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const double scale = k % 9 < 3 ? 3e-3 : k % 9 < 6 ? 0.3 : 100;
        EXPECT_NEAR(found[k], expected[k], n == 0 ? 1e-9 * scale : 0) << models << ", meeting " << n << ", value " << k;
      }
    }
  }
}

// Spheres land on one wall model and clusters on another: each as if it were alone with its own.
TEST(MixedScenes, GroupsHaveWallModelsOfTheirOwn) {
  const std::string of_spheres = "model hooke tangential history rolling_friction epsd2",
                    of_clusters = "model hertz tangential history rolling_friction epsd cohesion sjkr";
  const auto wall = [](const char* id, const char* group, const std::string& models) {
    return std::string("fix ") + id + " " + group + " wall/gran/cluster " + models + " primitive type 1 xplane 0.0\n";
  };
  const auto add = [](LiggghtsSession& session, bool cluster) {
    Start start;
    start.position = Eigen::Vector3d(4e-3, cluster ? 0.02 : 0, 0);
    start.velocity = Eigen::Vector3d(-0.3, 0.1, 0.05);
    start.omega = Eigen::Vector3d(30, -20, 60);
    if (cluster)
      add_body(session, shape_of("cube", "8"), start);
    else
      add_sphere(session, start, 3.2e-3);
  };
  const auto state = [](LiggghtsSession& session, int tag) {
    const int i = session.local(tag);
    std::vector<double> values;
    for (const double* row : {session.atom().x[i], session.atom().v[i], session.atom().omega[i]})
      values.insert(values.end(), row, row + 3);
    return values;
  };
  LiggghtsSession together;
  open_models(together, "gran/cluster model hertz tangential history");
  add(together, false);
  add(together, true);
  together.script("group spheres id 1\ngroup clusters id 2\n" + wall("s", "spheres", of_spheres) +
                  wall("c", "clusters", of_clusters) + "run 3000\n");
  for (const bool cluster : {false, true}) {
    LiggghtsSession alone, otherwise;
    for (LiggghtsSession* session : {&alone, &otherwise}) {
      open_models(*session, "gran/cluster model hertz tangential history");
      add(*session, cluster);
    }
    alone.script(wall("w", "all", cluster ? of_clusters : of_spheres) + "run 3000\n");
    otherwise.script(wall("w", "all", cluster ? of_spheres : of_clusters) + "run 3000\n");
    EXPECT_EQ(state(together, cluster ? 2 : 1), state(alone, 1)) << cluster;
    EXPECT_NE(state(together, cluster ? 2 : 1), state(otherwise, 1)) << "the models must differ";
  }
}
