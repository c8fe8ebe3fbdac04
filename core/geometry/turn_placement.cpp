#include "geometry/turn_placement.h"

#include <cmath>
#include <limits>

#include "base/sort.h"
#include "geometry/bent_placement.h"
#include "geometry/nearest.h"
#include "parts/chains.h"

namespace dualblock {
namespace {

constexpr double kLeastRise = 0.02; // of its extent: what rises less is as good as straight
constexpr double kSummit = 0.05;    // of the rise: what is less below the highest counts as being there

/// Pieces of a curve or a side: where, how large, and how high above what they are measured from.
struct Piece {
  Vec<3> middle;
  double size, height;
};

/// The middle of what is highest.
Vec<3> summitOf(const std::vector<Piece> &pieces, double rise) {
  Vec<3> sum{0.0};
  double weight = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (const Piece &p : pieces) most = std::max(most, p.height);
  for (const Piece &p : pieces) {
    const double below = std::max(0.0, 1 - (most - p.height) / (kSummit * rise));
    sum += p.size * below * below * p.middle;
    weight += p.size * below * below;
  }
  return sum / weight; // the highest itself counts
}

/// Of a curve: where it is farthest from its chord.
void placeOnChain(const ReferenceMesh<3> &mesh, const Chain &chain, Vec<3> &x) {
  const auto node = [&](std::size_t k) { return mesh.nodes[at(chain.nodes[k])]; };
  const Vec<3> from = node(0);
  const Vec<3> chord = node(chain.nodes.size() - 1) - from;
  const double square = glm::dot(chord, chord);
  if (!(square > 0)) return;
  const auto off = [&](const Vec<3> &y) { return y - from - glm::dot(y - from, chord) / square * chord; };
  Vec<3> farthest{0.0};
  for (std::size_t k = 1; k + 1 < chain.nodes.size(); ++k)
    if (glm::length(off(node(k))) > glm::length(farthest)) farthest = off(node(k));
  const double rise = glm::length(farthest);
  if (rise <= kLeastRise * std::sqrt(square)) return;
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k) {
    const Vec<3> middle = (node(k) + node(k + 1)) / 2.0;
    pieces.push_back({middle, glm::length(node(k + 1) - node(k)), glm::dot(off(middle), farthest) / rise});
  }
  const Vec<3> place = summitOf(pieces, rise);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k) {
    const Vec<3> y = nearestOnSegment(place, node(k), node(k + 1));
    if (glm::length(y - place) >= least) continue;
    least = glm::length(y - place);
    x = y;
  }
}

/// A side as triangles, with the mean of its normals where it turns, each edge weighing by its length and by
/// the angle that the side turns by there.
struct SideShape {
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> rim; // nodes, twice
  Vec<3> mean{0.0};
};

SideShape shapeOf(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Index side) {
  SideShape shape;
  std::vector<Vec<3>> normals;
  std::vector<std::pair<std::array<Index, 2>, std::size_t>> edges;
  for (const FaceRef<3> *f = parts.sideFaces.begin(side); f != parts.sideFaces.end(side); ++f) {
    const auto [a, b, c] = mesh.sortedFace(f->simplex, f->face);
    for (const auto &edge : {std::array{a, b}, std::array{b, c}, std::array{a, c}})
      edges.emplace_back(edge, normals.size());
    shape.triangles.push_back({a, b, c});
    normals.push_back(mesh.faceNormal(f->simplex, f->face));
  }
  sortItems(edges);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto &[a, b] = edges[e].first;
    if (e + 1 == edges.size() || edges[e + 1].first != edges[e].first) {
      shape.rim.insert(shape.rim.end(), {a, b});
      continue;
    }
    const Vec<3> &n = normals[edges[e].second];
    const Vec<3> &m = normals[edges[e + 1].second];
    const double angle = std::acos(std::clamp(glm::dot(n, m), -1.0, 1.0));
    shape.mean += angle * glm::length(mesh.nodes[at(b)] - mesh.nodes[at(a)]) * (n + m);
    ++e;
  }
  return shape;
}

/// Of a side: where it is farthest from its rim along its mean normal, out or in.
void placeOnSide(const ReferenceMesh<3> &mesh, const Parts<3> &parts, Index side, Vec<3> &x) {
  const SideShape shape = shapeOf(mesh, parts, side);
  if (shape.rim.empty() || !(glm::length(shape.mean) > 0)) return;
  const Vec<3> up = glm::normalize(shape.mean);
  double rim = 0;
  for (const Index n : shape.rim)
    rim += glm::dot(mesh.nodes[at(n)], up) / static_cast<double>(shape.rim.size());
  std::vector<Piece> pieces;
  double low = 0;
  double high = 0;
  double area = 0;
  for (const auto &[a, b, c] : shape.triangles) {
    const Vec<3> &o = mesh.nodes[at(a)];
    const Vec<3> u = mesh.nodes[at(b)] - o;
    const Vec<3> v = mesh.nodes[at(c)] - o;
    const Vec<3> middle = o + (u + v) / 3.0;
    pieces.push_back({middle, glm::length(glm::cross(u, v)) / 2, glm::dot(middle, up) - rim});
    low = std::min(low, pieces.back().height);
    high = std::max(high, pieces.back().height);
    area += pieces.back().size;
  }
  const double rise = std::max(high, -low);
  if (!(rise > kLeastRise * std::sqrt(area))) return;
  if (-low > high)
    for (Piece &p : pieces) p.height = -p.height;
  x = nearestOnSide(mesh, parts, side, summitOf(pieces, rise));
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
