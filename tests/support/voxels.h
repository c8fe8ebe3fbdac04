// Domains made of unit cubes, as surfaces, for one solid or several that share facets.
#pragma once

#include <functional>
#include <map>

#include "domain/domain.h"

namespace dualblock::test {

/// The cells of an n^3 grid whose `label(i, j, k)` is not 0, with a facet wherever the label changes. Between
/// two labels the facet is there once, seen from the lower cell.
inline Domain<3> voxelDomain(int n, const std::function<int(int, int, int)> &label) {
  Domain<3> domain;
  std::map<std::array<int, 3>, Index> vertices;
  const auto vertex = [&](std::array<int, 3> x) {
    const auto [at, isNew] = vertices.emplace(x, toIndex(domain.vertices.size()));
    if (isNew) domain.vertices.emplace_back(x[0], x[1], x[2]);
    return at->second;
  };
  const auto labelOf = [&](std::array<int, 3> c) {
    for (const int x : c)
      if (x < 0 || x >= n) return 0;
    return label(c[0], c[1], c[2]);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const std::array<int, 3> cell{i, j, k};
        const int here = labelOf(cell);
        if (here == 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (int far = 0; far < 2; ++far) {
            std::array<int, 3> next = cell;
            next[axis] += far ? 1 : -1;
            const int there = labelOf(next);
            if (there == here || (there != 0 && far == 0)) continue;
            std::vector<Index> loop;
            for (const auto &[a, b] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
              std::array<int, 3> corner = cell;
              corner[axis] += far;
              corner[(axis + 1) % 3] += far ? a : b;
              corner[(axis + 2) % 3] += far ? b : a;
              loop.push_back(vertex(corner));
            }
            domain.facets.push_back({{loop}});
          }
      }
  return domain;
}

/// Bars of one cell's width along all three axes, `step` cells apart, in an n^3 grid.
inline Domain<3> scaffold(int n, int step) {
  Domain<3> domain = voxelDomain(
      n, [step](int i, int j, int k) { return (i % step == 0) + (j % step == 0) + (k % step == 0) >= 2; });
  domain.name = "scaffold";
  return domain;
}

} // namespace dualblock::test
