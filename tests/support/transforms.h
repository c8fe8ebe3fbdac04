// Domains that should give the same block mesh: vertices renumbered, turned, or moved by next to nothing.
#pragma once

#include <cmath>
#include <numeric>
#include <random>

#include "domain/domain.h"

namespace dualblock::test {

/// Applies `move` to every point of the domain.
template <int N, typename Move> Domain<N> moved(Domain<N> domain, Move move) {
  for (auto &v : domain.vertices) v = move(v);
  for (auto &h : domain.holes) h = move(h);
  for (auto &r : domain.regions) r.point = move(r.point);
  if (domain.reference) {
    for (auto &v : domain.reference->nodes) v = move(v);
    // The first nodes are the vertices: keep them so to the last bit.
    for (std::size_t v = 0; v < domain.vertices.size(); ++v) domain.reference->nodes[v] = domain.vertices[v];
  }
  return domain;
}

/// A rotation that maps no coordinate axis or plane onto one.
inline Domain<2> rotated(const Domain<2> &domain) {
  const double c = std::cos(0.7134);
  const double s = std::sin(0.7134);
  return moved(domain, [&](const Vec<2> &x) { return Vec<2>{c * x.x - s * x.y, s * x.x + c * x.y}; });
}

inline Domain<3> rotated(const Domain<3> &domain) {
  const Vec<3> axis = glm::normalize(Vec<3>{0.31, -0.83, 0.57});
  const double c = std::cos(1.0731);
  const double s = std::sin(1.0731);
  return moved(domain, [&](const Vec<3> &x) { // Rodrigues' formula
    return c * x + s * glm::cross(axis, x) + (1 - c) * glm::dot(axis, x) * axis;
  });
}

/// Each vertex moved by up to `relative` times the domain's size along each axis. The nodes of a given
/// reference mesh must stay on straight facets: there the whole domain is sheared by as little.
template <int N> Domain<N> perturbed(Domain<N> domain, double relative, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto step = [&] { return relative * (static_cast<double>(random()) / 2147483647.5 - 1); };
  const double size = domainSize(domain.vertices);
  if (!domain.reference) {
    for (auto &v : domain.vertices)
      for (int k = 0; k < N; ++k) v[k] += size * step();
    return domain;
  }
  std::array<Vec<N>, N> rows;
  for (int k = 0; k < N; ++k)
    for (int m = 0; m < N; ++m) rows[at(k)][m] = step();
  return moved(domain, [&](const Vec<N> &x) {
    Vec<N> y = x;
    for (int k = 0; k < N; ++k) y[k] += glm::dot(rows[at(k)], x);
    return y;
  });
}

/// Vertices and facets in another order, and each facet's loop begun elsewhere.
template <int N> Domain<N> renumbered(const Domain<N> &domain, std::uint32_t seed) {
  std::mt19937 random(seed);
  const std::size_t n = domain.vertices.size();
  std::vector<Index> to(n);
  std::iota(to.begin(), to.end(), 0);
  for (std::size_t k = n; k > 1; --k) std::swap(to[k - 1], to[random() % k]);
  Domain<N> result = domain;
  for (std::size_t v = 0; v < n; ++v) result.vertices[at(to[v])] = domain.vertices[v];
  for (Facet &facet : result.facets)
    for (auto &loop : facet.loops) {
      for (Index &v : loop) v = to[at(v)];
      // In 2D a loop is a segment with the domain on its left, and segments stand loop by loop.
      if (N == 3) std::rotate(loop.begin(), loop.begin() + random() % loop.size(), loop.end());
    }
  if (N == 3)
    for (std::size_t k = result.facets.size(); k > 1; --k)
      std::swap(result.facets[k - 1], result.facets[random() % k]);
  if (result.reference) {
    for (std::size_t v = 0; v < n; ++v) result.reference->nodes[at(to[v])] = domain.vertices[v];
    for (auto &simplex : result.reference->simplices)
      for (Index &v : simplex)
        if (at(v) < n) v = to[at(v)];
  }
  return result;
}

} // namespace dualblock::test
