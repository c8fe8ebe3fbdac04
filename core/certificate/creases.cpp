// Where the blocks keep the domain's curves: edges at which the fan of blocks between two facets opens.
#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {

/// Turns around each edge of each block face on a facet, through the blocks, until another facet ends the
/// fan.
template <int N>
std::vector<Crease> findCreases(const CertificateInput<N> &in, const BlockComplex<N> &complex) {
  const auto key = [&](const BlockFace<N> &face) {
    return in.mesh.sideKey(in.parts.sides[at(face.side)].tag);
  };
  const auto mateOf = [&](Index f) { // the same face, seen from the other block
    if (f > 0 && complex.faces[at(f - 1)].key == complex.faces[at(f)].key) return f - 1;
    if (at(f + 1) < complex.faces.size() && complex.faces[at(f + 1)].key == complex.faces[at(f)].key)
      return f + 1;
    return kNone;
  };
  const auto holds = [](const BlockFace<N> &face, Index node) {
    return std::binary_search(face.key.begin(), face.key.end(), node);
  };
  std::vector<Crease> creases;
  for (const BlockFace<N> &start : complex.faces) {
    if (facetOf(in, start) == kNone) continue;
    for (std::size_t k = 0; k < start.cycle.size(); ++k) {
      const Index a = start.cycle[k];
      const Index b = N == 2 ? a : start.cycle[(k + 1) % start.cycle.size()];
      Index block = start.block;
      int from = start.local;
      Crease crease{{kNone, kNone}, {std::min(a, b), std::max(a, b)}, 0};
      while (at(crease.blocks) < in.primal.blocks.size()) {
        ++crease.blocks;
        Index across = kNone;
        for (int f = 0; f < 2 * N; ++f) {
          const Index face = complex.faceOf[at(2 * N * block + f)];
          if (f != from && holds(complex.faces[at(face)], a) && holds(complex.faces[at(face)], b))
            across = face;
        }
        if (across == kNone) break;
        if (facetOf(in, complex.faces[at(across)]) != kNone) {
          crease.keys = {key(start), key(complex.faces[at(across)])};
          break;
        }
        const Index next = mateOf(across);
        if (next == kNone) break; // no facet where there is no block: checkFacets says so
        block = complex.faces[at(next)].block;
        from = complex.faces[at(next)].local;
      }
      if (crease.keys[0] < crease.keys[1]) creases.push_back(crease); // each fan is met from both of its ends
    }
  }
  sortItems(creases);
  creases.erase(std::unique(creases.begin(), creases.end()), creases.end());
  return creases;
}

template std::vector<Crease> findCreases(const CertificateInput<2> &, const BlockComplex<2> &);
template std::vector<Crease> findCreases(const CertificateInput<3> &, const BlockComplex<3> &);

} // namespace dualblock
