#include "certificate/elements.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "base/box_tree.h"
#include "certificate/checks.h"
#include "certificate/embedding.h"

namespace dualblock {
namespace {

constexpr int kElementSamples = 1; // along each direction inside of an element's face: there are many
constexpr std::size_t kElementCrossings = 8; // that are named
constexpr double kSameMeasure = 1e-10;       // of the blocks' measure: rounding of a sum of millions

/// Which faces of cells (blocks or elements) are one. Faces are numbered 2N times the cell, plus the local
/// number, and kept by their lowest node in flat lists: there may be millions.
template <int N> class FaceTwins {
public:
  using Cell = std::array<Index, 1 << N>;
  using Cycle = std::array<Index, 1 << (N - 1)>;

  FaceTwins(const std::vector<Cell> &cells, std::size_t nodes)
      : cells_(cells), twin_(cells.size() * 2 * N, kNone) {
    const Lists<Index> byNode = collectLists<Index>(nodes, [&](auto put) {
      for (Index f = 0; f < toIndex(twin_.size()); ++f) {
        const Cycle c = cycle(f);
        put(*std::min_element(c.begin(), c.end()), f);
      }
    });
    for (Index node = 0; node < byNode.count(); ++node)
      for (const Index *f = byNode.begin(node); f != byNode.end(node); ++f)
        for (const Index *g = f + 1; g != byNode.end(node); ++g) match(*f, *g);
  }

  Cycle cycle(Index f) const {
    Cycle c;
    for (std::size_t k = 0; k < c.size(); ++k)
      c[k] = cells_[at(f / (2 * N))][at(faceCorner<N>(f % (2 * N), static_cast<int>(k)))];
    return c;
  }
  /// The same face of another cell, or kNone.
  Index operator[](Index f) const { return twin_[at(f)]; }
  Index count() const { return toIndex(twin_.size()); }
  /// A face that three cells have, or two on the same side of it, or that two see in another order; kNone.
  Index fault() const { return fault_; }

private:
  void match(Index f, Index g) {
    const Cycle a = cycle(f);
    Cycle b = cycle(g);
    Cycle keyA = a;
    Cycle keyB = b;
    sortItems(keyA);
    sortItems(keyB);
    if (keyA != keyB) return;
    std::reverse(b.begin(), b.end()); // on opposite sides they run around in opposite directions
    if constexpr (N == 3) std::rotate(b.begin(), std::find(b.begin(), b.end(), a[0]), b.end());
    if (a != b || twin_[at(f)] != kNone || twin_[at(g)] != kNone) fault_ = fault_ == kNone ? f : fault_;
    twin_[at(f)] = g;
    twin_[at(g)] = f;
  }

  const std::vector<Cell> &cells_;
  std::vector<Index> twin_;
  Index fault_ = kNone;
};

template <int N>
void checkFaces(const ElementInput<N> &in, const FaceTwins<N> &twins, Certificate &certificate) {
  if (twins.fault() != kNone)
    certificate.fail(Check::topology, "elements do not lie on opposite sides of the face that they share",
                     {{"element", twins.fault() / (2 * N)}});
  Index outer = 0;
  for (Index f = 0; f < twins.count(); ++f) outer += twins[f] == kNone ? 1 : 0;
  if (outer != toIndex(in.refined.boundary.faces.size()))
    certificate.fail(Check::topology, std::to_string(outer) + " faces belong to one element only, and " +
                                          std::to_string(in.refined.boundary.faces.size()) +
                                          " are handed out as the boundary");
}

template <int N> void checkMeasures(const ElementInput<N> &in, Certificate &certificate) {
  certificate.worstCoefficient = std::numeric_limits<double>::infinity();
  const auto measure = [&](const std::vector<Vec<N>> &x, const std::array<Index, 1 << N> &cell, double &sum) {
    std::array<Vec<N>, 1 << N> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = x[at(cell[k])];
    double ratio = 0;
    double own = 0;
    const int sign = jacobianSign<N>(corners, ratio, &own);
    certificate.worstCoefficient = std::min(certificate.worstCoefficient, ratio);
    sum += own;
    return sign;
  };
  double sum = 0;
  for (Index e = 0; e < toIndex(in.refined.elements.size()); ++e)
    if (measure(in.refined.positions, in.refined.elements[at(e)], sum) <= 0)
      certificate.fail(Check::geometry,
                       "element " + std::to_string(e) + " could not be shown to be positive everywhere",
                       {{"element", e}});
  certificate.meshMeasure = sum;
  const bool isBent = !in.bent.faces.empty();
  if (!isBent) { // elements are pieces of their blocks' own maps
    double blocks = 0;
    for (const auto &block : in.blocks.blocks) measure(in.blocks.positions, block, blocks);
    if (!(std::abs(sum - blocks) <= kSameMeasure * blocks))
      certificate.fail(Check::geometry, "the elements add up to " + scientific(sum) + " and the blocks to " +
                                            scientific(blocks));
  }
  certificate.isExact = !isBent;
  certificate.domainMeasure = in.domainMeasure > 0 ? in.domainMeasure : sum;
}

/// How thick the blocks are behind each of their faces on facets: through rows of them, to the next facet.
std::vector<double> columnsOf(const ElementInput<3> &in) {
  const FaceTwins<3> twins(in.blocks.blocks, in.blocks.positions.size());
  const auto middle = [&](Index f) {
    Vec<3> sum{0.0};
    for (const Index node : twins.cycle(f)) sum += in.blocks.positions[at(node)] / 4.0;
    return sum;
  };
  const auto tagOf = [&](Index f) { return in.blocks.tags[at(f / 6)][at(f % 6)]; };
  std::vector<double> columns(at(twins.count()), 0);
  for (Index face = 0; face < twins.count(); ++face) {
    if (tagOf(face) == kNone) continue;
    Index f = face;
    for (Index n = 0; n < in.blocks.blockCount(); ++n) {
      columns[at(face)] += glm::length(middle(f ^ 1) - middle(f));
      const Index next = twins[f ^ 1];
      if (next == kNone || tagOf(f ^ 1) != kNone) break;
      f = next;
    }
  }
  return columns;
}

/// Per block, whether its elements may leave the bent sides: it stays straight, or touches one that does.
/// Where that was not asked for, straight blocks are refused as such.
std::vector<bool> mayLeaveSides(const ElementInput<3> &in) {
  std::vector<bool> may(in.blocks.blocks.size(), false);
  std::vector<bool> isStraight(in.blocks.positions.size(), false); // nodes
  for (const Index b : in.refined.straightened)
    for (const Index n : in.blocks.blocks[at(b)]) isStraight[at(n)] = true;
  for (std::size_t b = 0; b < may.size(); ++b)
    for (const Index n : in.blocks.blocks[b]) may[b] = may[b] || isStraight[at(n)];
  return may;
}

void checkSides(const ElementInput<3> &in, Certificate &certificate) {
  std::vector<bool> bentPatch(in.patchOfSurface.size(), false);
  for (const Index p : in.bent.patchOfFace) bentPatch[at(p)] = true;
  const std::vector<double> columns = columnsOf(in);
  std::vector<SideFace> faces;
  const auto patchOf = [&](Index surface) {
    const Index patch = in.patchOfSurface[at(surface)];
    return patch == kNone ? surface : patch;
  };
  for (std::size_t f = 0; f < in.refined.boundary.faces.size(); ++f) {
    const Index patch = patchOf(in.refined.boundary.facet[f]);
    if (!bentPatch[at(patch)]) continue;
    const Index element = in.refined.boundaryElement[f];
    const Index block = in.refined.block[at(element)];
    double column = std::numeric_limits<double>::infinity();
    for (int local = 0; local < 6; ++local)
      if (const Index tag = in.blocks.tags[at(block)][at(local)];
          tag != kNone && patchOf(FaceTag::surface(tag)) == patch)
        column = std::min(column, columns[at(6 * block + local)]);
    const auto &nodes = in.refined.boundary.faces[f];
    faces.push_back({nodes, patch, element, column});
  }
  std::vector<SideTriangle> triangles;
  for (std::size_t t = 0; t < in.bent.faces.size(); ++t)
    triangles.push_back({in.bent.faces[t], in.bent.patchOfFace[t]});
  SideMeasures measures = measureSides(in.refined.positions, faces, triangles, kElementSamples);
  const std::vector<bool> mayLeave = mayLeaveSides(in);
  for (const FaceFault &fault : measures.faults) {
    const SideFace &face = faces[at(fault.face)];
    if (mayLeave[at(in.refined.block[at(face.owner)])]) continue;
    certificate.fail(Check::features,
                     "element " + std::to_string(face.owner) + " strays from the bent side of facet " +
                         std::to_string(face.patch) + describe(fault),
                     {{"element", face.owner}, {"facet", face.patch}});
  }
  certificate.fidelity.sides = std::move(measures.sides);
  summarize(certificate.fidelity, certificate.meshMeasure / certificate.domainMeasure - 1,
            certificate.domainMeasure);
  const bool mayStray = in.mayStayStraight && !in.refined.straightened.empty();
  if (!(certificate.fidelity.strayed <= kMostStrayed) && !mayStray)
    certificate.fail(Check::features,
                     scientific(100 * certificate.fidelity.strayed) +
                         " % of the domain's volume lies between its bent sides and the elements");
}

void checkEmbedding(const ElementInput<3> &in, Certificate &certificate) {
  Box box;
  for (const Vec<3> &x : in.refined.positions) box.add(x);
  const QuadSurface surface{in.refined.positions, in.refined.boundary.faces};
  const auto elementAt = [&](Index face) { return in.refined.boundaryElement[at(face)]; };
  for (const auto &[a, b] :
       crossingFaces(surface, 1e-12 * glm::length(box.high - box.low), kElementCrossings))
    certificate.fail(Check::features, "the elements' boundary could not be shown not to cross itself",
                     {{"element", elementAt(a)}, {"element", elementAt(b)}});
  if (!certificate.valid) return;
  for (const WrongShell &shell : wrongShells(surface))
    certificate.fail(Check::features, "just outside of an element's boundary face there are elements already",
                     {{"element", elementAt(shell.face)}});
}

} // namespace

template <int N> Certificate certifyElements(const ElementInput<N> &in) {
  Certificate certificate;
  checkFaces(in, FaceTwins<N>(in.refined.elements, in.refined.positions.size()), certificate);
  checkMeasures(in, certificate);
  if constexpr (N == 3)
    if (!in.bent.faces.empty()) {
      checkEmbedding(in, certificate);
      checkSides(in, certificate);
    }
  if (!in.refined.straightened.empty() && !in.mayStayStraight)
    certificate.fail(Check::features,
                     std::to_string(in.refined.straightened.size()) +
                         " block(s) keep straight elements beside a bent side, off the domain: give other "
                         "intervals, or ask for straight elements");
  return certificate;
}

template Certificate certifyElements(const ElementInput<2> &);
template Certificate certifyElements(const ElementInput<3> &);

} // namespace dualblock
