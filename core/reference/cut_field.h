// What a cut follows: a function of the place whose zero set the split surface takes (ARCHITECTURE.md 3). A
// plane is the usual one; bent sides ask for bent cuts.
#pragma once

#include <memory>

#include "base/plane.h"
#include "base/types.h"

namespace dualblock {

/// A straight piece of a chain, from one end to the other. In 2D chains of segments are as good as in 3D.
template <int N> using Segment = std::array<Vec<N>, 2>;

template <int N> class CutField {
public:
  CutField() = default;
  CutField(const CutField &) = delete;
  CutField &operator=(const CutField &) = delete;
  virtual ~CutField() = default;

  /// In units of length near the zero set; its sign tells the sides apart.
  virtual double value(const Vec<N> &x) const = 0;

  /// Whether x, within the tolerance, is on the curve that the zero set has to hold, if there is one.
  virtual bool isAnchor(const Vec<N> & /*x*/, double /*tolerance*/) const { return false; }
};

/// A direction across a chain, and the normal beside it.
template <int N> struct Heading { Vec<N> ahead, normal; };

/// A sheet that leaves a chain ahead, into the domain: the extension of a bent side beyond a curve. It ends
/// at the chain. Between the ends of a segment the heading turns from the one to the other, so that the sheet
/// has no steps.
template <int N> struct Sweep {
  std::vector<Segment<N>> segments;
  std::vector<std::array<Heading<N>, 2>> headings; // per segment: at both ends
  std::vector<double> gaps; // per segment: the angle, from ahead towards the normal and below 2 pi, at which
                            // the outside begins to be the other side's
  double reach;             // how far ahead it goes
  double slope = 0;         // with which it sinks below its headings at the chain, away from the normal,
  double depth = 1;         // to this times the slope far ahead
};

/// Its field.
template <int N> class SweptField final : public CutField<N> {
public:
  explicit SweptField(Sweep<N> sweep) : sweep_(std::move(sweep)) {}
  double value(const Vec<N> &x) const override;
  bool isAnchor(const Vec<N> &x, double tolerance) const override;

private:
  Sweep<N> sweep_;
};

/// The distance to one chain less that to another: its zero set runs between the two.
template <int N> class MiddleField final : public CutField<N> {
public:
  MiddleField(std::vector<Segment<N>> first, std::vector<Segment<N>> second)
      : first_(std::move(first)), second_(std::move(second)) {}
  double value(const Vec<N> &x) const override;

private:
  std::vector<Segment<N>> first_, second_;
};

/// Where the field vanishes between a and b, from 0 at a to 1 at b, given its values there, of unlike signs.
template <int N>
double rootBetween(const CutField<N> &field, const Vec<N> &a, const Vec<N> &b, double va, double vb);

/// Where a segment is nearest to a point, from 0 to 1.
template <int N> double nearestOn(const Segment<N> &segment, const Vec<N> &x);

/// Distance of a point from a segment.
template <int N> double distanceTo(const Segment<N> &segment, const Vec<N> &x);

extern template class SweptField<3>;
extern template class MiddleField<3>;
extern template double rootBetween<3>(const CutField<3> &, const Vec<3> &, const Vec<3> &, double, double);
extern template double nearestOn<3>(const Segment<3> &, const Vec<3> &);
extern template double distanceTo<3>(const Segment<3> &, const Vec<3> &);

} // namespace dualblock
