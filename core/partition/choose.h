// Which cuts a component gets, and where simplices serve it better (ARCHITECTURE.md 3, rule 4): whatever
// gives fewest blocks, then the least distorted ones.
#pragma once

#include "partition/decompose.h"
#include "partition/fills/mixed_mesh.h"

namespace dualblock {

/// What parts can be judged by before there is a mesh.
struct Score {
  double blocks = 0;
  double worstSine = 1; // smallest sine of an angle between two sides of a part

  void add(const Score &o) {
    blocks += o.blocks;
    worstSine = std::min(worstSine, o.worstSine);
  }
  bool operator==(const Score &) const = default;
};

/// What a policy of cutting comes to for the whole domain, simplices in place of cuts that do not serve.
struct CutTrial : Score {
  CutPolicy policy;
  Index components = 0; // that took it
};

/// Whether the policy was tried that is left where no other serves.
inline bool hasLastPolicy(const std::vector<CutTrial> &trials) {
  return std::any_of(trials.begin(), trials.end(), [](const CutTrial &t) { return t.policy.isLast; });
}

template <int N> struct PartChoice {
  Decomposition<N> decomposition;
  std::vector<PartSource> source; // per component
  Score score;
  std::vector<CutTrial> trials;
  std::string whySimplices; // of the first component that does without cuts, or empty
  /// Blocks that cuts alone, the confined fallback and the reference simplices would give, as far as they
  /// were counted to choose between them: infinity where they give no valid mesh, below 0 where nobody asked.
  std::array<double, 3> alternatives{-1, -1, -1};
};

/// A mesh whose simplices the fallback takes, made when it is first asked for; null if it cannot be made.
template <int N> using CoarseMesh = std::function<const ReferenceMesh<N> *()>;

/// Cuts `mesh`, whose parts are `uncut`, by the policies that suit its components best. Where they are cheap
/// to try, and could differ, all of them are tried: on the coarsest mesh unless `isCoarse`, as the mesh is
/// that one, or there are bent sides, which a finer mesh cuts better. So what is cheap is so for every mesh.
template <int N>
PartChoice<N> chooseParts(ReferenceMesh<N> &mesh, const Parts<N> &uncut, const CutOptions &options,
                          const CoarseMesh<N> &coarse, bool isCoarse);

enum class Proposals : std::uint8_t { all, last };

/// A mesh that has been cut, and the choice of parts that goes with it.
template <int N> struct PartProposal {
  ReferenceMesh<N> mesh;
  PartChoice<N> choice;
};

/// What the parts could be other than `chosen`, whatever the number of blocks: by each policy the cut parts,
/// simplices in place of those that are not simple, from every apex, and the reference
/// simplices; nothing where that would not be cheap to try. Or, for parts that have been refused, only those
/// of the last policy, which needs more simplices.
template <int N>
std::vector<PartProposal<N>> proposeParts(const ReferenceMesh<N> &mesh, const Parts<N> &uncut,
                                          const CutOptions &options, const CoarseMesh<N> &coarse,
                                          const Score &chosen, Proposals which);

extern template PartChoice<2> chooseParts(ReferenceMesh<2> &, const Parts<2> &, const CutOptions &,
                                          const CoarseMesh<2> &, bool);
extern template PartChoice<3> chooseParts(ReferenceMesh<3> &, const Parts<3> &, const CutOptions &,
                                          const CoarseMesh<3> &, bool);
extern template std::vector<PartProposal<2>> proposeParts(const ReferenceMesh<2> &, const Parts<2> &,
                                                          const CutOptions &, const CoarseMesh<2> &,
                                                          const Score &, Proposals);
extern template std::vector<PartProposal<3>> proposeParts(const ReferenceMesh<3> &, const Parts<3> &,
                                                          const CutOptions &, const CoarseMesh<3> &,
                                                          const Score &, Proposals);

} // namespace dualblock
