// Cuts along planes (ARCHITECTURE.md 3): what is cut falls apart by the signs of the plane and nothing else
// changes.
#include "reference/cut.h"

#include <cmath>
#include <map>
#include <random>

#include "support/dimensions.h"

namespace dualblock::test {
namespace {

template <typename Dimension> class PlaneCut : public ::testing::Test {};
TYPED_TEST_SUITE(PlaneCut, Dimensions);

double toleranceOf(double size) { return 1e-9 * size; }

template <int N> struct Seed {
  Index simplex;
  int from, to;
};

template <int N> std::array<Index, N - 1> ridgeOf(const ReferenceMesh<N> &mesh, const Seed<N> &seed) {
  std::array<Index, N - 1> ridge{};
  std::size_t m = 0;
  for (int v = 0; v < N + 1; ++v)
    if (v != seed.from && v != seed.to) ridge[m++] = mesh.simplices[at(seed.simplex)][at(v)];
  return ridge;
}

/// Some simplex that has the ridge: simplices are replaced by cuts, ridges in the plane are not.
template <int N> Seed<N> seedAt(const ReferenceMesh<N> &mesh, const std::array<Index, N - 1> &ridge) {
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    std::vector<int> off;
    for (int v = 0; v < N + 1; ++v)
      if (std::find(ridge.begin(), ridge.end(), mesh.simplices[at(s)][at(v)]) == ridge.end())
        off.push_back(v);
    if (off.size() == 2) return {s, off[0], off[1]};
  }
  throw std::logic_error("the ridge is gone");
}

template <int N> Seed<N> randomSeed(const ReferenceMesh<N> &mesh, std::mt19937 &random) {
  const Index s = static_cast<Index>(random() % mesh.simplices.size());
  const int from = static_cast<int>(random() % (N + 1));
  return {s, from, (from + 1 + static_cast<int>(random() % N)) % (N + 1)};
}

/// A random plane through the ridge.
template <int N> Plane<N> planeAt(const ReferenceMesh<N> &mesh, const Seed<N> &seed, std::mt19937 &random) {
  const auto ridge = ridgeOf(mesh, seed);
  Vec<N> normal;
  for (int k = 0; k < N; ++k) normal[k] = static_cast<double>(random()) / 2147483647.5 - 1;
  if constexpr (N == 3) normal = glm::cross(normal, mesh.nodes[at(ridge[1])] - mesh.nodes[at(ridge[0])]);
  return planeThrough(mesh.nodes[at(ridge[0])], normal);
}

template <int N> Index cut(ReferenceMesh<N> &mesh, const Plane<N> &plane, const Seed<N> &seed) {
  mesh.surfaces.push_back({SurfaceKind::reflexCut, 0, plane});
  return cutAlong<N>(mesh, toIndex(mesh.surfaces.size()) - 1, {{seed.simplex, seed.from, seed.to}},
                     toleranceOf(mesh.size));
}

template <int N> int signOf(const ReferenceMesh<N> &mesh, const Plane<N> &plane, Index node) {
  const double d = plane.distance(mesh.nodes[at(node)]);
  return d > toleranceOf(mesh.size) ? 1 : d < -toleranceOf(mesh.size) ? -1 : 0;
}

/// -1 or 1, or 0 for a simplex that the plane crosses.
template <int N> int sideOf(const ReferenceMesh<N> &mesh, const Plane<N> &plane, Index s) {
  int low = 0;
  int high = 0;
  for (const Index v : mesh.simplices[at(s)]) {
    low = std::min(low, signOf(mesh, plane, v));
    high = std::max(high, signOf(mesh, plane, v));
  }
  return low < 0 && high > 0 ? 0 : low + high;
}

/// Length or area of plane and mesh, from the crossed edges of each simplex.
template <int N> double sectionMeasure(const ReferenceMesh<N> &mesh, const Plane<N> &plane) {
  double sum = 0;
  for (Index s = 0; s < mesh.simplexCount(); ++s) {
    if (sideOf(mesh, plane, s) != 0) continue;
    std::vector<Vec<N>> points;
    const auto &v = mesh.simplices[at(s)];
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (signOf(mesh, plane, v[i]) == 0) points.push_back(mesh.nodes[at(v[i])]);
      for (std::size_t k = i + 1; k < v.size(); ++k) {
        if (signOf(mesh, plane, v[i]) * signOf(mesh, plane, v[k]) >= 0) continue;
        const double a = plane.distance(mesh.nodes[at(v[i])]);
        const double b = plane.distance(mesh.nodes[at(v[k])]);
        points.push_back(mesh.nodes[at(v[i])] + a / (a - b) * (mesh.nodes[at(v[k])] - mesh.nodes[at(v[i])]));
      }
    }
    if constexpr (N == 2) {
      sum += glm::length(points.at(1) - points.at(0));
    } else {
      Vec<3> centre{0.0};
      for (const Vec<3> &p : points) centre += p / static_cast<double>(points.size());
      const Vec<3> u = glm::normalize(points[0] - centre);
      const Vec<3> w = glm::cross(plane.normal, u);
      std::sort(points.begin(), points.end(), [&](const Vec<3> &a, const Vec<3> &b) {
        return std::atan2(glm::dot(a - centre, w), glm::dot(a - centre, u)) <
               std::atan2(glm::dot(b - centre, w), glm::dot(b - centre, u));
      });
      for (std::size_t k = 0; k < points.size(); ++k)
        sum += glm::length(glm::cross(points[k] - centre, points[(k + 1) % points.size()] - centre)) / 2;
    }
  }
  return sum;
}

template <int N> void expectSoundAfterCut(const ReferenceMesh<N> &mesh) {
  EXPECT_EQ(brokenInvariants(mesh, true), std::vector<std::string>{}); // slivers may be flat by rounding
}

template <int N> std::vector<std::string> convexExamples() {
  if constexpr (N == 2) return {"square_2d", "pentagon_2d", "square_2d_second"};
  else return {"tetrahedron", "tapered_brick", "icosahedron", "house"};
}

/// Calls visit(mesh, random) for meshes of convex domains.
template <int N, typename Visit> void forConvexMeshes(Visit visit) {
  for (const std::string &name : convexExamples<N>())
    for (const double edgeLength : {0.0, 0.6})
      for (std::uint32_t seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE(name + ", edge length " + std::to_string(edgeLength) + ", seed " + std::to_string(seed));
        std::mt19937 random(seed + 100);
        visit(fill(loadExample<N>(name), edgeLength, seed), random);
      }
}

TYPED_TEST(PlaneCut, SeparatesTheSigns) {
  constexpr int N = TypeParam::value;
  int cuts = 0;
  forConvexMeshes<N>([&](const ReferenceMesh<N> &start, std::mt19937 &random) {
    for (int trial = 0; trial < 6; ++trial) {
      ReferenceMesh<N> mesh = start;
      const Seed<N> seed = randomSeed(mesh, random);
      const auto ridge = ridgeOf(mesh, seed);
      const Plane<N> plane = planeAt(mesh, seed, random);
      const double section = sectionMeasure(mesh, plane);
      const Index faces = cut(mesh, plane, seed);
      expectSoundAfterCut(mesh);
      EXPECT_NEAR(measureOf(mesh), measureOf(start), 1e-12 * mesh.size);
      for (Index f = 0; f + 1 < toIndex(mesh.surfaces.size()); ++f)
        EXPECT_NEAR(surfaceMeasure(mesh, f), surfaceMeasure(start, f), 1e-11);
      if (section < 1e-6) { // the plane touches the domain at the ridge only
        EXPECT_EQ(faces, 0);
        EXPECT_EQ(mesh.simplices, start.simplices);
        continue;
      }
      ++cuts;
      EXPECT_GT(faces, 0);
      const Index surface = toIndex(mesh.surfaces.size()) - 1;
      EXPECT_NEAR(surfaceMeasure(mesh, surface), section, 1e-9);
      const auto parts = buildParts(mesh, {});
      ASSERT_EQ(parts.parts.size(), 2U);
      std::map<Index, int> side;
      for (Index s = 0; s < mesh.simplexCount(); ++s) {
        const int here = sideOf(mesh, plane, s);
        ASSERT_NE(here, 0) << "simplex " << s << " is crossed still";
        const auto known = side.emplace(parts.partOfSimplex[at(s)], here).first;
        EXPECT_EQ(known->second, here) << "the parts hang together across the plane";
      }
      // The same cut again.
      const ReferenceMesh<N> once = mesh;
      const Index again = cut(mesh, plane, seedAt(mesh, ridge));
      EXPECT_EQ(again, 0);
      EXPECT_EQ(mesh.simplices, once.simplices);
      EXPECT_EQ(mesh.tags, once.tags);
    }
  });
  EXPECT_GT(cuts, 40);
}

// Later cuts run through earlier ones: the parts of a convex domain are the cells of the planes' arrangement.
TYPED_TEST(PlaneCut, CutsCrossOneAnother) {
  constexpr int N = TypeParam::value;
  std::size_t mostParts = 0;
  forConvexMeshes<N>([&](ReferenceMesh<N> mesh, std::mt19937 &random) {
    const double measure = measureOf(mesh);
    std::vector<Plane<N>> planes;
    std::vector<double> sizes;
    const Index facets = toIndex(mesh.surfaces.size());
    for (int k = 0; k < 3; ++k) {
      const Seed<N> seed = randomSeed(mesh, random);
      const Plane<N> plane = planeAt(mesh, seed, random);
      if (sectionMeasure(mesh, plane) < 1e-6) continue;
      sizes.push_back(sectionMeasure(mesh, plane));
      planes.push_back(plane);
      cut(mesh, plane, seed);
      expectSoundAfterCut(mesh);
    }
    EXPECT_NEAR(measureOf(mesh), measure, 1e-12 * mesh.size);
    for (std::size_t k = 0; k < planes.size(); ++k)
      EXPECT_NEAR(surfaceMeasure(mesh, facets + toIndex(k)), sizes[k], 1e-9) << "split surface " << k;
    const auto parts = buildParts(mesh, {});
    std::map<std::vector<int>, Index> partOf;
    for (Index s = 0; s < mesh.simplexCount(); ++s) {
      std::vector<int> signs;
      for (const Plane<N> &plane : planes) signs.push_back(sideOf(mesh, plane, s));
      const auto known = partOf.emplace(signs, parts.partOfSimplex[at(s)]).first;
      EXPECT_EQ(known->second, parts.partOfSimplex[at(s)]);
    }
    EXPECT_EQ(partOf.size(), parts.parts.size());
    mostParts = std::max(mostParts, parts.parts.size());
  });
  EXPECT_GE(mostParts, N == 2 ? 6U : 7U);
}

// A plane through faces that are there already needs no new nodes, even if it is off by next to nothing.
TYPED_TEST(PlaneCut, UsesFacesInThePlane) {
  constexpr int N = TypeParam::value;
  for (const double shift : {0.0, 1e-11, -1e-11}) {
    const ReferenceMesh<N> start = fill(loadExample<N>(convexExamples<N>()[1]), 0, 3);
    for (Index s = 0; s < start.simplexCount(); ++s)
      for (int i = 0; i < N + 1; ++i) {
        if (start.neighbors[at(s)][at(i)] == kNone) continue;
        ReferenceMesh<N> mesh = start;
        Plane<N> plane = planeThrough(mesh.nodes[at(mesh.sortedFace(s, i)[0])], mesh.faceNormal(s, i));
        plane.offset += shift;
        const Seed<N> seed{s, i, i == 0 ? 1 : 0};
        const Index faces = cut(mesh, plane, seed);
        EXPECT_GT(faces, 0);
        EXPECT_NE(mesh.tags[at(s)][at(i)], kNone) << "the face was in the plane already";
        EXPECT_EQ(mesh.simplices[at(s)], start.simplices[at(s)]);
        if (mesh.simplices == start.simplices) {
          EXPECT_EQ(mesh.nodes, start.nodes);
        }
        expectSoundAfterCut(mesh);
      }
  }
}

// Only the component that holds the seed is cut: one prong of a U, not the other.
TYPED_TEST(PlaneCut, StaysInItsComponent) {
  constexpr int N = TypeParam::value;
  const std::vector<Vec<2>> u{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  Domain<N> domain;
  if constexpr (N == 2) {
    domain.vertices = u;
    for (Index k = 0; k < 8; ++k) domain.facets.push_back({{{k, (k + 1) % 8}}});
  } else {
    domain = prism(u, 0, 1);
  }
  int tried = 0;
  const ReferenceMesh<N> start = fill(domain, 0.5, 1);
  for (Index s = 0; s < start.simplexCount(); ++s)
    for (int from = 0; from < N + 1; ++from)
      for (int to = 0; to < from; ++to) {
        const Seed<N> seed{s, from, to};
        const auto ridge = ridgeOf(start, seed);
        // In the left prong, and level: then the plane y = constant holds it and meets both prongs.
        const double y = start.nodes[at(ridge[0])].y;
        bool fits = y > 1.05 && y < 1.95;
        for (const Index v : ridge)
          fits &= std::abs(start.nodes[at(v)].y - y) < 1e-9 && start.nodes[at(v)].x < 1.5;
        if (!fits || tried > 20) continue;
        ++tried;
        ReferenceMesh<N> mesh = start;
        Vec<N> up{0.0};
        up[1] = 1;
        cut(mesh, planeThrough(mesh.nodes[at(ridge[0])], up), seed);
        expectSoundAfterCut(mesh);
        EXPECT_NEAR(surfaceMeasure(mesh, toIndex(mesh.surfaces.size()) - 1), 1, 1e-9);
        const auto parts = buildParts(mesh, {});
        EXPECT_EQ(parts.parts.size(), 2U);
        for (std::size_t v = 0; v < mesh.nodes.size(); ++v)
          if (v >= start.nodes.size()) {
            EXPECT_LT(mesh.nodes[v].x, 1.5) << "a node in the other prong";
          }
      }
  EXPECT_GT(tried, 0);
}

} // namespace
} // namespace dualblock::test
