// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A small OpenFOAM case made by a test: dictionaries as text, a mesh from blockMesh or annulusMesh, a flow in this
// process.
#pragma once

#include "flow/averagedFlow.H"

#include "Time.H"
#include "fvMesh.H"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace eccentra::test {

/// What a program printed (both streams) and its exit code.
struct Outcome {
  int exit_code;
  std::string text;
};

/// Runs a command of a shell in this folder and waits for it.
Outcome run_program(const std::string& folder, const std::string& command);

/// The command of a stock solver that may load our libraries; the sanitizers' own library, if any, comes first.
std::string stock_solver(const std::string& name);

/// Relative to the run folder of the test. The folder is emptied first.
class FlowCase {
 public:
  explicit FlowCase(const std::string& name);

  const std::string& folder() const { return folder_; }
  /// Writes a dictionary or field file with its header.
  void write(const std::string& path, const std::string& foam_class, const std::string& body) const;
  void dictionary(const std::string& path, const std::string& body) const { write(path, "dictionary", body); }

  /// Entries of system/controlDict that differ from: start 0, deltaT 1, end 1, no output, binary.
  void control(const std::map<std::string, std::string>& entries);
  /// Schemes: second order in space; ddt as given. Solvers: tight tolerances. Entries go into PIMPLE.
  void numerics(const std::string& ddt, const std::string& pimple);
  /// Channel between y = 0 and y = gap; cyclic in x (flow) and empty in z. cells across.
  void channel_mesh(double gap, int cells_along, int cells_across);
  /// Box of size L cubed, cyclic in all directions.
  void periodic_box_mesh(double length, int nx, int ny, int nz);
  /// Periodic annulus of the paper (hole 63.5 mm, pipe 24.13 mm).
  void annulus_mesh(double eccentricity, int radial, int around, int axial, double length = 0.05,
                    double wall_grading = 1);
  /// more: further entries of transportProperties.
  void fluid(const std::string& model, double rho, const std::string& coefficients, const std::string& more = "");
  void newtonian(double rho, double mu);
  void drive(const std::string& entries) { dictionary("constant/flowProperties", "drive { " + entries + " }\n"); }
  /// U: internal value and boundary entries; p: zero with these boundary entries.
  void fields(const std::string& U_internal, const std::string& U_boundary, const std::string& p_boundary);
  void channel_fields();
  /// Pipe turning at this angular velocity [1/s].
  void annulus_fields(double eccentricity, double omega = 0);

  /// Drops time, mesh and flow; the next use reads them again from the latest time folder, as a restart does.
  void reopen();
  Foam::Time& time();
  Foam::fvMesh& mesh();
  Foam::averagedFlow& flow(Foam::averagedFlow::particles presence = Foam::averagedFlow::particles::none,
                           Foam::averagedFlow::stressShare share = Foam::averagedFlow::stressShare::full);
  /// Steps of the flow; before(t) is called after ++time.
  void advance(int steps, const std::function<void(double)>& before = {});
  /// Long steps until the value changes by less than the relative tolerance in one step; returns the value.
  double steady(const std::function<double()>& value, double tolerance, int max_steps);

 private:
  std::string folder_;
  std::unique_ptr<Foam::Time> time_;
  std::unique_ptr<Foam::fvMesh> mesh_;
  std::unique_ptr<Foam::averagedFlow> flow_;
};

/// Volume average of the axial velocity [m/s].
double mean_velocity(const Foam::averagedFlow& flow, int component = 2);

} // namespace eccentra::test
