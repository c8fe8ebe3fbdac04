// Finding a ridge again after cuts have divided it. Internal to parts/.
#pragma once

#include <optional>

#include "reference/reference_mesh.h"

namespace dualblock {

/// What faces `from` and `to` of a simplex share.
template <int N> struct Ridge {
  Index simplex;
  int from, to;
};

/// The ridge at `node`, towards `goal`, that leads from a face with tag f to one with tag g, turning through
/// surfaces numbered from crossFrom on. It is looked up by identity, since earlier cuts may have divided it.
template <int N>
std::optional<Ridge<N>> findRidge(const ReferenceMesh<N> &mesh, Index node, Index goal, Index f, Index g,
                                  Index crossFrom) {
  std::optional<Ridge<N>> best;
  double bestCosine = 0.5;
  visitStar(mesh, node, [&](Index s) {
    const int local = mesh.localVertex(s, node);
    for (int i = 0; i < N + 1; ++i) {
      if (i == local || mesh.tags[at(s)][i] != f) continue;
      for (int k = 0; k < N + 1; ++k) {
        if (k == i || k == local) continue;
        const FaceRef<N> end = turnAroundRidge(mesh, s, i, k, crossFrom, [](Index) {});
        if (mesh.tags[at(end.simplex)][end.face] != g) continue;
        double cosine = 1;
        if constexpr (N == 3) {
          const Index other = mesh.simplices[at(s)][6 - i - k - local];
          cosine = glm::dot(glm::normalize(mesh.nodes[at(other)] - mesh.nodes[at(node)]),
                            glm::normalize(mesh.nodes[at(goal)] - mesh.nodes[at(node)]));
        }
        if (cosine <= bestCosine) continue;
        best = Ridge<N>{s, i, k};
        if (cosine > 1 - 1e-12) return true; // no other leads there
        bestCosine = cosine;
      }
    }
    return false;
  });
  return best;
}

} // namespace dualblock
