// Check 1: the matching rules of the paper's section 4.3. On each face of the reference mesh a contribution
// leaves a trace: the subset of the face's nodes that it is cut off around. At every trace on an inner face
// the same D-bar-surfaces must arrive from both sides. On a face of the boundary at most one arrives at a
// trace, or two around a corner (ARCHITECTURE.md 6).
#include <bit>

#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {
namespace {

/// The mask over the face's nodes in ascending order of node number, then the surface, in one number.
using Trace = std::uint64_t;

/// Each simplex's vertices by the order of their node numbers, which its neighbours see alike.
template <int N> struct Ranks {
  std::vector<std::array<std::uint8_t, N + 1>> ofVertex; // per simplex
  std::vector<std::uint8_t> masks;                       // per contribution: its vertices' ranks

  explicit Ranks(const CertificateInput<N> &in) : ofVertex(in.mesh.simplices.size()) {
    masks.reserve(in.contributions.ofSimplex.items.size());
    for (Index s = 0; s < in.mesh.simplexCount(); ++s) {
      auto &rank = ofVertex[at(s)];
      const auto &nodes = in.mesh.simplices[at(s)];
      for (int v = 0; v < N + 1; ++v)
        for (int w = 0; w < N + 1; ++w)
          if (nodes[w] < nodes[v]) ++rank[at(v)];
      const Contribution *const end = in.contributions.ofSimplex.end(s);
      for (const Contribution *c = in.contributions.ofSimplex.begin(s); c != end; ++c) {
        unsigned mask = 0;
        for (int v = 0; v < N + 1; ++v)
          if (c->mask >> v & 1) mask |= 1U << rank[at(v)];
        masks.push_back(static_cast<std::uint8_t>(mask));
      }
    }
  }
};

template <int N>
void tracesOn(const CertificateInput<N> &in, const Ranks<N> &ranks, Index s, int face,
              std::vector<Trace> &traces) {
  traces.clear();
  const unsigned off = ranks.ofVertex[at(s)][at(face)];
  const Lists<Contribution> &all = in.contributions.ofSimplex;
  for (std::size_t c = at(all.offsets[at(s)]); c < at(all.offsets[at(s) + 1]); ++c) {
    const unsigned mask = ranks.masks[c];
    const unsigned onFace = (mask & ((1U << off) - 1)) | (mask >> (off + 1)) << off;
    if (onFace == 0 || onFace == (1U << N) - 1) continue; // misses the face, or runs parallel to it
    traces.push_back(Trace{onFace} << 32 | at(in.surfaces.ofSide[at(all.items[c].side)]));
  }
}

/// Whether a node of the mask is a corner of the part at which all of these sides meet.
template <int N>
bool hasCorner(const CertificateInput<N> &in, Index s, unsigned mask, const std::array<Index, 3> &sides) {
  const Index part = in.parts.partOfSimplex[at(s)];
  for (int v = 0; v < N + 1; ++v) {
    if ((mask >> v & 1) == 0) continue;
    const std::array<Index, 2> wanted{part, in.mesh.simplices[at(s)][v]};
    const auto corner = std::lower_bound(in.parts.corners.begin(), in.parts.corners.end(), wanted,
                                         [](const Corner &c, const std::array<Index, 2> &w) {
                                           return std::array{c.part, c.node} < w;
                                         });
    if (corner == in.parts.corners.end() || std::array{corner->part, corner->node} != wanted) continue;
    if (std::all_of(sides.begin(), sides.end(), [&](Index side) {
          return std::binary_search(corner->sides.begin(), corner->sides.end(), side);
        }))
      return true;
  }
  return false;
}

/// Face i of s, on the boundary. That at its edges the same D-bar-surfaces arrive from the next face of the
/// boundary needs no check: all contributions that part an edge's nodes leave traces on both faces of their
/// simplex that have it, so it follows from the inner faces around the edge.
template <int N>
void checkBoundaryFace(const CertificateInput<N> &in, Index s, int i, Certificate &certificate) {
  const auto fail = [&](const char *message) {
    certificate.fail(Check::matching, message, {{"simplex", s}});
  };
  const Contribution *const begin = in.contributions.ofSimplex.begin(s);
  const Contribution *const end = in.contributions.ofSimplex.end(s);
  const unsigned all = RegionTables<N>::kFullMask & ~(1U << i);
  Index own = kNone;
  for (const Contribution *c = begin; c != end; ++c)
    if ((c->mask & all) == all) own = c->side;
  if (own == kNone) return fail("no D-bar-surface runs along a face of the boundary");
  for (const Contribution *c = begin; c != end; ++c) {
    const unsigned trace = c->mask & all;
    int others = 0; // that leave the same trace
    for (const Contribution *d = c + 1; d != end; ++d) {
      // A D-bar-surface may cross itself on the boundary, where it comes back from around a hole, but as the
      // sides that it belongs to there are two, a side has one contribution.
      if (c->side == d->side) fail("a side has two contributions in one simplex of the boundary");
      if (trace == 0 || (d->mask & all) != trace) continue;
      ++others;
      if (trace == all) fail("two D-bar-surfaces run along one face of the boundary");
      else if (others > N - 2) fail("too many D-bar-surfaces arrive together at a face of the boundary");
      else if (!hasCorner(in, s, trace, {own, c->side, d->side}))
        fail("two D-bar-surfaces arrive together at a face of the boundary, and at no corner");
    }
  }
}

} // namespace

template <int N> void checkMatching(const CertificateInput<N> &in, Certificate &certificate) {
  const Ranks<N> ranks(in);
  std::vector<Trace> left;
  std::vector<Trace> right;
  for (const NotFull &n : in.contributions.notFull)
    certificate.fail(Check::matching, "a simplex touches a side that it should share a face with",
                     {{"simplex", n.simplex}});
  for (Index s = 0; s < in.mesh.simplexCount(); ++s) {
    const bool empty = in.contributions.ofSimplex.size(s) == 0;
    for (int i = 0; i < N + 1; ++i) {
      const Index t = in.mesh.neighbors[at(s)][i];
      if (t == kNone) {
        checkBoundaryFace(in, s, i, certificate);
        continue;
      }
      if (t < s || (empty && in.contributions.ofSimplex.size(t) == 0)) continue;
      int k = 0; // the face of t towards s: opposite to the vertex that s lacks
      for (int v = 0; v < N + 1; ++v) {
        const auto &mine = in.mesh.simplices[at(s)];
        if (std::find(mine.begin(), mine.end(), in.mesh.simplices[at(t)][v]) == mine.end()) k = v;
      }
      tracesOn(in, ranks, s, i, left);
      tracesOn(in, ranks, t, k, right);
      if (left == right) continue; // within a part, where both list the same sides
      sortItems(left);
      sortItems(right);
      if (left != right)
        certificate.fail(Check::matching, "the D-bar-surfaces that arrive at a face from both sides differ",
                         {{"simplex", s}, {"simplex", t}});
    }
  }
}

template void checkMatching(const CertificateInput<2> &, Certificate &);
template void checkMatching(const CertificateInput<3> &, Certificate &);

} // namespace dualblock
