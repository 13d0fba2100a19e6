// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Nanoseconds per particle of each effect, alone and together, beside a hand-written drag loop.
#include "closures/fluid_options.h"

#include "hand_written_drag.h"
#include "law_names.h"
#include "particle_arrays.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <sstream>

using namespace eccentra::closures;
using namespace eccentra::link;
using eccentra::test::ParticleArrays;

namespace {

constexpr int kParticles = 4096; // fits the second-level cache, as a rank's share of a scene does
const std::string kMud = "rheology herschel_bulkley 1 0.28 0.65 density 1000 buoyancy off ";
const std::string kOil = "rheology newtonian 0.1 density 1000 buoyancy off ";

EffectList effects_of(const std::string& arguments) {
  std::istringstream stream(arguments);
  std::vector<std::string> list;
  for (std::string word; stream >> word;)
    list.push_back(word);
  return make_effects(read_fluid_options(list, 1));
}

void run_effects(benchmark::State& state, const std::string& arguments) {
  ParticleArrays particles(kParticles);
  EffectList effects = effects_of(arguments);
  for (const auto& effect : effects)
    effect->prepare(particles);
  for (auto _ : state) {
    particles.clear_forces();
    for (const auto& effect : effects)
      effect->apply(particles.half_step());
    benchmark::ClobberMemory();
  }
  state.counters["ns_per_particle"] = benchmark::Counter(1e-9 * double(kParticles) * double(state.iterations()),
                                                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void run_hand_written(benchmark::State& state) {
  ParticleArrays particles(kParticles);
  for (auto _ : state) {
    particles.clear_forces();
    eccentra::test::hand_written_drag(particles.half_step(), {1.0, 0.28, 0.65, 1000.0});
    benchmark::ClobberMemory();
  }
  state.counters["ns_per_particle"] = benchmark::Counter(1e-9 * double(kParticles) * double(state.iterations()),
                                                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

} // namespace

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("empty", [](benchmark::State& s) { run_effects(s, kMud); });
  benchmark::RegisterBenchmark("hand_written_drag/herschel_bulkley", run_hand_written);
  for (const std::string& law : eccentra::test::drag_laws())
    for (const auto& [fluid, rheology] : {std::pair{"herschel_bulkley", kMud}, std::pair{"newtonian", kOil}}) {
      const std::string arguments = rheology + "drag " + law;
      benchmark::RegisterBenchmark(("drag_" + law + "/" + fluid).c_str(),
                                   [arguments](benchmark::State& s) { run_effects(s, arguments); });
    }
  const std::pair<const char*, const char*> single[] = {
      {"shear_lift", "shear_lift saffman_mei"}, {"rotational_lift", "rotational_lift oesterle_bui_dinh"},
      {"drag_torque", "drag_torque dennis"},    {"pressure_gradient", "pressure_gradient on"},
      {"viscous_stress", "viscous_stress on"},  {"buoyancy", "buoyancy on"}};
  std::string all = "drag chien ";
  for (const auto& [name, arguments] : single) {
    all += std::string(arguments) + " ";
    for (const auto& [fluid, rheology] : {std::pair{"herschel_bulkley", kMud}, std::pair{"newtonian", kOil}}) {
      const std::string line = rheology + arguments;
      benchmark::RegisterBenchmark((std::string(name) + "/" + fluid).c_str(),
                                   [line](benchmark::State& s) { run_effects(s, line); });
    }
  }
  for (const auto& [fluid, rheology] : {std::pair{"herschel_bulkley", kMud}, std::pair{"newtonian", kOil}}) {
    const std::string line = rheology + all;
    benchmark::RegisterBenchmark((std::string("all/") + fluid).c_str(),
                                 [line](benchmark::State& s) { run_effects(s, line); });
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
