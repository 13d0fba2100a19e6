// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fields pass through memory, so that what is written, and its checksum, is known before the disk can refuse it.
#include "fluidCheckpoint.H"

#include "link/durable_files.h"

#include "IFstream.H"
#include "IOobject.H"
#include "OStringStream.H"
#include "Time.H"
#include "zeroGradientFvPatchFields.H"

#include <filesystem>
#include <sstream>
#include <string>

namespace eccentra::fluidCheckpoint {

using namespace Foam;

namespace {

/// Digits that bring a double back bit for bit.
constexpr int kAllDigits = 17;
constexpr int kKept = 2;
const char* const kFolder = "checkpoints";
const char* const kPrefix = "fluid-";
const char* const kComplete = ".complete";
const char* const kFacts = "facts";

std::string named(std::int64_t step) {
  return kPrefix + std::to_string(step);
}

/// Instance of the checkpoint's fields below the case or processor folder.
fileName instanceOf(std::int64_t step) {
  return fileName(kFolder) / named(step);
}

std::string rankFolder(const Time& time, std::int64_t step) {
  return time.path() / instanceOf(step);
}

std::string recordOf(const Time& time, std::int64_t step) {
  return time.globalPath() / kFolder / (named(step) + kComplete);
}

/// The first sentence of any rank, on every rank.
std::string shared(const std::string& sentence) {
  List<string> all(Pstream::nProcs());
  all[Pstream::myProcNo()] = sentence;
  Pstream::gatherList(all);
  Pstream::scatterList(all);
  for (const string& one : all)
    if (!one.empty())
      return one;
  return "";
}

/// Runs what may fail on one rank alone, and then fails on every rank.
template <class Work> void together(Work&& work) {
  std::string problem;
  try {
    work();
  } catch (const std::exception& error) {
    problem = error.what();
  }
  problem = shared(problem);
  if (!problem.empty())
    throw link::Refusal("no checkpoint could be written: " + problem);
}

template <class Field> void add(link::DurableFolder& folder, const word& name, const Field& field) {
  OStringStream os(IOstream::BINARY);
  os.precision(kAllDigits);
  field.writeHeader(os);
  field.writeData(os);
  IOobject::writeEndDivider(os);
  const std::string bytes = os.str();
  folder.add(name, bytes.data(), bytes.size());
}

IOobject stored(const word& name, const fvMesh& mesh, std::int64_t step) {
  return IOobject(name, instanceOf(step), mesh, IOobject::MUST_READ, IOobject::NO_WRITE, false);
}

template <class Field> void readInto(Field& field, const word& name, std::int64_t step) {
  const fvMesh& mesh = field.mesh();
  field == Field(stored(name, mesh, step), mesh);
}

word memoryName(std::size_t number) {
  return "spreading" + std::to_string(number);
}

volScalarField cellValues(const word& name, const fvMesh& mesh) {
  return volScalarField(IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false),
                        mesh, dimensionedScalar(dimless, Zero), zeroGradientFvPatchScalarField::typeName);
}

/// Calls visit(field, name in the checkpoint) for all that averagedFlow keeps from one step to the next.
template <class Visit> void forFields(const fvMesh& mesh, Visit&& visit) {
  auto& U = mesh.lookupObjectRef<volVectorField>("U");
  auto& alpha = mesh.lookupObjectRef<volScalarField>("alpha");
  auto& phi = mesh.lookupObjectRef<surfaceScalarField>("phi");
  // The present level first: replacing it may push an older one back.
  visit(U, "U");
  visit(U.oldTime(), "Uold");
  // The limiter of an extrapolated velocity looks one level further back.
  visit(U.oldTime().oldTime(), "UoldOld");
  visit(alpha, "alpha");
  visit(alpha.oldTime(), "alphaOld");
  visit(phi, "phi");
  visit(phi.oldTime(), "phiOld");
  visit(mesh.lookupObjectRef<volScalarField>("p"), "p");
  visit(mesh.lookupObjectRef<volVectorField>("withheldForce"), "withheldForce");
  if (mesh.foundObject<volScalarField>("driveResponse"))
    visit(mesh.lookupObjectRef<volScalarField>("driveResponse"), "driveResponse");
}

/// Also those that are newer: they belong to a run that was given up.
void removeOthers(const Time& time, std::int64_t step) {
  const std::string folder = time.path() / kFolder;
  int kept = 0;
  for (const std::int64_t other : link::numbered_entries(folder, kPrefix)) {
    if (other <= step && kept++ < kKept)
      continue;
    std::error_code ignored;
    std::filesystem::remove(recordOf(time, other), ignored);
    std::filesystem::remove_all(rankFolder(time, other), ignored);
  }
}

} // namespace

std::string write(averagedFlow& flow, exchange::particleExchange& exchange, const link::CheckpointMark& mark,
                  const dictionary& facts) {
  const fvMesh& mesh = flow.mesh();
  const Time& time = mesh.time();
  std::unique_ptr<link::DurableFolder> folder;
  std::uint32_t checksum = 0;
  together([&] {
    folder = std::make_unique<link::DurableFolder>(rankFolder(time, mark.step));
    forFields(mesh, [&](const auto& field, const word& name) { add(*folder, name, field); });
    std::size_t number = 0;
    for (const scalarField* values : exchange.memory()) {
      const word name = memoryName(number++);
      volScalarField field(cellValues(name, mesh));
      field.primitiveFieldRef() = *values;
      field.correctBoundaryConditions();
      add(*folder, name, field);
    }
    OStringStream os;
    os.precision(kAllDigits);
    facts.write(os, false);
    const std::string text = os.str();
    folder->add(kFacts, text.data(), text.size());
  });
  together([&] { checksum = folder->commit(mark); });
  List<scalar> checksums(Pstream::nProcs());
  checksums[Pstream::myProcNo()] = checksum;
  Pstream::gatherList(checksums);
  together([&] {
    if (!Pstream::master())
      return;
    link::Notes notes = {{"ranks", std::to_string(Pstream::nProcs())}};
    forAll(checksums, rank) notes.emplace_back("rank", std::to_string(std::uint64_t(checksums[rank])));
    std::filesystem::create_directories(std::filesystem::path(recordOf(time, mark.step)).parent_path());
    link::write_record(recordOf(time, mark.step), mark, notes);
  });
  removeOthers(time, mark.step);
  return recordOf(time, mark.step);
}

// FNV-1a over the numbers of cells.
std::uint64_t layoutOf(const fvMesh& mesh) {
  List<label> cells(Pstream::nProcs());
  cells[Pstream::myProcNo()] = mesh.nCells();
  Pstream::gatherList(cells);
  Pstream::scatterList(cells);
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const label count : cells)
    hash = (hash ^ std::uint64_t(count)) * 0x100000001b3;
  return hash;
}

void begin(Time& time, bool again) {
  const std::string path = time.globalPath() / kFolder / "start";
  const std::optional<link::Manifest> earlier = again ? link::read_record(path) : std::nullopt;
  if (earlier) {
    const scalar usual = time.deltaTValue();
    time.setTime(std::stod(earlier->note("time")), 0);
    time.setDeltaT(usual, false);
    return;
  }
  std::ostringstream value;
  value.precision(kAllDigits);
  value << time.value();
  together([&] {
    if (!Pstream::master())
      return;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    link::write_record(path, {0, 0}, {{"time", value.str()}});
  });
}

bool whole(const fvMesh& mesh, const link::CheckpointMark& mark, std::string& why) {
  const Time& time = mesh.time();
  std::string problem;
  // Read by every rank: processor folders lie where the case lies, or the case could not run.
  const std::optional<link::Manifest> record = link::read_record(recordOf(time, mark.step), &problem);
  if (record) {
    std::vector<std::string> sums;
    for (const auto& [name, value] : record->notes)
      if (name == "rank")
        sums.push_back(value);
    const std::size_t rank = Pstream::myProcNo();
    if (mark.id != 0 && record->mark.id != mark.id)
      problem = "'" + recordOf(time, mark.step) + "' belongs to another run than the DEM side's";
    else if (sums.size() != std::size_t(Pstream::nProcs()))
      problem = "'" + recordOf(time, mark.step) + "' was written by " + std::to_string(sums.size()) +
                " ranks and this run has " + std::to_string(Pstream::nProcs()) + ": use as many";
    else if (const auto part = link::check_folder(rankFolder(time, mark.step), &problem);
             part && std::to_string(part->checksum) != sums[rank])
      problem = "'" + rankFolder(time, mark.step) + "' belongs to another checkpoint";
  }
  why = shared(problem);
  return why.empty();
}

dictionary facts(const fvMesh& mesh, std::int64_t step) {
  IFstream is(fileName(rankFolder(mesh.time(), step)) / kFacts);
  return dictionary(is);
}

void readFields(averagedFlow& flow, exchange::particleExchange& exchange, std::int64_t step) {
  const fvMesh& mesh = flow.mesh();
  forFields(mesh, [&](auto& field, const word& name) { readInto(field, name, step); });
  std::size_t number = 0;
  for (scalarField* values : exchange.memory())
    *values = volScalarField(stored(memoryName(number++), mesh, step), mesh).primitiveField();
}

} // namespace eccentra::fluidCheckpoint
