// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Looks for whole checkpoints.
#include "link/checkpoint/checkpoint_choice.h"

#include <filesystem>

namespace eccentra::link {

const char* const kCheckpoints = "checkpoints";
const char* const kDemFile = "dem.restart";
const char* const kFluidPrefix = "fluid-";
const char* const kFluidRecord = ".complete";

std::string restart_file_of(const CheckpointMark& mark) {
  return mark.step < 0 ? "none" : std::string(kCheckpoints) + '/' + std::to_string(mark.step) + '/' + kDemFile;
}

std::vector<std::string> script_variables(const CheckpointChoice& choice) {
  return {"-var", "resumes", choice.mark.step < 0 ? "0" : "1", "-var", "checkpoint", choice.restart_file};
}

CheckpointChoice newest_checkpoint(const std::function<bool(const Manifest&, std::string&)>& fluid_part) {
  CheckpointChoice choice;
  for (const std::int64_t step : numbered_entries(kCheckpoints, "")) {
    const std::string folder = std::string(kCheckpoints) + '/' + std::to_string(step);
    std::string why;
    const std::optional<Manifest> dem = check_folder(folder, &why);
    if (dem && fluid_part(*dem, why)) {
      choice.mark = dem->mark;
      choice.restart_file = restart_file_of(choice.mark);
      choice.notes = dem->notes;
      return choice;
    }
    choice.passed_over.push_back("checkpoint " + std::to_string(step) + " is passed over: " + why);
  }
  return choice;
}

bool fluid_record_is_whole(const Manifest& dem, std::string& why) {
  namespace fs = std::filesystem;
  const fs::path place = dem.note("fluid");
  std::error_code unreachable;
  if (place.empty() || !fs::exists(place.parent_path(), unreachable))
    return true;
  const std::optional<Manifest> record = read_record(place, &why);
  if (!record)
    return false;
  if (record->mark.id != dem.mark.id) {
    why = "'" + place.string() + "' belongs to another run";
    return false;
  }
  const fs::path parts = place.parent_path() / place.stem();
  std::size_t rank = 0;
  for (const auto& [word, checksum] : record->notes) {
    if (word != "rank")
      continue;
    const fs::path part = parts / ("rank" + std::to_string(rank++));
    const std::optional<Manifest> manifest = check_folder(part, &why);
    if (!manifest)
      return false;
    if (std::to_string(manifest->checksum) != checksum) {
      why = "'" + part.string() + "' belongs to another checkpoint";
      return false;
    }
  }
  return true;
}

} // namespace eccentra::link
