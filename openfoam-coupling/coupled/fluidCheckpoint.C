// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fields pass through memory, so that what is written, and its checksum, is known before the disk can refuse it.
#include "coupled/fluidCheckpoint.H"

#include "coupled/fieldsOfParts.H"

#include "link/checkpoint/durable_files.h"

#include "IFstream.H"
#include "IOobject.H"
#include "OSspecific.H"
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
const char* const kPart = "part";

std::string named(std::int64_t step) {
  return kPrefix + std::to_string(step);
}

/// In the case, not in the processor folders: decomposePar removes these when the ranks become others.
fileName stepFolder(const Time& time, std::int64_t step) {
  return time.globalPath() / kFolder / named(step);
}

fileName rankFolder(const Time& time, std::int64_t step, label rank) {
  return stepFolder(time, step) / ("rank" + std::to_string(rank));
}

std::string recordOf(const Time& time, std::int64_t step) {
  return time.globalPath() / kFolder / (named(step) + kComplete);
}

const char* const kWriting = "no checkpoint could be written: ";

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
template <class Work> void together(const char* what, Work&& work) {
  std::string problem;
  try {
    work();
  } catch (const std::exception& error) {
    problem = error.what();
  }
  problem = shared(problem);
  if (!problem.empty())
    throw link::Refusal(what + problem);
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

/// Fields that this rank has written itself: bit for bit.
class ownFields {
 public:
  ownFields(const fvMesh& mesh, std::int64_t step)
      : mesh_(mesh), folder_(rankFolder(mesh.time(), step, Pstream::myProcNo())) {}
  template <class Field> void read(Field& field, const word& name) const {
    field == Field(IOobject(name, folder_, mesh_, IOobject::MUST_READ, IOobject::NO_WRITE, false), mesh_);
  }

 private:
  const fvMesh& mesh_;
  const fileName folder_;
};

word memoryName(std::size_t number) {
  return "spreading" + std::to_string(number);
}

volScalarField cellValues(const word& name, const fvMesh& mesh) {
  return volScalarField(IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false),
                        mesh, dimensionedScalar(dimless, Zero), zeroGradientFvPatchScalarField::typeName);
}

/// Calls visit(field, name in the checkpoint) for all that averagedFlow keeps from one step to the next.
template <class Visit> void forFields(averagedFlow& flow, bool pending, Visit&& visit) {
  const fvMesh& mesh = flow.mesh();
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
  if (pending) {
    visit(flow.particleForce(), "particleForce");
    visit(flow.exchange(), "exchange");
  }
}

/// All of the flow, and values per cell, through `from`.read(field, name).
template <class From>
void readAll(averagedFlow& flow, bool pending, const std::vector<scalarField*>& cells, const From& from) {
  forFields(flow, pending, [&](auto& field, const word& name) { from.read(field, name); });
  std::size_t number = 0;
  for (scalarField* values : cells) {
    const word name = memoryName(number++);
    volScalarField field(cellValues(name, flow.mesh()));
    from.read(field, name);
    *values = field.primitiveField();
  }
}

label ranksOf(const link::Manifest& record) {
  label ranks = 0;
  for (const auto& [name, value] : record.notes)
    ranks += name == "rank";
  return ranks;
}

meshPart storedPart(const Time& time, std::int64_t step, label rank) {
  IFstream is(rankFolder(time, step, rank) / kPart);
  meshPart part;
  is >> part;
  return part;
}

/// Also those that are newer: they belong to a run that was given up. On the first rank, when all have written.
void removeOthers(const Time& time, std::int64_t step) {
  if (!Pstream::master())
    return;
  int kept = 0;
  for (const std::int64_t other : link::numbered_entries(time.globalPath() / kFolder, kPrefix)) {
    if (other <= step && kept++ < kKept)
      continue;
    std::error_code ignored;
    std::filesystem::remove(recordOf(time, other), ignored);
    std::filesystem::remove_all(std::string(stepFolder(time, other)), ignored);
  }
}

} // namespace

std::string write(averagedFlow& flow, bool pending, const std::vector<scalarField*>& cells,
                  const link::CheckpointMark& mark, const dictionary& facts) {
  const fvMesh& mesh = flow.mesh();
  const Time& time = mesh.time();
  std::unique_ptr<link::DurableFolder> folder;
  std::uint32_t checksum = 0;
  together(kWriting, [&] {
    folder = std::make_unique<link::DurableFolder>(rankFolder(time, mark.step, Pstream::myProcNo()));
    forFields(flow, pending, [&](const auto& field, const word& name) { add(*folder, name, field); });
    std::size_t number = 0;
    for (const scalarField* values : cells) {
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
    OStringStream part;
    part << meshPart(mesh);
    const std::string division = part.str();
    folder->add(kPart, division.data(), division.size());
  });
  together(kWriting, [&] { checksum = folder->commit(mark); });
  List<scalar> checksums(Pstream::nProcs());
  checksums[Pstream::myProcNo()] = checksum;
  Pstream::gatherList(checksums);
  together(kWriting, [&] {
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
  // All have looked before the first rank writes: one that is late would find what the first has just written.
  if (returnReduce(earlier.has_value(), andOp<bool>())) {
    const scalar usual = time.deltaTValue();
    time.setTime(std::stod(earlier->note("time")), 0);
    time.setDeltaT(usual, false);
    return;
  }
  std::ostringstream value;
  value.precision(kAllDigits);
  value << time.value();
  together(kWriting, [&] {
    if (!Pstream::master())
      return;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    link::write_record(path, {0, 0}, {{"time", value.str()}});
  });
}

bool whole(const fvMesh& mesh, const link::CheckpointMark& mark, std::string& why) {
  const Time& time = mesh.time();
  std::string problem;
  // Read by every rank: the ranks share the case's folder.
  const std::optional<link::Manifest> record = link::read_record(recordOf(time, mark.step), &problem);
  if (record) {
    std::vector<std::string> sums;
    for (const auto& [name, value] : record->notes)
      if (name == "rank")
        sums.push_back(value);
    if (mark.id != 0 && record->mark.id != mark.id)
      problem = "'" + recordOf(time, mark.step) + "' belongs to another run than the DEM side's";
    // Whoever wrote them: each rank looks after its share.
    for (std::size_t rank = Pstream::myProcNo(); rank < sums.size() && problem.empty(); rank += Pstream::nProcs()) {
      const std::string folder = rankFolder(time, mark.step, label(rank));
      const auto part = link::check_folder(folder, &problem);
      if (part && std::to_string(part->checksum) != sums[rank])
        problem = "'" + folder + "' belongs to another checkpoint";
    }
  }
  why = shared(problem);
  return why.empty();
}

dictionary facts(const fvMesh& mesh, std::int64_t step) {
  const fileName own = rankFolder(mesh.time(), step, Pstream::myProcNo()) / kFacts;
  IFstream is(isFile(own) ? own : rankFolder(mesh.time(), step, 0) / kFacts);
  return dictionary(is);
}

void readFields(averagedFlow& flow, bool pending, const std::vector<scalarField*>& cells, std::int64_t step) {
  const fvMesh& mesh = flow.mesh();
  const Time& time = mesh.time();
  const std::optional<link::Manifest> record = link::read_record(recordOf(time, step));
  const label ranks = record ? ranksOf(*record) : 0;
  const bool same = ranks == Pstream::nProcs() && storedPart(time, step, Pstream::myProcNo()) == meshPart(mesh);
  if (returnReduce(same, andOp<bool>())) {
    readAll(flow, pending, cells, ownFields(mesh, step));
    return;
  }
  List<meshPart> parts(ranks);
  fileNameList folders(ranks);
  forAll(parts, rank) {
    parts[rank] = storedPart(time, step, rank);
    folders[rank] = rankFolder(time, step, rank);
  }
  std::unique_ptr<fieldsOfParts> from;
  together("", [&] { from = std::make_unique<fieldsOfParts>(mesh, folders, parts); });
  readAll(flow, pending, cells, *from);
  Info << "the checkpoint of " << ranks << " rank(s) is divided anew among " << Pstream::nProcs() << endl;
}

} // namespace eccentra::fluidCheckpoint
