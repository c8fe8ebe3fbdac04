#include "remesh/size_field.h"

#include <cmath>
#include <map>

#include "geometry/nearest.h"
#include "partition/heuristics.h"

namespace dualblock {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Distance along a ray at which it meets a triangle, or infinity.
double meets(const Vec<3> &from, const Vec<3> &direction, const std::array<Vec<3>, 3> &x) {
  const Vec<3> a = x[1] - x[0];
  const Vec<3> b = x[2] - x[0];
  const Vec<3> p = glm::cross(direction, b);
  const double det = glm::dot(a, p);
  if (det == 0) return kInfinity;
  const Vec<3> s = from - x[0];
  const double u = glm::dot(s, p) / det;
  const Vec<3> q = glm::cross(s, a);
  const double v = glm::dot(direction, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 ? glm::dot(b, q) / det : kInfinity;
}

Box boxOf(std::span<const Vec<3>> points) {
  Box box;
  for (const Vec<3> &x : points) box.add(x);
  return box;
}

} // namespace

SizeField::SizeField(const ReferenceMesh<3> &mesh, const Parts<3> &features, double scale)
    : largest_(kLargestTriangle * mesh.size), smallest_(kSmallestTriangle * mesh.size), scale_(mesh.size),
      factor_(scale) {
  readFaces(mesh);
  readCurves(mesh, features);
  std::vector<Box> boxes;
  for (const Face &face : faces_) boxes.push_back(boxOf(face.x));
  faceTree_.emplace(boxes);
  boxes.clear();
  for (const CurveSegment &segment : segments_) boxes.push_back(boxOf(segment.ends));
  segmentTree_.emplace(boxes);
}

void SizeField::readFaces(const ReferenceMesh<3> &mesh) {
  struct Ridge {
    std::array<Index, 2> nodes;
    Index face;
    double height;
  };
  std::vector<Ridge> ridges;
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      const Index tag = mesh.tags[at(s)][i];
      if (tag == kNone) continue;
      const std::array<Index, 3> v = mesh.sortedFace(s, i);
      Face face{{}, -mesh.faceNormal(s, i), mesh.sideKey(tag) / 2, 0};
      for (std::size_t k = 0; k < 3; ++k) face.x[k] = mesh.nodes[at(v[k])];
      const double area2 = glm::length(glm::cross(face.x[1] - face.x[0], face.x[2] - face.x[0]));
      if (mesh.surfaces[at(FaceTag::surface(tag))].bent)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t m = (k + 1) % 3;
          ridges.push_back(
              {sortedPair(v[k], v[m]), toIndex(faces_.size()), area2 / glm::length(face.x[m] - face.x[k])});
        }
      faces_.push_back(face);
    }
  sortItems(ridges, [](const Ridge &a, const Ridge &b) { return a.nodes < b.nodes; });
  for (std::size_t k = 1; k < ridges.size(); ++k) {
    if (ridges[k].nodes != ridges[k - 1].nodes) continue;
    Face &a = faces_[at(ridges[k - 1].face)];
    Face &b = faces_[at(ridges[k].face)];
    if (a.patch != b.patch) continue;
    const double turn = glm::length(a.inward - b.inward); // nearly: no two machines' arc sines are alike
    const double width = (ridges[k - 1].height + ridges[k].height) / 2;
    if (turn < kLeastTurn || !(width > 0)) continue;
    a.bend = std::max(a.bend, turn / width);
    b.bend = std::max(b.bend, turn / width);
  }
}

void SizeField::readCurves(const ReferenceMesh<3> &mesh, const Parts<3> &features) {
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    const Curve<3> &curve = features.curves[c];
    std::array<Index, 2> patches;
    for (std::size_t k = 0; k < 2; ++k) patches[k] = mesh.sideKey(features.sides[at(curve.sides[k])].tag) / 2;
    patches = sortedPair(patches[0], patches[1]);
    std::map<Index, std::vector<std::size_t>> at_; // segments at each node
    double length = 0;
    const std::size_t first = segments_.size();
    for (const auto &[a, b] : curve.ridges) {
      at_[a].push_back(segments_.size());
      at_[b].push_back(segments_.size());
      segments_.push_back(
          {{mesh.nodes[at(a)], mesh.nodes[at(b)]}, toIndex(c), patches, 0, 0, {kNone, kNone}});
      length += glm::length(mesh.nodes[at(a)] - mesh.nodes[at(b)]);
    }
    std::array<Index, 2> ends{kNone, kNone};
    for (const auto &[node, list] : at_) {
      if (list.size() == 1) ends[ends[0] == kNone ? 0 : 1] = node;
      if (list.size() != 2) continue;
      const Segment<3> &a = segments_[list[0]].ends;
      const Segment<3> &b = segments_[list[1]].ends;
      const double la = glm::length(a[1] - a[0]);
      const double lb = glm::length(b[1] - b[0]);
      const double cosine = std::abs(glm::dot(a[1] - a[0], b[1] - b[0])) / (la * lb);
      const double turn = std::sqrt(std::max(0.0, 2 - 2 * cosine));
      if (turn < kLeastTurn) continue;
      for (const std::size_t s : list) segments_[s].bend = std::max(segments_[s].bend, 2 * turn / (la + lb));
    }
    for (std::size_t s = first; s < segments_.size(); ++s) {
      segments_[s].length = length;
      segments_[s].corners = ends;
    }
  }
}

double SizeField::thicknessAt(const Vec<3> &x, const Vec<3> &inward, Index patch) const {
  const double near = 1e-6 * scale_;
  double least = kInfinity;
  Index hit = kNone;
  faceTree_->visit([&](const Box &box) { return box.meetsRay(x, inward) && box.squareTo(x) < least * least; },
                   [&](Index f) {
                     const double t = meets(x, inward, faces_[at(f)].x);
                     if (t <= near || t >= least) return;
                     least = t;
                     hit = faces_[at(f)].patch;
                   });
  if (hit == kNone || hit == patch) return kPerThickness * least;
  // In a wedge it is thin wherever its edge is near; what is there has to be as fine as the edge, not finer.
  const std::array<Index, 2> patches = sortedPair(hit, patch);
  const Index edge = nearestSegment(patches, x);
  if (edge == kNone) return kPerThickness * least;
  const CurveSegment &segment = segments_[at(edge)];
  const double distance = glm::length(nearestOnSegment<3>(x, segment.ends[0], segment.ends[1]) - x);
  return std::max({kPerThickness * least, kInWedge * distance, kAtWedge * sizeOf(segment)});
}

double SizeField::onSide(Index patch, const Vec<3> &x) const {
  double found = kInfinity;
  Index nearest = kNone;
  faceTree_->nearest(x, kInfinity, [&](Index f) {
    const Face &face = faces_[at(f)];
    if (face.patch != patch) return kInfinity;
    const Vec<3> d = nearestOnTriangle(x, face.x[0], face.x[1], face.x[2]) - x;
    if (const double square = glm::dot(d, d); square < found) {
      found = square;
      nearest = f;
    }
    return found;
  });
  if (nearest == kNone) return largest_;
  const Face &face = faces_[at(nearest)];
  double size = largest_;
  if (face.bend > 0) size = std::min(size, kPerRadius / face.bend);
  return bounded(std::min(size, thicknessAt(x, face.inward, patch)));
}

/// Of the curve between two sides, or kNone.
Index SizeField::nearestSegment(std::array<Index, 2> patches, const Vec<3> &x) const {
  double found = kInfinity;
  Index nearest = kNone;
  segmentTree_->nearest(x, kInfinity, [&](Index s) {
    const CurveSegment &segment = segments_[at(s)];
    if (segment.patches != patches) return kInfinity;
    const Vec<3> d = nearestOnSegment<3>(x, segment.ends[0], segment.ends[1]) - x;
    const double square = glm::dot(d, d);
    if (square < found) {
      found = square;
      nearest = s;
    }
    return square;
  });
  return nearest;
}

/// What a curve's own bends and length ask for.
double SizeField::sizeOf(const CurveSegment &segment) const {
  const double size = std::min(largest_, segment.length);
  return segment.bend > 0 ? std::min(size, kPerRadius / segment.bend) : size;
}

double SizeField::onCurve(std::array<Index, 2> patches, const Vec<3> &x) const {
  const Index nearest = nearestSegment(patches, x);
  if (nearest == kNone) return largest_;
  const CurveSegment &here = segments_[at(nearest)];
  double size = sizeOf(here);
  const double limit = size / kPerGap;
  const double square = segmentTree_->nearest(x, limit * limit, [&](Index s) {
    const CurveSegment &other = segments_[at(s)];
    if (other.curve == here.curve || other.patches == here.patches) return kInfinity;
    const bool shares = std::any_of(other.patches.begin(), other.patches.end(),
                                    [&](Index p) { return p == here.patches[0] || p == here.patches[1]; });
    if (!shares) return kInfinity;
    for (const Index corner : other.corners)
      if (corner != kNone && (corner == here.corners[0] || corner == here.corners[1])) return kInfinity;
    const Vec<3> d = nearestOnSegment<3>(x, other.ends[0], other.ends[1]) - x;
    return glm::dot(d, d);
  });
  return bounded(std::min(size, kPerGap * std::sqrt(square)));
}

} // namespace dualblock
