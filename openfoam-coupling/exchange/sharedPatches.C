// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two ranks may share one plain and several periodic processor patches; the name of the periodic pair orders them.
#include "exchange/sharedPatches.H"

#include "cyclicPolyPatch.H"
#include "processorCyclicPolyPatch.H"
#include "processorPolyPatch.H"

#include <algorithm>
#include <map>
#include <string>

namespace eccentra::exchange {

using namespace Foam;

std::vector<std::vector<label>> sharedPatches(const fvMesh& mesh) {
  std::vector<std::multimap<std::string, label>> named(Pstream::nProcs());
  for (const polyPatch& patch : mesh.boundaryMesh()) {
    if (!isA<processorPolyPatch>(patch))
      continue;
    const label neighbour = refCast<const processorPolyPatch>(patch).neighbProcNo();
    std::string key;
    if (isA<processorCyclicPolyPatch>(patch)) {
      const auto& referred =
          refCast<const cyclicPolyPatch>(refCast<const processorCyclicPolyPatch>(patch).referPatch());
      // The two halves of a pair meet each other: the partner of "a" is "b".
      const bool first = referred.owner() == (neighbour >= Pstream::myProcNo());
      key = std::min(referred.name(), referred.neighbPatch().name()) + (first ? ":a" : ":b");
    }
    named[neighbour].emplace(key, patch.index());
  }
  std::vector<std::vector<label>> shared(named.size());
  for (std::size_t rank = 0; rank < named.size(); ++rank)
    for (const auto& entry : named[rank])
      shared[rank].push_back(entry.second);
  return shared;
}

} // namespace eccentra::exchange
