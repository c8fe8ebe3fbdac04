#include "geometry/turn_placement.h"

#include <cmath>
#include <limits>

#include "base/sort.h"
#include "geometry/nearest.h"
#include "parts/chains.h"

namespace dualblock {
namespace {

constexpr double kLeastTurning = 0.1; // radians: what turns less is as good as straight
constexpr double kSharpness = 16;     // of the mean's direction: what is turned by 30 degrees weighs a tenth

/// Pieces of a curve or a side: where, how large, and in which direction they are turned.
struct Piece {
  Vec<3> middle, direction;
  double size;
};

/// The place of those that are turned like `mean`; nothing if none is.
bool placeTurnedLike(const std::vector<Piece> &pieces, const Vec<3> &mean, Vec<3> &place) {
  Vec<3> sum{0.0};
  double weight = 0;
  const Vec<3> unit = glm::normalize(mean);
  for (const Piece &p : pieces) {
    const double w = p.size * std::pow(std::max(0.0, glm::dot(p.direction, unit)), kSharpness);
    sum += w * p.middle;
    weight += w;
  }
  if (!(weight > 0)) return false;
  place = sum / weight;
  return true;
}

double angleBetween(const Vec<3> &a, const Vec<3> &b) {
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

bool placeOnChain(const ReferenceMesh<3> &mesh, const Chain &chain, Vec<3> &x) {
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k) {
    const Vec<3> a = mesh.nodes[at(chain.nodes[k])];
    const Vec<3> d = mesh.nodes[at(chain.nodes[k + 1])] - a;
    if (const double length = glm::length(d); length > 0) pieces.push_back({a + 0.5 * d, d / length, length});
  }
  Vec<3> mean{0.0};
  double turning = 0;
  for (std::size_t k = 0; k + 1 < pieces.size(); ++k) {
    const double angle = angleBetween(pieces[k].direction, pieces[k + 1].direction);
    mean += angle * (pieces[k].direction + pieces[k + 1].direction);
    turning += angle;
  }
  Vec<3> place;
  if (turning < kLeastTurning || !(glm::length(mean) > 0) || !placeTurnedLike(pieces, mean, place))
    return false;
  double least = std::numeric_limits<double>::infinity();
  for (const Piece &p : pieces) {
    const double along = std::clamp(glm::dot(place - p.middle, p.direction), -0.5 * p.size, 0.5 * p.size);
    const Vec<3> y = p.middle + along * p.direction;
    if (glm::length(y - place) >= least) continue;
    least = glm::length(y - place);
    x = y;
  }
  return true;
}

bool placeOnSide(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Index side, Vec<3> &x) {
  std::vector<Piece> pieces; // triangles
  std::vector<std::pair<std::array<Index, 2>, std::size_t>> edges;
  for (const FaceRef<3> *f = parts.sideFaces.begin(side); f != parts.sideFaces.end(side); ++f) {
    const auto [a, b, c] = mesh.sortedFace(f->simplex, f->face);
    const Vec<3> u = mesh.nodes[at(b)] - mesh.nodes[at(a)];
    const Vec<3> v = mesh.nodes[at(c)] - mesh.nodes[at(a)];
    const double area = glm::length(glm::cross(u, v)) / 2;
    if (!(area > 0)) continue;
    for (const auto &edge : {std::array{a, b}, std::array{b, c}, std::array{a, c}})
      edges.emplace_back(edge, pieces.size());
    pieces.push_back({mesh.nodes[at(a)] + (u + v) / 3.0, mesh.faceNormal(f->simplex, f->face), area});
  }
  sortItems(edges);
  Vec<3> mean{0.0};
  double most = 0;
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    if (edges[e].first != edges[e + 1].first) continue;
    const auto &[a, b] = edges[e].first;
    const Vec<3> &n = pieces[edges[e].second].direction;
    const Vec<3> &m = pieces[edges[e + 1].second].direction;
    mean += angleBetween(n, m) * glm::length(mesh.nodes[at(b)] - mesh.nodes[at(a)]) * (n + m);
  }
  for (const Piece &p : pieces) most = std::max(most, angleBetween(p.direction, pieces[0].direction));
  Vec<3> place;
  if (most < kLeastTurning || !(glm::length(mean) > 0) || !placeTurnedLike(pieces, mean, place)) return false;
  double least = std::numeric_limits<double>::infinity();
  for (const FaceRef<3> *f = parts.sideFaces.begin(side); f != parts.sideFaces.end(side); ++f) {
    const auto [a, b, c] = mesh.sortedFace(f->simplex, f->face);
    const Vec<3> y = nearestOnTriangle(place, mesh.nodes[at(a)], mesh.nodes[at(b)], mesh.nodes[at(c)]);
    if (glm::length(y - place) >= least) continue;
    least = glm::length(y - place);
    x = y;
  }
  return true;
}

} // namespace

void placeByTurning(const ReferenceMesh<3> &mesh, const Parts<3> &parts, const DualCells<3> &dual,
                    Primal<3> &primal) {
  const auto isBent = [&](Index side) {
    const Surface<3> &surface = mesh.surfaces[at(FaceTag::surface(parts.sides[at(side)].tag))];
    return surface.bent && surface.kind == SurfaceKind::facet;
  };
  std::vector<bool> done(primal.positions.size(), false); // parts beside each other share nodes
  const auto next = [&](Index part, const std::array<Index, 3> &label) {
    const Index piece = dual.findPiece(part, label);
    const Index node = piece == kNone ? kNone : dual.pieces[at(piece)].cell;
    if (node == kNone || done[at(node)]) return kNone;
    done[at(node)] = true;
    return node;
  };
  for (const Curve<3> &curve : parts.curves) {
    if (!isBent(curve.sides[0]) && !isBent(curve.sides[1])) continue;
    const std::vector<Chain> chains = chainsOf(curve);
    if (chains.size() != 1 || chains[0].closed) continue;
    if (const Index node = next(curve.part, {curve.sides[0], curve.sides[1], kNone}); node != kNone)
      placeOnChain(mesh, chains[0], primal.positions[at(node)]);
  }
  for (Index side = 0; side < toIndex(parts.sides.size()); ++side)
    if (isBent(side))
      if (const Index node = next(parts.sides[at(side)].part, {side, kNone, kNone}); node != kNone)
        placeOnSide(mesh, parts, side, primal.positions[at(node)]);
}

} // namespace dualblock
