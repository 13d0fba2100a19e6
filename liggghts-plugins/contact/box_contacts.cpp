// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices of one box against the other's solid, then pairs of edges. Four numbers at a time: x, y, z and 0.
#include "contact/box_contacts.h"

#include "contact/hand_over.h"

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

namespace {

typedef long long Long4 __attribute__((vector_size(32)));

/// As in manifold.cpp.
constexpr double same_distance = 1e-9;
constexpr double may_have_crossed = 0.25;
/// Squared sine below which edges are parallel: the ends have it all.
constexpr double parallel = 1e-9;
/// Round-off of the squared distances by which ends are told to be out of reach.
constexpr double safely = 1e-9;

constexpr Long4 sign_bit = {1LL << 63, 1LL << 63, 1LL << 63, 1LL << 63};

inline double sum3(const Double4& v) {
  return v[0] + v[1] + v[2];
}
inline double dot3(const Double4& u, const Double4& v) {
  return sum3(u * v);
}
/// The sums of four vectors, whose fourth lanes are 0.
inline Double4 sums(const Double4& a, const Double4& b, const Double4& c, const Double4& d) {
  const Double4 ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7),
                cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}
inline Double4 magnitude(const Double4& v) {
  return reinterpret_cast<Double4>(reinterpret_cast<Long4>(v) & ~sign_bit);
}
/// v with the signs of `signs`; v >= 0.
inline Double4 with_signs(const Double4& v, const Double4& signs) {
  return reinterpret_cast<Double4>(reinterpret_cast<Long4>(v) | (reinterpret_cast<Long4>(signs) & sign_bit));
}
inline Double4 turned(const Double4* column, double x, double y, double z) {
  return column[0] * x + column[1] * y + column[2] * z;
}
inline Double4 vertex_of(const TurnedBox& box, int k) {
  return turned(box.column, box.core->x[k], box.core->y[k], box.core->z[k]);
}
/// Rows of the matrix with these columns.
inline void transpose(const Double4* column, Double4* row) {
  const Double4 zero = {0, 0, 0, 0};
  const Double4 low = __builtin_shufflevector(column[0], column[1], 0, 4, 2, 6),
                high = __builtin_shufflevector(column[0], column[1], 1, 5, 3, 7),
                low2 = __builtin_shufflevector(column[2], zero, 0, 4, 2, 6),
                high2 = __builtin_shufflevector(column[2], zero, 1, 5, 3, 7);
  row[0] = __builtin_shufflevector(low, low2, 0, 1, 4, 5);
  row[1] = __builtin_shufflevector(high, high2, 0, 1, 4, 5);
  row[2] = __builtin_shufflevector(low, low2, 2, 3, 6, 7);
}

} // namespace

double BoxContacts::gap() const {
  return std::sqrt(least_) - reach_;
}

const BoxContacts::Edges& BoxContacts::edges_of(const ContactCore& core) {
  for (const Edges& e : edges_)
    if (e.core == &core)
      return e;
  Edges e;
  e.core = &core;
  for (std::size_t k = 0; k < core.edges.size(); ++k) {
    const int from = core.edges[k][0], to = core.edges[k][1];
    const double p[3] = {core.x[from], core.y[from], core.z[from]}, q[3] = {core.x[to], core.y[to], core.z[to]};
    e.from[k] = from;
    e.to[k] = to;
    e.middle[k] = Double4{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2, 0};
    for (int d = 0; d < 3; ++d)
      if (p[d] * q[d] < 0 && std::abs(q[d] - p[d]) > core.half[d]) {
        e.axis[k] = d;
        e.half[k] = core.half[d];
        e.sign[k] = q[d] > p[d] ? 1 : -1;
      }
    e.middle[k][e.axis[k]] = 0;
  }
  edges_.push_back(e);
  return edges_.back();
}

void BoxContacts::find(const TurnedBox& a, const TurnedBox& b, const Double4& to_b, double reach, const int* ids,
                       int count) {
  constexpr int most = 5; // an edge with four corrections
  if (touches_.size() < static_cast<std::size_t>(most) * count)
    touches_.resize(2 * static_cast<std::size_t>(most) * count);
  count_ = 0;
  to_b_ = to_b;
  reach_ = reach;
  square_reach_ = reach * reach;
  least_ = std::numeric_limits<double>::max();
  elastic_ = false;
  losses_.clear();
  half_[0] = Double4{a.core->half[0], a.core->half[1], a.core->half[2], 0};
  half_[1] = Double4{b.core->half[0], b.core->half[1], b.core->half[2], 0};
  const int of_edges = feature_id(a.core->points, 0), of_b = feature_id(a.core->solid_feature(), 0),
            solids = feature_id(a.core->solid_feature(), b.core->solid_feature());
  int k = 0;
  if (count > 0 && ids[0] < of_edges) {
    transpose(b.column, rows_[1]);
    for (; k < count && ids[k] < of_edges; ++k)
      take_vertex<false>(a, b, feature_a(ids[k]), ids[k]);
  }
  const int first_edge = count_;
  if (k < count && ids[k] < of_b) {
    edges_of(*a.core); // may move the others
    const Edges& edges_b = edges_of(*b.core);
    const Edges& edges_a = edges_of(*a.core);
    for (; k < count && ids[k] < of_b; ++k)
      take_edge(a, b, edges_a, edges_b, ids[k]);
  }
  const int last_edge = count_;
  if (k < count && ids[k] < solids) {
    transpose(a.column, rows_[0]);
    for (; k < count && ids[k] < solids; ++k)
      take_vertex<true>(b, a, feature_b(ids[k]), ids[k]);
  }
  if (!losses_.empty())
    hand_over(first_edge, last_edge);
}

template <bool of_b> void BoxContacts::take_vertex(const TurnedBox& own, const TurnedBox& other, int vertex, int id) {
  const Double4 at = vertex_of(own, vertex), point = of_b ? at + to_b_ : at; // from A's centre
  const Double4 from = of_b ? point : at - to_b_;                            // from the solid's
  const Double4* row = rows_[!of_b];
  const Double4 local = row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
  const Double4 beyond = magnitude(local) - half_[!of_b], zero = {0, 0, 0, 0};
  const Double4 out = beyond > zero ? beyond : zero;
  const double square = dot3(out, out);
  least_ = std::min(least_, square);
  if (square >= square_reach_)
    return;
  double distance = std::sqrt(square);
  Double4 normal;
  if (square > 0) {
    normal = out * (1 / distance);
  } else { // inside, minus the depth under the nearest face
    const int k = beyond[0] >= beyond[1] ? (beyond[0] >= beyond[2] ? 0 : 2) : (beyond[1] >= beyond[2] ? 1 : 2);
    distance = beyond[k];
    normal = Double4{k == 0 ? 1. : 0., k == 1 ? 1. : 0., k == 2 ? 1. : 0., 0.};
  }
  normal = with_signs(normal, local);
  normal = turned(other.column, normal[0], normal[1], normal[2]);
  BoxTouch& t = touches_[count_++];
  t.normal = of_b ? -normal : normal;
  t.arm = of_b ? point - distance * normal : point;
  t.distance = distance;
  t.weight = 1;
  t.id = id;
  t.elastic = false;
}

void BoxContacts::take_edge(const TurnedBox& a, const TurnedBox& b, const Edges& edges_a, const Edges& edges_b,
                            int id) {
  const int i = feature_a(id) - a.core->points, j = feature_b(id) - b.core->points;
  // Points p + s u and q + t v from A's centre, u and v unit.
  const Double4 &middle_a = edges_a.middle[i], &middle_b = edges_b.middle[j];
  const Double4 p = turned(a.column, middle_a[0], middle_a[1], middle_a[2]),
                from_b = turned(b.column, middle_b[0], middle_b[1], middle_b[2]), q = from_b + to_b_, r = p - q,
                u = edges_a.sign[i] * a.column[edges_a.axis[i]], v = edges_b.sign[j] * b.column[edges_b.axis[j]];
  const double half_a = edges_a.half[i], half_b = edges_b.half[j];
  const Double4 dots = sums(u * v, u * r, v * r, r * r);
  const double uv = dots[0], ur = dots[1], vr = dots[2], rr = dots[3];
  const double det = 1 - uv * uv, sn = uv * vr - ur, tn = vr - uv * ur;
  if (!((det > parallel) & (std::abs(sn) < half_a * det) & (std::abs(tn) < half_b * det)))
    return; // an end is closest, and bounds the gap
  const double inverse = 1 / det;
  const Double4 on_a = p + sn * inverse * u, apart = on_a - (q + tn * inverse * v);
  const double square = dot3(apart, apart);
  least_ = std::min(least_, square);
  if (square >= square_reach_)
    return;
  double distance = std::sqrt(square);
  Double4 normal;
  if (distance > 0) {
    normal = apart * (1 / distance);
  } else {
    normal = Double4{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0], 0};
    normal /= std::sqrt(dot3(normal, normal));
  }
  // Edges that have passed each other: the normal still leads out of B and into A, from whose centres the edges stand
  // out.
  if (distance < may_have_crossed * reach_ && dot3(normal, from_b) < 0 && dot3(normal, p) > 0) {
    normal = -normal;
    distance = -distance;
  }
  double weight = 1;
  // Squared distances of the ends from the other edge: two of A, then two of B.
  const Double4 own = {-half_a, half_a, -half_b, half_b}, limit = {half_b, half_b, half_a, half_a},
                closest = Double4{vr, vr, -ur, -ur} + own * uv, upper = closest < limit ? closest : limit,
                at = upper > -limit ? upper : -limit;
  const Double4 squares = rr + own * (own + 2 * Double4{ur, ur, -vr, -vr}) + at * (at - 2 * closest);
  const double far = square_reach_ + safely * rr;
  if ((squares[0] < far) | (squares[1] < far) | (squares[2] < far) | (squares[3] < far)) {
    const Double4 end[4] = {p - half_a * u, p + half_a * u, q - half_b * v, q + half_b * v},
                  on[4] = {q + at[0] * v, q + at[1] * v, p + at[2] * u, p + at[3] * u};
    double end_distance[4], overlap[4];
    for (int k = 0; k < 4; ++k) {
      const Double4 out = end[k] - on[k];
      end_distance[k] = std::sqrt(dot3(out, out));
      overlap[k] = reach_ - end_distance[k];
    }
    const HandOver<4> share(reach_ - distance, overlap);
    weight = share.line;
    const int vertex[4] = {edges_a.from[i], edges_a.to[i], edges_b.from[j], edges_b.to[j]};
    for (int k = 0; k < 4; ++k) {
      if (share.loss[k] < no_weight)
        continue;
      const bool of_a = k < 2;
      const Double4 out = of_a ? end[k] - on[k] : on[k] - end[k];
      losses_.push_back(
          {vertex[k],
           of_a,
           end_distance[k],
           share.loss[k],
           {end_distance[k] > 0 ? out / end_distance[k] : normal, of_a ? end[k] : on[k], end_distance[k],
            -share.loss[k], of_a ? feature_id(vertex[k], feature_b(id)) : feature_id(feature_a(id), vertex[k]), true}});
    }
  }
  if (weight <= no_weight)
    return;
  BoxTouch& t = touches_[count_++];
  t.normal = normal;
  t.arm = on_a;
  t.distance = distance;
  t.weight = weight;
  t.id = id;
  t.elastic = false;
}

/// Takes what edges have taken over from the springs of their ends; drops contacts that have handed all of their spring
/// over. Those that owe more are elastic corrections. Contacts of edges are first .. last - 1. Ids ascend.
void BoxContacts::hand_over(int first, int last) {
  const int vertices = count_;
  for (const Loss& l : losses_) {
    // An end in reach of the edge is in reach of the solid. Where that edge is what the solid has closest to the
    // vertex, the vertex's own contact loses the weight.
    int own = l.of_a ? 0 : last;
    const int behind = l.of_a ? first : vertices;
    while (own < behind && (l.of_a ? feature_a(touches_[own].id) : feature_b(touches_[own].id)) != l.vertex)
      ++own;
    if (own < behind && touches_[own].distance > l.distance - same_distance * reach_)
      touches_[own].weight -= l.loss;
    else
      touches_[count_++] = l.correction;
  }
  int kept = 0;
  for (int k = 0; k < count_; ++k) {
    BoxTouch c = touches_[k];
    if (std::abs(c.weight) < no_weight)
      continue;
    c.elastic |= c.weight < 0;
    elastic_ |= c.elastic;
    int place = kept++;
    for (; place > 0 && c.id < touches_[place - 1].id; --place)
      touches_[place] = touches_[place - 1];
    touches_[place] = c;
  }
  count_ = kept;
}

} // namespace eccentra::contact
