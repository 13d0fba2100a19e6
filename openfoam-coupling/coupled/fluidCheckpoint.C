// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fields pass through memory, so that what is written, and its checksum, is known before the disk can refuse it.
#include "coupled/fluidCheckpoint.H"

#include "coupled/fieldsOfParts.H"
#include "flow/flowTurbulence.H"
#include "support/foam_compat.H"
#include "support/halfWritten.H"

#include "link/checkpoint/checkpoint_choice.h"
#include "link/checkpoint/checkpoint_room.h"
#include "link/checkpoint/durable_files.h"

#include "IFstream.H"
#include "IOobject.H"
#include "OSspecific.H"
#include "OStringStream.H"
#include "Time.H"
#include "zeroGradientFvPatchFields.H"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

namespace eccentra::fluidCheckpoint {

using namespace Foam;

namespace {

/// Digits that bring a double back bit for bit.
constexpr int kAllDigits = 17;
constexpr int kKept = 2;
constexpr label kFingerprint = 16;
/// Of two fingerprints; a cell's place in sizes of the mesh.
constexpr scalar kSamePlace = 1e-5;
const char* const kFacts = "facts";
const char* const kPart = "part";

std::string named(std::int64_t step) {
  return link::kFluidPrefix + std::to_string(step);
}

/// In the case, not in the processor folders: decomposePar removes these when the ranks become others.
fileName stepFolder(const Time& time, std::int64_t step) {
  return time.globalPath() / link::kCheckpoints / named(step);
}

fileName rankFolder(const Time& time, std::int64_t step, label rank) {
  return stepFolder(time, step) / ("rank" + std::to_string(rank));
}

std::string recordOf(const Time& time, std::int64_t step) {
  return time.globalPath() / link::kCheckpoints / (named(step) + link::kFluidRecord);
}

/// The record of the time at which the run that has checkpoints began.
std::string startOf(const fileName& globalPath) {
  return globalPath / link::kCheckpoints / "start";
}

const char* const kWriting = "no checkpoint could be written: ";

/// The first sentence of any rank, on every rank.
std::string shared(const std::string& sentence) {
  List<string> all(Pstream::nProcs());
  all[Pstream::myProcNo()] = sentence;
  compat::allGather(all);
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

/// Calls visit(field, name in the checkpoint) for all that averagedFlow keeps from one step to the next. The names are
/// none of OpenFOAM's: where U is read from a checkpoint, OpenFOAM would look for U_0 in the folder of that time.
template <class Visit> void forFields(averagedFlow& flow, bool pending, Visit&& visit) {
  const fvMesh& mesh = flow.mesh();
  auto& U = mesh.lookupObjectRef<volVectorField>("U");
  auto& alpha = mesh.lookupObjectRef<volScalarField>("alpha");
  auto& phi = mesh.lookupObjectRef<surfaceScalarField>("phi");
  // The present level first: replacing it may push an older one back.
  visit(U, "UNow");
  visit(U.oldTime(), "UOld");
  // The limiter of an extrapolated velocity looks one level further back.
  visit(U.oldTime().oldTime(), "UOldOld");
  visit(alpha, "alphaNow");
  visit(alpha.oldTime(), "alphaOld");
  visit(phi, "phiNow");
  visit(phi.oldTime(), "phiOld");
  visit(mesh.lookupObjectRef<volScalarField>("p"), "pNow");
  visit(mesh.lookupObjectRef<volVectorField>("withheldForce"), "withheldForceNow");
  if (mesh.foundObject<volScalarField>("driveResponse"))
    visit(mesh.lookupObjectRef<volScalarField>("driveResponse"), "driveResponseNow");
  for (volScalarField* const field : flowTurbulence::transported(mesh)) {
    visit(*field, field->name() + "Now");
    visit(field->oldTime(), field->name() + "Old");
  }
  if (volScalarField* const nut = flowTurbulence::eddyViscosity(mesh))
    visit(*nut, "nutNow");
  if (pending) {
    visit(flow.particleForce(), "particleForceNow");
    visit(flow.exchange(), "exchangeNow");
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

/// Those that are newer were kept beside when the run began. On the first rank, when all have written.
void removeOld(const Time& time, std::int64_t step) {
  if (!Pstream::master())
    return;
  int kept = 0;
  for (const std::int64_t other : link::numbered_entries(time.globalPath() / link::kCheckpoints, link::kFluidPrefix)) {
    if (other > step || kept++ < kKept)
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
  removeOld(time, mark.step);
  return recordOf(time, mark.step);
}

// FNV-1a over the numbers of cells.
std::uint64_t layoutOf(const fvMesh& mesh) {
  List<label> cells(Pstream::nProcs());
  cells[Pstream::myProcNo()] = mesh.nCells();
  compat::allGather(cells);
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const label count : cells)
    hash = (hash ^ std::uint64_t(count)) * 0x100000001b3;
  return hash;
}

// Sums of the cells' centres and volumes with weights of either sign that only the cell's number in the whole mesh
// decides: a cell that moves, or changes places with another, changes them by what it has moved.
scalarList fingerprint(const fvMesh& mesh) {
  const boundBox box(mesh.points(), true);
  const scalar size = max(mag(box.span()), VSMALL);
  const labelList numbers(meshPart(mesh).cells);
  scalarList sums(kFingerprint, Zero);
  forAll(mesh.C(), celli) {
    std::uint64_t bits = (std::uint64_t(numbers.empty() ? celli : numbers[celli]) + 1) * 0x9e3779b97f4a7c15;
    bits ^= bits >> 29;
    bits *= 0xbf58476d1ce4e5b9;
    bits ^= bits >> 32;
    const vector at((mesh.C()[celli] - box.min()) / size);
    const scalar volume = std::cbrt(mesh.V()[celli]) / size;
    const scalar values[] = {at.x(), at.y(), at.z(), volume};
    forAll(sums, k) sums[k] += ((bits >> k) & 1 ? 1 : -1) * values[k % 4];
  }
  for (scalar& sum : sums)
    reduce(sum, sumOp<scalar>());
  const scalar cells = returnReduce(mesh.nCells(), sumOp<label>());
  for (scalar& sum : sums)
    sum /= std::sqrt(cells);
  sums.append(cells);
  sums.append(size);
  return sums;
}

bool sameMesh(const scalarList& a, const scalarList& b) {
  bool same = a.size() == b.size();
  for (label k = 0; same && k < a.size(); ++k)
    same = mag(a[k] - b[k]) <= kSamePlace * max(scalar(1), mag(a[k]));
  return same;
}

void clearHalfWritten(const fileName& globalPath, const fileName& path) {
  if (const std::optional<link::Manifest> start = link::read_record(startOf(globalPath)))
    removeHalfWritten(std::string(path), std::stod(start->note("time")));
}

void begin(Time& time, bool again, std::int64_t step) {
  const std::string path = startOf(time.globalPath());
  const std::optional<link::Manifest> earlier = again ? link::read_record(path) : std::nullopt;
  std::string moved;
  together("", [&] {
    if (Pstream::master())
      moved = link::make_room_for_checkpoints(time.globalPath(), link::Side::fluid, step, again);
  });
  if (!moved.empty())
    Info << moved.c_str() << endl;
  if (again)
    clearHalfWritten(time.globalPath(), time.path());
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

void finish(const Time& time) {
  together("", [&] {
    if (Pstream::master())
      link::mark_finished(time.globalPath());
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
