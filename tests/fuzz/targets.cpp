#include "fuzz/targets.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string_view>
#include <variant>

#include "io/read_json.h"
#include "io/read_off.h"
#include "io/read_poly.h"
#include "pipeline.h"
#include "support/voxels.h"

namespace dualblock::fuzz {
namespace {

std::string_view textOf(const std::uint8_t *data, std::size_t size) {
  return {reinterpret_cast<const char *>(data), size};
}

/// What a reader takes is as sound as its format promises, or preparation says what is not.
template <typename Read> void readAndPrepare(const Read &read) {
  auto domain = read();
  if (!domain.ok()) return;
  std::visit([](const auto &d) { (void)prepareDomain(d, 1e-6); }, domain.value());
}

class Bytes {
public:
  Bytes(const std::uint8_t *data, std::size_t size) : data_(data), size_(size) {}
  unsigned next() { return place_ < size_ ? data_[place_++] : 0; }
  double real(double low, double high) { return low + (high - low) * (256 * next() + next()) / 65535.0; }
  bool done() const { return place_ >= size_; }

private:
  const std::uint8_t *data_;
  std::size_t size_;
  std::size_t place_ = 0;
};

/// Any triangles between a few points of a small grid: mostly no solid at all.
Domain<3> soup(Bytes &bytes) {
  Domain<3> domain;
  const unsigned count = 4 + bytes.next() % 6;
  for (unsigned v = 0; v < count; ++v) {
    const unsigned x = bytes.next();
    const unsigned y = bytes.next();
    domain.vertices.emplace_back(x % 5, x / 5 % 5, y % 5);
  }
  while (!bytes.done() && domain.facets.size() < 24) {
    const auto vertex = [&] { return static_cast<Index>(bytes.next() % count); };
    domain.facets.push_back({{{vertex(), vertex(), vertex()}}});
  }
  return domain;
}

/// Cells of a 3^3 grid with planes anywhere, then sheared: always a solid, unless it is empty.
Domain<3> voxels(Bytes &bytes) {
  unsigned long cells = 0;
  for (int k = 0; k < 4; ++k) cells = cells << 8 | bytes.next();
  Domain<3> domain =
      test::voxelDomain(3, [&](int i, int j, int k) { return (cells >> (9 * i + 3 * j + k) & 1) != 0; });
  std::array<std::array<double, 4>, 3> planes{};
  for (auto &axis : planes)
    for (std::size_t k = 1; k < 4; ++k) axis[k] = axis[k - 1] + bytes.real(0.2, 2);
  const double a = bytes.real(-1, 1);
  const double b = bytes.real(-1, 1);
  for (Vec<3> &v : domain.vertices) {
    for (int k = 0; k < 3; ++k) v[k] = planes[at(k)][static_cast<std::size_t>(v[k])];
    v = {v.x + a * v.y, v.y + b * v.z, v.z};
  }
  return domain;
}

/// A prism over a star-shaped polygon: always a solid.
Domain<3> star(Bytes &bytes) {
  const Index n = static_cast<Index>(3 + bytes.next() % 14);
  Domain<3> domain;
  const double top = bytes.real(0.1, 3);
  for (const double height : {0.0, top})
    for (Index k = 0; k < n; ++k) {
      const double angle = 6.283185307179586 * (k + (height == 0 ? bytes.real(-0.3, 0.3) : 0)) / n;
      const double radius = height == 0 ? bytes.real(0.3, 2) : 0;
      if (height == 0) domain.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
      else domain.vertices.emplace_back(domain.vertices[at(k)].x, domain.vertices[at(k)].y, top);
    }
  std::vector<Index> base;
  std::vector<Index> roof;
  for (Index k = 0; k < n; ++k) {
    base.insert(base.begin(), k);
    roof.push_back(n + k);
    domain.facets.push_back({{{k, (k + 1) % n, n + (k + 1) % n, n + k}}});
  }
  domain.facets.push_back({{base}});
  domain.facets.push_back({{roof}});
  return domain;
}

} // namespace

void readJsonTarget(const std::uint8_t *data, std::size_t size) {
  readAndPrepare([&] { return readJson(textOf(data, size)); });
}

void readOffTarget(const std::uint8_t *data, std::size_t size) {
  readAndPrepare([&] { return readOff(textOf(data, size)); });
}

void readPolyTarget(const std::uint8_t *data, std::size_t size) {
  if (size == 0) return;
  readAndPrepare([&] { return readPoly(textOf(data + 1, size - 1), data[0] % 2 == 1); });
}

void pipelineTarget(const std::uint8_t *data, std::size_t size) {
  Bytes bytes(data, std::min<std::size_t>(size, 200));
  const unsigned kind = bytes.next() % 3;
  const Domain<3> domain = kind == 0 ? soup(bytes) : kind == 1 ? voxels(bytes) : star(bytes);
  PipelineOptions options;
  if (bytes.next() % 4 == 1) options.edgeLength = 0.3 * domainSize(domain.vertices);
  if (bytes.next() % 4 == 1) options.seed = bytes.next();
  const auto result = runPipeline<3>(domain, options);
  if (kind == 0 || domain.facets.empty()) return;
  if (result.ok() && result.value().certificate.valid) return;
  std::fprintf(stderr, "no certified mesh: %s\n",
               result.ok() ? result.value().certificate.failures[0].message.c_str()
                           : result.error().message.c_str());
  std::abort();
}

} // namespace dualblock::fuzz
