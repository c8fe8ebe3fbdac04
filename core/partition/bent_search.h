// The search for cuts that make parts with bent sides simple, and then better (ARCHITECTURE.md 3, rule 3).
#pragma once

#include <functional>
#include <optional>

#include "partition/cost.h"
#include "partition/make_cut.h"
#include "partition/sources.h"

namespace dualblock {

/// What a cut is made for.
enum class CutReason : std::uint8_t { none, needed, shape };

/// One cut after another: all parts are simple before any is bettered. Where cuts are weighed, one that
/// spoils how sides join gives way to another that answers the same finding and spoils less. Where joints are
/// wrong in the end, whole rows of cuts are tried, best first.
class BentSearch {
public:
  /// Cuts reflex curves that earlier cuts have made, of the mesh's parts; returns the number of cuts.
  using CutReflex = std::function<Index(ReferenceMesh<3> &, const Parts<3> &)>;

  /// `parts`: of the mesh, before and after every step.
  BentSearch(ReferenceMesh<3> &mesh, Parts<3> &parts, BentCutOptions options, bool weighsCuts,
             CutReflex cutReflex);

  /// Cuts the first part for which a source has a cut. Components that gave up are passed over. Where all
  /// parts of a component are simple, further cuts only better their shape: one that leaves one that is not
  /// is taken back, and not tried again. Returns why a cut was made, if one was.
  CutReason step(const std::vector<bool> &gaveUp);

  /// The mesh and its parts before the last step that made a cut.
  ReferenceMesh<3> meshBefore;
  Parts<3> partsBefore;
  /// Per component, whether all parts are simple now.
  std::vector<bool> isSimple;
  /// Cuts of reflex curves that were kept.
  Index reflexCuts = 0;
  /// Whether a cut has spoilt a joint.
  bool hasSpoilt = false;

private:
  bool cutBy(std::span<const Source> sources, PartView &view);
  bool trySource(Source source, const PartView &view);
  bool cutReflexAgain();
  bool cutJoints();
  bool take(Parts<3> parts, const Cost &cost);

  ReferenceMesh<3> &mesh_;
  Parts<3> &parts_;
  BentCutOptions options_;
  bool weighsCuts_;
  CutReflex cutReflex_;
  std::vector<Plane<3>> refused_;
  std::size_t partsWithoutReflex_ = 0; // how many there were when no reflex curve was left
  Cost cost_;                          // of the parts
  bool triedJoints_ = false;
};

/// Per component, whether all its parts are simple.
std::vector<bool> simpleComponents(const ReferenceMesh<3> &mesh, const Parts<3> &parts);

} // namespace dualblock
