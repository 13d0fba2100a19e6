// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of spheres from public generators, and the arguments and outputs of the tools for shapes.
#include "reported/shape_rows.h"
#include "shape/stl_solids.h"

namespace {
using namespace eccentra::shape;
using namespace eccentra::test;
using Eigen::Vector3d;

Made made_of_text(const std::string& text) {
  std::ofstream("list.clump", std::ios::binary) << text;
  return make({"file", "list.clump"}, 1);
}

TEST(Reported, clump_of_public_generators) {
  const Made plain = made_of_text("0 0 0 0.5\n0.25 0 0 1\n");
  ASSERT_EQ(plain.shape.size(), 1u);
  const std::vector<std::string> same = {
      "\xEF\xBB\xBF"
      "0 0 0 0.5\r\n0.25 0 0 1\r\n",                                                 // an editor of Windows
      "0 0 0 0.5\r0.25 0 0 1",                                                       // an old one of Apple
      "\t0\t0\t0\t0.5  \n\n0.25 0 0 1\t\n",                                          // blanks, no newline of its own
      "0.000e+00,0.000e+00,0.000e+00,5.000e-01\n2.5e-01,0e+00,0e+00,1e+00\n",        // CLUMP, Python
      "  0.000000, -0.000000,  0.000000,  0.500000\n  0.250000,  0.0,  0.0,  1.0\n", // CLUMP, MATLAB
      "0,0,0,0.5,\n0.25,0,0,1,\n",                                                   // a comma too many
      "0,0;0,0;0,0;0,5\n0,25;0;0;1\n",                                               // a spreadsheet in German
      "x,y,z,r\n0,0,0,0.5\n0.25,0,0,1\n",                                            // DEM-Engine
      "\"Points:0\",\"Points:1\",\"Points:2\",\"Radius\"\n0,0,0,0.5\n0.25,0,0,1\n",  // ParaView
      "r x y z\n0.5 0 0 0\n1 0.25 0 0\n",                                            // PFC's order
      "id x y z diameter\n1 0 0 0 1\n2 0.25 0 0 2\n",                                //
      "X (m) Y (m) Z (m) R (m)\n0 0 0 0.5\n0.25 0 0 1\n",                            //
      "#format x_y_z_r\n0\t0\t0\t0.5\n0.25\t0\t0\t1\n",                              // Yade, textExt
      "#format x_y_z_r_matId\n#made by hand\n0 0 0 0.5 0\n0.25 0 0 1 0\n",           //
      "#format id_x_y_z_r_matId\n7 0 0 0 0.5 0\n8 0.25 0 0 1 0\n",                   //
      "# x y z r clumpId\n0 0 0 0.5 3\n0.25 0 0 1 3\n",                              // Yade, textClumps
      "# x y z d\n0 0 0 1\n0.25 0 0 2\n",                                            //
      "2\n0 0 0 0.5\n0.25 0 0 1\n",                                                  // a count
      "2\n\n0 0 0 0.5\n0.25 0 0 1\n",                                                //
      "2\nx y z radius\n0 0 0 0.5\n0.25 0 0 1\n",                                    //
      "# stock\n0 0 0 0.5 # the first\n0.25 0 &\n 0 1\n",                            // LIGGGHTS, continued
      "+0 0 0 5.0D-1\n2.5d-1 0 0 1\n",                                               // Fortran
  };
  for (const std::string& text : same) {
    const Made made = made_of_text(text);
    ASSERT_EQ(made.shape.size(), 1u) << text << made.sentence;
    EXPECT_EQ(made.notes(), "");
    ASSERT_EQ(made.shape[0].spheres().size(), 2u) << text;
    for (int k = 0; k < 2; ++k) {
      EXPECT_LT((made.shape[0].spheres()[k].centre - plain.shape[0].spheres()[k].centre).norm(), 1e-15) << text;
      EXPECT_NEAR(made.shape[0].spheres()[k].radius, plain.shape[0].spheres()[k].radius, 1e-15) << text;
    }
  }
}

TEST(Reported, clump_that_is_no_list_of_spheres) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> bad = {
      {"0 0 0 1e308\n", {"line 1", "1e+308", "metres"}},
      {"0 0 0 1e200\n", {"1e+200", "metres"}},
      {"0 0 0 1e100\n", {"1e+100", "metres"}},
      {"1e13 0 0 1\n", {"1e+13"}},
      {"0 0 0 1e-30\n", {"1e-30", "below"}},
      {"0 0 0 1e999\n", {"'1e999'", "finite"}},
      {"0 0 nan 1\n", {"'nan'", "finite"}},
      {"0 0 0 -1\n", {"radius -1"}},
      {"0 0 0\n", {"3 numbers instead of 4"}},
      {"0 0 0 1 2\n", {"5 numbers instead of 4", "x y z r type"}},
      {"0,5 0,5 0,5 1\n", {"numbers instead of 4"}},
      {"0,,0,1\n", {"a field is empty"}},
      {"3\n0 0 0 1\n", {"count 3", "1"}},
      {"x,y,z,mass\n0,0,0,1\n", {"'mass'", "not known"}},
      {"x,y,z\n0,0,0\n", {"header"}},
      {"x y z r d\n0 0 0 1 2\n", {"header"}},
      {"x[mm] y[mm] z[mm] r[mm]\n0 0 0 1\n", {"'mm'", "scale 1e-3"}},
      {"x y z r clumpId\n0 0 0 1 1\n1 0 0 1 2\n", {"line 3", "another clump"}},
      {"x y z r id\n0 0 0 1\n", {"4 numbers instead of 5"}},
      {std::string("0\0 0 0 1\n", 9), {"not plain text"}},
      {"\xFF\xFE"
       "0",
       {"not plain text"}},
      {"1 50\n0 0 0 1 0\n", {"2 numbers instead of 4"}}, // a tree of spheres
      {"Name stone\nBegin centers_and_radii\n0 0 0 1\n", {"line 1", "'Name'"}},
      {"", {"holds no spheres"}},
      {"# nothing\n", {"holds no spheres"}},
      {"0 0 0 1\n5 0 0 1\n", {"sphere 2", "touch"}},
      {"#: volume 1\n0 0 0 1\n", {"#:union_volume", "expected 1"}},
  };
  for (const auto& [text, parts] : bad) {
    const Made made = made_of_text(text);
    EXPECT_TRUE(made.shape.empty()) << text;
    expect_parts(made.sentence, parts);
  }
  fresh_folder("folder.clump");
  expect_parts(make({"file", "folder.clump"}, 1).sentence, {"is a folder"});
  for (const char* scale : {"1e300", "1e-300"}) { // finite spheres at a size that is none
    std::ofstream("one.clump") << "0 0 0 1\n";
    EXPECT_TRUE(make({"file", "one.clump", "scale", scale}).shape.empty()) << scale;
  }
}

TEST(Reported, clump_spheres_that_coincide) {
  const auto notes = [](const std::string& text, std::size_t spheres) {
    const Made made = made_of_text(text);
    EXPECT_EQ(made.shape.at(0).spheres().size(), spheres) << text;
    return made.notes();
  };
  const std::string two = "0 0 0 1\n1 0 0 1\n";
  EXPECT_EQ(notes(two, 2), "");
  expect_parts(notes(two + "1 0 0 1\n", 2), {"1 of 3 spheres repeat another", "2 and 3"});
  expect_parts(notes(two + "1 -0 1e-9 1\n0 0 0 1.0005\n", 2), {"2 of 4 spheres"});
  expect_parts(notes(two + "1.02 0 0 1\n", 3), {"1 pair(s)", "2 and 3", "nearly coincide"});
  EXPECT_EQ(notes(two + "1.1 0 0 1\n", 3), "");
  std::ofstream("repeat.clump") << "0 0 0 1e-3\n0 0 0 1e-3\n1e-3 0 0 1e-3\n";
  const ProgramResult run = dem("file repeat.clump");
  EXPECT_EQ(run.status, 0) << run.output;
  expect_parts(run.output, {"WARNING: fix r particletemplate/cluster", "1 of 3 spheres repeat another"});
}

TEST(Reported, clump_read_by_stock) {
  // Stock's own reader takes a file with chosen mass properties: "#:" begins a comment.
  write_stl("box.stl", box(Vector3d(1, .5, .5), Vector3d::Zero()));
  ASSERT_EQ(shell(program("clusterShape") + " stl box.stl --spheres 5 --scale 1e-3 --mass solid -o box.clump").status,
            0);
  ASSERT_NE(contents("box.clump").find("\n#: inertia "), std::string::npos);
  std::ofstream("stock.in") << R"(atom_style granular
boundary f f f
newton off
units si
region box block -0.05 0.05 -0.05 0.05 -0.05 0.05 units box
create_box 1 box
fix s all particletemplate/multisphere 15485863 atom_type 1 density constant 2500 nspheres 5 ntry 100000 &
  spheres file box.clump scale 1.0 type 1
print "stock took it"
)";
  const ProgramResult run = run_program({"liggghts", "-in", "stock.in"});
  EXPECT_EQ(run.status, 0) << run.output;
  expect_parts(run.output, {"\nstock took it"});
}

TEST(Reported, empty_words_of_shape_tools) {
  for (const char* arguments : {"cube 8 -o ''", "cube 8 --output ''", "cube 8 --vtk ''", "cube 8 --png ''",
                                "advise cube --error 0.05 --data ''", "stl x.stl --spheres ''", "''", "file ''"}) {
    const ProgramResult run = shell(program("clusterShape") + " " + arguments);
    EXPECT_GT(run.status, 0) << arguments;
    EXPECT_NE(run.output, "") << arguments;
  }
  const auto home = fresh_folder("nowhere");
  const ProgramResult keys = run_program({program("eccentra-keys"), ""}, {home, {}, 60});
  EXPECT_GT(keys.status, 0);
  expect_parts(keys.output, {"eccentra-keys: error", "empty"});
  EXPECT_TRUE(std::filesystem::is_empty(home));
  EXPECT_FALSE(std::filesystem::exists("/dem.secret"));
}

TEST(Reported, full_standard_output_of_shape_tools) {
  std::filesystem::remove_all("keys");
  for (const std::string& arguments :
       {std::string("clusterShape cube 8"), std::string("clusterShape cube 8 --json"), std::string("clusterShape list"),
        std::string("clusterShape --help"), std::string("clusterShape compare cube 8 disk 7"),
        std::string("clusterShape advise disk --error 0.1"), std::string("eccentra-keys --help"),
        std::string("eccentra-keys keys"), std::string("annulusReport --help")}) {
    const ProgramResult run = shell(program(arguments) + " > /dev/full");
    EXPECT_GT(run.status, 0) << arguments;
    expect_parts(run.output, {"standard output cannot be written"});
  }
}

} // namespace
