// The paper's 2D matching rules (4.3) on contributions given one by one, hard or soft, whatever made them.
#pragma once

#include <string>

#include "contributions/contributions.h"
#include "domain/domain.h"

namespace dualblock {

/// A place where the rules are broken: on the edge between two nodes, at the point near the first.
struct MatchingFault {
  Index near, far;
  int hard; // hard contributions that arrive there, with those of the points that soft ones collapse it with
  std::string message;
};

/// Checks every matching point. A contribution touches an edge of its triangle at the point near node a when
/// its subset holds a but not the edge's other node. At an inner point as many hard contributions must arrive
/// from the left as from the right. Soft contributions collapse the points that they join into one virtual
/// point, where two or four hard ones must meet; and at each edge that it is on, those that arrive on the
/// left, at any of its points, must be as many as on the right. A boundary point takes one hard contribution
/// or none. Where all this holds, each D-bar-curve must cross another or itself: only there are blocks.
std::vector<MatchingFault> checkGivenContributions(const std::vector<std::array<Index, 3>> &triangles,
                                                   const std::vector<GivenContribution> &contributions);

/// The same as contributions of the reference mesh, for looking at; they belong to no side.
Contributions<2> givenContributions(const ReferenceMesh<2> &mesh,
                                    const std::vector<GivenContribution> &contributions);

} // namespace dualblock
