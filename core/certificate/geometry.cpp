// Check 4: every block is positive, certified by the Bezier coefficients of its Jacobian determinant, and the
// blocks' volumes add up to the domain's. The determinant is built here from its definition by polynomial
// multiplication, not by the construction's formula.
#include <cmath>
#include <cstdio>
#include <limits>

#include "certificate/checks.h"

namespace dualblock {
namespace {

/// Up to 27 numbers: a block's determinant has no more coefficients, and there are many blocks.
class Coefficients {
public:
  void assign(std::size_t count, double value) {
    size_ = count;
    std::fill(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(count), value);
  }
  double &operator[](std::size_t k) { return items_[k]; }
  double operator[](std::size_t k) const { return items_[k]; }
  double *begin() { return items_.data(); }
  double *end() { return items_.data() + size_; }
  const double *begin() const { return items_.data(); }
  const double *end() const { return items_.data() + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

private:
  std::array<double, 27> items_;
  std::size_t size_ = 0;
};

/// A polynomial in Bernstein form with the given degree per axis (0 beyond N).
struct Bernstein {
  std::array<int, 3> degree{};
  Coefficients c; // first axis fastest

  std::size_t index(int i, int j, int k) const {
    const int place = i + (degree[0] + 1) * (j + (degree[1] + 1) * k);
    return at(place);
  }
  std::size_t size() const { return index(degree[0], degree[1], degree[2]) + 1; }
};

/// C(a, i) C(b, p) / C(a + b, i + p), the weight of a product of coefficients along one axis, for a + b up
/// to 2.
double productWeight(int a, int i, int b, int p) {
  constexpr double kBinomial[3][3] = {{1, 0, 0}, {1, 1, 0}, {1, 2, 1}};
  return kBinomial[a][i] * kBinomial[b][p] / kBinomial[a + b][i + p];
}

template <typename Visit> void forIndices(const std::array<int, 3> &degree, Visit visit) {
  for (int k = 0; k <= degree[2]; ++k)
    for (int j = 0; j <= degree[1]; ++j)
      for (int i = 0; i <= degree[0]; ++i) visit(i, j, k);
}

Bernstein multiply(const Bernstein &a, const Bernstein &b) {
  Bernstein r;
  for (std::size_t axis = 0; axis < 3; ++axis) r.degree[axis] = a.degree[axis] + b.degree[axis];
  r.c.assign(r.size(), 0);
  forIndices(a.degree, [&](int i, int j, int k) {
    forIndices(b.degree, [&](int p, int q, int s) {
      const double w = productWeight(a.degree[0], i, b.degree[0], p) *
                       productWeight(a.degree[1], j, b.degree[1], q) *
                       productWeight(a.degree[2], k, b.degree[2], s);
      r.c[r.index(i + p, j + q, k + s)] += w * a.c[a.index(i, j, k)] * b.c[b.index(p, q, s)];
    });
  });
  return r;
}

void addTo(Bernstein &a, const Bernstein &b, double factor) {
  if (a.c.empty()) {
    a = b;
    for (double &x : a.c) x *= factor;
    return;
  }
  for (std::size_t n = 0; n < a.c.size(); ++n) a.c[n] += factor * b.c[n];
}

/// Coordinate `x` of the derivative of the block's map along `axis`.
template <int N> Bernstein derivative(const std::array<Vec<N>, 1 << N> &corners, int axis, int x) {
  // VTK's order: parameters of corner n.
  static constexpr int kParameters[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  Bernstein d;
  for (int a = 0; a < N; ++a) d.degree[static_cast<std::size_t>(a)] = a == axis ? 0 : 1;
  d.c.assign(d.size(), 0);
  for (std::size_t n = 0; n < corners.size(); ++n) {
    std::array<int, 3> p{kParameters[n][0], kParameters[n][1], kParameters[n][2]};
    const double sign = p[static_cast<std::size_t>(axis)] == 1 ? 1 : -1;
    p[static_cast<std::size_t>(axis)] = 0;
    d.c[d.index(p[0], p[1], p[2])] += sign * corners[n][x];
  }
  return d;
}

template <int N> Bernstein determinant(const std::array<Vec<N>, 1 << N> &corners) {
  std::array<std::array<Bernstein, N>, N> d; // d[axis][coordinate]
  for (int axis = 0; axis < N; ++axis)
    for (int x = 0; x < N; ++x)
      d[static_cast<std::size_t>(axis)][static_cast<std::size_t>(x)] = derivative<N>(corners, axis, x);
  Bernstein sum;
  if constexpr (N == 2) {
    addTo(sum, multiply(d[0][0], d[1][1]), 1);
    addTo(sum, multiply(d[0][1], d[1][0]), -1);
  } else {
    for (std::size_t x = 0; x < 3; ++x) { // by the third row's minors
      const std::size_t y = (x + 1) % 3;
      const std::size_t z = (x + 2) % 3;
      Bernstein minor;
      addTo(minor, multiply(d[0][y], d[1][z]), 1);
      addTo(minor, multiply(d[0][z], d[1][y]), -1);
      addTo(sum, multiply(minor, d[2][x]), 1);
    }
  }
  return sum;
}

/// One half of the polynomial along an axis, by de Casteljau.
Bernstein half(const Bernstein &whole, std::size_t axis, bool upper) {
  Bernstein r = whole;
  const int n = whole.degree[axis];
  std::array<int, 3> lines = whole.degree;
  lines[axis] = 0;
  forIndices(lines, [&](int i, int j, int k) {
    std::array<int, 3> at{i, j, k};
    std::vector<double> row;
    for (int m = 0; m <= n; ++m) {
      at[axis] = m;
      row.push_back(whole.c[whole.index(at[0], at[1], at[2])]);
    }
    for (int level = 0; level <= n; ++level) {
      at[axis] = upper ? n - level : level;
      r.c[r.index(at[0], at[1], at[2])] = upper ? row.back() : row[0];
      for (int m = 0; m + level < n; ++m) {
        const auto u = static_cast<std::size_t>(m);
        if (!upper) row[u] = (row[u] + row[u + 1]) / 2;
      }
      if (upper)
        for (int m = n; m > level; --m) {
          const auto u = static_cast<std::size_t>(m);
          row[u] = (row[u] + row[u - 1]) / 2;
        }
    }
  });
  return r;
}

int signWithin(const Bernstein &p, double error, int depth) {
  if (*std::min_element(p.c.begin(), p.c.end()) > error) return 1;
  // The coefficients at the corners are values of the determinant.
  for (int k = 0; k <= p.degree[2]; k += std::max(p.degree[2], 1))
    for (int j = 0; j <= p.degree[1]; j += std::max(p.degree[1], 1))
      for (int i = 0; i <= p.degree[0]; i += std::max(p.degree[0], 1))
        if (p.c[p.index(i, j, k)] <= error) return -1;
  if (depth == 0) return 0;
  const std::size_t axis = static_cast<std::size_t>(depth % 3);
  const std::size_t split = p.degree[axis] > 0 ? axis : 0;
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
template <int N> double domainMeasure(const CertificateInput<N> &in, double &surface) {
  std::vector<bool> outer(in.domain.facets.size(), false);
  for (Index s = 0; s < in.mesh.simplexCount(); ++s)
    for (int i = 0; i < N + 1; ++i)
      if (in.mesh.neighbors[at(s)][i] == kNone && in.mesh.tags[at(s)][i] != kNone)
        outer[at(FaceTag::surface(in.mesh.tags[at(s)][i]))] = true;
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

std::string scientific(double x) {
  char text[32]; // a stream would bring 28 kB (gzip) of locales into the module
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

/// Sign (see jacobianSign) and ratio of the smallest to the largest coefficient of a block's determinant.
template <int N> int signOf(const Bernstein &p, const std::array<Vec<N>, 1 << N> &corners, double &ratio) {
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

template <int N> int jacobianSign(const std::array<Vec<N>, 1 << N> &corners, double &ratio) {
  return signOf<N>(determinant<N>(corners), corners, ratio);
}

template <int N> void checkGeometry(const CertificateInput<N> &in, Certificate &certificate) {
  certificate.worstCoefficient = std::numeric_limits<double>::infinity();
  double sum = 0;
  for (Index b = 0; b < toIndex(in.primal.blocks.size()); ++b) {
    std::array<Vec<N>, 1 << N> corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
      corners[k] = in.primal.positions[at(in.primal.blocks[at(b)].nodes[k])];
    const Bernstein p = determinant<N>(corners);
    double ratio = 0;
    const int sign = signOf<N>(p, corners, ratio);
    certificate.worstCoefficient = std::min(certificate.worstCoefficient, ratio);
    if (sign <= 0)
      certificate.fail(Check::geometry,
                       sign < 0
                           ? "block " + std::to_string(b) + " is inverted or flat at a point"
                           : "block " + std::to_string(b) + " could not be shown to be positive everywhere",
                       {{"block", b}});
    double mean = 0;
    for (const double c : p.c) mean += c;
    sum += mean / static_cast<double>(p.c.size());
  }
  double surface = 0;
  certificate.domainMeasure = domainMeasure(in, surface);
  certificate.meshMeasure = sum;
  const double allowed = 1e-10 * std::abs(certificate.domainMeasure) + 2 * in.facetDeviation * surface;
  certificate.isExact = std::abs(sum - certificate.domainMeasure) <= allowed;
  if (!certificate.isExact && !isBent(in))
    certificate.fail(Check::geometry, "the blocks' " + std::string(N == 2 ? "areas" : "volumes") +
                                          " add up to " + scientific(sum) + " instead of the domain's " +
                                          scientific(certificate.domainMeasure));
}

template int jacobianSign<2>(const std::array<Vec<2>, 4> &, double &);
template int jacobianSign<3>(const std::array<Vec<3>, 8> &, double &);
template void checkGeometry(const CertificateInput<2> &, Certificate &);
template void checkGeometry(const CertificateInput<3> &, Certificate &);

} // namespace dualblock
