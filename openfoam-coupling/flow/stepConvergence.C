// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Says once what kind of iteration does not converge, and at the end how often.
#include "flow/stepConvergence.H"

#include <sstream>

namespace Foam {

void stepConvergence::endStep(label outerCorrectors, const dictionary& PIMPLE, scalar fastest) {
  ++steps_;
  moving_ = fastest > kAtRest;
  if (!moving_) {
    return;
  }
  linear_ += failing_;
  const dictionary* const control = PIMPLE.findDict("residualControl");
  const label allowed = PIMPLE.getOrDefault<label>("nOuterCorrectors", 1);
  outer_ += control && !control->empty() && allowed > 1 && outerCorrectors >= allowed;
}

void stepConvergence::measured(scalar residual) {
  latest_ = residual;
  if (steps_ <= kStart) {
    return;
  }
  ++measured_;
  worst_ = max(worst_, residual);
  unsolved_ += residual > kResidual;
}

std::string stepConvergence::news(const word& time) {
  std::ostringstream text;
  if (linear_ > 0 && !saidLinear_) {
    saidLinear_ = true;
    text << "warning: not converged within the step at t = " << time
         << " s: a linear solver stopped at its maxIter; raise maxIter or take another solver in system/fvSolution\n";
  }
  if (outer_ > 0 && !saidOuter_) {
    saidOuter_ = true;
    text << "warning: not converged within the step at t = " << time
         << " s: nOuterCorrectors ended above PIMPLE/residualControl; raise nOuterCorrectors or reduce deltaT\n";
  }
  if (unsolved_ > 0 && !saidUnsolved_) {
    saidUnsolved_ = true;
    text << "warning: not converged within the step at t = " << time << " s: the momentum equation lacks "
         << 100 * latest_
         << " % of its largest force; reduce deltaT, raise nOuterCorrectors or nCorrectors, or take further steps "
            "where a steady flow is wanted\n";
  }
  return text.str();
}

std::string stepConvergence::summary() const {
  if (linear_ == 0 && outer_ == 0 && unsolved_ == 0 && !(latest_ > kResidual)) {
    return "";
  }
  std::ostringstream text;
  text << "not converged within the step: linear solvers in " << linear_ << " and outer correctors in " << outer_
       << " of " << steps_ << " steps, momentum in " << unsolved_ << " of " << measured_ << " reports (worst residual "
       << worst_ << ", last " << latest_
       << "); reduce deltaT, raise nOuterCorrectors or nCorrectors, or take further steps\n";
  return text.str();
}

} // namespace Foam
