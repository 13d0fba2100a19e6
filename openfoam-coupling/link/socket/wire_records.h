// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The fields of each record in the order in which they travel, described once for writing, reading and counting.
#pragma once

#include "link/socket/wire_values.h"

#include <type_traits>

namespace eccentra::link::wire {

// `Way` is Writer, Reader or Sizer; `Record` is const where it is only read.

/// Numbers of a vector.
template <class Way, class Numbers> constexpr void numbers(Way& way, Numbers& three) {
  for (auto& value : three)
    way.number(value);
}

/// Fields of Extents.
template <class Way, class Record> constexpr void extents_fields(Way& way, Record& extents) {
  numbers(way, extents.low);
  numbers(way, extents.high);
  for (auto& periodic : extents.periodic)
    way.yes_or_no(periodic);
  way.unused();
}

/// Fields of FlowCurve.
template <class Way, class Record> constexpr void flow_curve_fields(Way& way, Record& law) {
  way.number(law.yield_stress);
  way.number(law.consistency);
  way.number(law.index);
}

/// Fields of CheckpointMark.
template <class Way, class Record> constexpr void mark_fields(Way& way, Record& mark) {
  way.plain(mark.step);
  way.plain(mark.id);
}

/// Fields of DemTerms.
template <class Way, class Record> constexpr void dem_terms_fields(Way& way, Record& terms) {
  way.plain(terms.protocol);
  way.yes_or_no(terms.extents);
  way.number(terms.length_unit);
  way.number(terms.time_step);
  way.plain(terms.interval);
  way.plain(terms.particles);
  extents_fields(way, terms.domain);
  way.quantities(terms.needed);
  way.yes_or_no(terms.overlap);
  way.number(terms.fluid_density);
  flow_curve_fields(way, terms.rheology);
  numbers(way, terms.gravity);
  mark_fields(way, terms.resumes);
  way.plain(terms.rank_connections);
  way.unused();
}

/// Fields of FluidTerms.
template <class Way, class Record> constexpr void fluid_terms_fields(Way& way, Record& terms) {
  way.plain(terms.protocol);
  way.yes_or_no(terms.has_gravity);
  way.number(terms.length_unit);
  way.number(terms.time_step);
  extents_fields(way, terms.domain);
  way.quantities(terms.offered);
  way.unused();
  way.number(terms.fluid_density);
  flow_curve_fields(way, terms.rheology);
  numbers(way, terms.gravity);
  way.plain(terms.layout);
}

/// Fields of DemTotals.
template <class Way, class Record> constexpr void totals_fields(Way& way, Record& totals) {
  way.plain(totals.particles);
  way.plain(totals.inserted);
  way.number(totals.inserted_mass);
  way.number(totals.volume);
  way.number(totals.mass);
  way.number(totals.fastest);
  numbers(way, totals.impulse);
  numbers(way, totals.momentum);
  numbers(way, totals.volume_position);
  numbers(way, totals.volume_velocity);
}

/// Fields of DemLoad.
template <class Way, class Record> constexpr void load_fields(Way& way, Record& load) {
  way.plain(load.ranks);
  way.plain(load.max_particles);
  way.number(load.mean_seconds);
  way.number(load.max_seconds);
  way.number(load.between.waited);
  way.number(load.between.messages);
  way.number(load.between.operations);
  way.number(load.between.bytes);
}

/// All of a coupling step but the number and the length of its rows, which come first.
template <class Way, class Record> constexpr void coupling_step_fields(Way& way, Record& coupling_step) {
  way.quantities(coupling_step.needed);
  way.number(coupling_step.elapsed);
  way.number(coupling_step.dem_seconds);
  way.number(coupling_step.pack_seconds);
  way.plain(coupling_step.steps_done);
  way.plain(coupling_step.steps_total);
  way.plain(coupling_step.number);
  totals_fields(way, coupling_step.totals);
  load_fields(way, coupling_step.load);
}

// Lists and names carry their number first.

/// The number of entries, at most `most`; a reader refuses more than fit into the rest of the message at `least` bytes
/// each.
template <class Way, class List> constexpr void list_size(Way& way, List& list, std::uint64_t most, std::size_t least) {
  std::uint64_t count = list.size();
  way.plain(count);
  if constexpr (std::is_same_v<Way, Reader>) {
    if (count > most || count * least > way.left())
      broken("does not hold what it states");
    list.resize(count);
  }
}

/// A name of at most kMostName characters.
template <class Way, class Text> constexpr void name_field(Way& way, Text& name) {
  list_size(way, name, kMostName, 1);
  for (auto& letter : name)
    way.plain(letter);
}

/// Fields of PrimitiveWall.
template <class Way, class Record> constexpr void primitive_fields(Way& way, Record& wall) {
  name_field(way, wall.id);
  name_field(way, wall.name);
  auto form = static_cast<std::uint32_t>(wall.form);
  way.plain(form);
  if constexpr (std::is_same_v<Way, Reader>) {
    if (form > 1)
      broken("holds a wall of an unknown form");
    wall.form = static_cast<PrimitiveWall::Form>(form);
  }
  numbers(way, wall.point);
  numbers(way, wall.direction);
  way.number(wall.radius);
  numbers(way, wall.velocity);
  numbers(way, wall.angular_velocity);
}

/// Corners of triangles.
template <class Way, class List> constexpr void triangles(Way& way, List& list) {
  constexpr std::size_t kTriangleBytes = 9 * sizeof(double);
  list_size(way, list, kMostTriangles, kTriangleBytes);
  for (auto& triangle : list)
    for (auto& corner : triangle)
      numbers(way, corner);
}

/// Not of a fixed length.
template <class Way, class Record> constexpr void walls_fields(Way& way, Record& walls) {
  constexpr std::size_t kPrimitive = 2 * sizeof(std::uint64_t) + sizeof(std::uint32_t) + 13 * sizeof(double);
  constexpr std::size_t kMesh = 4 * sizeof(std::uint64_t) + 2 * sizeof(std::uint32_t);
  list_size(way, walls.primitives, kMostWalls, kPrimitive);
  for (auto& wall : walls.primitives)
    primitive_fields(way, wall);
  list_size(way, walls.meshes, kMostWalls, kMesh);
  for (auto& mesh : walls.meshes) {
    name_field(way, mesh.id);
    name_field(way, mesh.name);
    way.yes_or_no(mesh.moves);
    way.yes_or_no(mesh.velocity_known);
    triangles(way, mesh.corners);
    triangles(way, mesh.velocities);
    if (!mesh.velocities.empty() && mesh.velocities.size() != mesh.corners.size())
      broken("holds a wall mesh whose velocities are not those of its triangles");
  }
}

/// Bytes of a record, given its description: kBytes<DemTerms>(dem_terms_fields<Sizer, DemTerms>).
template <class Record> constexpr std::size_t bytes_of(void (*fields)(Sizer&, Record&)) {
  Sizer sizer;
  Record record{};
  fields(sizer, record);
  return sizer.bytes();
}

} // namespace eccentra::link::wire
