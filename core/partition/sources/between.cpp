// Cuts between the curves that two sides meet in.
#include <limits>

#include "partition/heuristics.h"
#include "partition/sources.h"

namespace dualblock {
namespace {

/// Whether all of one chain is behind a plane and all of the other in front.
bool isBetween(const Plane<3> &plane, const std::vector<Segment<3>> &behind,
               const std::vector<Segment<3>> &front, double tolerance) {
  const auto isOn = [&](const std::vector<Segment<3>> &chain, double sign) {
    return std::all_of(chain.begin(), chain.end(), [&](const Segment<3> &s) {
      return sign * plane.distance(s[0]) > tolerance && sign * plane.distance(s[1]) > tolerance;
    });
  };
  return isOn(behind, -1) && isOn(front, 1);
}

/// Of the planes through axes of the domain the one that is most like a given one and lies between two
/// chains; along the coordinate axes where it is nearly so.
std::optional<Plane<3>> planeBetween(const PartView &v, const Plane<3> &given,
                                     const std::vector<Segment<3>> &behind,
                                     const std::vector<Segment<3>> &front) {
  std::optional<Plane<3>> best;
  double most = kLikeCosine;
  for (const Axis &axis : v.axes) {
    std::vector<Vec<3>> normals{given.normal};
    for (int k = 0; k < 3; ++k) {
      Vec<3> unit{0.0};
      unit[k] = given.normal[k] < 0 ? -1 : 1;
      normals.push_back(unit);
    }
    for (std::size_t k = normals.size(); k-- > 0;) {
      const Vec<3> flat = normals[k] - glm::dot(normals[k], axis.direction) * axis.direction;
      const double cosine = glm::dot(flat, given.normal);
      if (cosine <= most) continue;
      const Plane<3> plane = planeThrough(axis.centre, flat);
      if (!isBetween(plane, behind, front, 1e-3 * v.mesh.size)) continue;
      most = cosine;
      best = plane;
    }
  }
  return best;
}

/// Two sides that meet in several curves: between the first of them and the others.
Cut separate(const PartView &v, const std::vector<Chain> &chains) {
  Cut cut{planeSurface({}, {0, 0, 1}), {}};
  std::vector<Segment<3>> first = segmentsOf(chains[0], v.mesh.nodes);
  std::vector<Segment<3>> others;
  for (std::size_t c = 1; c < chains.size(); ++c) {
    const auto more = segmentsOf(chains[c], v.mesh.nodes);
    others.insert(others.end(), more.begin(), more.end());
  }
  // Mirror images lie on both sides of a plane: better than a field, which is no plane between its nodes.
  const auto centre = [](const std::vector<Segment<3>> &chain) {
    Vec<3> sum{0.0};
    double length = 0;
    for (const Segment<3> &s : chain) {
      const double l = glm::length(s[1] - s[0]);
      sum += 0.5 * l * (s[0] + s[1]);
      length += l;
    }
    return sum / length;
  };
  const Vec<3> a = centre(first);
  const Vec<3> b = centre(others);
  if (glm::length(b - a) > kOnAxis * v.mesh.size) {
    const Plane<3> plane = planeThrough((a + b) / 2.0, b - a);
    cut.surface.plane = plane;
    bool mirrored = true;
    for (const Segment<3> &s : first)
      for (const Vec<3> &x : s) {
        double least = std::numeric_limits<double>::infinity();
        const Vec<3> image = x - 2 * plane.distance(x) * plane.normal;
        for (const Segment<3> &o : others) least = std::min(least, distanceTo<3>(o, image));
        mirrored &= least <= kMirrored * v.mesh.size;
      }
    if (mirrored) return cut;
    if (const auto between = planeBetween(v, plane, first, others)) {
      cut.surface.plane = *between;
      return cut;
    }
  }
  cut.surface.bent = true;
  cut.surface.field = std::make_shared<MiddleField<3>>(std::move(first), std::move(others));
  return cut;
}

} // namespace

std::vector<Cut> betweenCurves(const PartView &v) {
  std::vector<Cut> list;
  if (!v.hasBentSide()) return list;
  for (const Curve<3> *curve : v.curves)
    if (const std::vector<Chain> chains = chainsOf(*curve); chains.size() > 1)
      list.push_back(separate(v, chains));
  return list;
}

} // namespace dualblock
