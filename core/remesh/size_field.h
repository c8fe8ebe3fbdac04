// How long edges should be on the boundary of a domain: by how it bends, how thick it is, and how near its
// curves are.
#pragma once

#include <optional>

#include "base/box_tree.h"
#include "parts/parts.h"

namespace dualblock {

class SizeField {
public:
  /// mesh: without split surfaces; `features`: its parts.
  SizeField(const ReferenceMesh<3> &mesh, const Parts<3> &features, double scale);

  double largest() const { return largest_; }
  double smallest() const { return smallest_; }
  /// Of a point on a side (half of ReferenceMesh::sideKey); `inward`: into the domain, a unit vector.
  double onSide(Index patch, const Vec<3> &x) const;
  /// Of a point on a curve between two sides.
  double onCurve(std::array<Index, 2> patches, const Vec<3> &x) const;

private:
  struct Face {
    std::array<Vec<3>, 3> x;
    Vec<3> inward;
    Index patch;
    double bend; // 1 / radius
  };
  struct CurveSegment {
    Segment<3> ends;
    Index curve; // its number
    std::array<Index, 2> patches;
    double bend;
    double length;                // of the whole curve
    std::array<Index, 2> corners; // nodes at the curve's ends, or kNone
  };

  void readFaces(const ReferenceMesh<3> &mesh);
  void readCurves(const ReferenceMesh<3> &mesh, const Parts<3> &features);
  double thicknessAt(const Vec<3> &x, const Vec<3> &inward, Index patch) const;
  Index nearestSegment(std::array<Index, 2> patches, const Vec<3> &x) const;
  double sizeOf(const CurveSegment &segment) const;
  double bounded(double size) const { return std::clamp(factor_ * size, smallest_, largest_); }

  double largest_, smallest_, scale_;
  double factor_; // of all sizes
  std::vector<Face> faces_;
  std::vector<CurveSegment> segments_;
  std::optional<BoxTree> faceTree_, segmentTree_;
};

} // namespace dualblock
