// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// LIGGGHTS runs in a test process with our styles: a sphere falls freely by the closed form.
#include "styles/entry/host_symbols.h"
#include "support/granular_script.h"
#include "support/liggghts_session.h"

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <string>

using namespace eccentra::test;

TEST(Session, SphereFallsFreely) {
  LiggghtsSession session;
  session.script(granular_box("0 1 0 1 0 1", "p p p") + granular_material({}, "0.01") + sphere_contacts() + R"(
    timestep 1e-5
    fix gravity all gravity 9.81 vector 0 0 -1
    create_atoms 1 single 0.5 0.5 0.9 units box
    set group all diameter 0.01 density 2500
    fix integrate all nve/sphere
    run 1000
  )");
  const int i = session.local(1);
  if (i >= 0) {
    const double t = 1000 * 1e-5;
    EXPECT_NEAR(session.atom().v[i][2], -9.81 * t, 1e-12);
  }
}

// The clock of the ranks belongs to our own programs: whoever loads libeccentra keeps the MPI library's functions.
TEST(Session, MpiCallsStayTheLibrarys) {
  for (void* call : {dlsym(RTLD_DEFAULT, "MPI_Wait"), dlsym(RTLD_DEFAULT, "MPI_Allreduce")}) {
    Dl_info where;
    ASSERT_NE(dladdr(call, &where), 0);
    EXPECT_NE(std::string(where.dli_fname).find("libmpi"), std::string::npos) << where.dli_fname;
  }
}

// A function that the library calls by the loader, and one that it does not call.
TEST(Session, CallsThatTheLoaderBindsAreSeen) {
  const void* const inside = dlsym(RTLD_DEFAULT, "_ZN9LAMMPS_NS5Input5parseEv");
  const std::string called = "_ZN9LAMMPS_NS5Input15execute_commandEv", never = "_ZN9LAMMPS_NS5Input5neverEv";
  EXPECT_EQ(eccentra::styles::bound_inside(inside, {called, never}), std::vector<std::string>{never});
  EXPECT_TRUE(eccentra::styles::bound_inside(nullptr, {called}).empty());
}
