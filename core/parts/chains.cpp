#include "parts/chains.h"

#include <cmath>

#include "base/sort.h"
#include "partition/heuristics.h"

namespace dualblock {
std::vector<Chain> chainsOf(const Curve<3> &curve) {
  std::vector<std::array<Index, 2>> links; // each ridge from both ends
  for (const auto &[a, b] : curve.ridges) {
    links.push_back({a, b});
    links.push_back({b, a});
  }
  sortItems(links);
  std::vector<bool> used(links.size(), false);
  const auto degree = [&](Index node) {
    const auto first = std::lower_bound(links.begin(), links.end(), std::array<Index, 2>{node, kNone});
    const auto last = std::lower_bound(links.begin(), links.end(), std::array<Index, 2>{node + 1, kNone});
    return last - first;
  };
  std::vector<Chain> chains;
  const auto follow = [&](std::size_t link) {
    Chain chain{{links[link][0]}, false};
    while (true) {
      used[link] = true;
      const auto back =
          std::lower_bound(links.begin(), links.end(), std::array<Index, 2>{links[link][1], links[link][0]});
      used[static_cast<std::size_t>(back - links.begin())] = true;
      const Index here = links[link][1];
      if (here == chain.nodes.front()) {
        chain.closed = true;
        break;
      }
      chain.nodes.push_back(here);
      if (degree(here) != 2) break;
      std::size_t next = static_cast<std::size_t>(
          std::lower_bound(links.begin(), links.end(), std::array<Index, 2>{here, kNone}) - links.begin());
      if (used[next]) ++next;
      if (next == links.size() || links[next][0] != here || used[next]) break;
      link = next;
    }
    chains.push_back(std::move(chain));
  };
  for (std::size_t link = 0; link < links.size(); ++link) // from ends first, then around
    if (!used[link] && degree(links[link][0]) != 2) follow(link);
  for (std::size_t link = 0; link < links.size(); ++link)
    if (!used[link]) follow(link);
  return chains;
}

std::vector<Segment<3>> segmentsOf(const Chain &chain, const std::vector<Vec<3>> &nodes) {
  std::vector<Segment<3>> segments;
  for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k)
    segments.push_back({nodes[at(chain.nodes[k])], nodes[at(chain.nodes[k + 1])]});
  if (chain.closed) segments.push_back({nodes[at(chain.nodes.back())], nodes[at(chain.nodes.front())]});
  return segments;
}

namespace {

/// The axis of the circle through three points; nothing where they are nearly in a row.
bool axisThrough(const Vec<3> &a, const Vec<3> &second, const Vec<3> &third, Axis &axis) {
  const Vec<3> b = second - a;
  const Vec<3> c = third - a;
  const Vec<3> normal = glm::cross(b, c);
  const double square = glm::dot(normal, normal);
  if (!(square > 1e-4 * glm::dot(b, b) * glm::dot(c, c))) return false;
  axis.centre =
      a + (glm::dot(c, c) * glm::cross(normal, b) + glm::dot(b, b) * glm::cross(c, normal)) / (2 * square);
  axis.direction = normal / std::sqrt(square);
  return true;
}

} // namespace

bool axisOf(const Chain &chain, const std::vector<Vec<3>> &nodes, Axis &axis) {
  const auto node = [&](std::size_t k) { return nodes[at(chain.nodes[k])]; };
  const std::size_t count = chain.nodes.size();
  if (!chain.closed) return axisThrough(node(0), node(count / 2), node(count - 1), axis);
  // A circle's nodes need not be evenly spaced: their mean would be beside the centre.
  if (axisThrough(node(0), node(count / 3), node(2 * count / 3), axis)) {
    const double radius = glm::length(node(0) - axis.centre);
    bool isCircle = true;
    for (std::size_t k = 0; k < count && isCircle; ++k)
      isCircle = std::abs(glm::length(node(k) - axis.centre) - radius) <= kCircle * radius;
    if (isCircle) return true;
  }
  Vec<3> area{0.0};
  Vec<3> centre{0.0};
  double length = 0;
  for (const Segment<3> &s : segmentsOf(chain, nodes)) {
    area += glm::cross(s[0] - node(0), s[1] - node(0));
    const double l = glm::length(s[1] - s[0]);
    centre += 0.5 * l * (s[0] + s[1]);
    length += l;
  }
  if (!(glm::length(area) > 1e-6 * length * length)) return false;
  axis = {centre / length, glm::normalize(area)};
  return true;
}

std::vector<Axis> axesOf(const Parts<3> &parts, const std::vector<Vec<3>> &nodes) {
  std::vector<Axis> axes;
  for (const Curve<3> &curve : parts.curves)
    for (const Chain &chain : chainsOf(curve))
      if (Axis axis; axisOf(chain, nodes, axis)) axes.push_back(axis);
  return axes;
}

const Axis *knownAxis(const std::vector<Axis> &known, const Chain &chain, const std::vector<Vec<3>> &nodes,
                      const Axis &axis) {
  const double radius = glm::length(nodes[at(chain.nodes[0])] - axis.centre);
  for (const Axis &k : known) {
    if (std::abs(glm::dot(k.direction, axis.direction)) < kSameAxisCosine) continue;
    const Vec<3> beside = axis.centre - k.centre;
    if (glm::length(beside - glm::dot(beside, k.direction) * k.direction) <= kSameAxisPlace * radius)
      return &k;
  }
  return nullptr;
}

bool axisOf(const Chain &chain, const std::vector<Vec<3>> &nodes, const std::vector<Axis> &known,
            Axis &axis) {
  if (!axisOf(chain, nodes, axis)) return false;
  if (const Axis *k = knownAxis(known, chain, nodes, axis)) {
    axis.centre = k->centre + glm::dot(axis.centre - k->centre, k->direction) * k->direction;
    axis.direction = glm::dot(axis.direction, k->direction) < 0 ? -k->direction : k->direction;
  }
  return true;
}

std::vector<Index> halfOf(const Chain &chain, const std::vector<Vec<3>> &nodes, const Axis &axis,
                          const Vec<3> &towards) {
  std::vector<Index> half;
  for (const Index n : chain.nodes)
    if (glm::dot(nodes[at(n)] - axis.centre, towards) > 0) half.push_back(n);
  return half;
}

} // namespace dualblock
