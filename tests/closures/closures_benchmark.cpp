// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Nanoseconds per particle of each effect, alone and together, beside a hand-written drag loop.
#include "closures/fluid_options.h"
#include "closures/oriented_shape.h"
#include "closures/projected_area.h"
#include "shape/cluster_shape.h"
#include "shape/resistance.h"

#include "hand_written_drag.h"
#include "law_names.h"
#include "particle_arrays.h"

#include <Eigen/Geometry>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <tuple>

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

/// The same particles as disks of 48 spheres that lie at random.
class Disks : public ParticleArrays {
 public:
  explicit Disks(int count) : ParticleArrays(count) {
    std::size_t used = 0;
    const eccentra::shape::ClusterShape disk = eccentra::shape::make_shape({"disk", "48"}, 0, used, 6.35e-3);
    const double d = 2.0 * disk.equivalent_radius();
    factors_.sphericity = disk.sphericity();
    oriented_ =
        oriented_shape(eccentra::shape::resistance_of(disk), disk.inertia_per_mass() / (d * d),
                       [&](const Eigen::Vector3d& along) { return projected_area(disk.spheres(), along) / (d * d); });
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < count; ++i) {
      const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
      const Eigen::Quaterniond q = Eigen::Quaterniond(w, x, y, z).normalized();
      quaternions_.insert(quaternions_.end(), {q.w(), q.x(), q.y(), q.z()});
    }
  }
  ShapeFactors factors(int) const override { return factors_; }
  const OrientedShape* oriented(int) const override { return &oriented_; }
  const double* quaternion(int i) const override { return &quaternions_[4 * std::size_t(i)]; }

 private:
  ShapeFactors factors_;
  OrientedShape oriented_;
  std::vector<double> quaternions_;
};

/// All effects that the arguments make, or the one with the name `only`; without the quantities of the flow that they
/// do not need.
template <class Particles>
void run_effects(benchmark::State& state, const std::string& arguments, const std::string& only = "") {
  Particles particles(kParticles);
  EffectList effects = effects_of(arguments);
  effects.erase(std::remove_if(effects.begin(), effects.end(),
                               [&](const auto& effect) { return !only.empty() && effect->name() != only; }),
                effects.end());
  unsigned needs = 0;
  for (const auto& effect : effects) {
    effect->prepare(particles);
    needs |= effect->needs();
  }
  HalfStep half_step = particles.half_step();
  for (const FlowQuantity& quantity : kFlowQuantities)
    if (!(needs & quantity.bit))
      half_step.samples[quantity.bit] = nullptr;
  for (auto _ : state) {
    particles.clear_forces();
    for (const auto& effect : effects)
      effect->apply(half_step);
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
  benchmark::RegisterBenchmark("empty", [](benchmark::State& s) { run_effects<ParticleArrays>(s, kMud); });
  benchmark::RegisterBenchmark("hand_written_drag/herschel_bulkley", run_hand_written);
  for (const std::string& law : eccentra::test::drag_laws())
    for (const auto& [fluid, rheology] : {std::pair{"herschel_bulkley", kMud}, std::pair{"newtonian", kOil}}) {
      const std::string arguments = rheology + "drag " + law;
      benchmark::RegisterBenchmark(("drag_" + law + "/" + fluid).c_str(),
                                   [arguments](benchmark::State& s) { run_effects<ParticleArrays>(s, arguments); });
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
                                   [line](benchmark::State& s) { run_effects<ParticleArrays>(s, line); });
    }
  }
  for (const auto& [fluid, rheology] : {std::pair{"herschel_bulkley", kMud}, std::pair{"newtonian", kOil}}) {
    const std::string line = rheology + all;
    benchmark::RegisterBenchmark((std::string("all/") + fluid).c_str(),
                                 [line](benchmark::State& s) { run_effects<ParticleArrays>(s, line); });
  }
  const std::string real = "drag chien oriented on drag_torque dennis strain_torque jeffery pitching_torque dabade ";
  const std::tuple<const char*, std::string, const char*> oriented[] = {
      {"oriented_drag_chien", "drag chien oriented on", ""},
      {"oriented_drag_holzer_sommerfeld", "drag holzer_sommerfeld oriented on", ""},
      {"oriented_drag_torque", "drag_torque dennis oriented on", ""},
      {"strain_torque", real, "strain_torque"},
      {"pitching_torque", real, "pitching_torque"},
      {"oriented_all", real, ""}};
  for (const auto& [name, arguments, only] : oriented)
    for (const auto& [fluid, rheology] : {std::pair{"herschel_bulkley", kMud}, std::pair{"newtonian", kOil}})
      benchmark::RegisterBenchmark((std::string(name) + "/" + fluid).c_str(),
                                   [line = rheology + arguments, only = std::string(only)](benchmark::State& s) {
                                     run_effects<Disks>(s, line, only);
                                   });
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
