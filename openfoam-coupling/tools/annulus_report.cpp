// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// annulusReport: table, CSV, charts and pictures of one or more case folders.
#include "base/standard_output.h"
#include "report/bed_picture.h"
#include "report/charts.h"
#include "report/html_page.h"
#include "report/paraview_files.h"
#include "report/scene_picture.h"
#include "report/summary.h"
#include "shape/vtk/virtual_display.h"

#include <CLI/CLI.hpp>
#include <vtkObject.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>

namespace {

namespace fs = std::filesystem;
using namespace eccentra::report;

void write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream)
    throw std::runtime_error(file.string() + ": cannot be written: check the folder and the space on the disk");
}

int run(int argc, char** argv) {
  CLI::App app(
      "Numbers, charts and pictures of runs: coupled ones on any mesh, and runs of LIGGGHTS alone.\n"
      "Reads CASE/log.liggghts, CASE/postProcessing/eccentra/coupling.csv, the particles that the run dumped beside "
      "it\n"
      "(particles_*.vtk, grains_*.vtp), the last flow written and, of an annulus, CASE/system/annulusMeshDict.\n"
      "Several cases: side by side.");
  app.name("annulusReport");
  std::vector<std::string> folders;
  std::string out;
  double share = 0.5;
  std::size_t layers = 40;
  bool pictures = true;
  bool html = false;
  bool paraview = false;
  std::size_t frames = 0;
  std::size_t film = 0;
  app.add_option("CASE", folders, "case folders")->required();
  app.add_option("-o,--output", out, "folder for what is written (default: CASE/report of the first case)");
  app.add_option("--share", share, "the last part of the run that means are taken over (default 0.5)");
  app.add_option("--layers", layers, "layers of the concentration profile (default 40)")->check(CLI::Range(2, 1000));
  app.add_flag("!--no-pictures", pictures, "table and CSV alone");
  app.add_flag("--html", html, "also report.html: one page that needs no other file");
  app.add_flag("--paraview", paraview, "also NAME.pvd of each case: bodies, walls and fields for ParaView, in seconds");
  app.add_option("--frames", frames, "a strip of so many pictures from the start to the end of the first case")
      ->check(CLI::Range(1, 100));
  app.add_option("--film", film,
                 "film.png of so many pictures of the first case, one each tenth of a second (animated)")
      ->check(CLI::Range(2, 2000));
  app.set_version_flag("--version", ECCENTRA_REPORT_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return app.exit(error);
    throw std::runtime_error(std::string(error.what()) + ": see annulusReport --help");
  }

  std::vector<Case> cases;
  std::vector<Summary> summaries;
  for (const std::string& folder : folders) {
    cases.push_back(read_case(folder));
    summaries.push_back(summarise(cases.back(), share, layers));
  }
  const fs::path folder = out.empty() ? fs::path(folders.front()) / "report" : fs::path(out);
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw std::runtime_error(folder.string() + ": cannot be made: " + failed.message());
  const std::string classes = classes_text(summaries);
  const std::string table = to_text(summaries) + classes;
  std::fputs(table.c_str(), stdout);
  write(folder / "summary.txt", table);
  write(folder / "summary.csv", to_csv(summaries));
  if (!classes.empty())
    write(folder / "classes.csv", classes_csv(summaries));
  if (std::any_of(cases.begin(), cases.end(), [](const Case& c) { return c.is_annulus; }))
    write(folder / "profile.csv", profile_csv(summaries));
  for (const Case& c : cases)
    for (const std::string& id : c.dem.left_out)
      std::fprintf(stderr, "annulusReport: note: %s: mesh %s is turned by its script and is not drawn\n",
                   c.name.c_str(), id.c_str());
  if (pictures) {
    const eccentra::shape::VirtualDisplay display;
    vtkObject::GlobalWarningDisplayOff();
    const bool annuli = std::all_of(cases.begin(), cases.end(), [](const Case& c) { return c.is_annulus; });
    if (std::any_of(cases.begin(), cases.end(), [](const Case& c) { return c.run.rows() > 0; }))
      draw_charts(cases, summaries, folder);
    if (annuli)
      draw_beds(cases, folder / "beds.png");
    else
      draw_views(last_views(cases), folder / "scene.png");
    if (frames > 0)
      draw_views(strip(cases.front(), frames), folder / "strip.png");
    if (film > 0)
      draw_film(strip(cases.front(), film), folder / "film.png");
  }
  if (paraview)
    for (const Case& c : cases)
      std::printf("for ParaView: %s\n", write_paraview(c, folder).c_str());
  if (html)
    write(folder / "report.html", html_page(cases, summaries, folder));
  std::printf("written: %s\n", folder.c_str());
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  try {
    const int code = run(argc, argv);
    eccentra::finish_standard_output();
    return code;
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "annulusReport: error: %s\n", error.what());
    return 1;
  }
}
