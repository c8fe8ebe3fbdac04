// Surfaces that are embedded, and some that are not: crossings, folds, shells inside of one another.
#include "certificate/embedding.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace dualblock::test {
namespace {

struct Surface {
  std::vector<Vec<3>> positions;
  std::vector<std::array<Index, 4>> faces;

  QuadSurface view() const { return {positions, faces}; }
  std::size_t crossings(double margin = 1e-12, std::size_t most = 100) const {
    return crossingFaces(view(), margin, most).size();
  }
  /// Faces by their corners.
  Surface &add(const std::array<Vec<3>, 4> &corners) {
    const Index first = toIndex(positions.size());
    positions.insert(positions.end(), corners.begin(), corners.end());
    faces.push_back({first, first + 1, first + 2, first + 3});
    return *this;
  }
  /// Six faces, seen from outside or, around a cavity, from inside.
  Surface &addBox(const Vec<3> &low, const Vec<3> &high, bool isCavity = false) {
    const Index first = toIndex(positions.size());
    for (int k = 0; k < 8; ++k)
      positions.emplace_back(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
    for (std::array<Index, 4> f : {std::array<Index, 4>{0, 4, 6, 2},
                                   {1, 3, 7, 5},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 2, 3, 1},
                                   {4, 5, 7, 6}}) {
      for (Index &v : f) v += first;
      if (isCavity) std::swap(f[1], f[3]);
      faces.push_back(f);
    }
    return *this;
  }
};

Vec<3> turned(const Vec<3> &x) { // by whatever, so that nothing is along an axis
  const Vec<3> y{std::cos(0.7) * x.x - std::sin(0.7) * x.y, std::sin(0.7) * x.x + std::cos(0.7) * x.y, x.z};
  return {y.x, std::cos(0.4) * y.y - std::sin(0.4) * y.z, std::sin(0.4) * y.y + std::cos(0.4) * y.z};
}

TEST(Embedding, ABoxIsEmbedded) {
  Surface box = Surface{}.addBox({0, 0, 0}, {1, 2, 3});
  EXPECT_EQ(box.crossings(), 0U);
  EXPECT_TRUE(wrongShells(box.view()).empty());
  for (Vec<3> &x : box.positions) x = turned(x);
  EXPECT_EQ(box.crossings(), 0U);
  EXPECT_TRUE(wrongShells(box.view()).empty());
}

TEST(Embedding, BoxesThatCross) {
  Surface two = Surface{}.addBox({0, 0, 0}, {1, 1, 1}).addBox({0.5, 0.4, 0.3}, {1.5, 1.4, 1.3});
  for (const bool isTurned : {false, true}) {
    if (isTurned)
      for (Vec<3> &x : two.positions) x = turned(x);
    const auto pairs = crossingFaces(two.view(), 1e-12, 100);
    EXPECT_EQ(pairs.size(), 6U); // each face of a corner with two of the other
    for (const auto &[a, b] : pairs) EXPECT_TRUE(a < 6 && b >= 6) << a << " " << b;
    EXPECT_EQ(two.crossings(1e-12, 2), 2U);
  }
}

// Side by side: apart by more than the margin or by less, and with faces that lie in one another's planes.
TEST(Embedding, HowNearIsTooNear) {
  for (const auto &[gap, count] : {std::pair{1e-5, 0U}, {2e-6, 0U}, {5e-7, 5U}, {0.0, 5U}}) {
    const Surface two = Surface{}.addBox({0, 0, 0}, {1, 1, 1}).addBox({1 + gap, 0.2, 0.2}, {2, 0.8, 0.8});
    EXPECT_EQ(two.crossings(1e-6), count) << gap;
  }
  // Where they share a corner they may touch, or overlap by as much.
  for (const auto &[overlap, count] : {std::pair{0.0, 0U}, {5e-7, 0U}, {2e-6, 1U}}) {
    const Surface two = Surface{}
                            .add({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}})
                            .add({{{0, 0, 0}, {-1, 0.2, 0.3}, {0.5, 0.5, -overlap}, {0.2, -1, 0.3}}});
    EXPECT_EQ(two.crossings(1e-6), count) << overlap;
  }
}

TEST(Embedding, Folds) {
  const std::array<Vec<3>, 4> flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  const auto folded = [&](double x, double z) {
    return Surface{}.add(flat).add({{{1, 0, 0}, {1 + x, 0, z}, {1 + x, 1, z}, {1, 1, 0}}}).crossings();
  };
  EXPECT_EQ(folded(1, 0), 0U);
  EXPECT_EQ(folded(0, 1), 0U);
  EXPECT_EQ(folded(-0.9, 0.1), 0U);
  EXPECT_EQ(folded(-0.9, 0), 1U); // back upon the other
  EXPECT_EQ(folded(-0.9, -1e-3), 0U);
  // Another one through a common edge's end.
  EXPECT_EQ(
      Surface{}.add(flat).add({{{0, 0, 0}, {0.5, 0.5, 0.5}, {0.9, 0.9, 0}, {0.5, 0.5, -0.5}}}).crossings(),
      1U);
}

/// Bilinear, over [0, 1]^2: z = lift + 4 height u (1 - v).
std::array<Vec<3>, 4> saddle(double lift, double height) {
  return {{{0, 0, lift}, {1, 0, lift + height}, {1, 1, lift}, {0, 1, lift + height}}};
}

// Hulls of warped faces are tetrahedra, which meet long before the faces do.
TEST(Embedding, WarpedFacesAreDividedUntilTheyAreApart) {
  EXPECT_EQ(Surface{}.add(saddle(0, 1)).add(saddle(0.02, 1)).crossings(), 0U);
  EXPECT_EQ(Surface{}.add(saddle(0, 1)).add(saddle(0.02, 0.9)).crossings(), 1U);
  EXPECT_EQ(Surface{}.add(saddle(0, 1)).add(saddle(0.02, 1.05)).crossings(), 0U);
  EXPECT_EQ(Surface{}.add(saddle(0, 1)).add(saddle(0, 1)).crossings(), 1U);
  // Nearer than a face can be divided: not shown.
  EXPECT_EQ(Surface{}.add(saddle(0, 1)).add(saddle(1e-5, 1)).crossings(), 1U);
}

// Faces that only a plane along an edge of each keeps apart; flat ones side by side in one plane.
TEST(Embedding, EachKindOfPlaneSeparates) {
  const auto isApart = [](std::array<Vec<3>, 4> p, std::array<Vec<3>, 4> q) {
    for (Vec<3> &x : p) x = turned(x);
    for (Vec<3> &x : q) x = turned(x);
    return Surface{}.add(p).add(q).crossings() == 0;
  };
  EXPECT_TRUE(isApart({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
                      {{{1.01, -3, 0}, {2, -3, 0}, {2, 4, 0}, {1.01, 0.5, 0}}}));
  EXPECT_FALSE(isApart({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
                       {{{0.99, -3, 0}, {2, -3, 0}, {2, 4, 0}, {0.99, 0.5, 0}}}));
  EXPECT_TRUE(isApart({{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}},
                      {{{0.99, -3, 0.02}, {3, -3, 2}, {3, 3, 2}, {0.99, 3, 0.02}}}));
}

TEST(Embedding, ShellsInsideOfOneAnother) {
  const Surface inside = Surface{}.addBox({0, 0, 0}, {4, 4, 4}).addBox({1, 1, 1}, {2, 2, 2});
  EXPECT_EQ(inside.crossings(), 0U);
  const auto wrong = wrongShells(inside.view());
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_GE(wrong[0].face, 6);
  EXPECT_TRUE(wrong[0].isKnown);
  EXPECT_EQ(wrong[0].layers, 1);
  const Surface deeper = Surface{}
                             .addBox({0, 0, 0}, {4, 4, 4})
                             .addBox({1, 1, 1}, {3.1, 3.2, 3.3})
                             .addBox({1.5, 1.5, 1.5}, {2, 2, 2});
  ASSERT_EQ(wrongShells(deeper.view()).size(), 2U);
  EXPECT_EQ(wrongShells(deeper.view())[1].layers, 2);
}

TEST(Embedding, CavitiesMayHoldShells) {
  Surface nested = Surface{}.addBox({0, 0, 0}, {5, 5, 5}).addBox({1, 1, 1}, {4, 4, 4}, true);
  EXPECT_TRUE(wrongShells(nested.view()).empty());
  nested.addBox({2, 2, 2}, {3, 3, 3});
  EXPECT_TRUE(wrongShells(nested.view()).empty());
  for (Vec<3> &x : nested.positions) x = turned(x);
  EXPECT_TRUE(wrongShells(nested.view()).empty());
  // A cavity where nothing is around it: just outside of its faces there is less than nothing.
  const Surface alone = Surface{}.addBox({1, 1, 1}, {4, 4, 4}, true);
  ASSERT_EQ(wrongShells(alone.view()).size(), 1U);
  EXPECT_EQ(wrongShells(alone.view())[0].layers, -1);
}

/// A box whose upper face is warped: its corners are moved up and down in turn.
Surface warpedBox(double height) {
  Surface box = Surface{}.addBox({0, 0, 0}, {1, 1, 1});
  for (const std::size_t k : {5U, 6U}) box.positions[k].z += height;
  for (const std::size_t k : {4U, 7U}) box.positions[k].z -= height;
  return box;
}

// A ray may meet a warped face twice.
TEST(Embedding, RaysThroughWarpedFaces) {
  for (const double height : {0.05, 0.3, 0.6}) {
    Surface surface = warpedBox(height);
    EXPECT_TRUE(wrongShells(surface.view()).empty()) << height;
    surface.addBox({0.3, 0.3, 0.05}, {0.7, 0.7, 0.35});
    EXPECT_EQ(wrongShells(surface.view()).size(), 1U) << height;
    Surface above = warpedBox(height); // between its horns
    above.addBox({0.02, 0.02, 1 - 0.5 * height}, {0.04, 0.04, 1 - 0.45 * height});
    EXPECT_EQ(above.crossings(), 0U);
    EXPECT_TRUE(wrongShells(above.view()).empty()) << height;
  }
}

// A ray that leaves a face through one that is met along its rim is none that counts; another one is tried.
TEST(Embedding, ManySmallShells) {
  Surface grid;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) grid.addBox({i, j, k}, {i + 0.5, j + 0.5, k + 0.5});
  EXPECT_TRUE(wrongShells(grid.view()).empty());
  const std::size_t before = grid.faces.size();
  grid.addBox({2.1, 2.1, 2.1}, {2.4, 2.4, 2.4});
  const auto wrong = wrongShells(grid.view());
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_GE(at(wrong[0].face), before);
}

// Small faces that meet at a corner are apart by planes of a margin's width.
TEST(Embedding, FacesHardlyLargerThanTheMargin) {
  EXPECT_EQ(Surface{}
                .add({{{0, 0, 0}, {1e-4, 0, 0}, {1e-4, 1e-4, 0}, {0, 1e-4, 0}}})
                .add({{{0, 0, 0}, {-1e-4, 0, 0}, {-1e-4, -1e-4, 0}, {0, -1e-4, 0}}})
                .crossings(1e-6),
            0U);
}

/// A cube, the upper one of whose faces is the first.
Surface cube() {
  Surface surface = Surface{}.addBox({0, 0, 0}, {1, 1, 1});
  std::rotate(surface.faces.begin(), surface.faces.end() - 1, surface.faces.end());
  return surface;
}

const Vec<3> kFrom{0.5, 0.5, 1}; // where the first ray from there begins

/// Where it goes.
Vec<3> firstDirection() {
  const double turn = 2.399963229728653;
  const Vec<3> along = glm::normalize(Vec<3>(1, 1, 0));
  const Vec<3> across = glm::normalize(Vec<3>(-1, 1, 0));
  return Vec<3>(0, 0, 1) + 0.15 * (std::cos(turn) * along + std::sin(turn) * across);
}

// The first ray from a cube runs into an edge of another box.
TEST(Embedding, ARayThatMeetsAnEdgeDoesNotCount) {
  Surface surface = cube();
  const Vec<3> direction = firstDirection();
  const Vec<3> met = kFrom + direction;
  // The lower edge on that side from which the ray comes.
  const double width = direction.x > 0 ? 1 : -1;
  surface.addBox({std::min(met.x, met.x + width), met.y - 3, met.z},
                 {std::max(met.x, met.x + width), met.y + 3, met.z + 1});
  EXPECT_TRUE(wrongShells(surface.view()).empty());
}

/// The face whose ray tells that a cube lies in a box: the second one where a face in the way of the first
/// one's ray makes that unclear. The face's corners are along the ray and along two directions across it,
/// from a place that it comes by.
Index teller(const std::array<Vec<3>, 4> &met) {
  const Vec<3> along = glm::normalize(firstDirection());
  const Vec<3> right = glm::normalize(glm::cross(along, Vec<3>(1, 0, 0)));
  const Vec<3> up = glm::cross(along, right);
  Surface surface = cube().addBox({-9, -9, -9}, {9, 9, 9});
  std::array<Vec<3>, 4> corners;
  for (std::size_t k = 0; k < 4; ++k)
    corners[k] = kFrom + (2 + met[k].x) * along + met[k].y * right + met[k].z * up;
  surface.add(corners);
  for (const WrongShell &shell : wrongShells(surface.view()))
    if (shell.face < 6) return shell.face;
  return kNone;
}

TEST(Embedding, RaysNearTheRimOfAFaceDoNotCount) {
  const auto nearRim = [](double share) {
    return teller({{{0, -share, -0.5}, {0, 1 - share, -0.5}, {0, 1 - share, 0.5}, {0, -share, 0.5}}});
  };
  EXPECT_EQ(nearRim(0.3), 0);
  EXPECT_EQ(nearRim(1e-5), 0);
  EXPECT_EQ(nearRim(1e-8), 1);
}

TEST(Embedding, RaysAlongAFaceDoNotCount) {
  const auto tilted = [](double slope) {
    return teller(
        {{{-0.5, -0.5, -slope / 2}, {-0.5, 0.5, -slope / 2}, {0.5, 0.5, slope / 2}, {0.5, -0.5, slope / 2}}});
  };
  EXPECT_EQ(tilted(0.1), 0);
  EXPECT_EQ(tilted(1e-5), 0);
  EXPECT_EQ(tilted(1e-8), 1);
}

// A saddle, whose ridge the ray goes through twice, or hardly touches.
TEST(Embedding, RaysThatGrazeAFaceDoNotCount) {
  const auto grazed = [](double share) {
    const double height = 0.2;
    const double high = height * (1 - share);
    const double low = -height * (1 + share);
    return teller({{{-1, 0, high}, {0, 1, low}, {1, 0, high}, {0, -1, low}}});
  };
  EXPECT_EQ(grazed(0.1), 0);
  EXPECT_EQ(grazed(1e-10), 0);
  EXPECT_EQ(grazed(1e-12), 1);
}

// Along a side that is a point a face runs in no direction.
TEST(Embedding, NothingTellsWhereTriangularFacesAre) {
  const std::array<Vec<3>, 4> x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Surface tetrahedron{{x.begin(), x.end()}, {{0, 2, 1, 0}, {0, 1, 3, 0}, {1, 2, 3, 1}, {2, 0, 3, 2}}};
  const auto wrong = wrongShells(tetrahedron.view());
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_FALSE(wrong[0].isKnown);
}

// A face without area tells nothing, whatever is around it.
TEST(Embedding, NothingTellsWhereAFlatFaceIs) {
  Surface flat = Surface{}.addBox({0, 0, 0}, {4, 4, 4});
  flat.add({{{1, 1, 1}, {1.5, 1, 1}, {2, 1, 1}, {3, 1, 1}}});
  const auto wrong = wrongShells(flat.view());
  ASSERT_EQ(wrong.size(), 1U);
  EXPECT_FALSE(wrong[0].isKnown);
}

} // namespace
} // namespace dualblock::test
