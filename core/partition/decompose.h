// Which faces to split along (ARCHITECTURE.md 3, rules 1 and 2): plane cuts through reflex curves, then
// through vertices of parts where more than N sides meet.
#pragma once

#include <functional>
#include <optional>

#include "partition/cut_options.h"
#include "partition/fills/pull.h"
#include "parts/features.h"

namespace dualblock {

struct DecomposeOptions : CutOptions {
  std::vector<CutPolicy> policies;         // per component; empty: the default for all
  Index simplexLimit = 0;                  // give up when the mesh has more; 0: no limit
  Apex apex = Apex::corner;                // of the parts that are pulled
  std::function<double(Index)> blockLimit; // of a component: give up when its parts would give more blocks
                                           // than this; asked for only where vertices have to be cut
};

/// A mesh and its parts, before cuts that only better the shape of parts.
struct EarlyParts {
  ReferenceMesh<3> mesh;
  Parts<3> parts;
  Index bentCuts;
};

template <int N> struct Decomposition {
  Parts<N> parts;
  Index reflexCuts = 0;              // split surfaces added by rule 1
  Index vertexCuts = 0;              // by rule 2
  Index bentCuts = 0;                // by rule 3
  std::optional<PulledMesh> pulled;  // of the parts before rule 2, where that had something to do
  std::shared_ptr<EarlyParts> early; // where bent parts were simple before the last of their cuts
  std::vector<bool> gaveUp; // per component: the block limit was reached, or cuts multiplied the simplices
};

/// Cuts `mesh`, whose parts are `uncut`, into more parts. Reflex curves get the number of sectors that their
/// type asks for (paper 2.4); afterwards vertices are cut until every part is simple, or no cut is left that
/// helps.
template <int N>
Decomposition<N> decompose(ReferenceMesh<N> &mesh, const Parts<N> &uncut, DecomposeOptions options);

/// Goes back to the parts before those cuts.
void takeEarly(ReferenceMesh<3> &mesh, Decomposition<3> &decomposition);

extern template Decomposition<2> decompose(ReferenceMesh<2> &, const Parts<2> &, DecomposeOptions);
extern template Decomposition<3> decompose(ReferenceMesh<3> &, const Parts<3> &, DecomposeOptions);

} // namespace dualblock
