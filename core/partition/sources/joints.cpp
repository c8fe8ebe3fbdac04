// Cuts where sides join: through corners of too many sides, and through places where the side behind one of
// the part's has a corner that the part lacks.
#include "base/sort.h"
#include "partition/heuristics.h"
#include "partition/sources.h"
#include "parts/place.h"

namespace dualblock {
namespace {

/// Directions that differ, either way round or not.
void addDirection(std::vector<Vec<3>> &list, const Vec<3> &direction, bool isLine) {
  const double length = glm::length(direction);
  if (!(length > kSameJoint)) return;
  const Vec<3> unit = direction / length;
  for (const Vec<3> &known : list) {
    const double cosine = glm::dot(known, unit);
    if ((isLine ? std::abs(cosine) : cosine) > 1 - kSameJointCosine) return;
  }
  list.push_back(unit);
}

/// In which the curves of all parts leave a node, at once and in the end.
std::vector<Vec<3>> directionsAt(const PartView &v, Index node) {
  std::vector<Vec<3>> directions;
  for (const Curve<3> &curve : v.parts.curves) {
    bool isHere = false;
    for (const auto &[a, b] : curve.ridges) {
      if (a != node && b != node) continue;
      isHere = true;
      addDirection(directions, v.node(a == node ? b : a) - v.node(node), false);
    }
    if (!isHere) continue;
    for (const Chain &chain : chainsOf(curve)) {
      if (chain.closed) continue;
      if (chain.nodes.front() == node)
        addDirection(directions, v.node(chain.nodes.back()) - v.node(node), false);
      if (chain.nodes.back() == node)
        addDirection(directions, v.node(chain.nodes.front()) - v.node(node), false);
    }
  }
  return directions;
}

/// Of planes through a node: those of what is plane there, along two curves each, square to one, and half way
/// between two.
std::vector<Vec<3>> normalsAt(const PartView &v, Index node) {
  std::vector<Index> star;
  std::vector<Index> surfaces;
  collectStar(v.mesh, node, star);
  for (const Index s : star)
    for (int i = 0; i < 4; ++i)
      if (const Index tag = v.mesh.tags[at(s)][i]; tag != kNone && v.mesh.simplices[at(s)][i] != node)
        surfaces.push_back(FaceTag::surface(tag));
  sortItems(surfaces);
  surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
  std::vector<Vec<3>> normals;
  for (const Index s : surfaces)
    if (!v.mesh.surfaces[at(s)].bent) addDirection(normals, v.mesh.surfaces[at(s)].plane.normal, true);
  const std::vector<Vec<3>> directions = directionsAt(v, node);
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t k = i + 1; k < directions.size(); ++k)
      addDirection(normals, glm::cross(directions[i], directions[k]), true);
  for (const Vec<3> &direction : directions) addDirection(normals, direction, true);
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t k = i + 1; k < directions.size(); ++k)
      addDirection(normals, directions[i] - directions[k], true);
  return normals;
}

} // namespace

std::vector<Cut> throughJoints(const PartView &v) {
  Index joint = kNone; // one at a time: what mends it may mend others
  const auto offer = [&](Index node) {
    if (joint == kNone || placeOf(v.mesh, node) < placeOf(v.mesh, joint)) joint = node;
  };
  for (const Corner *corner : v.corners)
    if (corner->sides.size() > 3) offer(corner->node);
  if (joint == kNone && v.parts.parts[at(v.part)].defect == Defect::unlikeSides)
    for (const UnlikeCorner &corner : unlikeCorners(v.parts))
      if (corner.part == v.part) offer(corner.node);
  std::vector<Cut> list;
  if (joint == kNone) return list;
  for (const Vec<3> &normal : normalsAt(v, joint))
    list.push_back({planeSurface(v.node(joint), normal), {joint}});
  return list;
}

} // namespace dualblock
