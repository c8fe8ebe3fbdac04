#include "reference/cut.h"

#include "base/deadline.h"
#include "base/sort.h"
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace dualblock {
namespace {

/// A piece of the section: a simplex that the surface crosses (face = -1), or an inner face that lies in the
/// surface between a simplex behind it and one in front.
struct SectionPiece {
  Index simplex;
  int face;
};

template <int N> class Section {
public:
  Section(const ReferenceMesh<N> &mesh, const Surface<N> &surface, double tolerance)
      : mesh_(mesh), surface_(surface), tolerance_(tolerance) {
    if (surface.field) known_.assign(mesh.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  }

  double value(Index node) const {
    if (!surface_.field) return surface_.plane.distance(mesh_.nodes[at(node)]);
    if (at(node) >= known_.size())
      known_.resize(mesh_.nodes.size(), std::numeric_limits<double>::quiet_NaN());
    double &known = known_[at(node)];
    if (std::isnan(known)) known = surface_.field->value(mesh_.nodes[at(node)]);
    return known;
  }

  int sign(Index node) const {
    const double d = value(node);
    if (std::abs(d) > tolerance_) return d > 0 ? 1 : -1;
    if (std::abs(d) <= kExact * tolerance_) return 0;
    const auto [known, isNew] = nearSigns_.try_emplace(node, 0);
    if (isNew && hasNearer(node, d)) known->second = d > 0 ? 1 : -1;
    return known->second;
  }

  void addSeed(const CutSeed<N> &seed) {
    if (seed.from >= 0) {
      turn(seed.simplex, seed.from, seed.to, seed.crossFrom);
    } else if (isCrossed(signsOf(seed.simplex))) {
      addCrossed(seed.simplex);
    } else {
      for (int i = 0; i < N + 1; ++i) addPlaneFace(seed.simplex, i);
    }
  }

  /// Grows the section's component from its seeds.
  void grow() {
    while (!queue_.empty()) {
      const SectionPiece piece = queue_.back();
      queue_.pop_back();
      if (piece.face < 0) growFromSimplex(piece.simplex);
      else growAroundPlaneRidges(piece.simplex, piece.face);
    }
  }

  std::vector<Index> crossed;           // simplices with nodes on both sides
  std::vector<SectionPiece> planeFaces; // inner faces in the plane, seen from behind

  /// -1 or +1: the side that an uncrossed simplex lies on; a flat one in the plane counts as in front.
  int side(const std::array<Index, N + 1> &nodes) const {
    for (const Index v : nodes)
      if (const int s = sign(v)) return s;
    return 1;
  }

private:
  static constexpr double kExact = 1e-3; // of the tolerance

  /// Whether an edge that clearly crosses the surface leads to a node that is nearer to it. If both counted
  /// as on it, the cut would run along the edge, where parts on both sides of it may end the cut at either
  /// node.
  bool hasNearer(Index node, double d) const {
    constexpr double kSlope = 0.03;
    bool found = false;
    visitStar(mesh_, node, [&](Index s) {
      for (const Index other : mesh_.simplices[at(s)]) {
        const double o = value(other);
        found |= std::abs(o) < std::abs(d) &&
                 std::abs(o - d) > kSlope * glm::length(mesh_.nodes[at(other)] - mesh_.nodes[at(node)]);
      }
      return found;
    });
    return found;
  }

  using Signs = std::array<int, N + 1>;

  Signs signsOf(Index s) const {
    Signs signs;
    for (int v = 0; v < N + 1; ++v) signs[at(v)] = sign(mesh_.simplices[at(s)][v]);
    return signs;
  }

  static bool isCrossed(const Signs &signs) {
    const auto [low, high] = std::minmax_element(signs.begin(), signs.end());
    return *low < 0 && *high > 0;
  }

  void addCrossed(Index s) {
    if (!seen_.insert(std::int64_t{s} * (N + 2)).second) return;
    crossed.push_back(s);
    queue_.push_back({s, -1});
  }

  /// Takes face i of s into the section if it lies in the plane between the two sides.
  void addPlaneFace(Index s, int i) {
    const Index t = mesh_.neighbors[at(s)][i];
    if (t == kNone) return;
    for (int v = 0; v < N + 1; ++v)
      if (v != i && sign(mesh_.simplices[at(s)][v]) != 0) return;
    const int here = side(mesh_.simplices[at(s)]);
    if (here == side(mesh_.simplices[at(t)])) return;
    const SectionPiece behind = here < 0 ? SectionPiece{s, i} : SectionPiece{t, mesh_.mirrorFace(s, i)};
    if (!seen_.insert(std::int64_t{behind.simplex} * (N + 2) + 1 + behind.face).second) return;
    planeFaces.push_back(behind);
    queue_.push_back(behind);
  }

  /// Takes what the section has around a ridge, from one wall to the other. Returns the two walls.
  std::array<FaceRef<N>, 2> turn(Index s, int from, int to, Index crossFrom) {
    const auto visit = [&](Index t) {
      const Signs signs = signsOf(t);
      if (isCrossed(signs)) addCrossed(t);
      else if (std::count(signs.begin(), signs.end(), 0) >= N)
        for (int i = 0; i < N + 1; ++i) addPlaneFaceOnRidge(t, i, s, from, to);
    };
    const FaceRef<N> first = turnAroundRidge(mesh_, s, from, to, crossFrom, visit);
    if (first.simplex == s && first.face == from) return {first, first};
    return {first, turnAroundRidge(mesh_, s, to, from, crossFrom, visit)};
  }

  /// Around a ridge in the plane: through the part, and through the part behind where the ridge lies inside a
  /// split surface as seen from there, too. Where two sides meet at the ridge, from here or from behind, the
  /// cut ends.
  void growAroundRidge(Index s, int from, int to) {
    const auto [first, second] = turn(s, from, to, kCrossNone);
    const Index tag = mesh_.tags[at(first.simplex)][first.face];
    const Index behind = mesh_.neighbors[at(first.simplex)][first.face];
    if (tag == kNone || behind == kNone) return;
    if (mesh_.sideKey(tag) != mesh_.sideKey(mesh_.tags[at(second.simplex)][second.face])) return;
    const int wall = mesh_.mirrorFace(first.simplex, first.face);
    for (int k = 0; k < N + 1; ++k) { // the other face of `behind` that holds the ridge
      if (k == wall) continue;
      const Index node = mesh_.simplices[at(behind)][k];
      bool onRidge = false;
      for (int v = 0; v < N + 1; ++v) onRidge |= v != from && v != to && mesh_.simplices[at(s)][v] == node;
      if (onRidge) continue;
      const FaceRef<N> end = turnAroundRidge(mesh_, behind, wall, k, kCrossNone, [](Index) {});
      if (mesh_.neighbors[at(end.simplex)][end.face] == second.simplex &&
          mesh_.mirrorFace(end.simplex, end.face) == second.face)
        turn(behind, wall, k, kCrossNone);
    }
  }

  void addPlaneFaceOnRidge(Index t, int i, Index s, int from, int to) {
    // Only faces that hold the ridge itself: others may belong to another component.
    for (int v = 0; v < N + 1; ++v) {
      if (v == from || v == to) continue;
      const Index node = mesh_.simplices[at(s)][v];
      const int k = mesh_.localVertex(t, node);
      if (k < 0 || k == i) return;
    }
    addPlaneFace(t, i);
  }

  void growFromSimplex(Index s) {
    const Signs signs = signsOf(s);
    for (int i = 0; i < N + 1; ++i) { // across crossed faces
      Signs ofFace = signs;
      ofFace[at(i)] = 0;
      if (mesh_.neighbors[at(s)][i] != kNone && isCrossed(ofFace)) addCrossed(mesh_.neighbors[at(s)][i]);
    }
    growAroundPlaneRidges(s, -1);
  }

  /// Around every ridge of s, or of its face, that lies in the plane.
  void growAroundPlaneRidges(Index s, int face) {
    const Signs signs = signsOf(s);
    for (int i = 0; i < N + 1; ++i)
      for (int k = i + 1; k < N + 1; ++k) {
        if (face >= 0 && i != face && k != face) continue;
        bool inPlane = true;
        for (int m = 0; m < N + 1; ++m) inPlane &= m == i || m == k || signs[at(m)] == 0;
        if (inPlane) growAroundRidge(s, i, k);
      }
  }

  const ReferenceMesh<N> &mesh_;
  const Surface<N> &surface_;
  const double tolerance_;
  mutable std::vector<double> known_;                // a field's values
  mutable std::unordered_map<Index, int> nearSigns_; // of nodes within the tolerance
  std::vector<SectionPiece> queue_;
  std::unordered_set<std::int64_t> seen_; // membership only: no order is taken from it
};

} // namespace

template <int N>
std::vector<Index> sectionOf(const ReferenceMesh<N> &mesh, const Surface<N> &surface,
                             const std::vector<CutSeed<N>> &seeds, double tolerance) {
  Section<N> section(mesh, surface, tolerance);
  for (const CutSeed<N> &seed : seeds) section.addSeed(seed);
  section.grow();
  std::vector<Index> simplices = std::move(section.crossed);
  for (const CutSeed<N> &seed : seeds)
    if (seed.from >= 0) {
      const auto add = [&](Index s) { simplices.push_back(s); };
      turnAroundRidge(mesh, seed.simplex, seed.from, seed.to, seed.crossFrom, add);
      turnAroundRidge(mesh, seed.simplex, seed.to, seed.from, seed.crossFrom, add);
    }
  for (const SectionPiece &piece : section.planeFaces) simplices.push_back(piece.simplex);
  sortItems(simplices);
  simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
  return simplices;
}

template <int N>
Index cutAlong(ReferenceMesh<N> &mesh, Index surface, const std::vector<CutSeed<N>> &seeds,
               double tolerance) {
  checkDeadline();
  const Surface<N> along = mesh.surfaces[at(surface)];
  Section<N> section(mesh, along, tolerance);
  for (const CutSeed<N> &seed : seeds) section.addSeed(seed);
  section.grow();
  Index faces = 0;

  const auto tagPair = [&](Index behind, int i) {
    const Index front = mesh.neighbors[at(behind)][i];
    if (front == kNone || mesh.tags[at(behind)][i] != kNone) return;
    mesh.tags[at(behind)][i] = FaceTag::back(surface);
    mesh.tags[at(front)][mesh.mirrorFace(behind, i)] = FaceTag::front(surface);
    ++faces;
  };
  for (const SectionPiece &piece : section.planeFaces) tagPair(piece.simplex, piece.face);
  if (section.crossed.empty()) return faces;

  std::vector<std::pair<Index, Index>> crossing;
  for (const Index s : section.crossed) {
    const auto &v = mesh.simplices[at(s)];
    for (int i = 0; i < N + 1; ++i)
      for (int k = i + 1; k < N + 1; ++k)
        if (section.sign(v[i]) * section.sign(v[k]) < 0) crossing.emplace_back(std::minmax(v[i], v[k]));
  }
  sortItems(crossing);
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  std::vector<EdgeSplit> splits;
  splits.reserve(crossing.size());
  for (const auto &[a, b] : crossing) {
    const double da = section.value(a);
    const double db = section.value(b);
    const Vec<N> &from = mesh.nodes[at(a)];
    const Vec<N> &to = mesh.nodes[at(b)];
    double t = da / (da - db);
    if constexpr (N == 3)
      if (along.field) t = rootBetween<N>(*along.field, from, to, da, db);
    const Vec<N> x = from + t * (to - from);
    splits.push_back({a, b, mesh.nodeCount()});
    mesh.nodes.push_back(x);
  }

  // A new node lies in the plane by identity, whatever its rounded coordinates say.
  const Index firstNew = splits.front().node;
  const auto signByIdentity = [&](Index node) { return node >= firstNew ? 0 : section.sign(node); };
  const auto sideOf = [&](Index s) {
    for (const Index v : mesh.simplices[at(s)])
      if (const int sg = signByIdentity(v)) return sg;
    return 1;
  };
  std::vector<Index> pieces = section.crossed;
  subdivide(mesh, splits, pieces);
  for (const Index s : pieces) {
    if (sideOf(s) > 0) continue;
    for (int i = 0; i < N + 1; ++i) {
      bool inPlane = true;
      for (int v = 0; v < N + 1; ++v) inPlane &= v == i || signByIdentity(mesh.simplices[at(s)][v]) == 0;
      const Index t = mesh.neighbors[at(s)][i];
      if (inPlane && t != kNone && sideOf(t) > 0) tagPair(s, i);
    }
  }
  return faces;
}

template std::vector<Index> sectionOf(const ReferenceMesh<3> &, const Surface<3> &,
                                      const std::vector<CutSeed<3>> &, double);
template Index cutAlong(ReferenceMesh<2> &, Index, const std::vector<CutSeed<2>> &, double);
template Index cutAlong(ReferenceMesh<3> &, Index, const std::vector<CutSeed<3>> &, double);

} // namespace dualblock
