// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes from STL files of every kind, as users hand them over: what is not one body is named, what is repaired is
// said.
#include "reported/shape_rows.h"
#include "shape/stl_solids.h"

#include <array>
#include <cmath>
#include <cstring>

namespace {
using namespace eccentra::shape;
using namespace eccentra::test;
using Eigen::Vector3d;
using Facets = std::vector<Facet>;

constexpr double kFloatDigits = 1e-6; // of STL

/// Inserts one body of the template and prints "mass <number>".
const char* const kPrintMass = R"(fix d all particledistribution/discrete 32452843 1 r 1.0
fix move all nve/cluster
region a block -1e-6 1e-6 -1e-6 1e-6 -1e-6 1e-6 volume_limit 1e-30 units box
fix pa all insert/pack seed 49979687 distributiontemplate d insert_every once overlapcheck no all_in no vel constant 0 0 0 region a particles_in_region 1
run 1
compute m all property/atom mass
compute s all reduce sum c_m
variable mass equal c_s
thermo_style custom step c_s
run 0
print "mass ${mass}"
)";

double mass_of(const ProgramResult& result) {
  const std::size_t at = result.output.rfind("\nmass ");
  EXPECT_NE(at, std::string::npos) << result.output;
  return at == std::string::npos ? 0 : std::stod(result.output.substr(at + 6));
}

Facets cube(const Vector3d& corner, double edge = 1) {
  return box(Vector3d::Constant(edge / 2), corner + Vector3d::Constant(edge / 2));
}

Facets inside_out(Facets facets) {
  for (Facet& f : facets)
    std::swap(f[0], f[1]);
  return facets;
}

Facets together(std::initializer_list<Facets> parts) {
  Facets all;
  for (const Facets& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

const Facets kCube = cube(Vector3d::Zero());

/// The cube beside kCube whose facets on the wall between both are those of kCube.
Facets mirrored_cube() {
  Facets facets = inside_out(kCube);
  for (Facet& f : facets)
    for (Vector3d& v : f)
      v.x() = 2 - v.x();
  return facets;
}

const Facets kFlake = box(Vector3d(0.5, 0.5, 0.025), Vector3d(0.5, 0.5, 0.025));

/// A flake whose top has a vertex beside the middle of an edge: outside of it the facets fold over each other.
Facets flake_with_vertex_at(double x) {
  const double t = 0.05;
  const Vector3d low[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Vector3d high[4];
  for (int k = 0; k < 4; ++k)
    high[k] = low[k] + Vector3d(0, 0, t);
  Facets facets = {{low[0], low[3], low[2]}, {low[0], low[2], low[1]}};
  for (int k = 0; k < 4; ++k) {
    const int n = (k + 1) % 4;
    facets.push_back({low[k], low[n], high[n]});
    facets.push_back({low[k], high[n], high[k]});
  }
  const Vector3d c(x, 0.5, t);
  for (const Facet& f :
       Facets{{high[0], high[1], c}, {high[0], c, high[2]}, {high[0], high[2], high[3]}, {high[1], high[2], c}})
    facets.push_back(f);
  return facets;
}

const std::vector<std::string> kTwenty = {"spheres", "20", "resolution", "16", "scale", "1"};

Made made_of(const Facets& facets, const std::vector<std::string>& more = kTwenty) {
  write_stl("solid.stl", facets);
  std::vector<std::string> arguments = {"stl", "solid.stl"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return make(arguments);
}

TEST(Reported, stl_two_bodies) {
  write_stl("two.stl", together({cube(Vector3d::Zero()), cube(Vector3d(3, 0, 0))}));
  const ProgramResult result = dem("stl two.stl spheres 10 scale 1e-3 mass solid diameter 1.5e-3");
  EXPECT_NE(result.status, 0);
  expect_parts(result.output, {"two.stl", "2 pieces", "one file per solid"});
  const ProgramResult ranks =
      shell("mpirun --oversubscribe -np 2 " + program("eccentra-dem") + " -in shape.in; echo status $?");
  EXPECT_EQ(ranks.output.find("status 0"), std::string::npos) << ranks.output;
}

TEST(Reported, stl_own_size) {
  write_stl("ok.stl", box(Vector3d(1, 0.5, 0.5), Vector3d(1, 0.5, 0.5)));
  for (const char* mass : {"solid", "union"}) {
    const ProgramResult result = dem(std::string("stl ok.stl spheres 10 scale 1e-3 mass ") + mass, kPrintMass);
    ASSERT_EQ(result.status, 0) << result.output;
    const double solid = 2500 * 2e-9, part = mass_of(result) / solid;
    if (std::strcmp(mass, "solid") == 0)
      EXPECT_NEAR(part, 1, kFloatDigits);
    else
      EXPECT_TRUE(part > 0.5 && part < 1) << part;
    expect_parts(result.output, {"10 spheres hold", "% of the volume of the solid"});
  }
  const Made own = make({"stl", "ok.stl", "spheres", "10", "scale", "1e-3"});
  ASSERT_EQ(own.shape.size(), 1u) << own.sentence;
  double low = 1, high = -1;
  for (const Sphere& s : own.shape[0].spheres()) {
    low = std::min(low, s.centre.x() - s.radius);
    high = std::max(high, s.centre.x() + s.radius);
  }
  EXPECT_NEAR(high - low, 2e-3, 1e-4); // touches both ends but for the grid
}

TEST(Reported, clump_of_stl_mass_solid) {
  // A wedge: centre and principal axes of the solid are not those of its spheres.
  const Vector3d p[] = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 1}, {0, 1, 1}};
  const Facets wedge = {{p[0], p[2], p[1]}, {p[3], p[4], p[5]}, {p[0], p[1], p[4]}, {p[0], p[4], p[3]},
                        {p[1], p[2], p[5]}, {p[1], p[5], p[4]}, {p[2], p[0], p[3]}, {p[2], p[3], p[5]}};
  write_stl("wedge.stl", wedge);
  const std::string arguments = " stl wedge.stl --spheres 12 --scale 1e-3 --mass solid ";
  ASSERT_EQ(shell(program("clusterShape") + arguments + "-o wedge.clump").status, 0);
  const Made file = make({"file", "wedge.clump"}),
             solid = make({"stl", "wedge.stl", "spheres", "12", "scale", "1e-3", "mass", "solid"});
  ASSERT_EQ(file.shape.size(), 1u) << file.sentence;
  const ClusterShape &a = file.shape[0], &b = solid.shape.at(0);
  EXPECT_NEAR(a.volume(), 1e-9, kFloatDigits * 1e-9);
  EXPECT_NEAR(a.volume(), b.volume(), 1e-12 * b.volume());
  EXPECT_NEAR(a.sphericity(), b.sphericity(), 1e-12);
  EXPECT_LT((a.inertia_per_mass() - b.inertia_per_mass()).norm(), 1e-9 * b.inertia_per_mass().norm());
  for (std::size_t k = 0; k < b.spheres().size(); ++k)
    EXPECT_LT((a.spheres()[k].centre - b.spheres()[k].centre).norm(), 1e-9 * b.bounding_radius());
  const ProgramResult run = dem("file wedge.clump", kPrintMass);
  EXPECT_NEAR(mass_of(run), 2500 * 1e-9, 2 * kFloatDigits * 2500 * 1e-9);
  // The same at another size, and through a second file.
  EXPECT_NEAR(make({"file", "wedge.clump"}, 2e-3).shape.at(0).equivalent_radius(), 1e-3, 1e-15);
  EXPECT_NEAR(make({"file", "wedge.clump", "scale", "2"}).shape.at(0).volume(), 8 * b.volume(), 1e-11 * b.volume());
  ASSERT_EQ(shell(program("clusterShape") + " wedge.clump -o again.clump").status, 0);
  EXPECT_NEAR(make({"file", "again.clump"}).shape.at(0).volume(), b.volume(), 1e-12 * b.volume());
  // A list that was edited no longer has these properties.
  ASSERT_EQ(shell("sed '$d' wedge.clump > edited.clump").status, 0);
  expect_parts(make({"file", "edited.clump"}).sentence, {"edited.clump", "union volume", "#:"});
  ASSERT_EQ(shell("sed '/^#: inertia/d' wedge.clump > less.clump; sed 's/^#: volume .*/#: volume nan/' wedge.clump > "
                  "nan.clump; sed 's/^#: centre/#: center/' wedge.clump > word.clump")
                .status,
            0);
  expect_parts(make({"file", "less.clump"}).sentence, {"inertia", "expected 6"});
  expect_parts(make({"file", "nan.clump"}).sentence, {"'nan'", "finite"});
  expect_parts(make({"file", "word.clump"}).sentence, {"center", "centre"});
}

TEST(Reported, stl_flake_with_overlapping_sliver) {
  const Facets tetrahedron = {{Vector3d(.2, .2, .02), Vector3d(.8, .2, .02), Vector3d(.5, .3, .2)},
                              {Vector3d(.2, .2, .02), Vector3d(.5, .3, .2), Vector3d(.5, .5, .02)},
                              {Vector3d(.8, .2, .02), Vector3d(.5, .5, .02), Vector3d(.5, .3, .2)},
                              {Vector3d(.2, .2, .02), Vector3d(.5, .5, .02), Vector3d(.8, .2, .02)}};
  const Facet sliver{Vector3d(.2, .2, .05), Vector3d(.9, .3, .05), Vector3d(.9, .31, .05)};
  struct Case {
    Facets facets;
    std::vector<std::string> parts;
  };
  for (const Case& c : {Case{flake_with_vertex_at(1.1), {"folds over itself", "(1 "}},
                        Case{flake_with_vertex_at(1.001), {"folds over itself"}},
                        Case{together({kFlake, tetrahedron}), {"2 pieces", "cross"}},
                        Case{together({kFlake, {sliver}}), {"not a closed surface", "3 edges"}}})
    expect_parts(made_of(c.facets, {"spheres", "100", "resolution", "60", "missing", "0.95"}).sentence, c.parts);
  // The same flake with the vertex on or within its outline is a solid.
  for (const double x : {1.0, 0.9}) {
    const Made flake =
        made_of(flake_with_vertex_at(x), {"spheres", "50", "resolution", "60", "missing", "0.98", "mass", "solid"});
    ASSERT_EQ(flake.shape.size(), 1u) << flake.sentence;
    EXPECT_NEAR(flake.shape[0].volume(), 0.05, 1e-6);
    for (const Sphere& s : flake.shape[0].spheres())
      EXPECT_LE(s.radius, 0.025 * (1 + kFloatDigits)) << "thicker than the flake";
  }
}

TEST(Reported, stl_of_several_solids) {
  struct Case {
    std::string name;
    Facets facets;
    std::vector<std::string> parts;
  };
  const Facets inner = cube(Vector3d::Constant(0.3), 0.4), core = cube(Vector3d::Constant(0.4), 0.2);
  const std::vector<Case> cases = {
      {"apart", together({kCube, cube(Vector3d(3, 0, 0))}), {"2 pieces", "not joined"}},
      {"three", together({kCube, cube(Vector3d(3, 0, 0)), cube(Vector3d(0, 3, 0))}), {"3 pieces"}},
      {"one of them inside out", together({kCube, inside_out(cube(Vector3d(3, 0, 0)))}), {"2 pieces"}},
      {"vertex", together({kCube, cube(Vector3d(1, 1, 1))}), {"2 pieces", "in a vertex only", "(1 1 1)"}},
      {"edge", together({kCube, cube(Vector3d(1, 1, 0))}), {"2 pieces", "in an edge only"}},
      {"overlap by 1/8", together({kCube, cube(Vector3d(.5, .5, .5))}), {"2 pieces", "cross"}},
      {"overlap along faces", together({kCube, cube(Vector3d(.5, 0, 0))}), {"2 pieces", "cross"}},
      {"touching faces", together({kCube, cube(Vector3d(1, .3, .2))}), {"2 pieces", "touch"}},
      {"one face, two triangulations", together({kCube, cube(Vector3d(1, 0, 0))}), {"several solids", "touch"}},
      {"plus sign",
       together({box(Vector3d(1, .2, .2), Vector3d::Zero()), box(Vector3d(.2, 1, .2), Vector3d::Zero())}),
       {"2 pieces", "cross"}},
      {"dust", together({kCube, cube(Vector3d(2, 0, 0), 1e-2)}), {"2 pieces"}},
      {"nested, both outward", together({kCube, inner}), {"2 solids", "one inside the other"}},
      {"nested, both inward", together({inside_out(kCube), inside_out(inner)}), {"2 solids", "one inside the other"}},
      {"loose in a cavity", together({kCube, inside_out(inner), core}), {"2 solids", "loose in the cavity"}},
  };
  for (const Case& c : cases) {
    const Made made = made_of(c.facets);
    expect_parts(made.sentence, c.parts);
    EXPECT_NE(made.sentence.find("expected one solid"), std::string::npos) << c.name << ": " << made.sentence;
  }
  // A shell inside that faces inward is a cavity, in a file that is inside out, too; the body is hollow.
  for (const Facets& hollow : {together({kCube, inside_out(inner)}), together({inside_out(kCube), inner})}) {
    const Made made = made_of(hollow, {"spheres", "60", "scale", "1", "mass", "solid", "missing", "0.7"});
    ASSERT_EQ(made.shape.size(), 1u) << made.sentence;
    expect_parts(made.notes(), {"hollow body", "6.4 %"});
    EXPECT_NEAR(made.shape[0].volume(), 1 - 0.064, 1e-6);
    EXPECT_NEAR(made.shape[0].inertia_per_mass().x(), (1 - 0.064 * .16) / 6 / (1 - 0.064), 1e-6);
    for (const Sphere& s : made.shape[0].spheres())
      EXPECT_GE(s.centre.cwiseAbs().maxCoeff(), 0.2) << "a sphere lies in the cavity";
  }
  // Two cubes that share a wall are one body, and the wall goes.
  const Made bar = made_of(together({kCube, mirrored_cube()}));
  ASSERT_EQ(bar.shape.size(), 1u) << bar.sentence;
  expect_parts(bar.notes(), {"4 facets", "back to back"});
}

void write_binary(const std::string& name, const Facets& facets, std::uint32_t count) {
  std::ofstream out(name, std::ios::binary);
  out << std::string(80, ' ');
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  for (const Facet& f : facets) {
    std::array<float, 12> numbers{};
    for (int k = 0; k < 9; ++k)
      numbers[3 + k] = static_cast<float>(f[k / 3][k % 3]);
    out.write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers).write("\0", 2);
  }
}

TEST(Reported, stl_that_is_not_closed_or_not_readable) {
  Facets open = kCube, stray = kCube, membrane = together({kCube, mirrored_cube()});
  open.pop_back();
  stray.push_back({Vector3d(.2, .2, 2), Vector3d(.5, .5, 2), Vector3d(.2, .6, 2)});
  // The wall that both cubes share, once: facets 2 and 3 of the first are its side x = 1.
  membrane.erase(membrane.begin() + 2, membrane.begin() + 4);
  const Vector3d p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  struct Case {
    Facets facets;
    std::vector<std::string> parts;
  };
  for (const Case& c :
       {Case{open, {"not a closed surface", "3 edges", "close the holes"}},
        Case{stray, {"not a closed surface", "3 edges", "(0.35 0.35 2)"}}, Case{membrane, {"odd number of facets"}},
        Case{{{p[0], p[1], p[2]}, {p[0], p[2], p[1]}}, {"no volume"}}, Case{{{p[0], p[0], p[0]}}, {"no volume"}},
        Case{box(Vector3d(1, 1, 1), Vector3d(1e5, 0, 0)), {"away from the origin"}}})
    expect_parts(made_of(c.facets).sentence, c.parts);

  write_stl("good.stl", kCube);
  const std::string good = contents("good.stl");
  const auto replaced = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    return text.replace(text.find(what), what.size(), by);
  };
  const std::string vertex =
      good.substr(good.find("vertex "), good.find('\n', good.find("vertex ")) - good.find("vertex "));
  write_binary("cut_off.stl", kCube, 13);
  write_binary("too_long.stl", kCube, 11);
  Facets not_a_number = kCube;
  not_a_number[0][0][0] = std::nan("");
  write_binary("nan.stl", not_a_number, 12);
  std::ofstream("text_nan.stl") << replaced(vertex, "vertex nan 0 0");
  std::ofstream("text_inf.stl") << replaced(vertex, "vertex 1e60 0 0");
  std::ofstream("text_word.stl") << replaced(vertex, "vertex one 0 0");
  std::ofstream("text_cut.stl") << good.substr(0, good.size() / 2);
  std::ofstream("words.stl") << "these are words\n";
  std::ofstream("empty.stl");
  std::ofstream("quad.stl")
      << "solid q\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex "
         "0 1 0\nendloop\nendfacet\nendsolid q\n";
  fresh_folder("folder.stl");
  const std::vector<std::pair<std::string, std::string>> files = {{"cut_off.stl", "13 facets, 12 are there"},
                                                                  {"too_long.stl", "11 facets, 12 are there"},
                                                                  {"nan.stl", "not a finite number"},
                                                                  {"text_nan.stl", "not a finite number"},
                                                                  {"text_inf.stl", "not a finite number"},
                                                                  {"text_word.stl", "can be read"},
                                                                  {"text_cut.stl", "cut off"},
                                                                  {"words.stl", "expected ASCII STL"},
                                                                  {"empty.stl", "empty"},
                                                                  {"quad.stl", "can be read"},
                                                                  {"folder.stl", "is a folder"},
                                                                  {"nowhere.stl", "cannot read"}};
  for (const auto& [file, part] : files)
    expect_parts(make({"stl", file, "spheres", "5"}).sentence, {file, part});
}

TEST(Reported, stl_that_is_repaired) {
  Facets mixed = kCube, twice = kCube, degenerate = kCube, sheet = kCube;
  for (std::size_t k = 0; k < mixed.size(); k += 3)
    std::swap(mixed[k][0], mixed[k][1]);
  twice.push_back(kCube[4]);
  degenerate.push_back({kCube[0][0], kCube[0][0], kCube[0][1]});
  sheet.push_back({Vector3d(.2, .2, 2), Vector3d(.5, .5, 2), Vector3d(.2, .6, 2)});
  sheet.push_back({Vector3d(.2, .2, 2), Vector3d(.2, .6, 2), Vector3d(.5, .5, 2)});
  const auto shaken = [](double by) {
    Facets facets = kCube;
    int step = 0;
    for (Facet& f : facets)
      for (Vector3d& v : f)
        for (int k = 0; k < 3; ++k)
          v[k] += by * std::sin(++step);
    return facets;
  };
  struct Case {
    Facets facets;
    std::vector<std::string> parts;
    double error;
  };
  for (const Case& c : {Case{inside_out(kCube), {"inside out"}, kFloatDigits},
                        Case{mixed, {"4 of its 12 facets", "turned"}, kFloatDigits},
                        Case{together({kCube, kCube}), {"12 facets are there twice"}, kFloatDigits},
                        Case{together({kCube, inside_out(kCube)}), {"12 facets are there twice"}, kFloatDigits},
                        Case{twice, {"1 facet is there twice"}, kFloatDigits},
                        Case{degenerate, {"1 facet is degenerate"}, kFloatDigits},
                        Case{sheet, {"2 facets are back to back"}, kFloatDigits}, Case{shaken(1e-7), {}, 1e-5},
                        Case{shaken(5e-6), {"corners", "joined"}, 1e-4}}) {
    const Made made = made_of(c.facets, {"spheres", "20", "resolution", "16", "scale", "1", "mass", "solid"});
    ASSERT_EQ(made.shape.size(), 1u) << made.sentence;
    expect_parts(made.notes(), c.parts);
    EXPECT_NEAR(made.shape[0].volume(), 1, c.error) << made.notes();
  }
  EXPECT_NE(made_of(shaken(1e-2)).sentence.find("not a closed surface"), std::string::npos);
  write_binary("binary.stl", kCube, 12);
  EXPECT_EQ(make({"stl", "binary.stl", "spheres", "20", "scale", "1"}).shape.size(), 1u);
}

TEST(Reported, stl_missing_volume) {
  write_stl("flake.stl", kFlake);
  const Made few = make({"stl", "flake.stl", "spheres", "20", "resolution", "40"});
  expect_parts(few.sentence, {"flake.stl", "20 spheres lack", "expected at most 50.0 %", "more spheres"});
  const Made allowed = make({"stl", "flake.stl", "spheres", "20", "resolution", "40", "missing", "0.99"});
  ASSERT_EQ(allowed.shape.size(), 1u) << allowed.sentence;
  expect_parts(allowed.notes(), {"% are missing", "give more spheres"});
  write_stl("cube.stl", kCube);
  const ProgramResult one = dem("stl cube.stl spheres 1 diameter 5e-3"); // pi/6 of the cube
  EXPECT_EQ(one.status, 0) << one.output;
  expect_parts(one.output, {"WARNING: fix r particletemplate/cluster", "1 sphere holds 52.4 %", "47.6 % are missing"});
}

TEST(Reported, stl_cover_balanced) {
  // 150 spheres for a flake whose sides are ten times its thickness: inside, they lack volume and are nowhere thicker;
  // balanced, the volume is right and the thickness errs either way.
  write_stl("flake.stl", box(Vector3d(.5, .5, .05), Vector3d::Zero()));
  const auto cover = [](const std::string& word) {
    return make(
        {"stl", "flake.stl", "spheres", "150", "scale", "1", "resolution", "60", "cover", word, "missing", "0.9"});
  };
  const Made inside = cover("inside"), balanced = cover("balanced");
  ASSERT_EQ(inside.shape.size(), 1u) << inside.sentence;
  ASSERT_EQ(balanced.shape.size(), 1u) << balanced.sentence;
  EXPECT_LT(inside.shape[0].volume(), 0.08);
  EXPECT_NEAR(balanced.shape[0].volume(), 0.1, 1e-7);
  expect_parts(balanced.notes(), {"150 spheres have the volume of the solid", "stand out"});
  // Thickness along lines through the flake.
  const auto thickness = [](const ClusterShape& shape, double x, double y) {
    double top = 0;
    for (const Sphere& s : shape.spheres()) {
      const double rest = s.radius * s.radius - std::pow(x - s.centre.x(), 2) - std::pow(y - s.centre.y(), 2);
      if (rest > 0)
        top = std::max(top, s.centre.z() + std::sqrt(rest));
    }
    return 2 * top;
  };
  double thin = 1, thick = 0, sum_inside = 0, sum_balanced = 0, thick_inside = 0;
  int lines = 0;
  for (double x = -.35; x <= .35; x += .01)
    for (double y = -.35; y <= .35; y += .01, ++lines) {
      const double t = thickness(balanced.shape[0], x, y), in = thickness(inside.shape[0], x, y);
      thin = std::min(thin, t);
      thick = std::max(thick, t);
      thick_inside = std::max(thick_inside, in);
      sum_balanced += t;
      sum_inside += in;
    }
  EXPECT_LE(thick_inside, 0.1 + 1e-6);
  EXPECT_LT(thin, 0.1);
  EXPECT_GT(thick, 0.1);
  EXPECT_LT(thick, 0.16) << "much thicker than the flake";
  EXPECT_LT(std::abs(sum_balanced / lines - 0.1), std::abs(sum_inside / lines - 0.1));
  EXPECT_NE(cover("outside").sentence.find("inside or balanced"), std::string::npos) << cover("outside").sentence;
}

TEST(Reported, stl_in_millimetres) {
  write_stl("grain.stl", cube(Vector3d::Zero(), 6));
  std::ofstream("grain.clump") << "0 0 0 3\n3 0 0 3\n";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"stl", "grain.stl", "spheres", "20"}, {"file", "grain.clump"}}) {
    std::vector<std::string> scaled = arguments;
    scaled.insert(scaled.end(), {"scale", "1e-3"});
    expect_parts(make(arguments).notes(), {"lengths are taken as metres", "scale 1e-3"});
    EXPECT_EQ(make(scaled).notes().find("metres"), std::string::npos) << make(scaled).notes();
    EXPECT_EQ(make(arguments, 6e-3).notes().find("metres"), std::string::npos) << make(arguments, 6e-3).notes();
  }
}

} // namespace
