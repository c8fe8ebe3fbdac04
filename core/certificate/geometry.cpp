// Check 4: every block is positive, certified by the Bezier coefficients of its Jacobian determinant, and the
// blocks' volumes add up to the domain's. The determinant is built here from its definition by polynomial
// multiplication, not by the construction's formula.
#include <cmath>
#include <cstdio>
#include <limits>

#include "certificate/checks.h"

namespace dualblock {
namespace {

using Degree = std::array<int, 3>; // per axis; 0 beyond the dimension

constexpr Degree operator+(const Degree &a, const Degree &b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// A polynomial in Bernstein form.
template <Degree D> struct Bernstein {
  static constexpr std::size_t index(int i, int j, int k) {
    return at(i + (D[0] + 1) * (j + (D[1] + 1) * k));
  }
  static constexpr std::size_t kSize = index(D[0], D[1], D[2]) + 1;
  std::array<double, kSize> c{}; // first axis fastest
};

template <typename Visit> constexpr void forIndices(const Degree &degree, Visit visit) {
  for (int k = 0; k <= degree[2]; ++k)
    for (int j = 0; j <= degree[1]; ++j)
      for (int i = 0; i <= degree[0]; ++i) visit(i, j, k);
}

/// C(a, i) C(b, p) / C(a + b, i + p), the weight of a product of coefficients along one axis, for a + b up
/// to 2.
constexpr double productWeight(int a, int i, int b, int p) {
  constexpr double kBinomial[3][3] = {{1, 0, 0}, {1, 1, 0}, {1, 2, 1}};
  return kBinomial[a][i] * kBinomial[b][p] / kBinomial[a + b][i + p];
}

/// One term of a product: coefficients of the factors, of the product, and the weight.
struct Term {
  std::size_t a, b, to;
  double weight;
};

template <Degree A, Degree B> constexpr auto productTerms() {
  std::array<Term, Bernstein<A>::kSize * Bernstein<B>::kSize> terms{};
  std::size_t n = 0;
  forIndices(A, [&](int i, int j, int k) {
    forIndices(B, [&](int p, int q, int s) {
      terms[n++] = {Bernstein<A>::index(i, j, k), Bernstein<B>::index(p, q, s),
                    Bernstein<A + B>::index(i + p, j + q, k + s),
                    productWeight(A[0], i, B[0], p) * productWeight(A[1], j, B[1], q) *
                        productWeight(A[2], k, B[2], s)};
    });
  });
  return terms;
}

/// Adds factor * a * b.
template <Degree A, Degree B>
void addProduct(Bernstein<A + B> &sum, const Bernstein<A> &a, const Bernstein<B> &b, double factor) {
  static constexpr auto kTerms = productTerms<A, B>(); // no block needs them anew, and there are many blocks
  for (const Term &t : kTerms) sum.c[t.to] += factor * t.weight * a.c[t.a] * b.c[t.b];
}

/// Coordinates of the derivative of the block's map along an axis, whose degree is D.
template <int N, Degree D>
std::array<Bernstein<D>, N> derivative(const std::array<Vec<N>, 1 << N> &corners, std::size_t axis) {
  // VTK's order: parameters of corner n.
  static constexpr int kParameters[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::array<Bernstein<D>, N> d;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    Degree p{kParameters[n][0], kParameters[n][1], kParameters[n][2]};
    const double sign = p[axis] == 1 ? 1 : -1;
    p[axis] = 0;
    for (int x = 0; x < N; ++x) d[at(x)].c[Bernstein<D>::index(p[0], p[1], p[2])] += sign * corners[n][x];
  }
  return d;
}

template <int N> constexpr Degree kJacobian = N == 2 ? Degree{1, 1, 0} : Degree{2, 2, 2};

template <int N> Bernstein<kJacobian<N>> determinant(const std::array<Vec<N>, 1 << N> &corners) {
  Bernstein<kJacobian<N>> sum;
  if constexpr (N == 2) {
    const auto u = derivative<2, Degree{0, 1, 0}>(corners, 0);
    const auto v = derivative<2, Degree{1, 0, 0}>(corners, 1);
    addProduct(sum, u[0], v[1], 1);
    addProduct(sum, u[1], v[0], -1);
  } else {
    const auto u = derivative<3, Degree{0, 1, 1}>(corners, 0);
    const auto v = derivative<3, Degree{1, 0, 1}>(corners, 1);
    const auto w = derivative<3, Degree{1, 1, 0}>(corners, 2);
    for (std::size_t x = 0; x < 3; ++x) { // by the third row's minors
      const std::size_t y = (x + 1) % 3;
      const std::size_t z = (x + 2) % 3;
      Bernstein<Degree{1, 1, 2}> minor;
      addProduct(minor, u[y], v[z], 1);
      addProduct(minor, u[z], v[y], -1);
      addProduct(sum, minor, w[x], 1);
    }
  }
  return sum;
}

/// One half of the polynomial along an axis, by de Casteljau.
template <Degree D> Bernstein<D> half(const Bernstein<D> &whole, std::size_t axis, bool upper) {
  Bernstein<D> r = whole;
  const int n = D[axis];
  Degree lines = D;
  lines[axis] = 0;
  forIndices(lines, [&](int i, int j, int k) {
    std::array<std::size_t, 3> place{}; // of the line's coefficients, from the end that stays
    std::array<double, 3> row{};
    for (int m = 0; m <= n; ++m) {
      Degree p{i, j, k};
      p[axis] = upper ? n - m : m;
      place[at(m)] = Bernstein<D>::index(p[0], p[1], p[2]);
      row[at(m)] = whole.c[place[at(m)]];
    }
    for (int level = 0; level <= n; ++level) {
      r.c[place[at(level)]] = row[0];
      for (int m = 0; m + level < n; ++m) row[at(m)] = (row[at(m)] + row[at(m + 1)]) / 2;
    }
  });
  return r;
}

template <Degree D> int signWithin(const Bernstein<D> &p, double error, int depth) {
  if (*std::min_element(p.c.begin(), p.c.end()) > error) return 1;
  // The coefficients at the corners are values of the determinant.
  for (int k = 0; k <= D[2]; k += std::max(D[2], 1))
    for (int j = 0; j <= D[1]; j += std::max(D[1], 1))
      for (int i = 0; i <= D[0]; i += std::max(D[0], 1))
        if (p.c[p.index(i, j, k)] <= error) return -1;
  if (depth == 0) return 0;
  const std::size_t axis = at(depth % 3);
  const std::size_t split = D[axis] > 0 ? axis : 0;
  const int low = signWithin(half(p, split, false), error, depth - 1);
  return low <= 0 ? low : signWithin(half(p, split, true), error, depth - 1);
}

double facetMeasure(const std::vector<Vec<2>> &v, const Facet &f, const Vec<2> &o) {
  const Vec<2> a = v[at(f.loops[0][0])] - o;
  const Vec<2> b = v[at(f.loops[0][1])] - o;
  return (a.x * b.y - a.y * b.x) / 2;
}

double facetMeasure(const std::vector<Vec<3>> &v, const Facet &f, const Vec<3> &o) {
  double sum = 0; // signed volume of the cone from o over the facet, as a fan of each loop
  for (const auto &loop : f.loops)
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      sum += glm::dot(v[at(loop[0])] - o, glm::cross(v[at(loop[k])] - o, v[at(loop[k + 1])] - o)) / 6;
  return sum;
}

Vec<2> facetNormal(const std::vector<Vec<2>> &v, const Facet &f) {
  const Vec<2> d = v[at(f.loops[0][1])] - v[at(f.loops[0][0])];
  return {d.y, -d.x};
}

Vec<3> facetNormal(const std::vector<Vec<3>> &v, const Facet &f) {
  Vec<3> sum{0.0};
  for (const auto &loop : f.loops)
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      sum += glm::cross(v[at(loop[k])] - v[at(loop[0])], v[at(loop[k + 1])] - v[at(loop[0])]);
  return sum;
}

/// The domain's area or volume from its facets alone; `surface` returns the measure of its boundary.
template <int N> double domainMeasure(const BlockInput<N> &in, double &surface) {
  std::vector<bool> outer(in.domain.facets.size(), false);
  const ReferenceMesh<N> &mesh = in.sideMesh();
  for (Index s = 0; s < mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i)
      if (mesh.neighbors[at(s)][i] == kNone && mesh.tags[at(s)][i] != kNone)
        outer[at(FaceTag::surface(mesh.tags[at(s)][i]))] = true;
  double sum = 0;
  surface = 0;
  const Vec<N> origin = in.domain.vertices[at(in.domain.facets[0].loops[0][0])];
  for (std::size_t f = 0; f < outer.size(); ++f) {
    if (!outer[f]) continue; // an interface inside the domain
    const Facet &facet = in.domain.facets[f];
    const Vec<N> normal = facetNormal(in.domain.vertices, facet);
    const bool outward = glm::dot(normal, in.mesh.surfaces[f].plane.normal) > 0;
    sum += (outward ? 1 : -1) * facetMeasure(in.domain.vertices, facet, origin);
    surface += glm::length(normal) / (N == 3 ? 2 : 1);
  }
  return sum;
}

/// What uneven facets may make of the domain's measure, as a share of it: beyond, nothing is shown by
/// agreement.
constexpr double kMostAllowed = 0.01;

/// Sign (see jacobianSign) and ratio of the smallest to the largest coefficient of a block's determinant.
template <int N>
int signOf(const Bernstein<kJacobian<N>> &p, const std::array<Vec<N>, 1 << N> &corners, double &ratio) {
  const auto [low, high] = std::minmax_element(p.c.begin(), p.c.end());
  ratio = *high > 0 ? *low / *high : -1;
  // Rounding: each coefficient is a mean of at most 64 determinants of coordinate differences, each exact to
  // a few units in the last place of the product of the lengths and of the coordinates that were subtracted.
  double extent = 0;
  double coordinate = 0;
  for (const Vec<N> &c : corners)
    for (int k = 0; k < N; ++k) {
      extent = std::max(extent, std::abs(c[k] - corners[0][k]));
      coordinate = std::max(coordinate, std::abs(c[k]));
    }
  const double unit = std::numeric_limits<double>::epsilon();
  const double error = 64 * unit * (extent + coordinate) * (N == 3 ? extent * extent : extent);
  return signWithin(p, error, 9);
}

} // namespace

template <int N> int jacobianSign(const std::array<Vec<N>, 1 << N> &corners, double &ratio, double *measure) {
  const auto p = determinant<N>(corners);
  if (measure) {
    *measure = 0;
    for (const double c : p.c) *measure += c / static_cast<double>(p.c.size());
  }
  return signOf<N>(p, corners, ratio);
}

template <int N> void checkGeometry(const BlockInput<N> &in, Certificate &certificate) {
  certificate.worstCoefficient = std::numeric_limits<double>::infinity();
  double sum = 0;
  for (Index b = 0; b < toIndex(in.blocks.blocks.size()); ++b) {
    std::array<Vec<N>, 1 << N> corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
      corners[k] = in.blocks.positions[at(in.blocks.blocks[at(b)][k])];
    double ratio = 0;
    double measure = 0;
    const int sign = jacobianSign<N>(corners, ratio, &measure);
    certificate.worstCoefficient = std::min(certificate.worstCoefficient, ratio);
    if (sign <= 0)
      certificate.fail(Check::geometry,
                       sign < 0
                           ? "block " + std::to_string(b) + " is inverted or flat at a point"
                           : "block " + std::to_string(b) + " could not be shown to be positive everywhere",
                       {{"block", b}});
    sum += measure;
  }
  double surface = 0;
  certificate.domainMeasure = domainMeasure(in, surface);
  certificate.meshMeasure = sum;
  const double allowed = 1e-10 * std::abs(certificate.domainMeasure) + 2 * in.facetDeviation * surface;
  if (allowed > kMostAllowed * std::abs(certificate.domainMeasure))
    certificate.fail(Check::geometry, "facets are up to " + scientific(in.facetDeviation) +
                                          " off their planes, too much for so thin a domain of " +
                                          scientific(certificate.domainMeasure) +
                                          (N == 2 ? " (area)" : " (volume)") + ": give a smaller tolerance");
  certificate.isExact = std::abs(sum - certificate.domainMeasure) <= allowed;
  if (!certificate.isExact && !isBent(in))
    certificate.fail(Check::geometry, "the blocks' " + std::string(N == 2 ? "areas" : "volumes") +
                                          " add up to " + scientific(sum) + " instead of the domain's " +
                                          scientific(certificate.domainMeasure));
}

template int jacobianSign<2>(const std::array<Vec<2>, 4> &, double &, double *);
template int jacobianSign<3>(const std::array<Vec<3>, 8> &, double &, double *);
template void checkGeometry(const BlockInput<2> &, Certificate &);
template void checkGeometry(const BlockInput<3> &, Certificate &);

} // namespace dualblock
