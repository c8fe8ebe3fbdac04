// Of check 5: each curve of the domain is a chain of primal edges. The nodes of the creases between two
// patches are put in order along the domain's curves between them; creases must join neighbours, from end to
// end.
#include <limits>
#include <span>

#include "base/sort.h"
#include "certificate/checks.h"

namespace dualblock {
namespace {

/// Connected pieces of the curves between two patches, with the place of each ridge along its piece. One
/// serves many curves, one after the other, most of which are too short to be worth vectors of their own.
class Course {
public:
  struct Stretch {
    Vec<3> from, to;
    Index piece;
    double start; // length before it
  };
  std::vector<Stretch> stretches;
  std::vector<double> lengths; // per piece
  std::vector<bool> closed;

  void follow(const std::vector<Vec<3>> &nodes, const std::vector<std::array<Index, 2>> &ridges);

private:
  using End = std::pair<Index, std::size_t>; // node, ridge
  std::vector<End> ends;
  std::vector<bool> used; // per ridge
};

void Course::follow(const std::vector<Vec<3>> &nodes, const std::vector<std::array<Index, 2>> &ridges) {
  stretches.clear();
  lengths.clear();
  closed.clear();
  ends.clear();
  used.assign(ridges.size(), false);
  for (std::size_t r = 0; r < ridges.size(); ++r)
    for (const Index n : ridges[r]) ends.emplace_back(n, r);
  sortItems(ends);
  const auto endsAt = [&](Index node) {
    const End *const last = ends.data() + ends.size();
    const End *const first = std::lower_bound<const End *>(ends.data(), last, End{node, 0});
    const End *end = first;
    while (end != last && end->first == node) ++end;
    return std::span<const End>(first, end);
  };
  const auto walk = [&](Index start) {
    const Index piece = toIndex(lengths.size());
    double length = 0;
    Index here = start;
    while (true) {
      std::size_t next = ridges.size();
      for (const auto &[node, r] : endsAt(here))
        if (!used[r]) next = std::min(next, r);
      if (next == ridges.size()) break;
      used[next] = true;
      const Index there = ridges[next][0] == here ? ridges[next][1] : ridges[next][0];
      const Vec<3> a = nodes[at(here)];
      const Vec<3> b = nodes[at(there)];
      stretches.push_back({a, b, piece, length});
      length += glm::length(b - a);
      here = there;
      if (here == start || endsAt(here).size() != 2) break;
    }
    lengths.push_back(length);
    closed.push_back(here == start);
  };
  const auto walkAll = [&](bool fromEnds) {
    for (const auto &[node, r] : ends)
      if (!used[r] && (endsAt(node).size() != 2) == fromEnds) walk(node);
  };
  walkAll(true);
  walkAll(false);
}

struct Place {
  Index piece;
  double along;
  Index node;
};

double distanceAlong(const Course::Stretch &s, const Vec<3> &x, double &along) {
  const Vec<3> d = s.to - s.from;
  const double square = glm::dot(d, d);
  const double t = square > 0 ? std::clamp(glm::dot(x - s.from, d) / square, 0.0, 1.0) : 0.0;
  along = s.start + t * glm::length(d);
  return glm::length(x - (s.from + t * d));
}

/// What an edge of the mesh stands for: the course from one of its nodes to the other.
struct Span {
  std::array<Index, 2> nodes;
  std::vector<Vec<3>> course;
};

/// What followsCourse works with, kept from one curve to the next.
struct Links {
  std::vector<Span> spans; // of the course that was followed last, if it bends
  std::vector<std::array<Place, 2>> all;
  std::vector<std::pair<double, Index>> order; // of one piece
  std::vector<std::array<Index, 2>> joined, wanted;
};

/// What the edges between neighbours in a piece's `order` stand for, where it bends at all.
void addSpans(const BlockInput<3> &in, const Course &course, Index piece,
              const std::vector<std::pair<double, Index>> &order, std::vector<Span> &spans) {
  std::vector<const Course::Stretch *> stretches;
  for (const Course::Stretch &s : course.stretches)
    if (s.piece == piece) stretches.push_back(&s);
  if (stretches.size() < 2) return;
  const auto addTo = [&](Span &span, double from, double to) { // the course's points strictly between
    for (const Course::Stretch *s : stretches)
      if (s->start > from && s->start < to) span.course.push_back(s->from);
  };
  const double length = course.lengths[at(piece)];
  for (std::size_t k = 0; k + (course.closed[at(piece)] ? 0 : 1) < order.size(); ++k) {
    const auto &[from, a] = order[k];
    const auto &[to, b] = order[(k + 1) % order.size()];
    Span span{{a, b}, {in.blocks.positions[at(a)]}};
    addTo(span, from, to > from ? to : length);
    if (to <= from) addTo(span, -1, to);
    span.course.push_back(in.blocks.positions[at(b)]);
    if (span.course.size() > 2) spans.push_back(std::move(span));
  }
}

/// Whether the creases join the course's nodes in their order, all around or from end to end.
bool followsCourse(const BlockInput<3> &in, const Course &course, const Crease *begin, const Crease *end,
                   double tolerance, Links &links) {
  auto &[spans, all, order, joined, wanted] = links;
  spans.clear();
  all.clear();
  for (const Crease *c = begin; c != end; ++c) {
    // The piece that holds both nodes best: nodes where pieces meet lie on several.
    std::array<Place, 2> link{};
    double least = std::numeric_limits<double>::infinity();
    for (Index piece = 0; piece < toIndex(course.lengths.size()); ++piece) {
      std::array<Place, 2> here{};
      double worst = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        double best = std::numeric_limits<double>::infinity();
        for (const Course::Stretch &s : course.stretches) {
          double along = 0;
          if (s.piece != piece) continue;
          const double d = distanceAlong(s, in.blocks.positions[at(c->nodes[k])], along);
          if (d >= best) continue;
          best = d;
          here[k] = {piece, along, c->nodes[k]};
        }
        worst = std::max(worst, best);
      }
      if (worst >= least) continue;
      least = worst;
      link = here;
    }
    if (!(least <= tolerance)) return false;
    all.push_back(link);
  }
  for (Index piece = 0; piece < toIndex(course.lengths.size()); ++piece) {
    order.clear();
    joined.clear();
    wanted.clear();
    for (const auto &link : all) {
      if (link[0].piece != piece) continue;
      for (const Place &p : link) order.emplace_back(p.along, p.node);
      joined.push_back(sortedPair(link[0].node, link[1].node));
    }
    sortItems(order);
    order.erase(std::unique(order.begin(), order.end(),
                            [](const auto &a, const auto &b) { return a.second == b.second; }),
                order.end());
    if (order.size() < 2) return false;
    const double length = course.lengths[at(piece)];
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
      if (!(order[k + 1].first - order[k].first > tolerance)) return false;
      wanted.push_back(sortedPair(order[k].second, order[k + 1].second));
    }
    if (course.closed[at(piece)]) {
      if (order.size() < 3) return false;
      wanted.push_back(sortedPair(order.back().second, order.front().second));
    } else if (order.front().first > tolerance || order.back().first < length - tolerance) {
      return false;
    }
    sortItems(wanted);
    sortItems(joined);
    if (wanted != joined) return false;
    addSpans(in, course, piece, order, spans);
  }
  return true;
}

/// Edges along curves stand for what is between their nodes.
void checkSpans(const std::vector<Span> &spans, const std::array<Index, 2> &keys, Certificate &certificate) {
  Fidelity &fidelity = certificate.fidelity;
  for (const Span &span : spans) {
    const double sag = sagOf(span.course);
    const double turning = turningOf(span.course);
    fidelity.largestDistance = std::max(fidelity.largestDistance, sag);
    fidelity.largestTurning = std::max(fidelity.largestTurning, turning);
    if (sag <= kMostDistance && turning <= kMostTurning) continue;
    const std::string strays = turning > kMostTurning
                                   ? "turns by " + scientific(turning) + " degrees along it"
                                   : "is up to " + scientific(sag) + " of its length away";
    certificate.fail(
        Check::features,
        "the edge between nodes " + std::to_string(span.nodes[0]) + " and " + std::to_string(span.nodes[1]) +
            " strays from the curve between facets " + std::to_string(keys[0] / 2) + " and " +
            std::to_string(keys[1] / 2) + ", which " + strays,
        {{"node", span.nodes[0]}, {"node", span.nodes[1]}, {"facet", keys[0] / 2}, {"facet", keys[1] / 2}});
  }
}

template <int N> std::array<Index, 2> keysOf(const BlockInput<N> &in, const Curve<N> &curve) {
  return sortedPair(in.mesh.sideKey(in.features.sides[at(curve.sides[0])].tag),
                    in.mesh.sideKey(in.features.sides[at(curve.sides[1])].tag));
}

template <int N> void failCurve(const std::array<Index, 2> &keys, Certificate &certificate) {
  certificate.fail(Check::features,
                   "the curve between facets " + std::to_string(keys[0] / 2) + " and " +
                       std::to_string(keys[1] / 2) + " is no chain of primal edges",
                   {{"facet", keys[0] / 2}, {"facet", keys[1] / 2}});
}

bool keysLess(const Crease &c, const std::array<Index, 2> &keys) { return c.keys < keys; }

} // namespace

void checkCurves(const BlockInput<3> &in, const std::vector<Crease> &creases, double tolerance,
                 Certificate &certificate) {
  std::vector<std::pair<std::array<Index, 2>, std::size_t>> order; // curves by keys
  for (std::size_t c = 0; c < in.features.curves.size(); ++c)
    order.emplace_back(keysOf(in, in.features.curves[c]), c);
  sortItems(order);
  Course course;
  Links links;
  std::vector<std::array<Index, 2>> ridges;
  std::size_t known = 0; // creases between patches that have a curve
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const auto keys = order[begin].first;
    ridges.clear();
    for (; end < order.size() && order[end].first == keys; ++end) {
      const auto &more = in.features.curves[order[end].second].ridges;
      ridges.insert(ridges.end(), more.begin(), more.end());
    }
    const Crease *first =
        creases.data() + (std::lower_bound(creases.begin(), creases.end(), keys, keysLess) - creases.begin());
    const Crease *last = first;
    while (last != creases.data() + creases.size() && last->keys == keys) ++last;
    known += static_cast<std::size_t>(last - first);
    course.follow(in.featureNodes, ridges);
    if (first == last || !followsCourse(in, course, first, last, tolerance, links))
      failCurve<3>(keys, certificate);
    else checkSpans(links.spans, keys, certificate);
  }
  if (known != creases.size())
    certificate.fail(Check::features, "blocks meet along a curve that the domain does not have");
}

void checkCurves(const BlockInput<2> &in, const std::vector<Crease> &creases, double,
                 Certificate &certificate) {
  std::vector<std::array<Index, 2>> wanted;
  std::vector<std::array<Index, 2>> made;
  for (const Curve<2> &curve : in.features.curves)
    for (std::size_t r = 0; r < curve.ridges.size(); ++r) wanted.push_back(keysOf(in, curve));
  for (const Crease &c : creases) made.push_back(c.keys);
  sortItems(wanted);
  if (wanted == made) return; // creases are sorted
  std::vector<std::array<Index, 2>> different;
  std::set_symmetric_difference(wanted.begin(), wanted.end(), made.begin(), made.end(),
                                std::back_inserter(different));
  for (const auto &keys : different) failCurve<2>(keys, certificate);
}

} // namespace dualblock
