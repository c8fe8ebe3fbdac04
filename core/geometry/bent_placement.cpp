#include "geometry/bent_placement.h"

#include <limits>

#include "geometry/nearest.h"

namespace dualblock {
namespace {

struct Mean {
  Vec<3> sum{0.0};
  double count = 0;
  void add(const Vec<3> &x) {
    sum += x;
    count += 1;
  }
  Vec<3> value() const { return count > 0 ? sum / count : sum; }
};

} // namespace

Vec<3> nearestOnSide(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Index side, const Vec<3> &x) {
  Vec<3> best = x;
  double least = std::numeric_limits<double>::infinity();
  for (const FaceRef<3> *f = parts.sideFaces.begin(side); f != parts.sideFaces.end(side); ++f) {
    const auto face = mesh.sortedFace(f->simplex, f->face);
    const Vec<3> y =
        nearestOnTriangle(x, mesh.nodes[at(face[0])], mesh.nodes[at(face[1])], mesh.nodes[at(face[2])]);
    if (glm::length(y - x) >= least) continue;
    least = glm::length(y - x);
    best = y;
  }
  return best;
}

void followBentSides(const ReferenceMesh<3> &mesh, const Parts<3> &parts, const DualCells<3> &dual,
                     Primal<3> &primal) {
  const auto isBent = [&](Index side) {
    return mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))].bent &&
           parts.sideFaces.size(side) > 1;
  };
  std::vector<bool> partIsBent(parts.parts.size(), false);
  for (Index side = 0; side < toIndex(parts.sides.size()); ++side)
    if (isBent(side)) partIsBent[at(parts.sides[at(side)].part)] = true;
  const auto nodeOf = [&](Index part, const std::array<Index, 3> &label) {
    const Index piece = dual.findPiece(part, label);
    return piece == kNone ? kNone : dual.pieces[at(piece)].cell;
  };
  std::vector<Mean> sideShift(parts.sides.size()); // of the curves around each side
  std::vector<Mean> curveShift(parts.parts.size());
  auto corner = parts.corners.begin();
  for (const Curve<3> &curve : parts.curves) {
    if (!partIsBent[at(curve.part)]) continue;
    while (corner != parts.corners.end() && corner->part < curve.part) ++corner;
    const Index node = nodeOf(curve.part, {curve.sides[0], curve.sides[1], kNone});
    Mean chord;
    for (auto c = corner; c != parts.corners.end() && c->part == curve.part; ++c)
      if (std::binary_search(c->sides.begin(), c->sides.end(), curve.sides[0]) &&
          std::binary_search(c->sides.begin(), c->sides.end(), curve.sides[1]))
        chord.add(mesh.nodes[at(c->node)]);
    if (node == kNone) continue;
    const Vec<3> shift = primal.positions[at(node)] - chord.value();
    for (const Index side : curve.sides) sideShift[at(side)].add(shift);
    curveShift[at(curve.part)].add(shift);
  }
  const std::vector<Vec<3>> flat = primal.positions;
  std::vector<bool> done(flat.size(), false); // a split surface's node belongs to two sides
  std::vector<Mean> shiftOfSides(parts.parts.size());
  for (Index side = 0; side < toIndex(parts.sides.size()); ++side) {
    const Index part = parts.sides[at(side)].part;
    if (!partIsBent[at(part)]) continue;
    const Index node = nodeOf(part, {side, kNone, kNone});
    if (node == kNone) continue;
    Vec<3> &x = primal.positions[at(node)];
    if (!done[at(node)]) {
      done[at(node)] = true;
      x += 2.0 * sideShift[at(side)].value();
      if (isBent(side)) x = nearestOnSide(mesh, parts, side, x);
    }
    shiftOfSides[at(part)].add(x - flat[at(node)]);
  }
  for (Index part = 0; part < toIndex(parts.parts.size()); ++part) {
    if (!partIsBent[at(part)]) continue;
    const Index node = nodeOf(part, {kNone, kNone, kNone});
    if (node != kNone)
      primal.positions[at(node)] += 3.0 * shiftOfSides[at(part)].value() - 3.0 * curveShift[at(part)].value();
  }
}

} // namespace dualblock
