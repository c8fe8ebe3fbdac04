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

/// The planes of a chain's segments, each where its segment is the nearest: the extension of a bent side
/// beyond a curve. It vanishes along the chain.
template <int N> class SweptField final : public CutField<N> {
public:
  /// planes[k] holds segments[k].
  SweptField(std::vector<Segment<N>> segments, std::vector<Plane<N>> planes)
      : segments_(std::move(segments)), planes_(std::move(planes)) {}
  double value(const Vec<N> &x) const override;
  bool isAnchor(const Vec<N> &x, double tolerance) const override;

private:
  std::vector<Segment<N>> segments_;
  std::vector<Plane<N>> planes_;
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
template <int N> double rootBetween(const CutField<N> &field, const Vec<N> &a, const Vec<N> &b, double va, double vb);

/// Distance of a point from a segment.
template <int N> double distanceTo(const Segment<N> &segment, const Vec<N> &x);

extern template class SweptField<2>;
extern template class SweptField<3>;
extern template class MiddleField<2>;
extern template class MiddleField<3>;
extern template double rootBetween<2>(const CutField<2> &, const Vec<2> &, const Vec<2> &, double, double);
extern template double rootBetween<3>(const CutField<3> &, const Vec<3> &, const Vec<3> &, double, double);
extern template double distanceTo<2>(const Segment<2> &, const Vec<2> &);
extern template double distanceTo<3>(const Segment<3> &, const Vec<3> &);

} // namespace dualblock
