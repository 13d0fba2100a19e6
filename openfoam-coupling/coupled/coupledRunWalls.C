// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two descriptions of one geometry: the script's walls against the mesh's patches, particles against the mesh.
#include "coupled/coupledRun.H"

#include "coupled/wallPatches.H"
#include "support/foam_compat.H"
#include "support/inputError.H"
#include "support/processGuards.H"

#include "link/stop_signal.h"

#include "Time.H"
#include "wordRes.H"

#include <algorithm>
#include <cstdio>

namespace eccentra {

using namespace Foam;

namespace {

/// Particles that a sentence names.
constexpr label kNamed = 5;

/// The same text on all ranks.
void share(std::string& text) {
  string all(text);
  compat::broadcast(all);
  text = all;
}

void checkApart(const wordRes& apart, const IOdictionary& properties, const link::WallDescription& dem,
                const std::vector<link::MeshPatch>& mesh) {
  std::vector<std::string> known;
  for (const link::MeshPatch& patch : mesh)
    known.push_back(patch.name);
  for (const link::PrimitiveWall& wall : dem.primitives)
    known.push_back(wall.id);
  for (const link::TriangleWall& wall : dem.meshes)
    known.push_back(wall.id);
  for (const wordRe& name : apart)
    if (std::none_of(known.begin(), known.end(), [&name](const std::string& one) { return name.match(one); })) {
      std::string all;
      for (const std::string& one : known)
        all += (all.empty() ? "" : ", ") + one;
      throw link::Refusal(properties.name() + ": wallsApart is '" + name +
                          "', which is neither a patch of the mesh nor a wall of the DEM script; known are " + all);
    }
}

} // namespace

std::string coupledRun::compare_walls(const link::WallDescription& walls) {
  const trapping off(0);
  const std::vector<link::MeshPatch> patches = wallPatches(flow_->U());
  const wordRes apart(properties_.getOrDefault<wordRes>("wallsApart", wordRes()));
  link::WallVerdict verdict;
  if (Pstream::master()) {
    try {
      checkApart(apart, properties_, walls, patches);
      verdict = link::compare_walls(walls, patches, [&apart](const std::string& name) { return apart.match(name); });
    } catch (const link::Refusal& refusal) {
      verdict.refusal = refusal.what();
    }
  }
  share(verdict.refusal);
  share(verdict.news);
  if (!verdict.refusal.empty())
    throw link::Refusal(verdict.refusal);
  scalarList chords(label(patches.size()), Zero);
  std::copy(verdict.chord_heights.begin(), verdict.chord_heights.end(), chords.begin());
  compat::broadcast(chords);
  // A particle may lie behind an opening; behind a wall only as far as the mesh's faces cut its arc short.
  depths_.assign(mesh_.boundaryMesh().size(), {0.0, exchange::kBehindOpening});
  label next = 0;
  for (const link::MeshPatch& patch : patches) {
    const scalar chord = chords[next++];
    if (patch.wall)
      depths_[mesh_.boundaryMesh().findPatchID(patch.name)] = {chord, exchange::kBehindWall};
  }
  if (exchange_)
    exchange_->allowDepths(depths_);
  if (overSocket_)
    print(verdict.news);
  return verdict.news;
}

void coupledRun::print(const std::string& news) {
  if (!news.empty() && Pstream::master()) {
    std::fputs((news.back() == '\n' ? news : news + "\n").c_str(), stdout);
    std::fflush(stdout);
  }
}

std::string coupledRun::placesOutside() const {
  // Five numbers for each.
  scalarList mine;
  for (const exchange::Outlier& one : exchange_->outside())
    for (const scalar number : {one.depth, one.position[0], one.position[1], one.position[2], scalar(one.patch)})
      mine.append(number);
  List<scalarList> all(Pstream::nProcs());
  all[Pstream::myProcNo()] = mine;
  Pstream::gatherList(all);
  std::string text;
  if (Pstream::master()) {
    std::vector<std::array<scalar, 5>> rows;
    for (const scalarList& list : all)
      for (label i = 0; i < list.size(); i += 5)
        rows.push_back({list[i], list[i + 1], list[i + 2], list[i + 3], list[i + 4]});
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a[0] > b[0]; });
    for (label i = 0; i < min(kNamed, label(rows.size())); ++i) {
      const auto& row = rows[i];
      char one[256];
      std::snprintf(one, sizeof one, "%s%s%.9g %.9g %.9g) m, %.3g m behind patch '%s'", i ? "; " : "",
                    link::kParticleAt, row[1], row[2], row[3], row[0],
                    mesh_.boundaryMesh()[label(row[4])].name().c_str());
      text += one;
    }
    if (label(rows.size()) > kNamed)
      text += "; ...";
  }
  share(text);
  return text;
}

void coupledRun::checkInside(const link::CouplingStep& couplingStep) {
  const label allowed = properties_.getOrDefault<label>("particlesOutside", 0);
  if (allowed < 0)
    throw inputError(properties_, "particlesOutside", allowed, "give a number of particles from 0 on");
  const label count = label(exchange_->balance().outside);
  outsideAtStart_ = count;
  if (count == 0)
    return;
  const std::string text = std::to_string(count) + " of " + std::to_string(couplingStep.totals.particles) +
                           " particles lie outside the mesh: " + placesOutside();
  // A run that goes on has them from before.
  if (count > allowed && dem_.resumes.step < 0)
    throw link::Refusal(text + "; move them inside, make the walls of the script and of the mesh the same, or allow " +
                        "them by particlesOutside " + std::to_string(count) + " in constant/couplingProperties");
  news_ += "warning: " + text + "\n";
}

void coupledRun::followOutside() {
  const label count = label(exchange_->balance().outside);
  if (outsideAtStart_ < 0 || count <= outsideAtStart_)
    return;
  news_ += "warning: at t = " + time_.timeName() + " s " + std::to_string(count) +
           " particles lie outside the mesh: " + placesOutside() +
           "; from now on they are counted only (column outside of coupling.csv)\n";
  outsideAtStart_ = labelMax;
}

link::StepAnswer coupledRun::answer() {
  link::StepAnswer answer;
  answer.stop_signal = returnReduce(label(link::stop_signal()), maxOp<label>());
  answer.news.swap(news_);
  if (overSocket_)
    print(answer.news);
  return answer;
}

} // namespace eccentra
