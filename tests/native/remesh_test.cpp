// Good simplices: whatever the edits do, what comes out is a mesh of the same domain, and of better shape.
#include <map>
#include <set>
#include <tuple>

#include "geometry/nearest.h"
#include "remesh/remesh.h"
#include "remesh/tet_editor.h"
#include "support/bent_domains.h"
#include "support/dimensions.h"
#include "support/random_domains.h"
#include "support/round_solids.h"

namespace dualblock::test {
namespace {

struct Remeshed {
  ReferenceMesh<3> coarse;
  Parts<3> features;
  ReferenceMesh<3> good;
};

Remeshed remeshed(const Domain<3> &domain, double scale = 1) {
  Remeshed r{fill(domain), {}, {}};
  r.features = buildParts(r.coarse, PartOptions{});
  keepVertices(r.coarse, r.features);
  auto good = remesh(r.coarse, r.features, {scale, 0});
  if (!good) throw std::runtime_error("no mesh");
  r.good = std::move(*good);
  return r;
}

double worstShape(const ReferenceMesh<3> &mesh) {
  double worst = 1;
  for (const auto &[a, b, c, d] : mesh.simplices)
    worst =
        std::min(worst, shapeOf(mesh.nodes[at(a)], mesh.nodes[at(b)], mesh.nodes[at(c)], mesh.nodes[at(d)]));
  return worst;
}

/// Nodes less edges plus faces less tetrahedra, of what has no boundary but these.
int eulerOf(const ReferenceMesh<3> &mesh) {
  std::set<std::array<Index, 2>> edges;
  std::set<std::array<Index, 3>> faces;
  std::set<Index> nodes;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    const auto &v = mesh.simplices[at(s)];
    for (std::size_t a = 0; a < 4; ++a) {
      nodes.insert(v[a]);
      faces.insert(mesh.sortedFace(s, static_cast<int>(a)));
      for (std::size_t b = 0; b < a; ++b) edges.insert(sortedPair(v[a], v[b]));
    }
  }
  return static_cast<int>(nodes.size()) - static_cast<int>(edges.size()) + static_cast<int>(faces.size()) -
         static_cast<int>(mesh.simplices.size());
}

std::map<Index, double> volumesOf(const ReferenceMesh<3> &mesh) {
  std::map<Index, double> volumes;
  for (std::size_t s = 0; s < mesh.simplices.size(); ++s)
    volumes[mesh.region[s]] += orientation<3>(mesh.nodes, mesh.simplices[s]) / 6;
  return volumes;
}

void expectCornersKept(const Remeshed &r) {
  for (const Corner &corner : r.features.corners)
    EXPECT_NE(std::find(r.good.nodes.begin(), r.good.nodes.end(), r.coarse.nodes[at(corner.node)]),
              r.good.nodes.end())
        << "corner " << corner.node;
}

// Of a polyhedron nothing may change: neither a region's volume, nor a facet's area.
TEST(Remesh, KeepsPolyhedraExactly) {
  int sound = 0;
  int all = 0;
  for (int kind = 0; kind < kRandomKinds; ++kind) {
    if (kind == 5) continue; // round: see below
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
      SCOPED_TRACE("kind " + std::to_string(kind) + ", seed " + std::to_string(seed));
      const Remeshed r = remeshed(randomSolid(kind, seed));
      if (std::any_of(r.coarse.surfaces.begin(), r.coarse.surfaces.end(),
                      [](const auto &s) { return s.bent; }))
        continue; // hulls of many facets
      EXPECT_EQ(brokenInvariants(r.good), std::vector<std::string>{});
      EXPECT_EQ(eulerOf(r.good), eulerOf(r.coarse));
      const double size2 = r.coarse.size * r.coarse.size;
      for (const auto &[region, volume] : volumesOf(r.coarse))
        EXPECT_NEAR(volumesOf(r.good)[region], volume, 1e-11 * size2 * r.coarse.size);
      for (Index f = 0; f < toIndex(r.coarse.surfaces.size()); ++f)
        EXPECT_NEAR(surfaceMeasure(r.good, f), surfaceMeasure(r.coarse, f), 1e-11 * size2) << f;
      expectCornersKept(r);
      // Acute angles of the domain remain, and needles are not worth their price: those are refused later.
      if (angleBound(r.coarse, r.features) > 0.5) sound += worstShape(r.good) > 0.2 ? 1 : 0, ++all;
    }
  }
  EXPECT_GE(sound, all * 9 / 10);
  EXPECT_GT(all, 20);
}

/// Distance of a node on a bent side from its facets, over the domain's size.
double largestDistance(const Remeshed &r) {
  const BentFacets<3> facets = bentFacetsOf(r.coarse, r.features, r.coarse.nodes);
  double largest = 0;
  for (Index s = 0; s < r.good.simplexCount(); ++s)
    for (int i = 0; i < 4; ++i) {
      const Index tag = r.good.tags[at(s)][at(i)];
      if (tag == kNone || !r.good.surfaces[at(FaceTag::surface(tag))].bent) continue;
      for (const Index v : r.good.sortedFace(s, i)) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t f = 0; f < facets.faces.size(); ++f) {
          if (facets.patchOfFace[f] != r.good.sideKey(tag) / 2) continue;
          const auto &[a, b, c] = facets.faces[f];
          const Vec<3> &x = r.good.nodes[at(v)];
          least = std::min(least, glm::length(nearestOnTriangle(x, a, b, c) - x));
        }
        largest = std::max(largest, least);
      }
    }
  return largest / r.coarse.size;
}

// Nodes of bent sides stay on them, faces stay near, and shapes are good, however poor the coarsest mesh is.
TEST(Remesh, FollowsBentSides) {
  const std::vector<std::pair<const char *, Domain<3>>> solids{{"plate with a hole", plateWithHole(32)},
                                                               {"shaft", shaft(24)},
                                                               {"ball", ball(16)},
                                                               {"torus", torus(32, 16)},
                                                               {"cone", cone(24)}};
  for (const auto &[name, domain] : solids) {
    SCOPED_TRACE(name);
    const Remeshed r = remeshed(domain);
    EXPECT_EQ(brokenInvariants(r.good, false, true), std::vector<std::string>{});
    EXPECT_EQ(eulerOf(r.good), eulerOf(r.coarse));
    expectCornersKept(r);
    EXPECT_LT(largestDistance(r), 1e-12);
    EXPECT_NEAR(measureOf(r.good), measureOf(r.coarse), 0.08 * measureOf(r.coarse));
    EXPECT_GE(worstShape(r.good), 0.25);
    EXPECT_LT(worstShape(r.coarse), 0.1); // or there would be nothing to show
  }
}

TEST(Remesh, IsReproducibleAndFinerWhereAsked) {
  const Domain<3> domain = plateWithHole(32);
  const Remeshed once = remeshed(domain);
  const Remeshed again = remeshed(domain);
  EXPECT_EQ(once.good.simplices, again.good.simplices);
  EXPECT_EQ(once.good.nodes, again.good.nodes);
  EXPECT_GT(remeshed(domain, 0.6).good.simplexCount(), 2 * once.good.simplexCount());
  EXPECT_FALSE(remesh(once.coarse, once.features, {1, once.good.simplexCount() / 2}).has_value());
}

/// Tetrahedra with their tags, wherever they are stored.
std::multiset<std::array<std::array<Index, 4>, 2>> contents(const TetMesh &mesh) {
  std::multiset<std::array<std::array<Index, 4>, 2>> all;
  for (Index t = 0; t < toIndex(mesh.tets.size()); ++t)
    if (mesh.isAlive(t)) all.insert({mesh.tets[at(t)].v, mesh.tets[at(t)].tags});
  return all;
}

class Editing : public ::testing::Test {
protected:
  Editing() {
    for (const Vec<3> &x : coarse_.nodes) mesh_.addNode({x, On::inside, {kNone, kNone}, 1});
    for (std::size_t s = 0; s < coarse_.simplices.size(); ++s)
      mesh_.add({coarse_.simplices[s], coarse_.tags[s], 0, 0});
    for (TetNode &node : mesh_.nodes) node.on = On::corner;
  }

  ReferenceMesh<3> coarse_ = fill(prism({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 0, 1));
  Parts<3> features_ = buildParts(coarse_, PartOptions{});
  BentShape<3> shape_{bentFacetsOf(coarse_, features_, coarse_.nodes, true)};
  SizeField sizes_{coarse_, features_, 1};
  TetMesh mesh_;
  TetEditor editor_{mesh_, coarse_, shape_, sizes_};
};

TEST_F(Editing, IsTakenBackWhole) {
  const auto before = contents(mesh_);
  mesh_.mark();
  std::vector<Index> added;
  for (Index s = 0; s < coarse_.simplexCount(); ++s) {
    const auto v = coarse_.simplices[at(s)];
    if (!mesh_.hasEdge(v[0], v[1])) continue;
    added.push_back(editor_.splitEdge(v[0], v[1]));
    editor_.smooth(added.back());
  }
  EXPECT_NE(contents(mesh_), before);
  EXPECT_GT(mesh_.worstOfNew(), 0);
  mesh_.rollBack();
  EXPECT_EQ(contents(mesh_), before);
  for (const Index node : added) EXPECT_TRUE(mesh_.star(node).empty());
  EXPECT_EQ(mesh_.aliveCount(), coarse_.simplexCount());
}

// A tetrahedron that stays may take the tag of one that goes: that is taken back as well.
TEST_F(Editing, TakesTagsBack) {
  const auto v = coarse_.simplices[0];
  const Index node = editor_.splitEdge(v[0], v[1]);
  ASSERT_NE(node, kNone);
  const auto before = contents(mesh_);
  for (const Index to : {v[0], v[1]}) {
    mesh_.mark();
    if (editor_.collapseEdge(node, to, 0, 10)) {
      EXPECT_NE(contents(mesh_), before);
    }
    mesh_.rollBack();
    EXPECT_EQ(contents(mesh_), before);
  }
  mesh_.mark();
  mesh_.setTag(0, 0, FaceTag::flipped(mesh_.tets[0].tags[0] == kNone ? 0 : mesh_.tets[0].tags[0]));
  EXPECT_NE(contents(mesh_), before);
  mesh_.rollBack();
  EXPECT_EQ(contents(mesh_), before);
}

// What swapping depends on, the tetrahedra at the edges of each, is looked at as a whole: nothing that is
// said to be unchanged may differ, and most of what is far away has to be.
TEST_F(Editing, KnowsWhereNothingHasChanged) {
  for (int round = 0; round < 4; ++round)
    for (const Tet &tet : std::vector<Tet>(mesh_.tets))
      if (tet.v[0] != kNone && mesh_.hasEdge(tet.v[0], tet.v[1])) editor_.splitEdge(tet.v[0], tet.v[1]);
  using Around = std::set<std::tuple<std::array<Index, 4>, std::array<Index, 4>, std::array<double, 12>>>;
  const auto around = [&](Index t) {
    Around all;
    std::vector<Index> shell;
    for (const Index a : mesh_.tets[at(t)].v)
      for (const Index b : mesh_.tets[at(t)].v) {
        if (a >= b) continue;
        mesh_.shellOf(a, b, shell);
        for (const Index s : shell) {
          const Tet &tet = mesh_.tets[at(s)];
          std::array<double, 12> places{};
          for (std::size_t k = 0; k < 12; ++k) places[k] = mesh_.x(tet.v[k / 3])[static_cast<int>(k % 3)];
          all.insert({tet.v, tet.tags, places});
        }
      }
    return all;
  };
  const auto expectKnown = [&](const char *what, const auto &edit) {
    SCOPED_TRACE(what);
    std::map<Index, Around> before;
    for (Index t = 0; t < toIndex(mesh_.tets.size()); ++t) {
      if (!mesh_.isAlive(t)) continue;
      mesh_.unchanged(t);
      before[t] = around(t);
    }
    edit();
    int same = 0;
    for (const auto &[t, was] : before) {
      if (!mesh_.isAlive(t) || mesh_.hasChanged(t)) continue;
      ++same;
      EXPECT_EQ(around(t), was) << "tetrahedron " << t;
    }
    EXPECT_GT(same, 0);
    EXPECT_LT(same, toIndex(before.size()));
  };
  const Tet first = mesh_.tets[0];
  Index node = kNone;
  expectKnown("divided", [&] { node = editor_.splitEdge(first.v[0], first.v[1]); });
  expectKnown("moved", [&] { mesh_.move(node, mesh_.x(node) + Vec<3>(1e-3)); });
  expectKnown("another tag", [&] { mesh_.setTag(mesh_.star(node)[0], 0, 0); });
  expectKnown("taken back", [&] {
    mesh_.mark();
    mesh_.move(node, mesh_.x(node) + Vec<3>(1e-3));
    for (const Index t : std::vector<Index>(mesh_.star(node).begin(), mesh_.star(node).end()))
      mesh_.unchanged(t);
    mesh_.rollBack();
  });
}

// What was divided contracts again, but never a corner into anything, nor a node off what it lies on.
TEST_F(Editing, ContractsWithinWhatANodeLiesOn) {
  const auto edge = [&](On on) -> std::array<Index, 2> {
    for (const Tet &tet : std::vector<Tet>(mesh_.tets))
      for (const auto &[a, b] : {std::pair(0, 1), std::pair(0, 2), std::pair(0, 3), std::pair(1, 2)})
        if (editor_.placeOf(tet.v[at(a)], tet.v[at(b)]).on == on) return {tet.v[at(a)], tet.v[at(b)]};
    return {kNone, kNone};
  };
  for (const On on : {On::curve, On::side}) {
    const auto [a, b] = edge(on);
    ASSERT_NE(a, kNone);
    EXPECT_FALSE(editor_.collapseEdge(a, b, 0, 10)) << "a corner went";
    const Index node = editor_.splitEdge(a, b);
    ASSERT_NE(node, kNone);
    EXPECT_EQ(mesh_.nodes[at(node)].on, on);
    for (const Tet &tet : std::vector<Tet>(mesh_.tets)) { // into what is off its curve or side
      if (tet.v[0] == kNone || !tet.has(node)) continue;
      for (const Index other : tet.v)
        if (other != node && editor_.placeOf(node, other).on != on) {
          EXPECT_FALSE(editor_.collapseEdge(node, other, 0, 10));
        }
    }
    EXPECT_TRUE(editor_.collapseEdge(node, a, 0, 10));
    EXPECT_TRUE(mesh_.star(node).empty());
  }
}

// A solid that no cut serves gets sound blocks, whose nodes lie on its bent sides, and so do refined ones.
TEST(Remesh, MakesSoundBlocksWhereNoCutServes) {
  int made = 0;
  for (const auto &[kind, seed] : {std::pair(4, 1U), std::pair(4, 4U), std::pair(4, 5U)}) {
    const auto r = run(bentSolid(kind, seed));
    EXPECT_TRUE(r.certificate.valid) << failuresOf(r.certificate);
    if (r.remeshedComponents == 0) continue;
    ++made;
    EXPECT_NE(r.given, nullptr);
    EXPECT_GE(minimumQuality(r), 0.1);
    EXPECT_LT(r.certificate.fidelity.largestDistance, 1.0 / 3);
  }
  EXPECT_GT(made, 0);
}

TEST(AngleBound, IsTheSineOfTheSmallestAngle) {
  const double third = std::numbers::pi / 3;
  const auto boundOf = [](const Domain<3> &domain) { return run(domain).angleBound; };
  EXPECT_EQ(boundOf(prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0, 1)), 1);
  EXPECT_NEAR(boundOf(prism({{0, 0}, {1, 0}, {0.5, std::sin(third)}}, 0, 1)), std::sin(third), 1e-12);
  EXPECT_NEAR(boundOf(prism({{0, 0}, {10, 0}, {10, 1}}, 0, 1)), 1 / std::sqrt(101), 1e-12);
  EXPECT_EQ(boundOf(prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0, 1)), 1); // reflex is not acute
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {                                    // and a bound it is
    const auto r = run(randomSolid(0, seed));
    EXPECT_LE(minimumQuality(r), r.angleBound + 1e-9) << seed;
  }
}

} // namespace
} // namespace dualblock::test
