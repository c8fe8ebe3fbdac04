// Sheets: cuts through curves that no plane holds (ARCHITECTURE.md 3, rule 1). Internal to parts/.
#pragma once

#include <limits>

#include "partition/sources/sectors.h"

namespace dualblock {

/// Where a sheet leaves a curve.
struct SheetStart {
  const Curve<3> &curve;
  std::span<const std::size_t> run; // of the curve's ridges
  std::vector<double> directions;   // per ridge of the run: from the curve's first side
  DirectionRange range;             // how far the directions may turn so that the sheet ends in another curve
  double reach = std::numeric_limits<double>::infinity(); // Sweep
  double slope = 0;
  double depth = 1;
};

/// The mean of the angles along a run.
template <int N> double meanAngle(const Curve<N> &curve, std::span<const std::size_t> run) {
  double mean = 0;
  for (const std::size_t k : run) mean += curve.frames[k].angle / static_cast<double>(run.size());
  return mean;
}

/// A dish: it leaves a closed curve half way between the curve's sides and soon runs level with it, so that
/// the dishes of several rims keep apart. Nothing where it would be steep.
std::optional<SheetStart> dishFrom(const ReferenceMesh<3> &mesh, const Curve<3> &curve,
                                   std::span<const std::size_t> run);

/// How far a sheet in the place of a sector's plane may turn.
DirectionRange rangeOfSheet(const Curve<3> &curve, std::span<const std::size_t> run, std::size_t sector);

/// The sheet; where another closed curve of the part wants one, too, it runs from the one to the other:
/// sheets that miss a curve by little leave parts like shavings.
std::shared_ptr<const CutField<3>> sheetThrough(const ReferenceMesh<3> &mesh, const SheetStart &start,
                                                std::span<const Curve<3>> curves);

} // namespace dualblock
